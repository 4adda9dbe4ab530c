!> Fabric tensors of the first, second and third kind of a distribution of directions (Kanatani 1984, Int. J. Engng Sci.
!> 22, 149-164), of rank 2 and 4, in three dimensions and in the plane.
!>
!> First kind: the moments <n n> and <n n n n>. Third kind: the traceless coefficients D of the density
!>   f(n) = f0 (1 + D2:nn + D4::nnnn),   f0 = 1/(4 pi) on the sphere, 1/(2 pi) on the circle,
!> cut off after rank 2 or 4, that comes nearest to the distribution; they are its harmonics of degree 2 and 4. Second
!> kind: the same density as one tensor, f = f0 F::nnnn, with f0 F2:nn when it ends at rank 2.
module hypofab_kinds
  use, intrinsic :: iso_c_binding, only: wp => c_double
  use hypofab_rank4, only: unit_tensor, unit_times, unit_times_unit
  implicit none
  private
  public :: third_kind, second_kind

contains

  !> Third kind from the first (Kanatani 1984):
  !>   sphere  D2 = 15/2 (N2 - 1/3 1),  D4 = 315/8 (N4 - 6/7 {1 N2} + 3/35 {1 1}),
  !>   plane   D2 = 4 (N2 - 1/2 1),     D4 = 16 (N4 - {1 N2} + 1/8 {1 1}),
  !> where {} is the fully symmetric part.
  !> @param dimension 3, or 2 for the plane xy
  !> @param first2    (6): N2, trace 1
  !> @param first4    (15): N4, whose contraction is N2
  !> @param third2    (6), @param third4 (15): filled, traceless
  pure subroutine third_kind(dimension, first2, first4, third2, third4)
    integer, intent(in) :: dimension
    real(wp), intent(in) :: first2(6), first4(15)
    real(wp), intent(out) :: third2(6), third4(15)

    if (dimension == 3) then
      third2 = 7.5_wp * (first2 - unit_tensor(3) / 3.0_wp)
      third4 = 39.375_wp * (first4 - 6.0_wp / 7.0_wp * unit_times(first2, 3) + 3.0_wp / 35.0_wp * unit_times_unit(3))
    else
      third2 = 4.0_wp * (first2 - unit_tensor(2) / 2.0_wp)
      third4 = 16.0_wp * (first4 - unit_times(first2, 2) + unit_times_unit(2) / 8.0_wp)
    end if
  end subroutine third_kind

  !> Second kind from the third: as n.n = 1, F2 = 1 + D2 and F4 = {1 1} + {1 D2} + D4.
  !> @param dimension 3, or 2 for the plane xy
  !> @param third2    (6), @param third4 (15): third kind
  !> @param second2   (6), @param second4 (15): filled
  pure subroutine second_kind(dimension, third2, third4, second2, second4)
    integer, intent(in) :: dimension
    real(wp), intent(in) :: third2(6), third4(15)
    real(wp), intent(out) :: second2(6), second4(15)

    second2 = unit_tensor(dimension) + third2
    second4 = unit_times_unit(dimension) + unit_times(third2, dimension) + third4
  end subroutine second_kind

end module hypofab_kinds
