!> A leg in one step, where it is short against |delta|: the step of many points side by side (lanes/short.f90), with one lane.
module umat_short_leg
  use, intrinsic :: iso_fortran_env, only: int64
  use umat_kinds, only: wp
  use umat_lanes
  use umat_lanes_short_single, only: attempt_short, farthest, longest_plain
  use umat_leg, only: leg_type
  use umat_material, only: material_type
  use umat_one_lane, only: n_lanes
  use umat_rate, only: state_type
  use umat_status, only: branch_reversal
  use umat_tensor, only: norm, trace
  implicit none
  private
  public :: short_leg

contains

  !> Integrate a leg in one step, if that is accurate enough.
  !> @param leg      without the tangent; its path is not used
  !> @param tolerance of the leg, relative
  !> @param state    in: start, out: end, if accepted; otherwise untouched
  !> @param error    estimate, relative, if accepted
  !> @param accepted is it accurate enough, and inside the domain?
  !> @param evaluations of L and N are added, that at the start only if accepted
  pure subroutine short_leg(m, leg, tolerance, state, error, accepted, evaluations)
    type(material_type), intent(in) :: m
    type(leg_type), intent(in) :: leg
    real(wp), intent(in) :: tolerance
    type(state_type), intent(inout) :: state
    real(wp), intent(out) :: error
    logical, intent(out) :: accepted
    integer, intent(inout) :: evaluations
    real(wp) :: lane(n_lanes, n_fields)
    integer(int64) :: tag(n_lanes, n_tags)

    accepted = .false.
    error = huge(error)
    if (leg%length > merge(farthest * m%R, longest_plain, m%intergranular)) return
    if (.not. 3.0_wp * m%p_t - trace(state%stress) > max(smallest_pressure * m%h_s, smallest_share * norm(state%stress))) return
    lane(1, l_stress:l_stress + 5) = state%stress
    lane(1, l_delta:l_delta + 5) = state%delta
    lane(1, l_e) = state%void_ratio
    lane(1, l_along:l_along + 5) = leg%direction
    lane(1, l_trace) = trace(leg%direction)
    lane(1, l_length) = leg%length
    lane(1, l_done) = 0.0_wp
    lane(1, l_evaluations) = 0.0_wp
    tag(1, t_kind) = merge(kind_straight, kind_plane, leg%branch == branch_reversal)
    tag(1, t_outcome) = outcome_begin
    call attempt_short(m, tolerance, 1, lane, tag)
    evaluations = evaluations + nint(lane(1, l_evaluations))
    if (tag(1, t_outcome) /= outcome_segment_done) return
    accepted = .true.
    error = lane(1, l_error)
    state%stress = lane(1, l_stress:l_stress + 5)
    if (m%intergranular) state%delta = lane(1, l_delta:l_delta + 5)
    state%void_ratio = lane(1, l_e)
  end subroutine short_leg

end module umat_short_leg
