!> Fully symmetric tensors of rank 2 (six components) and rank 4 (fifteen), in three dimensions and in the plane xy.
!>
!> Rank 2: xx yy zz xy xz yz. Rank 4: xxxx xxxy xxxz xxyy xxyz xxzz xyyy xyyz xyzz xzzz yyyy yyyz yyzz yzzz zzzz. In the
!> plane every component with a z is zero and the unit tensor is that of the plane.
module hypofab_rank4
  use, intrinsic :: iso_c_binding, only: wp => c_double
  implicit none
  private
  public :: unit_tensor, double_contraction, symmetric_product, components_of, unit_times, unit_times_unit, fourth_power

  !> How often a component of rank 2 occurs in a full contraction.
  real(wp), parameter, public :: multiplicity2(6) = [1.0_wp, 1.0_wp, 1.0_wp, 2.0_wp, 2.0_wp, 2.0_wp]
  !> How often a component of rank 4 occurs in a full contraction.
  real(wp), parameter, public :: multiplicity4(15) = &
                                 [1.0_wp, 4.0_wp, 4.0_wp, 6.0_wp, 12.0_wp, 6.0_wp, 4.0_wp, 12.0_wp, 12.0_wp, 4.0_wp, &
                                  1.0_wp, 4.0_wp, 6.0_wp, 4.0_wp, 1.0_wp]

  !> Component of rank 2 at (i, j).
  integer, parameter :: at(3, 3) = reshape([1, 4, 5, 4, 2, 6, 5, 6, 3], [3, 3])
  !> The four indices of each component of rank 4.
  integer, parameter :: indices(4, 15) = reshape( &
                      [1, 1, 1, 1, 1, 1, 1, 2, 1, 1, 1, 3, 1, 1, 2, 2, 1, 1, 2, 3, 1, 1, 3, 3, 1, 2, 2, 2, 1, 2, 2, 3, &
                         1, 2, 3, 3, 1, 3, 3, 3, 2, 2, 2, 2, 2, 2, 2, 3, 2, 2, 3, 3, 2, 3, 3, 3, 3, 3, 3, 3], [4, 15])

contains

  !> The unit tensor of rank 2.
  !> @param dimension 3, or 2 for the plane xy
  pure function unit_tensor(dimension) result(unit)
    integer, intent(in) :: dimension
    real(wp) :: unit(6)
    unit = [1.0_wp, 1.0_wp, merge(1.0_wp, 0.0_wp, dimension == 3), 0.0_wp, 0.0_wp, 0.0_wp]
  end function unit_tensor

  !> a:b of two tensors of rank 2.
  pure function double_contraction(a, b) result(s)
    real(wp), intent(in) :: a(6), b(6)
    real(wp) :: s
    s = sum(multiplicity2 * a * b)
  end function double_contraction

  !> The six components of the symmetric part of a matrix.
  pure function components_of(m) result(a)
    real(wp), intent(in) :: m(3, 3)
    real(wp) :: a(6)
    a = 0.5_wp*[2.0_wp * m(1, 1), 2.0_wp * m(2, 2), 2.0_wp * m(3, 3), m(1, 2) + m(2, 1), m(1, 3) + m(3, 1), &
                  m(2, 3) + m(3, 2)]
  end function components_of

  !> Symmetric part of the single contraction a b.
  pure function symmetric_product(a, b) result(c)
    real(wp), intent(in) :: a(6), b(6)
    real(wp) :: c(6)
    c(1) = a(1) * b(1) + a(4) * b(4) + a(5) * b(5)
    c(2) = a(4) * b(4) + a(2) * b(2) + a(6) * b(6)
    c(3) = a(5) * b(5) + a(6) * b(6) + a(3) * b(3)
    c(4) = 0.5_wp * ((a(1) + a(2)) * b(4) + a(4) * (b(1) + b(2)) + a(5) * b(6) + a(6) * b(5))
    c(5) = 0.5_wp * ((a(1) + a(3)) * b(5) + a(5) * (b(1) + b(3)) + a(4) * b(6) + a(6) * b(4))
    c(6) = 0.5_wp * ((a(2) + a(3)) * b(6) + a(6) * (b(2) + b(3)) + a(4) * b(5) + a(5) * b(4))
  end function symmetric_product

  !> Fully symmetric part of unit (x) a: the mean over the six ways to share out four indices among two pairs.
  pure function unit_times(a, dimension) result(t)
    real(wp), intent(in) :: a(6)
    integer, intent(in) :: dimension
    real(wp) :: t(15)
    real(wp) :: unit(6)
    integer :: m

    unit = unit_tensor(dimension)
    do m = 1, 15
      associate (i => indices(1, m), j => indices(2, m), k => indices(3, m), l => indices(4, m))
        t(m) = (unit(at(i, j)) * a(at(k, l)) + unit(at(k, l)) * a(at(i, j)) + unit(at(i, k)) * a(at(j, l)) + &
                unit(at(j, l)) * a(at(i, k)) + unit(at(i, l)) * a(at(j, k)) + unit(at(j, k)) * a(at(i, l))) / 6.0_wp
      end associate
    end do
  end function unit_times

  !> Fully symmetric part of unit (x) unit.
  pure function unit_times_unit(dimension) result(t)
    integer, intent(in) :: dimension
    real(wp) :: t(15)
    t = unit_times(unit_tensor(dimension), dimension)
  end function unit_times_unit

  !> n n n n of a vector.
  pure function fourth_power(n) result(t)
    real(wp), intent(in) :: n(3)
    real(wp) :: t(15)
    real(wp) :: xx, yy, zz, xy, xz, yz

    xx = n(1) * n(1)
    yy = n(2) * n(2)
    zz = n(3) * n(3)
    xy = n(1) * n(2)
    xz = n(1) * n(3)
    yz = n(2) * n(3)
    t = [xx * xx, xx * xy, xx * xz, xx * yy, xx * yz, xx * zz, xy * yy, xz * yy, xy * zz, xz * zz, &
         yy * yy, yy * yz, yy * zz, yz * zz, zz * zz]
  end function fourth_power

end module hypofab_rank4
