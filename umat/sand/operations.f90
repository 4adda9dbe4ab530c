!> The operations of the sand for the registry of models: umat/sand/row.c, which names them, and hypofab_model_row.h, which
!> says what they do. Parameters are in the order of PROPS; of a hypofab_state the sand uses thirteen numbers: stress, delta,
!> void ratio.
module umat_sand_operations
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
  use, intrinsic :: iso_c_binding, only: c_double, c_int, c_char, c_ptr, c_loc, c_null_char, c_null_ptr
  use umat_intergranular, only: intergranular_direction, delta_rate, slack_of_delta
  use umat_material, only: material_type, material_from_props, check_props, parameters, parameter_type, &
                           n_parameters
  use umat_rate, only: state_type, state_rate, linear_parts
  use umat_sands, only: sands, sand_type, n_sands
  use umat_status
  use umat_tensor, only: norm, trace
  use umat_update, only: options_type, report_type, update_state
  use umat_wolffersdorff, only: in_domain
  implicit none
  private
  public :: c_fault, c_state, out_of_domain, fail ! for the derivatives

  !> hypofab_parameter_info
  type, bind(C) :: c_parameter_info
    type(c_ptr) :: name, unit, description
    real(c_double) :: lower, upper, start, usual(2)
    integer(c_int) :: role, companion
  end type c_parameter_info

  !> hypofab_set_info
  type, bind(C) :: c_set_info
    type(c_ptr) :: name, description, source
  end type c_set_info

  !> What the sand uses of a hypofab_state.
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

  !> hypofab_fault
  type, bind(C) :: c_fault
    integer(c_int) :: about
    character(kind=c_char) :: name(32), text(256)
  end type c_fault

  ! C wants addresses of the tables' texts; these copies never change.
  type(parameter_type), target, protected :: parameter_table(n_parameters) = parameters
  type(sand_type), target, protected :: sand_table(n_sands) = sands

  !> hypofab_about
  integer(c_int), parameter :: about_nothing = 0, about_parameter = 1, about_variable = 2, about_argument = 3

