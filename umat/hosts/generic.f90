!> Entry points of the "generic" behaviour interface, by which every host with MGIS (MFrontGenericInterfaceSupport)
!> loads a constitutive law: OpenGeoSys, FEniCSx, code_aster, MOOSE, MoFEM, ... Unpack, call, pack. No physics here.
!>
!> A host finds the behaviour "hypofab" by the symbols of generic.c and calls hypofab_Tridimensional, hypofab_PlaneStrain,
!> hypofab_Axisymmetrical, hypofab_GeneralisedPlaneStrain or hypofab_AxisymmetricalGeneralisedPlaneStrain. Symmetric tensors
!> come in Mandel's notation, 11 22 33 and sqrt(2) times 12 13 23, of which the plane hypotheses have the first four and the
!> last one the first three. Material properties are PROPS(1..16) of the UMAT. Internal state variables are the
!> intergranular strain and STATEV(7..13) of the UMAT. Stress is total stress, tension positive, as in the UMAT.
!>
!> Loops stand where array expressions would be shorter: those of a length unknown to the compiler allocate memory.
module umat_generic
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_double, c_f_pointer, c_int, c_null_char, c_ptr
  use umat_host_state, only: n_statev, sv_void_ratio, unpack_state, pack_statev, pack_tangent
  use umat_kinds, only: wp
  use umat_material, only: material_type, material_from_props, check_props, n_parameters
  use umat_rate, only: state_type, continuum_stiffness
  use umat_status, only: status_ok, status_bad_argument, status_bad_state, status_step_limit
  use umat_tensor, only: norm, principal_values, trace, unit_tensor
  use umat_update, only: options_type, report_type, update_state
  use umat_wolffersdorff, only: hypoplastic_type, hypoplastic_tensors
  implicit none
  private
  public :: tridimensional, plane_strain, axisymmetrical, generalised_plane_strain
  public :: axisymmetrical_generalised_plane_strain

  !> The state of a point at the start or the end of a step; pointers that a behaviour does not need may be null.
  type, bind(C), public :: state_view
    type(c_ptr) :: gradients !< strain
    type(c_ptr) :: thermodynamic_forces !< stress
    type(c_ptr) :: mass_density
    type(c_ptr) :: material_properties
    type(c_ptr) :: internal_state_variables
    type(c_ptr) :: stored_energy
    type(c_ptr) :: dissipated_energy
    type(c_ptr) :: external_state_variables
  end type state_view

  !> What a host hands over; mgis_bv_BehaviourDataView of MGIS.
  type, bind(C), public :: behaviour_data
    type(c_ptr) :: error_message !< 512 characters, or null
    real(c_double) :: dt !< time step; sand as modelled here does not depend on it
    type(c_ptr) :: K !< in: K(1) says what is asked for, see request_type; out: the operator, rows first
    type(c_ptr) :: rdt !< the factor by which the next time step may grow; below 1 asks for a smaller step
    type(c_ptr) :: speed_of_sound
    type(state_view) :: s0 !< start of the step, never written
    type(state_view) :: s1 !< end of the step
  end type behaviour_data

  !> Operators that a host may ask for.
  integer, parameter :: no_operator = 0, elastic_operator = 1, secant_operator = 2, tangent_operator = 3
  integer, parameter :: consistent_operator = 4

  !> What K(1) asks for.
  type :: request_type
    logical :: prediction !< the operator at the start of the step alone; nothing is integrated
    integer :: operator
    logical :: speed_of_sound
  end type request_type

  integer, parameter :: success = 1, failure = -1
  integer, parameter :: message_length = 512
  real(wp), parameter :: sqrt2 = sqrt(2.0_wp)
  !> Components in Mandel's notation over tensor components.
  real(wp), parameter :: weight(6) = [1.0_wp, 1.0_wp, 1.0_wp, sqrt2, sqrt2, sqrt2]

