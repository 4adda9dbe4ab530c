!> Strain increments of many material points side by side: the same integration as update_state, one point per lane of
!> the vector registers.
!>
!> A group of points goes through rounds. In a round every point tries one step (step.f90); points whose increment
!> is done leave, the others close ranks, so that no lane runs empty while others need more steps. Points that the kernel
!> does not decide (input that is not finite, states outside the domain or close to its border, ...) are left to
!> update_state. What happens to a point depends on that point alone: not on its lane, its neighbours or the group.
module umat_batch
  use, intrinsic :: iso_c_binding, only: c_double, c_int, c_int64_t
  use umat_batch_group, only: group_type, whole_registers
  use umat_batch_kernel, only: kernel_type, kernel_of
  use umat_lanes
  use umat_many_lanes, only: most_points, n_lanes
  use umat_batch_points, only: points_type
  use umat_kinds, only: wp
  use umat_material, only: material_type, material_from_props, n_parameters
  use umat_step, only: most_share
  use umat_update, only: options_type
  implicit none
  private
  public :: update_points, update_many

  !> A path on which more steps are refused has a kink (the densest packing is reached, the isotropic axis is crossed), where
  !> rounding decides on the sequence of steps: the scalar update is to take it.
  integer, parameter :: most_refused = 6
  !> Step over |delta| beyond which the series of the path will mostly not reach.
  real(wp), parameter :: long_path = 0.2_wp

  !> What all points of a call have in common.
  type :: common_type
    type(material_type) :: m
    type(options_type) :: options
    type(kernel_type) :: kernel
  end type common_type

