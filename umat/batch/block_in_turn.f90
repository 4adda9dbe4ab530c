!> The update of a block of points, one after the other.
!>
!> The libraries hold block.f90 in place of this file, the same module over the update of many points side by side.
!> This one is for the single file of Abaqus users, which a compiler must take without options of ours.
module umat_block
  use umat_kinds, only: wp
  use umat_material, only: material_type
  use umat_rate, only: state_type
  use umat_update, only: options_type, report_type, update_state
  implicit none
  private
  public :: update_block, largest_block

  !> Points of a block at most.
  integer, parameter :: largest_block = 256

contains

  !> One strain increment of points of one material, at the default tolerance.
  !> @param m           material
  !> @param n           number of points, up to largest_block
  !> @param stress, delta, void_ratio in: start, out: end; a point's are untouched if its update fails
  !> @param strain      strain increments, tensor components
  !> @param status      of each point, as update_state gives it
  !> @param evaluations rate evaluations of each point
  subroutine update_block(m, n, stress, delta, void_ratio, strain, status, evaluations)
    type(material_type), intent(in) :: m
    integer, intent(in) :: n
    real(wp), intent(inout) :: stress(largest_block, 6), delta(largest_block, 6), void_ratio(largest_block)
    real(wp), intent(in) :: strain(largest_block, 6)
    integer, intent(inout) :: status(largest_block), evaluations(largest_block)
    type(state_type) :: state
    type(report_type) :: report
    real(wp) :: increment(6)
    integer :: i
    do i = 1, n
      state = state_type(stress(i, :), delta(i, :), void_ratio(i))
      increment = strain(i, :)
      call update_state(m, options_type(), state, increment, report, status(i))
      evaluations(i) = report%evaluations
      stress(i, :) = state%stress
      delta(i, :) = state%delta
      void_ratio(i) = state%void_ratio
    end do
  end subroutine update_block

end module umat_block