contains

  !> Three dimensions.
  !> @param d what the host hands over
  !> @return 1, or -1 and a message: d%s1 is untouched and a smaller step is asked for
  function tridimensional(d) result(outcome) bind(C, name='hypofab_Tridimensional')
    type(behaviour_data), intent(inout) :: d
    integer(c_int) :: outcome
    outcome = integrate(d, 6)
  end function tridimensional

  !> Plane strain. Components of delta out of the plane are taken as zero.
  function plane_strain(d) result(outcome) bind(C, name='hypofab_PlaneStrain')
    type(behaviour_data), intent(inout) :: d
    integer(c_int) :: outcome
    outcome = integrate(d, 4)
  end function plane_strain

  !> Axial symmetry: rr zz tt rz.
  function axisymmetrical(d) result(outcome) bind(C, name='hypofab_Axisymmetrical')
    type(behaviour_data), intent(inout) :: d
    integer(c_int) :: outcome
    outcome = integrate(d, 4)
  end function axisymmetrical

  !> Plane strain with a given strain normal to the plane.
  function generalised_plane_strain(d) result(outcome) bind(C, name='hypofab_GeneralisedPlaneStrain')
    type(behaviour_data), intent(inout) :: d
    integer(c_int) :: outcome
    outcome = integrate(d, 4)
  end function generalised_plane_strain

  !> One dimension, along the radius: rr zz tt.
  function axisymmetrical_generalised_plane_strain(d) result(outcome) &
    bind(C, name='hypofab_AxisymmetricalGeneralisedPlaneStrain')
    type(behaviour_data), intent(inout) :: d
    integer(c_int) :: outcome
    outcome = integrate(d, 3)
  end function axisymmetrical_generalised_plane_strain

  !> Integrate the step of one point, or predict an operator.
  !> @param d what the host hands over
  !> @param n components of a symmetric tensor
  function integrate(d, n) result(outcome)
    type(behaviour_data), intent(inout) :: d
    integer, intent(in) :: n
    integer(c_int) :: outcome
    real(c_double), pointer :: start_strain(:), end_strain(:), start_stress(:), start_variables(:), props(:), K(:)
    type(request_type) :: request
    type(material_type) :: m
    type(state_type) :: state
    type(report_type) :: report
    real(wp) :: statev(n_statev), stress(6), strain(6), stiffness(6, 6), speed, pore_pressure
    character(len=message_length) :: message
    integer :: status, i

    call c_f_pointer(d%s0%gradients, start_strain, [n])
    call c_f_pointer(d%s1%gradients, end_strain, [n])
    call c_f_pointer(d%s0%thermodynamic_forces, start_stress, [n])
    call c_f_pointer(d%s0%internal_state_variables, start_variables, [n + n_statev - 6])
    call c_f_pointer(d%s1%material_properties, props, [n_parameters])
    call c_f_pointer(d%K, K, [n * n])

    outcome = failure
    call check_props(props, status, message)
    if (status == status_ok .and. .not. (all(ieee_is_finite(start_strain)) .and. all(ieee_is_finite(end_strain)) .and. &
                                         all(ieee_is_finite(start_stress)) .and. &
                                         all(ieee_is_finite(start_variables)))) then
      status = status_bad_argument
      message = 'strain, stress or state variables are not finite'
    end if
    if (status /= status_ok) then
      call reject(d, message)
      return
    end if

    request = request_from(K(1))
    m = material_from_props(props, regularised=.true.)
    strain = 0.0_wp
    do i = 1, n
      strain(i) = (end_strain(i) - start_strain(i)) / weight(i)
    end do
    stress = from_mandel(start_stress)
    statev = statev_from(start_variables, n)
    call unpack_state(m, stress, statev, state, pore_pressure)
    if (.not. request%prediction) then
      if (request%operator == consistent_operator) then
        call update_state(m, options_type(), state, strain, report, status, stiffness)
      else
        call update_state(m, options_type(), state, strain, report, status)
      end if
    end if
    ! There is no elasticity and no damage here: elastic and secant are the stiffness of a reversal of strain.
    if (status == status_ok .and. (request%prediction .or. request%operator /= consistent_operator)) &
      call continuum_stiffness(m, state, merge(strain, 0.0_wp, request%operator >= tangent_operator), stiffness, status)
    if (status == status_ok .and. request%speed_of_sound) call wave_speed(m, state, d%s1%mass_density, speed, status)
    if (status /= status_ok) then
      call reject(d, reason(status))
      return
    end if

    if (request%operator /= no_operator) call pack_operator(m, stiffness, n, K)
    if (request%speed_of_sound) call set(d%speed_of_sound, speed)
    if (.not. request%prediction) then
      pore_pressure = pore_pressure - m%K_w * trace(strain) ! as in the UMAT
      call pack_statev(m, state, pore_pressure, report, statev)
      stress = state%stress - pore_pressure * unit_tensor
      call pack(d%s1, stress, statev, n)
    end if
    outcome = success
  end function integrate

  !> What K(1) asks for: 0 integrates alone; 1 to 4 integrate and want the elastic, secant, tangent or consistent tangent
  !> operator at the end; -1 to -3 want the elastic, secant or tangent operator at the start and nothing else. With 100
  !> added the speed of sound is wanted too.
  pure function request_from(first) result(request)
    real(c_double), intent(in) :: first
    type(request_type) :: request
    integer :: code
    code = nint(max(-3.0_c_double, min(104.0_c_double, first)))
    request%speed_of_sound = code > 50
    if (request%speed_of_sound) code = code - 100
    request%prediction = code < 0
    request%operator = min(abs(code), consistent_operator)
  end function request_from

  !> A tensor from its first three, four or all six components in Mandel's notation.
  pure function from_mandel(values) result(t)
    real(c_double), intent(in) :: values(:)
    real(wp) :: t(6)
    integer :: i
    t = 0.0_wp
    do i = 1, size(values)
      t(i) = values(i)
    end do
    t = t / weight
  end function from_mandel

  !> STATEV of the UMAT, whose delta has engineering shear, from the internal state variables.
  pure function statev_from(variables, n) result(statev)
    real(c_double), intent(in) :: variables(:)
    integer, intent(in) :: n
    real(wp) :: statev(n_statev)
    integer :: i
    statev = 0.0_wp
    do i = 1, n
      statev(i) = weight(i) * variables(i) ! sqrt(2) of Mandel and sqrt(2) more: twice the tensor component
    end do
    do i = sv_void_ratio, n_statev
      statev(i) = variables(n + i - sv_void_ratio + 1)
    end do
  end function statev_from

  !> Stress and internal state variables at the end of the step.
  subroutine pack(s1, stress, statev, n)
    type(state_view), intent(in) :: s1
    real(wp), intent(in) :: stress(6), statev(n_statev)
    integer, intent(in) :: n
    real(c_double), pointer :: forces(:), variables(:)
    integer :: i
    call c_f_pointer(s1%thermodynamic_forces, forces, [n])
    call c_f_pointer(s1%internal_state_variables, variables, [n + n_statev - 6])
    do i = 1, n
      forces(i) = weight(i) * stress(i)
      variables(i) = statev(i) / weight(i)
    end do
    do i = sv_void_ratio, n_statev
      variables(n + i - sv_void_ratio + 1) = statev(i)
    end do
  end subroutine pack

  !> The stiffness in Mandel's notation, rows first, pore water included.
  pure subroutine pack_operator(m, stiffness, n, K)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: stiffness(6, 6)
    integer, intent(in) :: n
    real(c_double), intent(inout) :: K(:)
    real(c_double) :: ddsdde(6, 6)
    integer :: i, j
    call pack_tangent(m, stiffness, ddsdde)
    do i = 1, n
      do j = 1, n
        K(n * (i - 1) + j) = weight(i) * ddsdde(i, j) * weight(j)
      end do
    end do
  end subroutine pack_operator

  !> A bound of the speed of waves, for the time step of explicit hosts: sqrt(M/density), M above X:E:X of every branch's
  !> stiffness E for X = sym(n m) with any unit vectors n, m.
  !>
  !> |X| <= 1, That:X <= t, the largest principal value of That, and (That:d)(d:X) <= (That:X + |That|)/2 for any unit
  !> tensor d. So X:(L:d)(d:X) <= identity + dyad t (t + |That|)/2, which also bounds X:L:X; theory.md Eq. (13) has at
  !> most max(1, m_R, m_T) of it, and N adds at most |N|.
  !> @param density pointer to the mass density
  !> @param speed   [sqrt(stress/density)]
  !> @param status  status_bad_state without a positive density
  subroutine wave_speed(m, state, density, speed, status)
    type(material_type), intent(in) :: m
    type(state_type), intent(in) :: state
    type(c_ptr), intent(in) :: density
    real(wp), intent(out) :: speed
    integer, intent(out) :: status
    real(c_double), pointer :: rho
    type(hypoplastic_type) :: h
    real(wp) :: factor, t

    speed = 0.0_wp
    status = status_bad_state
    if (.not. c_associated(density)) return
    call c_f_pointer(density, rho)
    if (.not. rho > 0.0_c_double) return
    call hypoplastic_tensors(m, state%stress, state%void_ratio, h, status)
    if (status /= status_ok) return
    factor = 1.0_wp
    if (m%intergranular) factor = max(factor, m%m_R, m%m_T)
    t = maxval(principal_values(h%that))
    speed = sqrt((factor * (h%identity + h%dyad * t * 0.5_wp * (t + norm(h%that))) + norm(h%N) + m%K_w) / rho)
  end subroutine wave_speed

  !> Ask for a smaller step and say why.
  subroutine reject(d, message)
    type(behaviour_data), intent(inout) :: d
    character(len=*), intent(in) :: message
    character(kind=c_char), pointer :: text(:)
    real(c_double), pointer :: rdt
    integer :: i
    if (c_associated(d%rdt)) then
      call c_f_pointer(d%rdt, rdt)
      rdt = min(rdt, 0.5_c_double)
    end if
    if (.not. c_associated(d%error_message)) return
    call c_f_pointer(d%error_message, text, [message_length])
    do i = 1, min(len_trim(message), message_length - 1)
      text(i) = message(i:i)
    end do
    text(i) = c_null_char
  end subroutine reject

  !> Why a step was rejected.
  pure function reason(status) result(text)
    integer, intent(in) :: status
    character(len=:), allocatable :: text
    select case (status)
    case (status_bad_argument)
      text = 'strain increment is not finite or above 1'
    case (status_bad_state)
      text = 'the state is not admissible, or the speed of sound is asked for without a positive mass density'
    case (status_step_limit)
      text = 'the bound on rate evaluations was reached before the end of the strain increment'
    case default
      text = 'the void ratio left 0.001 to 100, or a stress 10 h_s: the state left the domain of the model'
    end select
  end function reason

  !> Write a number where a host wants it.
  subroutine set(target, value)
    type(c_ptr), intent(in) :: target
    real(wp), intent(in) :: value
    real(c_double), pointer :: number
    if (.not. c_associated(target)) return
    call c_f_pointer(target, number)
    number = real(value, c_double)
  end subroutine set

end module umat_generic
