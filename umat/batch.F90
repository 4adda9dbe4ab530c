!> Strain increments of many material points side by side: the same integration as update_state, one point per lane of
!> the vector registers.
!>
!> A group of points goes through rounds. In a round every point tries one step (batch_step.F90); points whose increment
!> is done leave, the others close ranks, so that no lane runs empty while others need more steps. Points that the kernel
!> does not decide (input that is not finite, states outside the domain or close to its border, ...) are left to
!> update_state. What happens to a point depends on that point alone: not on its lane, its neighbours or the group.
module umat_batch
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use, intrinsic :: iso_c_binding, only: c_double, c_int, c_int64_t
  use, intrinsic :: iso_fortran_env, only: int64
  use umat_batch_lanes
  use umat_batch_begin_portable, only: begin_increment_portable => begin_increment, begin_segment_portable => begin_segment
  use umat_batch_step_portable, only: attempt_step_portable => attempt_step
#ifdef HYPOFAB_BATCH_X86
  use umat_batch_begin_avx2, only: begin_increment_avx2 => begin_increment, begin_segment_avx2 => begin_segment
  use umat_batch_step_avx2, only: attempt_step_avx2 => attempt_step
  use umat_batch_begin_avx512, only: begin_increment_avx512 => begin_increment, begin_segment_avx512 => begin_segment
  use umat_batch_step_avx512, only: attempt_step_avx512 => attempt_step
#endif
  use umat_kinds, only: wp
  use umat_material, only: material_type, material_from_props, n_parameters
  use umat_rate, only: state_type
  use umat_status, only: status_ok
  use umat_tableau, only: n_stages
  use umat_update, only: options_type, report_type, update_state
  implicit none
  private
  public :: update_points

  !> Instruction sets, the same numbers as in batch.h.
  integer, parameter :: portable = 0, avx2 = 1, avx512 = 2

  !> A path on which more steps are refused has a kink (the densest packing is reached, the isotropic axis is crossed), where
  !> rounding decides on the sequence of steps: the scalar update is to take it.
  integer, parameter :: most_refused = 6

