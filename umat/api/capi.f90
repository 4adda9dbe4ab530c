!> The C face of the constitutive model: the procedures of hypofab.h, sections material, state and constitutive.
!>
!> Purposes, arguments and errors are documented in hypofab.h. A hypofab_material is sixteen doubles in the order of
!> PROPS, a hypofab_state thirteen doubles: stress, delta, void ratio.
module umat_capi
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use, intrinsic :: iso_c_binding, only: c_double, c_int, c_char, c_ptr, c_loc, c_null_char
  use umat_intergranular, only: intergranular_direction, delta_rate, slack_of_delta
  use umat_material, only: material_type, material_from_props, check_props, parameters, parameter_type, n_parameters
  use umat_rate, only: state_type, state_rate, linear_parts
  use umat_sands, only: sands, sand_type, n_sands, find_sand
  use umat_status
  use umat_tensor, only: norm, friction_angle
  use umat_update, only: options_type, report_type, update_state
  use umat_wolffersdorff, only: in_domain
  implicit none
  private
  public :: c_state, domain_message, fail ! for the other half of the C face

  !> hypofab_parameter_info
  type, bind(C) :: c_parameter_info
    type(c_ptr) :: name, unit, description
    real(c_double) :: lower, upper
  end type c_parameter_info

  !> hypofab_sand_info
  type, bind(C) :: c_sand_info
    type(c_ptr) :: name, description, source
  end type c_sand_info

  !> hypofab_state
  type, bind(C) :: c_state
    real(c_double) :: stress(6), delta(6), void_ratio
  end type c_state

  !> hypofab_update_options
  type, bind(C) :: c_update_options
    real(c_double) :: tolerance
    integer(c_int) :: max_evaluations, regularised
  end type c_update_options

  !> hypofab_update_report
  type, bind(C) :: c_update_report
    integer(c_int) :: evaluations, branch
    real(c_double) :: substep
    integer(c_int) :: regularised
  end type c_update_report

  ! C wants addresses of the tables' texts; these copies never change.
  type(parameter_type), target, protected :: parameter_table(n_parameters) = parameters
  type(sand_type), target, protected :: sand_table(n_sands) = sands

  !> hypofab_about
  integer(c_int), parameter :: about_nothing = 0, about_parameter = 1, about_variable = 2, about_argument = 3

  !> Messages that several procedures give.
  character(len=*), parameter :: domain_message = 'a principal stress became tensile or zero, or the void ratio left (0, inf)'
  character(len=*), parameter :: state_message = &
                                 'state is not finite or has |delta| > R, expected finite stress, delta and void_ratio'

  interface
    !> base/message.h
    subroutine set_message(about, name, name_length, text, length) bind(C, name='hypofab_set_message')
      import :: c_char, c_int
      integer(c_int), value :: about, name_length, length
      character(kind=c_char), intent(in) :: name(*), text(*)
    end subroutine set_message
  end interface

