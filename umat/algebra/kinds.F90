!> The working precision of the constitutive model, and pi in it.
!>
!> Double precision; the tests compile the same sources in quadruple precision (HYPOFAB_QUADRUPLE) to check derivatives
!> and rounding against a more exact arithmetic.
module umat_kinds
  use, intrinsic :: iso_fortran_env, only: real64, real128
  implicit none
  private
#ifdef HYPOFAB_QUADRUPLE
  integer, parameter, public :: wp = real128
#else
  integer, parameter, public :: wp = real64
#endif
  real(wp), parameter, public :: pi = 3.14159265358979323846264338327950288_wp
end module umat_kinds
