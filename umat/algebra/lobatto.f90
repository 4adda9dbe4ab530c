!> Nodes of Lobatto on a step, the weights that integrate the polynomial through values at the nodes, and the highest
!> coefficients of that polynomial.
!>
!> Both ends of the step are nodes. The rule with n nodes behind the start is exact over the step for polynomials up to
!> degree 2 n - 1. Hairer, Wanner (1996), Solving ordinary differential equations II, section IV.5: Lobatto IIIA.
module umat_lobatto
  use umat_kinds, only: wp
  implicit none
  private
  public :: lobatto_type, rules

  !> Most nodes behind the start of a step, and the rules at hand: the short one and the long one.
  integer, parameter, public :: most_nodes = 4, rule_short = 1, rule_long = 2

  !> One rule. Node 0 is the start of the step, node n its end.
  type :: lobatto_type
    integer :: n !< nodes behind the start
    real(wp) :: c(0:most_nodes) !< place of the nodes in the step, 0 to 1
    real(wp) :: a(0:most_nodes, most_nodes) !< a(k, j): weight of node k in the integral from the start to node j
    real(wp) :: mode(0:most_nodes, 0:3) !< weights that give the coefficients of the Legendre polynomials of degree n to n-3
  end type lobatto_type

  real(wp), parameter :: r = sqrt(21.0_wp), unused = 0.0_wp

  type(lobatto_type), parameter :: rules(2) = [ &
    lobatto_type(2, [0.0_wp, 0.5_wp, 1.0_wp, unused, unused], reshape([ &
      5.0_wp / 24.0_wp, 1.0_wp / 3.0_wp, -1.0_wp / 24.0_wp, unused, unused, &
      1.0_wp / 6.0_wp, 2.0_wp / 3.0_wp, 1.0_wp / 6.0_wp, unused, unused, &
      unused, unused, unused, unused, unused, &
      unused, unused, unused, unused, unused], [5, 4]), reshape([ &
      1.0_wp / 3.0_wp, -2.0_wp / 3.0_wp, 1.0_wp / 3.0_wp, unused, unused, &
      -0.5_wp, 0.0_wp, 0.5_wp, unused, unused, &
      1.0_wp / 6.0_wp, 2.0_wp / 3.0_wp, 1.0_wp / 6.0_wp, unused, unused, &
      unused, unused, unused, unused, unused], [5, 4])), &
    lobatto_type(4, [0.0_wp, 0.5_wp - r / 14.0_wp, 0.5_wp, 0.5_wp + r / 14.0_wp, 1.0_wp], reshape([ &
      (119.0_wp + 3.0_wp * r) / 1960.0_wp, (343.0_wp - 9.0_wp * r) / 2520.0_wp, (392.0_wp - 96.0_wp * r) / 2205.0_wp, &
      (343.0_wp - 69.0_wp * r) / 2520.0_wp, (-21.0_wp + 3.0_wp * r) / 1960.0_wp, &
      13.0_wp / 320.0_wp, (392.0_wp + 105.0_wp * r) / 2880.0_wp, 8.0_wp / 45.0_wp, &
      (392.0_wp - 105.0_wp * r) / 2880.0_wp, 3.0_wp / 320.0_wp, &
      (119.0_wp - 3.0_wp * r) / 1960.0_wp, (343.0_wp + 69.0_wp * r) / 2520.0_wp, (392.0_wp + 96.0_wp * r) / 2205.0_wp, &
      (343.0_wp + 9.0_wp * r) / 2520.0_wp, (-21.0_wp - 3.0_wp * r) / 1960.0_wp, &
    1.0_wp / 20.0_wp, 49.0_wp / 180.0_wp, 16.0_wp / 45.0_wp, 49.0_wp / 180.0_wp, 1.0_wp / 20.0_wp], [5, 4]), reshape([ &
      1.0_wp / 5.0_wp, -7.0_wp / 15.0_wp, 8.0_wp / 15.0_wp, -7.0_wp / 15.0_wp, 1.0_wp / 5.0_wp, &
      -0.35_wp, 7.0_wp * r / 60.0_wp, 0.0_wp, -7.0_wp * r / 60.0_wp, 0.35_wp, &
      1.0_wp / 4.0_wp, 7.0_wp / 36.0_wp, -8.0_wp / 9.0_wp, 7.0_wp / 36.0_wp, 1.0_wp / 4.0_wp, &
      -0.15_wp, -7.0_wp * r / 60.0_wp, 0.0_wp, 7.0_wp * r / 60.0_wp, 0.15_wp], [5, 4]))]

end module umat_lobatto
