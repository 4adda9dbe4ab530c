!> The points of a call in the arrays of the caller: into a group and back.
module umat_batch_points
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use, intrinsic :: iso_c_binding, only: c_double, c_int, c_int64_t
  use umat_batch_group, only: group_type
  use umat_lanes
  use umat_many_lanes, only: most_points, n_lanes
  use umat_kinds, only: wp
  use umat_material, only: material_type
  use umat_rate, only: state_type
  use umat_status, only: status_ok
  use umat_update, only: options_type, report_type, update_state
  implicit none
  private
  public :: points_type

  !> Arrays of the caller, one row per point.
  type :: points_type
    !> In: start, out: end; a point's are untouched if its update fails. delta may be absent in the plain model, which only
    !> checks it.
    real(c_double), pointer, contiguous :: stress(:, :), delta(:, :), void_ratio(:)
    real(c_double), pointer, contiguous :: strain(:, :) !< increments, tensor components
    integer(c_int), pointer, contiguous :: status(:) !< as update_state gives it
    integer(c_int), pointer, contiguous :: evaluations(:) !< of the rate
    integer(c_int64_t) :: scalar = 0 !< number of points that update_state did
  contains
    procedure :: load, store, update_alone
  end type points_type

contains

  !> Put points into the lanes of a group. Loops, because array expressions of a size that is not constant are allocated.
  !> @param before number of points before the first
  !> @param n      number of points
  pure subroutine load(points, m, before, n, group)
    class(points_type), intent(in) :: points
    type(material_type), intent(in) :: m
    integer, intent(in) :: before, n
    type(group_type), intent(inout) :: group
    logical :: finite(most_points)
    integer :: j, k
    group%left = n
    do k = 1, n
      group%lanes(k, l_e) = points%void_ratio(before + k)
      group%point(k) = before + k
      finite(k) = ieee_is_finite(points%void_ratio(before + k))
    end do
    do j = 1, 6
      do k = 1, n
        group%lanes(k, l_stress - 1 + j) = points%stress(before + k, j)
        group%lanes(k, l_strain - 1 + j) = points%strain(before + k, j)
        group%lanes(k, l_delta - 1 + j) = 0.0_wp
        finite(k) = finite(k) .and. ieee_is_finite(points%stress(before + k, j)) .and. &
                    ieee_is_finite(points%strain(before + k, j))
      end do
    end do
    if (associated(points%delta)) then
      do j = 1, 6
        do k = 1, n
          if (m%intergranular) group%lanes(k, l_delta - 1 + j) = points%delta(before + k, j)
          finite(k) = finite(k) .and. ieee_is_finite(points%delta(before + k, j))
        end do
      end do
    end if
    do k = 1, n
      group%tags(k, t_short) = short_untried
      group%tags(k, t_kind) = kind_fixed
      group%tags(k, t_outcome) = merge(outcome_begin, outcome_special, finite(k))
    end do
  end subroutine load

  !> The end of the increment of points that are done.
  !> @param done number of them
  !> @param lane where they are, lane(:done)
  subroutine store(points, m, group, done, lane)
    class(points_type), intent(in) :: points
    type(material_type), intent(in) :: m
    type(group_type), intent(in) :: group
    integer, intent(in) :: done, lane(n_lanes)
    integer :: j, k
    do j = 1, 6
      do k = 1, done
        points%stress(group%point(lane(k)), j) = group%lanes(lane(k), l_stress - 1 + j)
      end do
    end do
    do k = 1, done
      points%void_ratio(group%point(lane(k))) = group%lanes(lane(k), l_e)
      points%status(group%point(lane(k))) = status_ok
      points%evaluations(group%point(lane(k))) = int(group%lanes(lane(k), l_evaluations), c_int)
    end do
    if (.not. m%intergranular) return
    do j = 1, 6
      do k = 1, done
        points%delta(group%point(lane(k)), j) = group%lanes(lane(k), l_delta - 1 + j)
      end do
    end do
  end subroutine store

  !> The scalar update of a point, from its start.
  !> @param k which point
  subroutine update_alone(points, m, options, k)
    class(points_type), intent(inout) :: points
    type(material_type), intent(in) :: m
    type(options_type), intent(in) :: options
    integer, intent(in) :: k
    type(state_type) :: state
    type(report_type) :: report
    integer :: outcome
    real(wp) :: increment(6)
    state = state_type(points%stress(k, :), 0.0_wp, points%void_ratio(k))
    if (associated(points%delta)) state%delta = points%delta(k, :)
    increment = points%strain(k, :)
    call update_state(m, options, state, increment, report, outcome)
    points%status(k) = int(outcome, c_int)
    points%evaluations(k) = int(report%evaluations, c_int)
    points%scalar = points%scalar + 1
    if (outcome /= status_ok) return
    points%stress(k, :) = state%stress
    if (m%intergranular) points%delta(k, :) = state%delta
    points%void_ratio(k) = state%void_ratio
  end subroutine update_alone

end module umat_batch_points
