!> Strain increments of many material points side by side: the same integration as update_state, one point per lane of
!> the vector registers.
!>
!> A group of points goes through rounds. In a round every point tries one step (step.f90); points whose increment
!> is done leave, the others close ranks, so that no lane runs empty while others need more steps. Points that the kernel
!> does not decide (input that is not finite, states outside the domain or close to its border, ...) are left to
!> update_state. What happens to a point depends on that point alone: not on its lane, its neighbours or the group.
module umat_batch
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use, intrinsic :: iso_c_binding, only: c_double, c_int, c_int64_t
  use, intrinsic :: iso_fortran_env, only: int64
  use umat_batch_lanes
  use umat_batch_begin_portable, only: begin_increment_portable => begin_increment, begin_segment_portable => begin_segment
  use umat_batch_short_portable, only: attempt_short_portable => attempt_short
  use umat_batch_step_portable, only: attempt_step_portable => attempt_step
#ifdef HYPOFAB_BATCH_X86
  use umat_batch_begin_avx2, only: begin_increment_avx2 => begin_increment, begin_segment_avx2 => begin_segment
  use umat_batch_short_avx2, only: attempt_short_avx2 => attempt_short
  use umat_batch_step_avx2, only: attempt_step_avx2 => attempt_step
  use umat_batch_begin_avx512, only: begin_increment_avx512 => begin_increment, begin_segment_avx512 => begin_segment
  use umat_batch_short_avx512, only: attempt_short_avx512 => attempt_short
  use umat_batch_step_avx512, only: attempt_step_avx512 => attempt_step
#endif
  use umat_kinds, only: wp
  use umat_material, only: material_type, material_from_props, n_parameters
  use umat_rate, only: state_type
  use umat_status, only: status_ok
  use umat_update, only: options_type, report_type, update_state
  implicit none
  private
  public :: update_points, update_many

  !> Instruction sets, the same numbers as in batch.h.
  integer, parameter :: portable = 0, avx2 = 1, avx512 = 2

  !> A path on which more steps are refused has a kink (the densest packing is reached, the isotropic axis is crossed), where
  !> rounding decides on the sequence of steps: the scalar update is to take it.
  integer, parameter :: most_refused = 6
  !> Step over |delta| beyond which the series of the path will mostly not reach.
  real(wp), parameter :: long_path = 0.2_wp

