!> A group of points that goes through the rounds together: which point is in which lane, and what a lane holds.
!>
!> The lanes in use stand in front. The last register is filled up with copies, so that the kernel works on whole ones.
module umat_batch_group
  use, intrinsic :: iso_fortran_env, only: int64
  use umat_lanes
  use umat_many_lanes, only: n_lanes, width
  use umat_kinds, only: wp
  implicit none
  private
  public :: group_type, whole_registers

  !> A group. No component has a value by default, for the compiler would copy a whole group to set it.
  type :: group_type
    real(wp) :: lanes(n_lanes, n_fields)
    integer(int64) :: tags(n_lanes, n_tags)
    integer :: point(n_lanes) !< whose numbers a lane holds
    integer :: left !< number of lanes in use; behind them are copies, whose point is 0
  contains
    procedure :: move, exchange, fill_up, bring_forward, begin_loading, any_begins
  end type group_type

contains

  !> What a lane holds into another.
  pure subroutine move(group, from, to)
    class(group_type), intent(inout) :: group
    integer, intent(in) :: from, to
    group%lanes(to, :) = group%lanes(from, :)
    group%tags(to, :) = group%tags(from, :)
    group%point(to) = group%point(from)
  end subroutine move

  !> What two lanes hold, the one for the other.
  pure subroutine exchange(group, a, b)
    class(group_type), intent(inout) :: group
    integer, intent(in) :: a, b
    real(wp) :: fields(n_fields)
    integer(int64) :: tags(n_tags)
    integer :: point
    fields = group%lanes(a, :)
    tags = group%tags(a, :)
    point = group%point(a)
    call group%move(b, a)
    group%lanes(b, :) = fields
    group%tags(b, :) = tags
    group%point(b) = point
  end subroutine exchange

  !> Fill the last register behind the lanes in use with copies of the last of them.
  pure subroutine fill_up(group)
    class(group_type), intent(inout) :: group
    integer :: lane
    do lane = group%left + 1, whole_registers(group%left)
      call group%move(group%left, lane)
      group%point(lane) = 0
    end do
  end subroutine fill_up

  !> Bring the lanes that have a property in front of those in use that have not.
  !> @return the last that has it
  pure subroutine bring_forward(group, has, last)
    class(group_type), intent(inout) :: group
    logical, intent(in) :: has(n_lanes)
    integer, intent(out) :: last
    logical :: mine(n_lanes)
    integer :: other
    mine = has
    last = 0
    other = group%left
    do
      do while (last < other)
        if (.not. mine(last + 1)) exit
        last = last + 1
      end do
      do while (last < other)
        if (mine(other)) exit
        other = other - 1
      end do
      if (last >= other) return
      call group%exchange(last + 1, other)
      mine(last + 1) = .true.
      mine(other) = .false.
    end do
  end subroutine bring_forward

  !> A reversal is done: what is left of the increment is loading.
  pure subroutine begin_loading(group, lane)
    class(group_type), intent(inout) :: group
    integer, intent(in) :: lane
    group%lanes(lane, l_length) = group%lanes(lane, l_rest)
    group%lanes(lane, l_rest) = 0.0_wp
    group%lanes(lane, l_done) = 0.0_wp
    group%tags(lane, t_kind) = kind_plane
    group%tags(lane, t_outcome) = outcome_begin
    group%tags(lane, t_short) = short_untried
  end subroutine begin_loading

  !> Is any lane about to begin a segment?
  pure function any_begins(group) result(yes)
    class(group_type), intent(in) :: group
    logical :: yes
    yes = any(group%tags(:group%left, t_outcome) == outcome_begin)
  end function any_begins

  !> Number of lanes in the registers that so many points fill.
  elemental function whole_registers(points) result(lanes)
    integer, intent(in) :: points
    integer :: lanes
    lanes = width * ((points + width - 1) / width)
  end function whole_registers

end module umat_batch_group