contains

  function parameter_describe(index, info) result(status) bind(C, name='hypofab_parameter_describe')
    integer(c_int), value :: index
    type(c_parameter_info), intent(out) :: info
    integer(c_int) :: status
    if (index < 0 .or. index >= n_parameters) then
      status = fail_number(status_bad_argument, 'parameter', index, n_parameters)
      return
    end if
    associate (p => parameter_table(index + 1))
      info = c_parameter_info(c_loc(p%name), c_loc(p%unit), c_loc(p%description), p%lower, p%upper)
    end associate
    status = status_ok
  end function parameter_describe

  pure function sand_count() result(count) bind(C, name='hypofab_sand_count')
    integer(c_int) :: count
    count = n_sands
  end function sand_count

  function sand_describe(index, info) result(status) bind(C, name='hypofab_sand_describe')
    integer(c_int), value :: index
    type(c_sand_info), intent(out) :: info
    integer(c_int) :: status
    if (index < 0 .or. index >= n_sands) then
      status = fail_number(status_bad_argument, 'sand', index, n_sands)
      return
    end if
    associate (s => sand_table(index + 1))
      info = c_sand_info(c_loc(s%name), c_loc(s%description), c_loc(s%source))
    end associate
    status = status_ok
  end function sand_describe

  function sand(name, props) result(status) bind(C, name='hypofab_sand')
    character(kind=c_char), intent(in) :: name(*)
    real(c_double), intent(inout) :: props(n_parameters)
    integer(c_int) :: status
    character(len=:), allocatable :: wanted, known
    integer :: i

    wanted = ''
    do i = 1, len(sands(1)%name)
      if (name(i) == c_null_char) exit
      wanted = wanted//name(i)
    end do
    i = find_sand(wanted)
    if (i > 0) then
      props = sands(i)%props
      status = status_ok
    else
      known = ''
      do i = 1, n_sands
        known = known//' '//sands(i)%name(:index(sands(i)%name, c_null_char) - 1)
      end do
      status = fail(status_bad_material, 'there is no sand "'//wanted//'", expected one of:'//known)
    end if
  end function sand

  function material_check(props) result(status) bind(C, name='hypofab_material_check')
    real(c_double), intent(in) :: props(n_parameters)
    integer(c_int) :: status
    character(len=256) :: message
    character(len=8) :: name
    call check_props(props, status, message, name)
    if (status /= status_ok) status = fail_about(status, about_parameter, trim(name), trim(message))
  end function material_check

  function state_check(props, state) result(status) bind(C, name='hypofab_state_check')
    real(c_double), intent(in) :: props(n_parameters)
    type(c_state), intent(in) :: state
    integer(c_int) :: status
    type(material_type) :: m
    character(len=24) :: value, bound

    status = material_check(props)
    if (status /= status_ok) return
    m = material_from_props(props)
    if (.not. all(ieee_is_finite(state%stress))) then
      status = fail_about(status_bad_state, about_variable, 'stress', 'stress is not finite')
    else if (.not. all(ieee_is_finite(state%delta))) then
      status = fail_about(status_bad_state, about_variable, 'delta', 'delta is not finite')
    else if (.not. (ieee_is_finite(state%void_ratio) .and. state%void_ratio > 0.0_c_double)) then
      write (value, '(g0.6)') state%void_ratio
      status = fail_about(status_bad_state, about_variable, 'void_ratio', 'void_ratio = '//trim(value)//' is not admissible, expected void_ratio > 0')
    else if (.not. in_domain(m, state%stress, state%void_ratio)) then
      status = fail_about(status_bad_state, about_variable, 'stress', 'stress has a tensile or zero principal value, expected all three compressive'// &
                    merge(' (of T - p_t 1)', '               ', m%p_t > 0.0_c_double))
    else if (.not. delta_within_bound(m, state%delta)) then
      write (value, '(g0.6)') norm(state%delta)
      write (bound, '(g0.6)') m%R
      status = fail_about(status_bad_state, about_variable, 'delta', '|delta| = '//trim(value)//' is not admissible, expected |delta| <= R = '// &
                    trim(bound))
    end if
  end function state_check

  function rate(props, state, stretching, state_rate_out, branch) result(status) bind(C, name='hypofab_rate')
    real(c_double), intent(in) :: props(n_parameters), stretching(6)
    type(c_state), intent(in) :: state
    type(c_state), intent(inout) :: state_rate_out
    integer(c_int), intent(inout), optional :: branch
    integer(c_int) :: status
    type(material_type) :: m
    type(state_type) :: r
    integer :: taken

    m = material_from_props(props)
    if (.not. all(ieee_is_finite(stretching))) then
      status = fail(status_bad_argument, 'stretching is not finite, expected six finite numbers')
      return
    else if (.not. delta_within_bound(m, state%delta)) then
      status = fail(status_bad_state, state_message)
      return
    end if
    call state_rate(m, state_type(state%stress, state%delta, state%void_ratio), stretching, r, taken, status)
    if (status /= status_ok) then
      status = fail(status, domain_message)
      return
    end if
    state_rate_out = c_state(r%stress, r%delta, r%void_ratio)
    if (present(branch)) branch = taken
  end function rate

  function linear_parts_c(props, state, reversal, jump, direction, branch) result(status) &
    bind(C, name='hypofab_linear_parts')
    real(c_double), intent(in) :: props(n_parameters)
    type(c_state), intent(in) :: state
    real(c_double), intent(inout) :: reversal(6, 6), jump(6), direction(6)
    integer(c_int), intent(inout) :: branch
    integer(c_int) :: status
    type(material_type) :: m
    real(c_double) :: matrix(6, 6), vector(6), unit(6)

    matrix = 0.0_c_double ! gfortran 12 does not see that linear_parts defines it
    m = material_from_props(props)
    call linear_parts(m, state_type(state%stress, state%delta, state%void_ratio), matrix, vector, unit, status)
    if (status /= status_ok) then
      status = fail(status, domain_message)
      return
    end if
    reversal = transpose(matrix) ! C stores rows first
    jump = vector
    direction = unit
    branch = merge(branch_loading, branch_plain, m%intergranular)
  end function linear_parts_c

  pure subroutine delta_rate_c(props, delta, stretching, branch, rate) bind(C, name='hypofab_delta_rate')
    real(c_double), intent(in) :: props(n_parameters), delta(6), stretching(6)
    integer(c_int), value :: branch
    real(c_double), intent(out) :: rate(6)
    type(material_type) :: m
    rate = 0.0_c_double
    if (branch == branch_plain) return
    m = material_from_props(props)
    rate = delta_rate(m, intergranular_direction(m, delta), stretching, branch)
  end subroutine delta_rate_c

  function update(props, options, state, strain, tangent, report) result(status) bind(C, name='hypofab_update')
    real(c_double), intent(in) :: props(n_parameters), strain(6)
    type(c_update_options), intent(in), optional :: options
    type(c_state), intent(inout) :: state
    real(c_double), intent(inout), optional :: tangent(6, 6)
    type(c_update_report), intent(inout), optional :: report
    integer(c_int) :: status
    type(options_type) :: o
    type(report_type) :: r
    type(state_type) :: s
    type(material_type) :: m
    logical :: regularised
    real(c_double) :: matrix(6, 6)

    status = material_check(props)
    if (status /= status_ok) return
    regularised = .false.
    if (present(options)) then
      regularised = options%regularised /= 0
      if (options%tolerance > 0.0_c_double) o%tolerance = options%tolerance
      if (options%max_evaluations > 0) o%max_evaluations = options%max_evaluations
    end if
    m = material_from_props(props, regularised)
    s = state_type(state%stress, state%delta, state%void_ratio)
    if (present(tangent)) then
      call update_state(m, o, s, strain, r, status, matrix)
    else
      call update_state(m, o, s, strain, r, status)
    end if
    if (present(report)) report = c_update_report(r%evaluations, r%branch, r%substep, merge(1, 0, r%regularised))
    select case (status)
    case (status_ok)
      state = c_state(s%stress, s%delta, s%void_ratio)
      if (present(tangent)) tangent = transpose(matrix)
    case (status_bad_argument)
      status = fail(status, 'strain increment is not finite or above 1, expected six finite numbers up to 1')
    case (status_bad_state)
      status = fail(status, state_message)
    case (status_step_limit)
      status = fail(status, 'the bound on rate evaluations was reached before the end of the strain increment')
    case default
      status = fail(status, domain_message)
    end select
  end function update

  !> Is delta finite and within the bound |delta| <= R, up to rounding? Any delta is where the model has none.
  pure function delta_within_bound(m, delta) result(within)
    type(material_type), intent(in) :: m
    real(c_double), intent(in) :: delta(6)
    logical :: within
    within = .not. m%intergranular
    if (.not. within) within = all(ieee_is_finite(delta)) .and. norm(delta) <= slack_of_delta * m%R
  end function delta_within_bound

  pure function friction_angle_c(stress) result(phi) bind(C, name='hypofab_friction_angle')
    real(c_double), intent(in) :: stress(6)
    real(c_double) :: phi
    phi = friction_angle(stress)
  end function friction_angle_c

  !> Keep a message for hypofab_last_message and return the status.
  function fail(status, message) result(same)
    integer, intent(in) :: status
    character(len=*), intent(in) :: message
    integer(c_int) :: same
    call set_message(about_nothing, '', 0_c_int, message, len(message, c_int))
    same = int(status, c_int)
  end function fail

  !> The same, with the parameter, state variable or argument that it is about.
  function fail_about(status, about, name, message) result(same)
    integer, intent(in) :: status
    integer(c_int), intent(in) :: about
    character(len=*), intent(in) :: name, message
    integer(c_int) :: same
    call set_message(about, name, len(name, c_int), message, len(message, c_int))
    same = int(status, c_int)
  end function fail_about

  !> The same for a number outside 0 .. n-1.
  function fail_number(status, what, number, n) result(same)
    integer, intent(in) :: status, n
    character(len=*), intent(in) :: what
    integer(c_int), intent(in) :: number
    integer(c_int) :: same
    character(len=12) :: given, last
    write (given, '(i0)') number
    write (last, '(i0)') n - 1
    same = fail(status, what//' number '//trim(given)//' does not exist, expected 0 to '//trim(last))
  end function fail_number

end module umat_capi
