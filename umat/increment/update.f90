!> One finite strain increment at a constant direction of strain, and its consistent tangent.
!>
!> The branch of the intergranular strain changes once at most, from reversal to loading, at a place known in closed form;
!> each part is integrated on its own (integration.f90), so that no step crosses the change.
module umat_update
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use umat_influence, only: influence_type
  use umat_integration, only: options_type, report_type, integrate
  use umat_intergranular, only: slack_of_delta
  use umat_kinds, only: wp
  use umat_material, only: material_type
  use umat_rate, only: state_type, choose_branch, continuum_stiffness
  use umat_status, only: status_ok, status_out_of_domain, status_bad_state, status_bad_argument, branch_loading, &
                         branch_reversal
  use umat_tensor, only: ddot, norm
  use umat_wolffersdorff, only: is_admissible
  implicit none
  private
  public :: options_type, report_type, update_state

  !> Largest strain increment accepted: beyond it a small strain increment has no meaning.
  real(wp), parameter :: largest_increment = 1.0_wp
  !> An increment shorter than this has the stiffness of its branch as its tangent, to rounding.
  real(wp), parameter :: shortest_tangent = 1.0e-14_wp

contains

  !> Integrate one strain increment.
  !> @param m       material
  !> @param options tolerance and bounds
  !> @param state   in: start, out: end; untouched on failure
  !> @param strain  strain increment, tensor components
  !> @param report  filled, also on failure
  !> @param status  status_ok; status_bad_state or status_bad_argument for input that is not finite, |delta| > R
  !>                or a strain increment above 1; status_out_of_domain when the path leaves it; status_step_limit
  !> @param tangent d stress/d strain increment, the derivative of the integrated stress; for a vanishing increment the
  !>                continuum stiffness of a reversal, or L without intergranular strain. Matrix on tensor components
  !>                [stress]
  pure subroutine update_state(m, options, state, strain, report, status, tangent)
    type(material_type), intent(in) :: m
    type(options_type), intent(in) :: options
    type(state_type), intent(inout) :: state
    real(wp), intent(in) :: strain(6)
    type(report_type), intent(out) :: report
    integer, intent(out) :: status
    real(wp), intent(out), optional :: tangent(6, 6)
    type(state_type) :: work
    real(wp) :: direction(6), length, turn
    type(influence_type) :: influence
    logical :: with_tangent

    call check_input(m, state, strain, status)
    if (status /= status_ok) return
    work = state
    length = norm(strain)
    with_tangent = present(tangent) .and. length >= shortest_tangent
    report%branch = choose_branch(m, work%delta, strain)
    if (length > 0.0_wp) then
      direction = strain / length
      turn = 0.0_wp
      if (report%branch == branch_reversal) then
        ! delta + turn direction is normal to the direction of strain.
        turn = -ddot(work%delta, direction)
        call integrate(m, options, branch_reversal, direction, 0.0_wp, min(turn, length), with_tangent, work, &
                       influence, report, status)
        if (status /= status_ok) return
        if (turn < length) report%branch = branch_loading
      end if
      if (report%branch /= branch_reversal) then
        call integrate(m, options, report%branch, direction, turn, length - turn, with_tangent, work, influence, &
                       report, status)
        if (status /= status_ok) return
      end if
    end if
    if (with_tangent) then
      tangent = transpose(influence%on_stress) / length
    else if (present(tangent)) then
      call continuum_stiffness(m, work, strain, tangent, status)
      if (status /= status_ok) return
    end if
    state = work
  end subroutine update_state

  !> Is the input finite and inside the model's domain?
  pure subroutine check_input(m, state, strain, status)
    type(material_type), intent(in) :: m
    type(state_type), intent(in) :: state
    real(wp), intent(in) :: strain(6)
    integer, intent(out) :: status
    status = status_bad_argument
    if (.not. all(ieee_is_finite(strain))) return
    if (maxval(abs(strain)) > largest_increment) return
    status = status_bad_state
    if (.not. (all(ieee_is_finite(state%stress)) .and. all(ieee_is_finite(state%delta)))) return
    if (.not. ieee_is_finite(state%void_ratio)) return
    if (m%intergranular) then
      if (norm(state%delta) > slack_of_delta * m%R) return
    end if
    status = status_out_of_domain
    if (.not. is_admissible(m, state%stress, state%void_ratio)) return
    status = status_ok
  end subroutine check_input

end module umat_update
