!> UMAT for Abaqus-style hosts: unpack, call, pack. No physics here.
!>
!> PROPS(16) and STATEV(13) are laid out as in the public sand UMAT, see docs/umat.md. The symbol is umat_; the binding
!> is C so that a null pointer from the host is an absent argument, as Fortran 2018 defines it. Nothing is printed,
!> nothing is kept between calls.
module umat_entry
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_is_finite
  use, intrinsic :: iso_c_binding, only: c_double, c_int, c_char
use umat_host_state, only: n_statev, tensor_from_host, unpack_state, turn_delta, pack_stress, pack_statev, &
                             pack_tangent, swap_shear
  use umat_kinds, only: wp
  use umat_material, only: material_type, material_from_props, check_props, n_parameters
  use umat_rate, only: state_type, continuum_stiffness
  use umat_status, only: status_ok, status_bad_argument
  use umat_tensor, only: norm, trace, unit_tensor
  use umat_update, only: options_type, report_type, update_state
  implicit none
  private
  public :: umat

contains

  !> The host's entry.
  !>
  !> Used: STRESS (total stress; tension positive), STATEV, DDSDDE, DSTRAN (engineering shear), PROPS, DROT and PNEWDT
  !> where present. NTENS = 6: 3D; 4: 11 22 33 12; 3: 11 22 12, where the stress normal to the plane follows from STATEV(9).
  !> A host without PNEWDT is Kratos: it orders shear 12 23 13.
  !> On failure STRESS and STATEV are untouched and a smaller step is asked for: PNEWDT = 0.5 where the host has it, NaN
  !> in STRESS where it has not. DDSDDE is then a finite stiffness: CalculiX solves with it before it looks at PNEWDT.
  pure subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, stran, dstran, time, dtime, &
                       temp, dtemp, predef, dpred, cmname, ndi, nshr, ntens, nstatv, props, nprops, coords, drot, &
                       pnewdt, celent, dfgrd0, dfgrd1, noel, npt, layer, kspt, kstep, kinc) bind(C, name='umat_')
    integer(c_int), intent(in) :: ndi, nshr, ntens, nstatv, nprops
    real(c_double), intent(inout) :: stress(ntens), statev(nstatv), ddsdde(ntens, ntens)
    real(c_double), intent(in) :: dstran(ntens), props(nprops)
    real(c_double), intent(inout), optional :: pnewdt
    real(c_double), intent(in), optional :: drot(3, 3)
    ! Never read: some hosts pass null pointers or garbage here.
    real(c_double), intent(in), optional :: sse, spd, scd, rpl, ddsddt(*), drplde(*), drpldt, stran(*), time(*), dtime
    real(c_double), intent(in), optional :: temp, dtemp, predef(*), dpred(*), coords(*), celent, dfgrd0(*), dfgrd1(*)
    character(kind=c_char), intent(in), optional :: cmname(*)
    integer(c_int), intent(in), optional :: noel, npt, layer, kspt, kstep(*), kinc
    type(material_type) :: m
    type(state_type) :: state
    type(report_type) :: report
    real(wp) :: host_stress(6), host_strain(6), strain(6), tangent(6, 6), pore_pressure
    character(len=1) :: message
    integer :: status, i

    status = status_bad_argument
    if (any(ntens == [3, 4, 6]) .and. nstatv >= n_statev .and. nprops >= n_parameters) then
      call check_props(props(:n_parameters), status, message)
      ! Hosts do pass NaN; nothing is computed with it, so that nothing traps.
      if (.not. (all(ieee_is_finite(stress)) .and. all(ieee_is_finite(statev(:n_statev))) .and. &
                 all(ieee_is_finite(dstran)))) status = status_bad_argument
    end if
    if (status == status_ok) then
      host_stress(:ntens) = stress
      host_strain(:ntens) = dstran
      if (.not. present(pnewdt)) then
        call swap_shear(host_stress(:ntens))
        call swap_shear(host_strain(:ntens))
      end if
      m = material_from_props(props(:n_parameters), regularised=.true.)
      call unpack_state(m, host_stress(:ntens), statev(:n_statev), state, pore_pressure)
      if (present(drot)) call turn_delta(drot, state, status)
    end if
    if (status == status_ok) then
      strain = tensor_from_host(host_strain(:ntens), 0.5_wp)
      call update_state(m, options_type(), state, strain, report, status, tangent)
      if (status /= status_ok) call stiffness_when_refused(m, state, ddsdde)
    else
      ddsdde = 0.0_c_double
      do i = 1, ntens
        ddsdde(i, i) = 1.0_c_double ! no admissible state, no stiffness; finite all the same
      end do
    end if
    if (status /= status_ok) then
      call ask_for_smaller_step(stress, pnewdt)
      return
    end if
    ! Water and grains move together: u grows with compression.
    pore_pressure = pore_pressure - m%K_w * trace(strain)
    call pack_stress(state%stress - pore_pressure * unit_tensor, stress)
    call pack_statev(m, state, pore_pressure, report, statev)
    call pack_tangent(m, tangent, ddsdde)
    if (.not. present(pnewdt)) then
      call swap_shear(stress)
      do i = 1, ntens
        call swap_shear(ddsdde(:, i))
      end do
      do i = 1, ntens
        call swap_shear(ddsdde(i, :))
      end do
    end if
  end subroutine umat

  !> DDSDDE of a refused increment: the stiffness of the state as it is; of a state outside the domain h_s, which is finite
  !> and stiff.
  pure subroutine stiffness_when_refused(m, state, ddsdde)
    type(material_type), intent(in) :: m
    type(state_type), intent(in) :: state
    real(c_double), intent(out) :: ddsdde(:, :)
    real(wp) :: stiffness(6, 6), zero(6)
    integer :: status, i
    zero = 0.0_wp
    status = status_bad_argument
    if (norm(state%delta) <= 2.0_wp * m%R .or. .not. m%intergranular) &
      call continuum_stiffness(m, state, zero, stiffness, status)
    if (status /= status_ok) then
      stiffness = 0.0_wp
      do i = 1, 6
        stiffness(i, i) = m%h_s
      end do
    end if
    call pack_tangent(m, stiffness, ddsdde)
  end subroutine stiffness_when_refused

  !> Ask the host to repeat the increment with a smaller step.
  pure subroutine ask_for_smaller_step(stress, pnewdt)
    real(c_double), intent(inout) :: stress(:)
    real(c_double), intent(inout), optional :: pnewdt
    if (present(pnewdt)) then
      pnewdt = 0.5_c_double
    else
      stress = ieee_value(1.0_c_double, ieee_quiet_nan)
    end if
  end subroutine ask_for_smaller_step

end module umat_entry
