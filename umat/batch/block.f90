!> The update of a block of points side by side; block_in_turn.f90 is the same module without the batch.
module umat_block
  use, intrinsic :: iso_c_binding, only: c_int, c_int64_t
  use umat_batch, only: update_many
  use umat_kinds, only: wp
  use umat_material, only: material_type
  use umat_update, only: options_type
  implicit none
  private
  public :: update_block, largest_block

  !> Points of a block at most.
  integer, parameter :: largest_block = 256

  interface
    !> instructions.c: the best instruction set of this processor.
    function best_instructions() bind(C, name='hypofab_batch_best_instructions')
      import :: c_int
      integer(c_int) :: best_instructions
    end function best_instructions
  end interface

contains

  !> One strain increment of points of one material, at the default tolerance; arguments as in block_in_turn.f90.
  subroutine update_block(m, n, stress, delta, void_ratio, strain, status, evaluations)
    type(material_type), intent(in) :: m
    integer, intent(in) :: n
    real(wp), intent(inout) :: stress(largest_block, 6), delta(largest_block, 6), void_ratio(largest_block)
    real(wp), intent(in) :: strain(largest_block, 6)
    integer, intent(inout) :: status(largest_block), evaluations(largest_block)
    integer(c_int64_t) :: scalar
    scalar = 0
    call update_many(m, options_type(), int(best_instructions()), n, int(largest_block, c_int64_t), stress, void_ratio, strain, &
                     status, evaluations, scalar, delta)
  end subroutine update_block

end module umat_block
