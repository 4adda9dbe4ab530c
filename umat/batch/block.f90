!> The update of a block of points side by side; block_in_turn.f90 is the same module without the batch.
module umat_block
  use umat_batch, only: update_many
  use umat_batch_kernel, only: best_instructions
  use umat_batch_points, only: points_type
  use umat_kinds, only: wp
  use umat_material, only: material_type
  use umat_update, only: options_type
  implicit none
  private
  public :: update_block, largest_block

  !> Points of a block at most.
  integer, parameter :: largest_block = 256

contains

  !> One strain increment of points of one material, at the default tolerance; arguments as in block_in_turn.f90.
  subroutine update_block(m, n, stress, delta, void_ratio, strain, status, evaluations)
    type(material_type), intent(in) :: m
    integer, intent(in) :: n
    real(wp), intent(inout), target :: stress(largest_block, 6), delta(largest_block, 6), void_ratio(largest_block)
    real(wp), intent(in), target :: strain(largest_block, 6)
    integer, intent(inout), target :: status(largest_block), evaluations(largest_block)
    type(points_type) :: points
    points = points_type(stress, delta, void_ratio, strain, status(:n), evaluations(:n))
    call update_many(m, options_type(), best_instructions(), points)
  end subroutine update_block

end module umat_block
