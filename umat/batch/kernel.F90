!> The kernel of an instruction set: the procedures that work on the lanes of a group, chosen at run time.
module umat_batch_kernel
  use, intrinsic :: iso_c_binding, only: c_int
  use umat_batch_begin_portable, only: begin_increment_portable => begin_increment, begin_segment_portable => begin_segment
  use umat_lanes_short_portable, only: attempt_short_portable => attempt_short
  use umat_batch_step_portable, only: attempt_step_portable => attempt_step
#ifdef HYPOFAB_BATCH_X86
  use umat_batch_begin_avx2, only: begin_increment_avx2 => begin_increment, begin_segment_avx2 => begin_segment
  use umat_lanes_short_avx2, only: attempt_short_avx2 => attempt_short
  use umat_batch_step_avx2, only: attempt_step_avx2 => attempt_step
  use umat_batch_begin_avx512, only: begin_increment_avx512 => begin_increment, begin_segment_avx512 => begin_segment
  use umat_lanes_short_avx512, only: attempt_short_avx512 => attempt_short
  use umat_batch_step_avx512, only: attempt_step_avx512 => attempt_step
#endif
  implicit none
  private
  public :: kernel_type, kernel_of, best_instructions

  !> Instruction sets, the same numbers as in batch.h.
  integer, parameter :: avx2 = 1, avx512 = 2

  !> What a kernel does; described in begin.f90, short.f90 and step.f90.
  type :: kernel_type
    procedure(begin_increment_portable), pointer, nopass :: begin_increment
    procedure(begin_segment_portable), pointer, nopass :: begin_segment
    procedure(attempt_short_portable), pointer, nopass :: attempt_short
    procedure(attempt_step_portable), pointer, nopass :: attempt_step
  end type kernel_type

  interface
    !> instructions.c: the best instruction set of this processor.
    function best_instructions() bind(C, name='hypofab_batch_best_instructions')
      import :: c_int
      integer(c_int) :: best_instructions
    end function best_instructions
  end interface

contains

  !> The kernel of an instruction set.
  !> @param instructions one that the processor has
  function kernel_of(instructions) result(kernel)
    integer(c_int), intent(in) :: instructions
    type(kernel_type) :: kernel
    select case (instructions)
#ifdef HYPOFAB_BATCH_X86
    case (avx512)
      kernel = kernel_type(begin_increment_avx512, begin_segment_avx512, attempt_short_avx512, attempt_step_avx512)
    case (avx2)
      kernel = kernel_type(begin_increment_avx2, begin_segment_avx2, attempt_short_avx2, attempt_step_avx2)
#endif
    case default
      kernel = kernel_type(begin_increment_portable, begin_segment_portable, attempt_short_portable, attempt_step_portable)
    end select
  end function kernel_of

end module umat_batch_kernel
