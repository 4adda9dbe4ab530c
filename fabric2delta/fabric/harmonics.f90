!> Harmonics of even degree on the sphere and on the circle, for densities of directions without sense (n and -n alike).
!>
!> Normalised so that the mean of a squared harmonic over all directions is 1. A density is then f0 sum c_k Y_k(n) with
!> c_k = <Y_k>, c_1 = 1, and N independent isotropic directions give N c_k^2 a mean of 1.
module hypofab_harmonics
  use, intrinsic :: iso_c_binding, only: wp => c_double, c_int
  implicit none
  private
  public :: harmonics_of, harmonics_count

  !> Largest degree, and the number of harmonics of even degree up to it on the sphere (on the circle: 9).
  integer, parameter, public :: largest_degree = 8, most_harmonics = 45

contains

  !> Number of harmonics of even degree up to a degree: (degree + 1)(degree + 2)/2 on the sphere, degree + 1 on the circle.
  pure function harmonics_count(dimension, degree) result(n) bind(C, name='hypofab_harmonics_count')
    integer(c_int), value, intent(in) :: dimension, degree
    integer(c_int) :: n
    if (dimension == 3) then
      n = (degree + 1) * (degree + 2) / 2
    else
      n = degree + 1
    end if
  end function harmonics_count

  !> All harmonics of even degree up to largest_degree in one direction.
  !>
  !> On the sphere, by degree l = 0, 2, .. and, within it, m = -l .. l: P_lm(z) cos(m phi) for m >= 0 and
  !> P_l|m|(z) sin(|m| phi) for m < 0, with the normalisation above; the polar axis is z. On the circle: 1 and, by degree,
  !> sqrt(2) sin(l phi), sqrt(2) cos(l phi).
  !> @param dimension 3, or 2 for the plane xy
  !> @param n         unit vector; in the plane its z is not used
  !> @param y         filled; beyond the count of the dimension: 0
  pure subroutine harmonics_of(dimension, n, y) bind(C, name='hypofab_harmonics_of')
    integer(c_int), value, intent(in) :: dimension
    real(wp), intent(in) :: n(3)
    real(wp), intent(out) :: y(most_harmonics)
    real(wp) :: cosines(0:largest_degree), sines(0:largest_degree)
    integer :: m

    ! Re and Im of (x + i y)^m: on the sphere they carry the factor sin^m of the polar angle.
    cosines(0) = 1.0_wp
    sines(0) = 0.0_wp
    do m = 1, largest_degree
      cosines(m) = n(1) * cosines(m - 1) - n(2) * sines(m - 1)
      sines(m) = n(1) * sines(m - 1) + n(2) * cosines(m - 1)
    end do
    if (dimension == 3) then
      call fill_sphere(n(3), cosines, sines, y)
    else
      y = 0.0_wp
      y(1) = 1.0_wp
      y(2:largest_degree:2) = sqrt(2.0_wp) * sines(2:largest_degree:2)
      y(3:largest_degree + 1:2) = sqrt(2.0_wp) * cosines(2:largest_degree:2)
    end if
  end subroutine harmonics_of

  !> The part in z: normalised associated Legendre functions over sin^m, by the recurrence in the degree, which is stable.
  pure subroutine fill_sphere(z, cosines, sines, y)
    real(wp), intent(in) :: z, cosines(0:largest_degree), sines(0:largest_degree)
    real(wp), intent(out) :: y(most_harmonics)
    real(wp) :: diagonal, below, here, above
    integer :: l, m, middle

    diagonal = 1.0_wp
    do m = 0, largest_degree
      if (m == 1) diagonal = sqrt(3.0_wp)
      if (m > 1) diagonal = diagonal * sqrt((2 * m + 1) / (2.0_wp * m))
      below = 0.0_wp
      here = diagonal
      do l = m, largest_degree
        if (modulo(l, 2) == 0) then
          middle = l * (l - 1) / 2 + l + 1 ! place of (l, 0)
          y(middle + m) = here * cosines(m)
          if (m > 0) y(middle - m) = here * sines(m)
        end if
        above = (sqrt((2.0_wp * l + 1) * (2 * l + 3)) * z * here - &
                 sqrt((2.0_wp * l + 3) * (l + m) * (l - m) / max(2.0_wp * l - 1, 1.0_wp)) * below) / &
                sqrt((l + 1.0_wp - m) * (l + 1 + m))
        below = here
        here = above
      end do
    end do
  end subroutine fill_sphere

end module hypofab_harmonics
