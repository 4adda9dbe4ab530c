!> What the benchmarks say of many measurements.
module bench_statistics
  use umat_kinds, only: wp
  implicit none
  private
  public :: median, quantile

contains

  !> Median.
  pure function median(values) result(middle)
    real(wp), intent(in) :: values(:)
    real(wp) :: middle
    middle = quantile(values, 0.5_wp)
  end function median

  !> The smallest value that a part of the values does not exceed, by sorting a copy.
  !> @param part 0 to 1
  pure function quantile(values, part) result(middle)
    real(wp), intent(in) :: values(:), part
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
    middle = sorted(max(1, ceiling(part * size(sorted))))
  end function quantile

end module bench_statistics