contains

  !> One strain increment of points of one material, for C.
  !> @param props           the 16 parameters, admissible
  !> @param tolerance       as in options_type, above zero
  !> @param max_evaluations as in options_type, above zero
  !> @param regularised     not zero: a response beyond the domain too (border.f90)
  !> @param delta           of the plain model only checked, and may be absent
  !> The other arguments are those of update_many.
  subroutine update_points(props, tolerance, max_evaluations, regularised, instructions, n, stride, stress, delta, &
                           void_ratio, strain, status, evaluations, scalar) bind(C, name='hypofab_update_points')
    real(c_double), intent(in) :: props(n_parameters)
    real(c_double), intent(in) :: tolerance
    integer(c_int), intent(in) :: max_evaluations
    integer(c_int), value :: regularised, instructions, n
    integer(c_int64_t), value :: stride
    real(c_double), intent(inout) :: stress(stride, *), void_ratio(*)
    real(c_double), intent(inout), optional :: delta(stride, *)
    real(c_double), intent(in) :: strain(stride, *)
    integer(c_int), intent(inout) :: status(*), evaluations(*)
    integer(c_int64_t), intent(inout) :: scalar
    type(options_type) :: options
    options = options_type(tolerance=tolerance, max_evaluations=max_evaluations)
    call update_many(material_from_props(props, regularised /= 0), options, int(instructions), int(n), stride, stress, &
                     void_ratio, strain, status, evaluations, scalar, delta)
  end subroutine update_points

  !> One strain increment of points of one material.
  !> @param m            material
  !> @param options      tolerance and bounds
  !> @param instructions one of the instruction sets, which the processor must have
  !> @param n            number of points
  !> @param stride       distance of two components of a tensor in the arrays, at least n
  !> @param stress, delta, void_ratio in: start, out: end; a point's are untouched if its update fails
  !> @param strain       strain increments, tensor components
  !> @param status       of each point, as update_state gives it
  !> @param evaluations  rate evaluations of each point
  !> @param scalar       the number of points that update_state did is added
  subroutine update_many(m, options, instructions, n, stride, stress, void_ratio, strain, status, evaluations, scalar, delta)
    type(material_type), intent(in) :: m
    type(options_type), intent(in) :: options
    integer, intent(in) :: instructions, n
    integer(c_int64_t), intent(in) :: stride
    real(c_double), intent(inout) :: stress(stride, *), void_ratio(*)
    real(c_double), intent(in) :: strain(stride, *)
    integer(c_int), intent(inout) :: status(*), evaluations(*)
    integer(c_int64_t), intent(inout) :: scalar
    real(c_double), intent(inout), optional :: delta(stride, *)
    integer :: first, count
    do first = 1, n, most_points
      count = min(n - first + 1, most_points)
      if (present(delta)) then
     call update_group(m, options, instructions, count, stride, stress(first, 1), void_ratio(first), strain(first, 1), &
                          status(first), evaluations(first), scalar, delta(first, 1))
      else
     call update_group(m, options, instructions, count, stride, stress(first, 1), void_ratio(first), strain(first, 1), &
                          status(first), evaluations(first), scalar)
      end if
    end do
  end subroutine update_many

  !> The same for up to most_points points.
  subroutine update_group(m, options, instructions, n, stride, stress, void_ratio, strain, status, evaluations, scalar, delta)
    type(material_type), intent(in) :: m
    type(options_type), intent(in) :: options
    integer, intent(in) :: instructions, n
    integer(c_int64_t), intent(in) :: stride
    real(c_double), intent(inout) :: stress(stride, *), void_ratio(*)
    real(c_double), intent(in) :: strain(stride, *)
    integer(c_int), intent(inout) :: status(*), evaluations(*)
    integer(c_int64_t), intent(inout) :: scalar
    real(c_double), intent(inout), optional :: delta(stride, *)
    real(wp) :: lanes(n_lanes, n_fields)
    integer(int64) :: tags(n_lanes, n_tags)
    integer :: point(n_lanes) !< whose numbers a lane holds
    integer :: left !< number of points left; behind them are copies, whose point is 0

    call load()
    call close_ranks()
    if (left > 0) call begin_increments()
    call close_ranks()
    do while (left > 0)
      call try_short_legs()
      if (left > 0) call step_all()
    end do

  contains

    !> Put every point into a lane. Loops, because array expressions of a size that is not constant are allocated.
    subroutine load()
      logical :: finite(most_points)
      integer :: j, k
      left = n
      do k = 1, n
        lanes(k, l_e) = void_ratio(k)
        finite(k) = ieee_is_finite(void_ratio(k))
        point(k) = k
      end do
      do j = 1, 6
        do k = 1, n
          lanes(k, l_stress - 1 + j) = stress(k, j)
          lanes(k, l_strain - 1 + j) = strain(k, j)
          lanes(k, l_delta - 1 + j) = 0.0_wp
          finite(k) = finite(k) .and. ieee_is_finite(stress(k, j)) .and. ieee_is_finite(strain(k, j))
        end do
      end do
      if (present(delta)) call load_delta(delta, finite)
      do k = 1, n
        tags(k, t_short) = short_untried
        tags(k, t_kind) = kind_fixed
        tags(k, t_outcome) = merge(outcome_begin, outcome_special, finite(k))
      end do
    end subroutine load

    !> The same for delta.
    !> @param given  delta of the points
    !> @param finite set to false where it is not
    subroutine load_delta(given, finite)
      real(c_double), intent(in) :: given(stride, *)
      logical, intent(inout) :: finite(most_points)
      integer :: j, k
      do j = 1, 6
        do k = 1, n
          if (m%intergranular) lanes(k, l_delta - 1 + j) = given(k, j)
          finite(k) = finite(k) .and. ieee_is_finite(given(k, j))
        end do
      end do
    end subroutine load_delta

    !> Hand what the kernel does not decide to the scalar update, and move the lanes still in use together.
    subroutine close_ranks()
      integer :: kept, j
      kept = 0
      do j = 1, left
        if (tags(j, t_outcome) == outcome_special) call update_alone(point(j))
        if (tags(j, t_outcome) /= outcome_begin .and. tags(j, t_outcome) /= outcome_going) cycle
        kept = kept + 1
        if (kept /= j) call move(j, kept)
      end do
      left = kept
      if (left > 0) call fill_up(left)
    end subroutine close_ranks

    !> A point into another lane.
    subroutine move(from, to)
      integer, intent(in) :: from, to
      lanes(to, :) = lanes(from, :)
      tags(to, :) = tags(from, :)
      point(to) = point(from)
    end subroutine move

    !> Fill the last register behind a lane with copies of it.
    subroutine fill_up(lane)
      integer, intent(in) :: lane
      integer :: j
      do j = lane + 1, padded(lane)
        call move(lane, j)
        point(j) = 0
      end do
    end subroutine fill_up

    !> Legs that begin are done in one step where they are short, and those that follow upon them.
    subroutine try_short_legs()
      integer :: n_new
      do
        n_new = partition(1, left, tags(:, t_short) == short_untried)
        if (n_new == 0) exit
        call fill_up(left)
        call attempt_short(n_new)
        call end_segments()
        call close_ranks()
      end do
    end subroutine try_short_legs

    !> Will the series of the path mostly reach?
    pure function is_near() result(near)
      logical :: near(n_lanes)
      near(:left) = lanes(:left, l_h) * lanes(:left, l_speed) < long_path * m%R * lanes(:left, l_rho)
      near(left + 1:) = .true.
    end function is_near

    !> Bring lanes first to last into the order of a property.
    !> @return the last that has it
    function partition(first, last, has) result(end)
      integer, intent(in) :: first, last
      logical, intent(in) :: has(n_lanes)
      integer :: end
      logical :: mine(n_lanes)
      integer :: other, held_point
      real(wp) :: held(n_fields)
      integer(int64) :: held_tag(n_tags)
      mine = has
      end = first - 1
      other = last
      do
        do while (end < other)
          if (.not. mine(end + 1)) exit
          end = end + 1
        end do
        do while (end < other)
          if (mine(other)) exit
          other = other - 1
        end do
        if (end >= other) return
        held = lanes(end + 1, :)
        held_tag = tags(end + 1, :)
        held_point = point(end + 1)
        call move(other, end + 1)
        lanes(other, :) = held
        tags(other, :) = held_tag
        point(other) = held_point
        mine(end + 1) = .true.
        mine(other) = .false.
      end do
    end function partition

    !> Number of lanes in whole registers.
    pure function padded(in_use) result(whole)
      integer, intent(in) :: in_use
      integer :: whole
      whole = width * ((in_use + width - 1) / width)
    end function padded

    subroutine begin_increments()
      select case (instructions)