contains

  !> Row of the parameter table, 0-based.
  subroutine sand_parameter(index, info) bind(C, name='hypofab_sand_parameter')
    integer(c_int), value :: index
    type(c_parameter_info), intent(out) :: info
    associate (p => parameter_table(index + 1))
      info = c_parameter_info(c_loc(p%name), c_loc(p%unit), c_loc(p%description), p%lower, p%upper, p%start, p%usual, &
                              p%role, p%companion - 1)
      if (p%must_be_given) info%start = ieee_value(info%start, ieee_quiet_nan)
    end associate
  end subroutine sand_parameter

  !> Built-in sand, 0-based, and the address of its parameters; null past the last.
  function sand_set(index, info) result(values) bind(C, name='hypofab_sand_set')
    integer(c_int), value :: index
    type(c_set_info), intent(inout) :: info
    type(c_ptr) :: values
    values = c_null_ptr
    if (index < 0 .or. index >= n_sands) return
    associate (s => sand_table(index + 1))
      info = c_set_info(c_loc(s%name), c_loc(s%description), c_loc(s%source))
      values = c_loc(s%props)
    end associate
  end function sand_set

  function check_material(props, fault) result(status) bind(C, name='hypofab_sand_check_material')
    real(c_double), intent(in) :: props(n_parameters)
    type(c_fault), intent(inout) :: fault
    integer(c_int) :: status
    character(len=256) :: message
    character(len=8) :: name
    call check_props(props, status, message, name)
    if (status /= status_ok) status = fail(fault, status, about_parameter, trim(name), trim(message))
  end function check_material

  function check_state(props, state, fault) result(status) bind(C, name='hypofab_sand_check_state')
    real(c_double), intent(in) :: props(n_parameters)
    type(c_state), intent(in) :: state
    type(c_fault), intent(inout) :: fault
    integer(c_int) :: status
    type(material_type) :: m
    character(len=24) :: value, bound

    status = status_ok
    m = material_from_props(props)
    if (.not. all(ieee_is_finite(state%stress))) then
      status = fail(fault, status_bad_state, about_variable, 'stress', 'stress is not finite')
    else if (.not. all(ieee_is_finite(state%delta))) then
      status = fail(fault, status_bad_state, about_variable, 'delta', 'delta is not finite')
    else if (.not. (ieee_is_finite(state%void_ratio) .and. state%void_ratio > 0.0_c_double)) then
      write (value, '(g0.6)') state%void_ratio
      status = fail(fault, status_bad_state, about_variable, 'void_ratio', &
                    'void_ratio = '//trim(value)//' is not admissible, expected void_ratio > 0')
    else if (.not. in_domain(m, state%stress, state%void_ratio)) then
      status = fail(fault, status_bad_state, about_variable, 'stress', &
                    'stress has a tensile or zero principal value, expected all three compressive'// &
                    merge(' (of T - p_t 1)', '               ', m%p_t > 0.0_c_double))
    else if (.not. delta_within_bound(m, state%delta)) then
      write (value, '(g0.6)') norm(state%delta)
      write (bound, '(g0.6)') m%R
      status = fail(fault, status_bad_state, about_variable, 'delta', &
                    '|delta| = '//trim(value)//' is not admissible, expected |delta| <= R = '//trim(bound))
    end if
  end function check_state

  function rate(props, state, stretching, state_rate_out, branch, fault) result(status) bind(C, name='hypofab_sand_rate')
    real(c_double), intent(in) :: props(n_parameters), stretching(6)
    type(c_state), intent(in) :: state
    type(c_state), intent(inout) :: state_rate_out
    integer(c_int), intent(inout) :: branch
    type(c_fault), intent(inout) :: fault
    integer(c_int) :: status
    type(material_type) :: m
    type(state_type) :: r
    integer :: taken

    m = material_from_props(props)
    if (.not. all(ieee_is_finite(stretching))) then
      status = fail(fault, status_bad_argument, about_argument, 'stretching', &
                    'stretching is not finite, expected six finite numbers')
      return
    else if (.not. delta_within_bound(m, state%delta)) then
      status = bad_state(fault)
      return
    end if
    call state_rate(m, state_type(state%stress, state%delta, state%void_ratio), stretching, r, taken, status)
    if (status /= status_ok) then
      status = out_of_domain(fault)
      return
    end if
    state_rate_out = c_state(r%stress, r%delta, r%void_ratio)
    branch = taken
  end function rate

  function linear_parts_c(props, state, reversal, jump, direction, branch, fault) result(status) &
    bind(C, name='hypofab_sand_linear_parts')
    real(c_double), intent(in) :: props(n_parameters)
    type(c_state), intent(in) :: state
    real(c_double), intent(inout) :: reversal(6, 6), jump(6), direction(6)
    integer(c_int), intent(inout) :: branch
    type(c_fault), intent(inout) :: fault
    integer(c_int) :: status
    type(material_type) :: m
    real(c_double) :: matrix(6, 6), vector(6), unit(6)

    matrix = 0.0_c_double ! gfortran 12 does not see that linear_parts defines it
    m = material_from_props(props)
    call linear_parts(m, state_type(state%stress, state%delta, state%void_ratio), matrix, vector, unit, status)
    if (status /= status_ok) then
      status = out_of_domain(fault)
      return
    end if
    reversal = transpose(matrix) ! C stores rows first
    jump = vector
    direction = unit
    branch = merge(branch_loading, branch_plain, m%intergranular)
  end function linear_parts_c

  pure subroutine variable_rates(props, state, stretching, branch, rate) bind(C, name='hypofab_sand_variable_rates')
    real(c_double), intent(in) :: props(n_parameters), stretching(6)
    type(c_state), intent(in) :: state
    integer(c_int), value :: branch
    real(c_double), intent(out) :: rate(7)
    type(material_type) :: m
    rate(1:6) = 0.0_c_double
    rate(7) = (1.0_c_double + state%void_ratio) * trace(stretching) ! theory.md Eq. (15)
    if (branch == branch_plain) return
    m = material_from_props(props)
    rate(1:6) = delta_rate(m, intergranular_direction(m, state%delta), stretching, branch)
  end subroutine variable_rates

  function update(props, options, state, strain, tangent, report, fault) result(status) bind(C, name='hypofab_sand_update')
    real(c_double), intent(in) :: props(n_parameters), strain(6)
    type(c_update_options), intent(in) :: options
    type(c_state), intent(inout) :: state
    real(c_double), intent(inout), optional :: tangent(6, 6)
    type(c_update_report), intent(inout) :: report
    type(c_fault), intent(inout) :: fault
    integer(c_int) :: status
    type(report_type) :: r
    type(state_type) :: s
    type(material_type) :: m
    real(c_double) :: matrix(6, 6)

    m = material_from_props(props, options%regularised /= 0)
    s = state_type(state%stress, state%delta, state%void_ratio)
    if (present(tangent)) then
      call update_state(m, options_type(options%tolerance, options%max_evaluations), s, strain, r, status, matrix)
    else
      call update_state(m, options_type(options%tolerance, options%max_evaluations), s, strain, r, status)
    end if
    report = c_update_report(r%evaluations, r%branch, r%substep, merge(1, 0, r%regularised))
    select case (status)
    case (status_ok)
      state = c_state(s%stress, s%delta, s%void_ratio)
      if (present(tangent)) tangent = transpose(matrix)
    case (status_bad_argument)
      status = fail(fault, status, about_argument, 'strain', &
                    'strain increment is not finite or above 1, expected six finite numbers up to 1')
    case (status_bad_state)
      status = bad_state(fault)
    case (status_step_limit)
      status = fail(fault, status, about_nothing, '', &
                    'the bound on rate evaluations was reached before the end of the strain increment')
    case default
      status = out_of_domain(fault)
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

  function out_of_domain(fault) result(status)
    type(c_fault), intent(inout) :: fault
    integer(c_int) :: status
    status = fail(fault, status_out_of_domain, about_nothing, '', &
                  'a principal stress became tensile or zero, or the void ratio left (0, inf)')
  end function out_of_domain

  function bad_state(fault) result(status)
    type(c_fault), intent(inout) :: fault
    integer(c_int) :: status
    status = fail(fault, status_bad_state, about_nothing, '', &
                  'state is not finite or has |delta| > R, expected finite stress, delta and void_ratio')
  end function bad_state

  !> Say why an operation failed, and return the status.
  function fail(fault, status, about, name, text) result(same)
    type(c_fault), intent(inout) :: fault
    integer, intent(in) :: status
    integer(c_int), intent(in) :: about
    character(len=*), intent(in) :: name, text
    integer(c_int) :: same
    fault%about = about
    call fill(fault%name, name)
    call fill(fault%text, text)
    same = int(status, c_int)
  end function fail

  !> A text for C, cut where there is no room.
  pure subroutine fill(place, text)
    character(kind=c_char), intent(inout) :: place(:)
    character(len=*), intent(in) :: text
    integer :: i, n
    n = min(len(text), size(place) - 1)
    do i = 1, n
      place(i) = text(i:i)
    end do
    place(n + 1) = c_null_char
  end subroutine fill

end module umat_sand_operations