contains

  !> One strain increment of points of one material, for C.
  !> @param props           the 16 parameters, admissible
  !> @param tolerance       as in options_type, above zero
  !> @param max_evaluations as in options_type, above zero
  !> @param regularised     not zero: a response beyond the domain too (border.f90)
  !> @param instructions    one of the instruction sets (batch.h), which the processor must have
  !> @param n               number of points
  !> @param stride          distance of two components of a tensor in the arrays, at least n
  !> @param stress, delta, void_ratio in: start, out: end; a point's are untouched if its update fails. delta of the plain
  !>                        model is only checked, and may be absent
  !> @param strain          strain increments, tensor components
  !> @param status          of each point, as update_state gives it
  !> @param evaluations     rate evaluations of each point
  !> @param scalar          the number of points that update_state did is added
  subroutine update_points(props, tolerance, max_evaluations, regularised, instructions, n, stride, stress, delta, &
                           void_ratio, strain, status, evaluations, scalar) bind(C, name='hypofab_update_points')
    real(c_double), intent(in) :: props(n_parameters)
    real(c_double), intent(in) :: tolerance
    integer(c_int), intent(in) :: max_evaluations
    integer(c_int), value :: regularised, instructions, n
    integer(c_int64_t), value :: stride
    real(c_double), intent(inout), target :: stress(stride, *), void_ratio(*)
    real(c_double), intent(inout), optional, target :: delta(stride, *)
    real(c_double), intent(in), target :: strain(stride, *)
    integer(c_int), intent(inout), target :: status(*), evaluations(*)
    integer(c_int64_t), intent(inout) :: scalar
    type(points_type) :: points
    points = points_type(stress(:, :6), null(), void_ratio(:n), strain(:, :6), status(:n), evaluations(:n))
    if (present(delta)) points%delta => delta(:, :6)
    call update_many(material_from_props(props, regularised /= 0), &
                     options_type(tolerance=tolerance, max_evaluations=max_evaluations), instructions, points)
    scalar = scalar + points%scalar
  end subroutine update_points

  !> One strain increment of points of one material.
  !> @param options      tolerance and bounds
  !> @param instructions one of the instruction sets, which the processor must have
  subroutine update_many(m, options, instructions, points)
    type(material_type), intent(in) :: m
    type(options_type), intent(in) :: options
    integer(c_int), intent(in) :: instructions
    type(points_type), intent(inout) :: points
    type(common_type) :: common
    integer :: before
    common = common_type(m, options, kernel_of(instructions))
    do before = 0, size(points%status) - 1, most_points
      call update_group(common, points, before, min(size(points%status) - before, most_points))
    end do
  end subroutine update_many

  !> The same for n points behind others, up to most_points.
  subroutine update_group(common, points, before, n)
    type(common_type), intent(in) :: common
    type(points_type), intent(inout) :: points
    integer, intent(in) :: before, n
    type(group_type) :: group
    call points%load(common%m, before, n, group)
    call close_ranks(common, points, group)
    call common%kernel%begin_increment(common%m, whole_registers(group%left), group%lanes, group%tags)
    call close_ranks(common, points, group)
    do while (group%left > 0)
      call try_short_legs(common, points, group)
      if (group%left > 0) call step_all(common, points, group)
    end do
  end subroutine update_group

  !> Hand what the kernel does not decide to the scalar update, and move the lanes still in use together.
  subroutine close_ranks(common, points, group)
    type(common_type), intent(in) :: common
    type(points_type), intent(inout) :: points
    type(group_type), intent(inout) :: group
    integer :: kept, j
    kept = 0
    do j = 1, group%left
      if (group%tags(j, t_outcome) == outcome_special) &
        call points%update_alone(common%m, common%options, group%point(j))
      if (group%tags(j, t_outcome) /= outcome_begin .and. group%tags(j, t_outcome) /= outcome_going) cycle
      kept = kept + 1
      if (kept /= j) call group%move(j, kept)
    end do
    group%left = kept
    if (kept > 0) call group%fill_up()
  end subroutine close_ranks

  !> Legs that begin are done in one step where they are short, and those that follow upon them.
  subroutine try_short_legs(common, points, group)
    type(common_type), intent(in) :: common
    type(points_type), intent(inout) :: points
    type(group_type), intent(inout) :: group
    integer :: new
    do
      call group%bring_forward(group%tags(:, t_short) == short_untried, new)
      if (new == 0) exit
      call group%fill_up()
      call common%kernel%attempt_short(common%m, most_share * common%options%tolerance, whole_registers(new), &
                                       group%lanes, group%tags)
      call end_segments(common, points, group)
      call close_ranks(common, points, group)
    end do
  end subroutine try_short_legs

  !> Begin the segments that are to begin, and try one step in every lane. Those with long paths stand together, so that few
  !> registers do more than the series of the path.
  subroutine step_all(common, points, group)
    type(common_type), intent(in) :: common
    type(points_type), intent(inout) :: points
    type(group_type), intent(inout) :: group
    integer :: near
    if (group%any_begins()) &
      call common%kernel%begin_segment(common%m, common%options, whole_registers(group%left), group%lanes, &
                                       group%tags)
    call group%bring_forward(is_near(common%m, group), near)
    call group%fill_up()
    call common%kernel%attempt_step(common%m, common%options%tolerance, whole_registers(group%left), group%lanes, &
                                    group%tags)
    call end_segments(common, points, group)
    call close_ranks(common, points, group)
  end subroutine step_all

  !> Will the series of the path mostly reach?
  pure function is_near(m, group) result(near)
    type(material_type), intent(in) :: m
    type(group_type), intent(in) :: group
    logical :: near(n_lanes)
    near(:group%left) = group%lanes(:group%left, l_h) * group%lanes(:group%left, l_speed) < &
                        long_path * m%R * group%lanes(:group%left, l_rho)
    near(group%left + 1:) = .true.
  end function is_near

  !> Loading follows upon a reversal, or the increment is done; another step may not be taken everywhere.
  subroutine end_segments(common, points, group)
    type(common_type), intent(in) :: common
    type(points_type), intent(inout) :: points
    type(group_type), intent(inout) :: group
    integer :: lane(n_lanes), done, k
    done = 0
    do k = 1, group%left
      if (group%tags(k, t_outcome) == outcome_going .and. .not. may_go_on(common%options, group, k)) &
        group%tags(k, t_outcome) = outcome_special
      if (group%tags(k, t_outcome) /= outcome_segment_done) cycle
      if (group%lanes(k, l_rest) > 0.0_wp) then
        call group%begin_loading(k)
      else
        done = done + 1
        lane(done) = k
      end if
    end do
    call points%store(common%m, group, done, lane)
  end subroutine end_segments

  !> May a lane take another step here? The scalar update knows why a bound is reached.
  pure function may_go_on(options, group, lane) result(yes)
    type(options_type), intent(in) :: options
    type(group_type), intent(in) :: group
    integer, intent(in) :: lane
    logical :: yes
    yes = group%lanes(lane, l_evaluations) <= options%max_evaluations .and. group%lanes(lane, l_refused) <= most_refused
  end function may_go_on

end module umat_batch