#ifdef HYPOFAB_BATCH_X86
      case (avx512)
        call begin_increment_avx512(m, padded(left), lanes, tags)
      case (avx2)
        call begin_increment_avx2(m, padded(left), lanes, tags)
#endif
      case default
        call begin_increment_portable(m, padded(left), lanes, tags)
      end select
    end subroutine begin_increments

    !> Begin the segments that are to begin, and try one step in every lane. Those with long paths stand together, so that few
    !> registers do more than the series of the path.
    subroutine step_all()
      integer :: near
      if (any(tags(:left, t_outcome) == outcome_begin)) call begin_segments()
      near = partition(1, left, is_near())
      call fill_up(left)
      call attempt()
      call end_segments()
      call close_ranks()
    end subroutine step_all

    subroutine begin_segments()
      select case (instructions)
#ifdef HYPOFAB_BATCH_X86
      case (avx512)
        call begin_segment_avx512(m, options, padded(left), lanes, tags)
      case (avx2)
        call begin_segment_avx2(m, options, padded(left), lanes, tags)
#endif
      case default
        call begin_segment_portable(m, options, padded(left), lanes, tags)
      end select
    end subroutine begin_segments

    !> @param n lanes that begin a leg, the first ones
    subroutine attempt_short(n)
      integer, intent(in) :: n
      select case (instructions)