contains

  !> One strain increment of points of one material.
  !> @param props           the 16 parameters, admissible
  !> @param tolerance       as in options_type, above zero
  !> @param max_evaluations as in options_type, above zero
  !> @param instructions    one of the instruction sets, which the processor must have
  !> @param n               number of points
  !> @param stride          distance of two components of a tensor in the arrays, at least n
  !> @param stress, delta, void_ratio in: start, out: end; a point's are untouched if its update fails
  !>                        of the plain model delta is only checked, and may be absent
  !> @param strain          strain increments, tensor components
  !> @param status          of each point, as update_state gives it
  !> @param evaluations     rate evaluations of all points
  !> @param scalar          number of points that update_state did
  subroutine update_points(props, tolerance, max_evaluations, instructions, n, stride, stress, delta, void_ratio, strain, &
                           status, evaluations, scalar) bind(C, name='hypofab_update_points')
    real(c_double), intent(in) :: props(n_parameters)
    real(c_double), intent(in) :: tolerance
    integer(c_int), intent(in) :: max_evaluations
    integer(c_int), value :: instructions, n
    integer(c_int64_t), value :: stride
    real(c_double), intent(inout) :: stress(stride, 6), void_ratio(stride)
    real(c_double), intent(inout), optional :: delta(stride, 6)
    real(c_double), intent(in) :: strain(stride, 6)
    integer(c_int), intent(out) :: status(n)
    integer(c_int64_t), intent(inout) :: evaluations, scalar
    type(material_type) :: m
    type(options_type) :: options
    integer :: first, last

    m = material_from_props(props)
    options = options_type(tolerance=tolerance, max_evaluations=max_evaluations)
    do first = 1, n, most_points
      last = min(n, first + most_points - 1)
      if (present(delta)) then
        call update_group(m, options, instructions, last - first + 1, stride, stress(first, 1), void_ratio(first), &
                          strain(first, 1), status(first:last), evaluations, scalar, delta(first, 1))
      else
        call update_group(m, options, instructions, last - first + 1, stride, stress(first, 1), void_ratio(first), &
                          strain(first, 1), status(first:last), evaluations, scalar)
      end if
    end do
  end subroutine update_points

  !> The same for up to most_points points.
  subroutine update_group(m, options, instructions, n, stride, stress, void_ratio, strain, status, evaluations, scalar, delta)
    type(material_type), intent(in) :: m
    type(options_type), intent(in) :: options
    integer, intent(in) :: instructions, n
    integer(c_int64_t), intent(in) :: stride
    real(c_double), intent(inout) :: stress(stride, *), void_ratio(*)
    real(c_double), intent(in) :: strain(stride, *)
    integer(c_int), intent(out) :: status(n)
    integer(c_int64_t), intent(inout) :: evaluations, scalar
    real(c_double), intent(inout), optional :: delta(stride, *)
    real(wp) :: lanes(n_lanes, n_fields)
    integer(int64) :: tags(n_lanes, n_tags)
    integer :: point(n_lanes) !< whose numbers a lane holds
    integer :: left !< number of lanes in use
    integer :: i

    call load()
    call close_ranks()
    if (left > 0) call begin_increments()
    call close_ranks()
    do while (left > 0)
      call step_all()
      do i = 1, left
        if (tags(i, t_outcome) == outcome_segment_done) call end_segment(i)
        if (tags(i, t_outcome) == outcome_going .and. .not. may_go_on(i)) tags(i, t_outcome) = outcome_special
      end do
      call close_ranks()
    end do

  contains

    !> Put every point into a lane.
    subroutine load()
      logical :: finite(n)
      integer :: j
      left = n
      tags(:n, t_far) = 0
      lanes(:n, l_e) = void_ratio(:n)
      finite = ieee_is_finite(void_ratio(:n))
      do j = 1, 6
        lanes(:n, l_stress - 1 + j) = stress(:n, j)
        lanes(:n, l_strain - 1 + j) = strain(:n, j)
        finite = finite .and. ieee_is_finite(stress(:n, j)) .and. ieee_is_finite(strain(:n, j))
        lanes(:n, l_delta - 1 + j) = 0.0_wp
        if (.not. present(delta)) cycle
        if (m%intergranular) lanes(:n, l_delta - 1 + j) = delta(:n, j)
        finite = finite .and. ieee_is_finite(delta(:n, j))
      end do
      tags(:n, t_kind) = kind_fixed
      tags(:n, t_outcome) = merge(outcome_begin, outcome_special, finite)
      point(:n) = [(j, j=1, n)]
    end subroutine load

    !> Hand what the kernel does not decide to the scalar update, move the lanes still in use together, and fill the last
    !> register with copies.
    subroutine close_ranks()
      integer :: kept, j
      kept = 0
      do j = 1, left
        if (tags(j, t_outcome) == outcome_special) call update_alone(point(j))
        if (tags(j, t_outcome) /= outcome_begin .and. tags(j, t_outcome) /= outcome_going) cycle
        kept = kept + 1
        if (kept == j) cycle
        lanes(kept, :) = lanes(j, :)
        tags(kept, :) = tags(j, :)
        point(kept) = point(j)
      end do
      left = kept
      if (left == 0) return
      do j = left + 1, padded()
        lanes(j, :) = lanes(left, :)
        tags(j, :) = tags(left, :)
      end do
    end subroutine close_ranks

    !> Bring lanes with long paths together at the end, so that few registers do more than the series of the path.
    subroutine sort_ranks()
      integer :: near, far, held_point
      integer(int64) :: held_tag
      real(wp) :: held
      integer :: j
      near = 1
      far = left
      do
        do while (near < far)
          if (tags(near, t_far) /= 0) exit
          near = near + 1
        end do
        do while (near < far)
          if (tags(far, t_far) == 0) exit
          far = far - 1
        end do
        if (near >= far) return
        do j = 1, n_fields
          held = lanes(near, j)
          lanes(near, j) = lanes(far, j)
          lanes(far, j) = held
        end do
        do j = 1, n_tags
          held_tag = tags(near, j)
          tags(near, j) = tags(far, j)
          tags(far, j) = held_tag
        end do
        held_point = point(near)
        point(near) = point(far)
        point(far) = held_point
      end do
    end subroutine sort_ranks

    !> Number of lanes that the kernel works on: whole registers.
    pure function padded() result(lanes_in_use)
      integer :: lanes_in_use
      lanes_in_use = width * ((left + width - 1) / width)
    end function padded

    subroutine begin_increments()
      select case (instructions)
