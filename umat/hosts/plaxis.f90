!> User_Mod, the entry of PLAXIS for user-defined soil models: unpack, call, pack. No physics here.
!>
!> Sig is effective stress, tension positive, in the order xx yy zz xy yz zx; dEps has engineering shear. The state
!> variables are STATEV(1..13) of the UMAT with delta in PLAXIS' order (docs/plaxis.md), and a count of increments that a
!> point did not follow. Excess pore pressure is PLAXIS' own: state variable 8 stays zero. Names and units are in
!> plaxis_queries.f90. Nothing is printed or kept between calls.
module umat_plaxis
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use, intrinsic :: iso_c_binding, only: c_double, c_int
  use umat_host_state, only: n_statev, sv_delta, sv_void_ratio, sv_pore_pressure, sv_evaluations, &
                             unset_void_ratio, tensor_from_host, unpack_state, pack_statev, pack_tangent, &
                             swap_shear
  use umat_kinds, only: wp
  use umat_material, only: material_type, material_from_props, check_props, n_parameters
  use umat_rate, only: state_type, continuum_stiffness
  use umat_status, only: status_ok, status_bad_state, status_bad_argument, status_bad_material
  use umat_tensor, only: norm, trace
  use umat_update, only: options_type, report_type, update_state
  implicit none
  private
  public :: user_mod

  !> Parameters: those of the UMAT, then the initial delta. PLAXIS hands over fifty numbers.
  integer, parameter, public :: n_plaxis_parameters = n_parameters + 6
  integer, parameter :: n_props = 50
  !> State variables: those of the UMAT, then the count of increments not followed.
  integer, parameter, public :: n_plaxis_statev = n_statev + 1
  integer, parameter :: sv_dropped = n_plaxis_statev

  !> IDTask.
  integer, parameter :: task_initialise = 1, task_stress = 2, task_stiffness = 3, task_count = 4, task_attributes = 5
  integer, parameter :: task_elastic = 6

  !> Relative error of an increment. Below the default, because errors of hundreds of increments add up and the stress
  !> comes without the stiffness here, whose error control makes the steps of the UMAT shorter.
  real(wp), parameter :: tolerance = 2.5e-7_wp

  !> A point as PLAXIS hands it over, in the components of the UMAT.
  type :: point_type
    type(material_type) :: m !< drained
    real(wp) :: K_w !< bulk stiffness of the pore water; 0 where PLAXIS asks for drained behaviour [stress]
    real(wp) :: statev(n_statev)
    type(state_type) :: state
    logical :: unset !< has it no state variables yet?
  end type point_type