#ifdef HYPOFAB_BATCH_X86
      case (avx512)
        call attempt_short_avx512(m, options%tolerance, padded(n), lanes, tags)
      case (avx2)
        call attempt_short_avx2(m, options%tolerance, padded(n), lanes, tags)
#endif
      case default
        call attempt_short_portable(m, options%tolerance, padded(n), lanes, tags)
      end select
    end subroutine attempt_short

    subroutine attempt()
      select case (instructions)
#ifdef HYPOFAB_BATCH_X86
      case (avx512)
        call attempt_step_avx512(m, options%tolerance, padded(left), lanes, tags)
      case (avx2)
        call attempt_step_avx2(m, options%tolerance, padded(left), lanes, tags)
#endif
      case default
        call attempt_step_portable(m, options%tolerance, padded(left), lanes, tags)
      end select
    end subroutine attempt

    !> Loading follows upon a reversal, or the increment is done; another step may not be taken everywhere.
    subroutine end_segments()
      integer :: lane(n_lanes), done, j, k
      done = 0
      do k = 1, left
        if (tags(k, t_outcome) == outcome_going .and. .not. may_go_on(k)) tags(k, t_outcome) = outcome_special
        if (tags(k, t_outcome) /= outcome_segment_done) cycle
        if (lanes(k, l_rest) > 0.0_wp) then
          lanes(k, l_length) = lanes(k, l_rest)
          lanes(k, l_rest) = 0.0_wp
          lanes(k, l_done) = 0.0_wp
          tags(k, t_kind) = kind_plane
          tags(k, t_outcome) = outcome_begin
          tags(k, t_short) = short_untried
        else
          done = done + 1
          lane(done) = k
        end if
      end do
      do j = 1, 6
        do k = 1, done
          stress(point(lane(k)), j) = lanes(lane(k), l_stress - 1 + j)
        end do
      end do
      do k = 1, done
        void_ratio(point(lane(k))) = lanes(lane(k), l_e)
        status(point(lane(k))) = status_ok
        evaluations(point(lane(k))) = int(lanes(lane(k), l_evaluations), c_int)
      end do
      if (m%intergranular) call store_delta(delta, lane, done)
    end subroutine end_segments

    !> delta of points that are done.
    subroutine store_delta(taken, lane, done)
      real(c_double), intent(inout) :: taken(stride, *)
      integer, intent(in) :: lane(n_lanes), done
      integer :: j, k
      do j = 1, 6
        do k = 1, done
          taken(point(lane(k)), j) = lanes(lane(k), l_delta - 1 + j)
        end do
      end do
    end subroutine store_delta

    !> May a lane take another step here? The scalar update knows why a bound is reached.
    pure function may_go_on(lane) result(yes)
      integer, intent(in) :: lane
      logical :: yes
     yes = lanes(lane, l_evaluations) <= options%max_evaluations .and. lanes(lane, l_refused) <= most_refused
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
      evaluations(k) = int(report%evaluations, c_int)
      scalar = scalar + 1
      if (outcome /= status_ok) return
      stress(k, :6) = state%stress
      if (m%intergranular) delta(k, :6) = state%delta
      void_ratio(k) = state%void_ratio
    end subroutine update_alone

  end subroutine update_group

end module umat_batch