#ifdef HYPOFAB_BATCH_X86
      case (avx512)
        call begin_increment_avx512(m, padded(), lanes, tags)
      case (avx2)
        call begin_increment_avx2(m, padded(), lanes, tags)
#endif
      case default
        call begin_increment_portable(m, padded(), lanes, tags)
      end select
    end subroutine begin_increments

    !> Begin the segments that are to begin, and try one step in every lane.
    subroutine step_all()
      logical :: begins
      begins = any(tags(:left, t_outcome) == outcome_begin)
      select case (instructions)
#ifdef HYPOFAB_BATCH_X86
      case (avx512)
        if (begins) call begin_segment_avx512(m, padded(), lanes, tags)
        if (begins) call sort_ranks()
        call attempt_step_avx512(m, options%tolerance, padded(), lanes, tags)
      case (avx2)
        if (begins) call begin_segment_avx2(m, padded(), lanes, tags)
        if (begins) call sort_ranks()
        call attempt_step_avx2(m, options%tolerance, padded(), lanes, tags)
#endif
      case default
        if (begins) call begin_segment_portable(m, padded(), lanes, tags)
        if (begins) call sort_ranks()
        call attempt_step_portable(m, options%tolerance, padded(), lanes, tags)
      end select
    end subroutine step_all

    !> Loading follows upon a reversal, or the increment is done.
    subroutine end_segment(lane)
      integer, intent(in) :: lane
      integer :: k, j
      if (lanes(lane, l_rest) > 0.0_wp) then
        lanes(lane, l_length) = lanes(lane, l_rest)
        lanes(lane, l_rest) = 0.0_wp
        tags(lane, t_kind) = kind_plane
        tags(lane, t_outcome) = outcome_begin
        return
      end if
      k = point(lane)
      do j = 1, 6
        stress(k, j) = lanes(lane, l_stress - 1 + j)
        if (m%intergranular) delta(k, j) = lanes(lane, l_delta - 1 + j)
      end do
      void_ratio(k) = lanes(lane, l_e)
      status(k) = status_ok
      evaluations = evaluations + int(lanes(lane, l_evaluations), int64)
    end subroutine end_segment

    !> May a lane take another step here? The scalar update knows why a bound is reached.
    pure function may_go_on(lane) result(yes)
      integer, intent(in) :: lane
      logical :: yes
     yes = lanes(lane, l_evaluations) + n_stages <= options%max_evaluations .and. lanes(lane, l_refused) <= most_refused
    end function may_go_on

    !> A point by the scalar update, from its start.
    subroutine update_alone(k)
      integer, intent(in) :: k
      type(state_type) :: state
      type(report_type) :: report
      integer :: outcome
      real(wp) :: increment(6)
      state = state_type(stress(k, :6), 0.0_wp, void_ratio(k))
      if (present(delta)) state%delta = delta(k, :6)
      increment = strain(k, :6)
      call update_state(m, options, state, increment, report, outcome)
      status(k) = int(outcome, c_int)
      evaluations = evaluations + report%evaluations
      scalar = scalar + 1
      if (outcome /= status_ok) return
      stress(k, :6) = state%stress
      if (m%intergranular) delta(k, :6) = state%delta
      void_ratio(k) = state%void_ratio
    end subroutine update_alone

  end subroutine update_group

end module umat_batch
