!> What the benchmarks say of many measurements.
module bench_statistics
  use umat_kinds, only: wp
  implicit none
  private
  public :: median

contains

  !> Median, by sorting a copy.
  pure function median(values) result(middle)
    real(wp), intent(in) :: values(:)
    real(wp) :: middle
    real(wp) :: sorted(size(values)), held
    integer :: a, b
    sorted = values
    do a = 2, size(sorted)
      held = sorted(a)
      do b = a - 1, 1, -1
        if (sorted(b) <= held) exit
        sorted(b + 1) = sorted(b)
      end do
      sorted(b + 1) = held
    end do
    middle = sorted((size(sorted) + 1) / 2)
  end function median

end module bench_statistics
