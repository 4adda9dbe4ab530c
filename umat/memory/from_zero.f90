!> delta that grows from zero under a constant direction of strain.
!>
!> With y = lambda/R and s = y^beta_r, theory.md Eq. (14) reads rho' = 1 - rho^beta_r, and rho = y (c_0 + c_1 s + c_2 s^2 + ...).
!> What is a power of y at delta = 0, and no polynomial there, becomes one of s; the coefficients depend on beta_r alone.
module umat_from_zero
  use umat_kinds, only: wp
  use umat_material, only: material_type
  implicit none
  private
  public :: from_zero_type, from_zero, terms

  !> Highest power of s.
  integer, parameter :: terms = 12

  !> Series in s: of rho/y, and of two integrals over a leg of rho^chi/y^chi, with the place in the leg from 0 to 1.
  type :: from_zero_type
    real(wp), dimension(0:terms) :: rho
    real(wp), dimension(0:terms) :: mean !< integral of rho^chi
    real(wp), dimension(0:terms) :: moment !< integral of rho^chi times the place
  end type from_zero_type

contains

  !> The series of a material with intergranular strain; theory.md Eqs. (17c).
  pure function from_zero(m) result(series)
    type(material_type), intent(in) :: m
    type(from_zero_type) :: series
    real(wp), dimension(0:terms) :: to_beta, to_chi !< coefficients of (rho/y)^beta_r and (rho/y)^chi
    integer :: k
    series%rho(0) = 1.0_wp
    to_beta(0) = 1.0_wp
    to_chi(0) = 1.0_wp
    do k = 1, terms
      series%rho(k) = -to_beta(k - 1) / (1.0_wp + k * m%beta_r)
      to_beta(k) = power_term(series%rho(0:k), m%beta_r, to_beta(0:k - 1))
      to_chi(k) = power_term(series%rho(0:k), m%chi, to_chi(0:k - 1))
    end do
    do k = 0, terms
      series%mean(k) = to_chi(k) / (m%chi + 1.0_wp + k * m%beta_r)
      series%moment(k) = to_chi(k) / (m%chi + 2.0_wp + k * m%beta_r)
    end do
  end function from_zero

  !> Next coefficient of the power of a series that begins with 1 (Euler's recurrence).
  !> @param base     the series, one term longer than power
  !> @param exponent of the power
  !> @param power    coefficients so far
  pure function power_term(base, exponent, power) result(term)
    real(wp), intent(in) :: base(0:), exponent, power(0:)
    real(wp) :: term
    integer :: k, n
    n = size(power)
    term = 0.0_wp
    do k = 1, n
      term = term + (k * (exponent + 1.0_wp) - n) * base(k) * power(n - k)
    end do
    term = term / n
  end function power_term

end module umat_from_zero
