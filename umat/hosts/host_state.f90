!> The state as hosts store it: STRESS, STATEV and DDSDDE of a UMAT to and from the types of the model. No physics here.
!>
!> Every host entry uses these: components in Abaqus order 11 22 33 12 13 23 (NTENS 6), 11 22 33 12 (4) or 11 22 12 (3),
!> total stress, tension positive, engineering shear in strain and in the stored delta.
module umat_host_state
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use, intrinsic :: iso_c_binding, only: c_double
  use umat_kinds, only: wp
  use umat_material, only: material_type
  use umat_rate, only: state_type
  use umat_status, only: status_ok, status_bad_argument
  use umat_tensor, only: norm, rotate, trace, friction_angle, unit_tensor
  use umat_update, only: report_type
  use umat_wolffersdorff, only: in_domain
  implicit none
  private
  public :: tensor_from_host, unpack_state, turn_delta, pack_stress, pack_statev, pack_tangent, swap_shear

  !> Positions in STATEV.
  integer, parameter, public :: n_statev = 13
  integer, parameter, public :: sv_delta = 1, sv_void_ratio = 7, sv_pore_pressure = 8, sv_p = 9, sv_evaluations = 10
  integer, parameter, public :: sv_friction_angle = 11, sv_rho = 12, sv_substep = 13
  !> A stored void ratio below this means "initialise from PROPS(16)".
  real(wp), parameter, public :: unset_void_ratio = 1.0e-3_wp

