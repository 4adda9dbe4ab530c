!> The Runge-Kutta pair and the constants of the error control: one place for the update of a point (update.f90) and of
!> many points side by side (batch.f90), which must take the same steps.
module umat_tableau
  use umat_kinds, only: wp
  implicit none
  public

  !> Largest strain increment accepted: beyond it a small strain increment has no meaning.
  real(wp), parameter :: largest_increment = 1.0_wp
  !> A stress that falls to this part of its start on a straight path is on its way to zero, which is outside the domain.
  real(wp), parameter :: vanishing = 1.0e-8_wp
  !> Part of the tolerance that one substep may use: errors of many substeps and of later increments add up.
  real(wp), parameter :: share = 0.2_wp
  !> First substep: this part of R, in which delta turns; of the plain model this strain.
  real(wp), parameter :: substep_of_R = 0.3_wp, plain_substep = 1.0e-4_wp

  !> Dormand and Prince (1980), Table 2: nodes, weights of the stages, of the step and of its error.
  integer, parameter :: n_stages = 7
  real(wp), parameter :: c(n_stages) = [0.0_wp, 1.0_wp / 5.0_wp, 3.0_wp / 10.0_wp, 4.0_wp / 5.0_wp, 8.0_wp / 9.0_wp, &
                                        1.0_wp, 1.0_wp]
  real(wp), parameter :: a(6, n_stages) = reshape([ &
    0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, &
    1.0_wp / 5.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, &
    3.0_wp / 40.0_wp, 9.0_wp / 40.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, &
    44.0_wp / 45.0_wp, -56.0_wp / 15.0_wp, 32.0_wp / 9.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, &
    19372.0_wp / 6561.0_wp, -25360.0_wp / 2187.0_wp, 64448.0_wp / 6561.0_wp, -212.0_wp / 729.0_wp, 0.0_wp, 0.0_wp, &
    9017.0_wp / 3168.0_wp, -355.0_wp / 33.0_wp, 46732.0_wp / 5247.0_wp, 49.0_wp / 176.0_wp, -5103.0_wp / 18656.0_wp, 0.0_wp, &
    35.0_wp / 384.0_wp, 0.0_wp, 500.0_wp / 1113.0_wp, 125.0_wp / 192.0_wp, -2187.0_wp / 6784.0_wp, 11.0_wp / 84.0_wp], &
    [6, n_stages])
  real(wp), parameter :: error_weight(n_stages) = [71.0_wp / 57600.0_wp, 0.0_wp, -71.0_wp / 16695.0_wp, &
                                                   71.0_wp / 1920.0_wp, -17253.0_wp / 339200.0_wp, 22.0_wp / 525.0_wp, &
                                                   -1.0_wp / 40.0_wp]
end module umat_tableau