contains

  !> The host's entry; the fixed argument list of PLAXIS.
  !>
  !> iAbort is 1 for what can never succeed: an unknown task or model, parameters out of their bounds, numbers that are not
  !> finite in the stored state, undrained behaviour without K_w. A strain increment that cannot be integrated does not
  !> abort: PLAXIS tries such increments while it iterates. Sig and StVar are then the old ones, and StVar says so.
  !> @param IDTask 1: set StVar0 where it is not set; 2: Sig, Swp and StVar; 3: D and BulkW; 4: nStat; 5: NonSym, iStrsDep,
  !>               iTimeDep, iTang; 6: elastic D and BulkW
  !> @param iMod   1
  !> @param IsUndr 1: undrained; excess pore pressure Swp (tension positive) grows by K_w times the volumetric strain
  !> @param Props  16 parameters of the UMAT, then the initial delta xx yy zz xy yz zx with engineering shear
  !> @param Sig0, Sig effective stress [stress]
  !> @param StVar0, StVar state variables; null in tasks 4 and 5 in some hosts
  !> @param dEps   strain increment
  !> @param D      stiffness d Sig / d dEps, columns first, [stress]
  subroutine user_mod(IDTask, iMod, IsUndr, iStep, iTer, iEl, Int, X, Y, Z, Time0, dTime, Props, Sig0, Swp0, StVar0, dEps, &
                      D, BulkW, Sig, Swp, StVar, ipl, nStat, NonSym, iStrsDep, iTimeDep, iTang, iPrjDir, iPrjLen, &
                      iAbort) bind(C, name='user_mod')
    integer(c_int), intent(in) :: IDTask, iMod, IsUndr
    integer(c_int), intent(inout) :: ipl, nStat, NonSym, iStrsDep, iTimeDep, iTang, iAbort
    real(c_double), intent(in) :: Props(n_props), Sig0(6), Swp0, dEps(6)
    real(c_double), intent(inout), optional :: StVar0(n_plaxis_statev), StVar(n_plaxis_statev)
    real(c_double), intent(inout) :: D(6, 6), BulkW, Sig(6), Swp
    ! Never read.
    integer(c_int), intent(in), optional :: iStep, iTer, iEl, Int, iPrjDir(*), iPrjLen
    real(c_double), intent(in), optional :: X, Y, Z, Time0, dTime
    type(point_type) :: point
    integer :: status

    iAbort = 1
    if (iMod /= 1) return
    select case (IDTask)
    case (task_count)
      nStat = n_plaxis_statev
    case (task_attributes)
      NonSym = 1
      iStrsDep = 1
      iTimeDep = 0
      iTang = 1
    case (task_initialise, task_stress, task_stiffness, task_elastic)
      if (.not. present(StVar0)) return
      call read_point(Props, IsUndr, Sig0, StVar0, point, status)
      if (status /= status_ok) return
      select case (IDTask)
      case (task_initialise)
        call initialise(point, StVar0)
      case (task_stress)
        if (.not. present(StVar)) return
        call advance(point, dEps, Sig0, Swp0, StVar0, Sig, Swp, StVar)
        ipl = 0
      case (task_stiffness)
        call tangent_stiffness(point, dEps, D, status)
      case default
        call elastic_stiffness(point, D, status)
      end select
      if (status /= status_ok) return
      if (IDTask /= task_stress) BulkW = real(point%K_w, c_double)
    case default
      return
    end select
    iAbort = 0
  end subroutine user_mod

  !> Check and unpack what belongs to a point.
  !> @param status status_ok, status_bad_material, status_bad_state or status_bad_argument
  subroutine read_point(props, is_undrained, sig0, stvar0, point, status)
    real(c_double), intent(in) :: props(n_props), sig0(6), stvar0(n_plaxis_statev)
    integer(c_int), intent(in) :: is_undrained
    type(point_type), intent(out) :: point
    integer, intent(out) :: status
    real(wp) :: delta(6), stress(6), pore_pressure
    character(len=1) :: message
    ! Typed numbers are rounded; a delta this much longer than R is shortened by unpack_state.
    real(wp), parameter :: slack = 1.01_wp

    call check_props(real(props(:n_parameters), wp), status, message)
    if (status /= status_ok) return
    point%m = material_from_props(real(props(:n_parameters), wp), regularised=.true.)
    status = status_bad_argument
    point%K_w = 0.0_wp
    if (is_undrained == 1) then
      point%K_w = point%m%K_w
      if (.not. point%K_w > 0.0_wp) return
    end if
    point%m%K_w = 0.0_wp

    status = status_bad_state
    if (.not. (all(ieee_is_finite(sig0)) .and. all(ieee_is_finite(stvar0)))) return
    stress = real(sig0, wp)
    call swap_shear(stress)
    point%statev = real(stvar0(:n_statev), wp)
    point%statev(sv_pore_pressure) = 0.0_wp
    point%unset = point%statev(sv_void_ratio) < unset_void_ratio
    if (point%unset) then
      status = status_bad_material
      if (.not. all(ieee_is_finite(props(n_parameters + 1:n_plaxis_parameters)))) return
      delta = real(props(n_parameters + 1:n_plaxis_parameters), wp)
      if (point%m%intergranular .and. norm(tensor_from_host(delta, 0.5_wp)) > slack * point%m%R) return
      point%statev(sv_delta:sv_delta + 5) = delta
    end if
    call swap_shear(point%statev(sv_delta:sv_delta + 5))
    call unpack_state(point%m, stress, point%statev, point%state, pore_pressure)
    status = status_ok
  end subroutine read_point

  !> State variables of a point that has none; PLAXIS repeats this task in every phase.
  subroutine initialise(point, stvar0)
    type(point_type), intent(inout) :: point
    real(c_double), intent(inout) :: stvar0(n_plaxis_statev)
    if (.not. point%unset) return
    stvar0 = 0.0_c_double
    call put_state(point, report_type(), stvar0)
    ! A void ratio at zero mean stress waits for the first stress.
    if (point%m%e_0 < 0.0_wp .and. .not. trace(point%state%stress) < 0.0_wp) stvar0(sv_void_ratio) = 0.0_c_double
  end subroutine initialise

  !> Integrate an increment, or keep the old state and mark it.
  subroutine advance(point, deps, sig0, swp0, stvar0, sig, swp, stvar)
    type(point_type), intent(inout) :: point
    real(c_double), intent(in) :: deps(6), sig0(6), swp0, stvar0(n_plaxis_statev)
    real(c_double), intent(inout) :: sig(6), swp, stvar(n_plaxis_statev)
    type(report_type) :: report
    type(options_type) :: options
    real(wp) :: strain(6), stress(6)
    integer :: status

    strain = strain_of(deps)
    options = options_type(tolerance=tolerance)
    call update_state(point%m, options, point%state, strain, report, status)
    stvar = stvar0
    if (status /= status_ok) then
      sig = sig0
      swp = swp0
      stvar(sv_evaluations) = -real(status, c_double)
      stvar(sv_dropped) = stvar0(sv_dropped) + 1.0_c_double
      return
    end if
    call put_state(point, report, stvar)
    stress = point%state%stress
    call swap_shear(stress)
    sig = real(stress, c_double)
    swp = swp0 + real(point%K_w * trace(strain), c_double)
  end subroutine advance

  !> State variables of the model and its report to those of PLAXIS.
  subroutine put_state(point, report, stvar)
    type(point_type), intent(in) :: point
    type(report_type), intent(in) :: report
    real(c_double), intent(inout) :: stvar(n_plaxis_statev)
    real(wp) :: delta(6)
    stvar(:n_statev) = real(point%statev, c_double)
    call pack_statev(point%m, point%state, 0.0_wp, report, stvar(:n_statev))
    delta = real(stvar(sv_delta:sv_delta + 5), wp)
    call swap_shear(delta)
    stvar(sv_delta:sv_delta + 5) = real(delta, c_double)
  end subroutine put_state

  !> Stiffness that belongs to an increment; to none where the increment cannot be integrated.
  subroutine tangent_stiffness(point, deps, d, status)
    type(point_type), intent(in) :: point
    real(c_double), intent(in) :: deps(6)
    real(c_double), intent(inout) :: d(6, 6)
    integer, intent(out) :: status
    type(state_type) :: state
    type(report_type) :: report
    real(wp) :: tangent(6, 6), zero(6)

    state = point%state
    call update_state(point%m, options_type(), state, strain_of(deps), report, status, tangent)
    if (status /= status_ok) then
      state = point%state
      zero = 0.0_wp
      call update_state(point%m, options_type(), state, zero, report, status, tangent)
    end if
    if (status == status_ok) call put_stiffness(point%m, tangent, d)
  end subroutine tangent_stiffness

  !> The stiffest and only symmetric answer of the model: m_R L, or L without intergranular strain.
  subroutine elastic_stiffness(point, d, status)
    type(point_type), intent(in) :: point
    real(c_double), intent(inout) :: d(6, 6)
    integer, intent(out) :: status
    type(state_type) :: state
    real(wp) :: stiffness(6, 6), zero(6)
    zero = 0.0_wp
    state = point%state
    state%delta = zero
    call continuum_stiffness(point%m, state, zero, stiffness, status)
    if (status == status_ok) call put_stiffness(point%m, stiffness, d)
  end subroutine elastic_stiffness

  !> A stiffness to PLAXIS.
  subroutine put_stiffness(m, stiffness, d)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: stiffness(6, 6)
    real(c_double), intent(inout) :: d(6, 6)
    integer, parameter :: order(6) = [1, 2, 3, 4, 6, 5]
    real(c_double) :: standard(6, 6)
    call pack_tangent(m, stiffness, standard)
    d = standard(order, order)
  end subroutine put_stiffness

  !> A strain increment of PLAXIS as tensor components xx yy zz xy xz yz.
  function strain_of(deps) result(strain)
    real(c_double), intent(in) :: deps(6)
    real(wp) :: strain(6)
    strain = real(deps, wp)
    call swap_shear(strain)
    strain(4:6) = 0.5_wp * strain(4:6)
  end function strain_of

end module umat_plaxis