contains

  !> Position, among 11 22 33 12 13 23, of component i of NTENS.
  pure function place(ntens, i)
    integer, intent(in) :: ntens, i
    integer :: place
    place = i
    if (ntens == 3 .and. i == 3) place = 4
  end function place

  !> A tensor from a host's components; shear is multiplied by a factor (1/2 for engineering strain).
  pure function tensor_from_host(values, shear_factor) result(t)
    real(wp), intent(in) :: values(:), shear_factor
    real(wp) :: t(6)
    integer :: i
    t = 0.0_wp
    do i = 1, size(values)
      t(place(size(values), i)) = values(i)
    end do
    t(4:6) = shear_factor * t(4:6)
  end function tensor_from_host

  !> Effective stress, intergranular strain, void ratio and excess pore pressure from STRESS and STATEV.
  pure subroutine unpack_state(m, stress, statev, state, pore_pressure)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: stress(:), statev(n_statev)
    type(state_type), intent(out) :: state
    real(wp), intent(out) :: pore_pressure
    real(wp) :: size_of_delta

    pore_pressure = statev(sv_pore_pressure)
    state%stress = tensor_from_host(stress, 1.0_wp)
    if (size(stress) == 3) then
      ! Effective p is in STATEV(9); in the first call it is not, and the plane's mean serves.
      if (abs(statev(sv_p)) > 0.0_wp) then
        state%stress(3) = -3.0_wp * (statev(sv_p) + pore_pressure) - state%stress(1) - state%stress(2)
      else
        state%stress(3) = 0.5_wp * (state%stress(1) + state%stress(2))
      end if
    end if
    state%stress = state%stress + pore_pressure * unit_tensor

    state%delta = 0.0_wp
    if (m%intergranular) then
      state%delta = [statev(sv_delta:sv_delta + 2), 0.5_wp * statev(sv_delta + 3:sv_delta + 5)]
      ! |delta| = R is the bound of the model; rounding or a host's mapping may push it over. What is far beyond was never
      ! an intergranular strain: it stays, and the update refuses it.
      size_of_delta = norm(state%delta)
      if (size_of_delta > m%R .and. size_of_delta < 2.0_wp * m%R) state%delta = state%delta * (m%R / size_of_delta)
    end if

    state%void_ratio = statev(sv_void_ratio)
    if (state%void_ratio < unset_void_ratio) state%void_ratio = initial_void_ratio(m, state%stress)
  end subroutine unpack_state

  !> Void ratio from PROPS(16): below zero the one at zero mean stress, up to 10 the void ratio itself, above 10 less 10.
  pure function initial_void_ratio(m, stress) result(e)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: stress(6)
    real(wp) :: e
    real(wp) :: pressure
    e = m%e_0
    if (m%e_0 >= 10.0_wp) then
      e = m%e_0 - 10.0_wp
    else if (m%e_0 < 0.0_wp) then
      pressure = max(0.0_wp, 3.0_wp * m%p_t - trace(stress))
      e = -m%e_0 * exp(-(pressure / m%h_s)**m%n) ! theory.md Eq. (6)
    end if
  end function initial_void_ratio

  !> delta is the UMAT's own to turn with the material; hosts turn STRESS themselves.
  !> @param status status_ok, or status_bad_argument when drot is not a rotation
  pure subroutine turn_delta(drot, state, status)
    real(wp), intent(in) :: drot(3, 3)
    type(state_type), intent(inout) :: state
    integer, intent(out) :: status
    real(wp), parameter :: unit(3, 3) = reshape([1, 0, 0, 0, 1, 0, 0, 0, 1] * 1.0_wp, [3, 3]), slack = 1.0e-3_wp
    status = status_bad_argument
    if (.not. all(ieee_is_finite(drot))) return
    if (any(abs(drot) > 1.0_wp + slack)) return
    if (any(abs(matmul(drot, transpose(drot)) - unit) > slack)) return
    state%delta = rotate(state%delta, drot)
    status = status_ok
  end subroutine turn_delta

  !> Total stress to the host.
  pure subroutine pack_stress(total, stress)
    real(wp), intent(in) :: total(6)
    real(c_double), intent(out) :: stress(:)
    integer :: i
    do i = 1, size(stress)
      stress(i) = real(total(place(size(stress), i)), c_double)
    end do
  end subroutine pack_stress

  !> State variables to the host.
  pure subroutine pack_statev(m, state, pore_pressure, report, statev)
    type(material_type), intent(in) :: m
    type(state_type), intent(in) :: state
    real(wp), intent(in) :: pore_pressure
    type(report_type), intent(in) :: report
    real(c_double), intent(inout) :: statev(:)
    if (m%intergranular) statev(sv_delta:sv_delta + 5) = real([state%delta(1:3), 2.0_wp * state%delta(4:6)], c_double)
    statev(sv_void_ratio) = real(state%void_ratio, c_double)
    statev(sv_pore_pressure) = real(pore_pressure, c_double)
    statev(sv_p) = real(-trace(state%stress) / 3.0_wp, c_double)
    statev(sv_evaluations) = real(report%evaluations, c_double)
    statev(sv_friction_angle) = real(friction_angle(state%stress), c_double)
    statev(sv_rho) = real(norm(state%delta) / merge(m%R, 1.0_wp, m%intergranular), c_double)
    statev(sv_substep) = real(marked_substep(m, state, report, real(statev(sv_substep), wp)), c_double)
  end subroutine pack_statev

  !> The suggested substep, marked by a negative sign where the stress is or was at or beyond the border of the domain
  !> (border.f90).
  !> @param old what the host has; it stays where there is no suggestion, but for the mark
  pure function marked_substep(m, state, report, old) result(substep)
    type(material_type), intent(in) :: m
    type(state_type), intent(in) :: state
    type(report_type), intent(in) :: report
    real(wp), intent(in) :: old
    real(wp) :: substep
    substep = abs(old)
    if (report%substep > 0.0_wp) then
      substep = report%substep
    else if (old < 0.0_wp) then
      substep = 0.0_wp
    end if
    if (.not. report%regularised .and. in_domain(m, state%stress, state%void_ratio)) return
    substep = -merge(substep, 1.0_wp, substep > 0.0_wp)
  end function marked_substep

  !> Stiffness to the host: engineering shear halves the doubly counted columns; pore water adds to the normal block.
  pure subroutine pack_tangent(m, tangent, ddsdde)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: tangent(6, 6)
    real(c_double), intent(out) :: ddsdde(:, :)
    real(wp) :: total(6, 6)
    integer :: n, i, j
    total = tangent
    total(:, 4:6) = 0.5_wp * total(:, 4:6)
    total(1:3, 1:3) = total(1:3, 1:3) + m%K_w
    n = size(ddsdde, 1)
    do j = 1, n
      do i = 1, n
        ddsdde(i, j) = real(total(place(n, i), place(n, j)), c_double)
      end do
    end do
  end subroutine pack_tangent

  !> From 11 22 33 12 23 13, the order of Abaqus/Explicit and PLAXIS, to 11 22 33 12 13 23, and back.
  pure subroutine swap_shear(values)
    real(wp), intent(inout) :: values(:)
    real(wp) :: held
    if (size(values) < 6) return
    held = values(5)
    values(5) = values(6)
    values(6) = held
  end subroutine swap_shear

end module umat_host_state
