!> The derivatives of the stress rate, in quadruple precision, against central differences of the rate itself.
!>
!> This program is the model compiled with HYPOFAB_QUADRUPLE; differences with h = 1e-12 are exact to about 1e-20 there.
!> Prints the worst error of each case and stops with an error where a bound is exceeded.
program test_variation
  use umat_intergranular, only: intergranular_direction
  use umat_kinds, only: wp
  use umat_material, only: material_type, material_from_props
  use umat_rate, only: rate_of_stress
  use umat_sands, only: sands, find_sand
  use umat_status, only: status_ok, branch_plain, branch_loading, branch_reversal
  use umat_tensor, only: norm, deviator, ddot, unit_tensor
  use umat_variation, only: vary_rate_of_stress
  implicit none

  !> How far a stress is from the isotropic axis.
  integer, parameter :: n_cases = 4
  real(wp), parameter :: deviators(n_cases) = [0.6_wp, 1.0e-3_wp, 1.0e-8_wp, 0.0_wp]
  character(len=24), parameter :: names(3) = [character(len=24) :: 'paper000', 'hochstetten', 'karlsruhe_fine']
  integer, parameter :: branches(3) = [branch_plain, branch_loading, branch_reversal]
  real(wp), parameter :: bound = 1.0e-10_wp
  real(wp) :: worst
  integer :: i, j, k, n_seed, failures
  integer, allocatable :: seed(:)

  if (precision(1.0_wp) < 30) error stop 'compiled without HYPOFAB_QUADRUPLE'
  call random_seed(size=n_seed)
  allocate (seed(n_seed), source=7)
  call random_seed(put=seed)
  failures = 0
  do i = 1, n_cases
    do j = 1, size(branches)
      worst = 0.0_wp
      do k = 1, 40
        worst = max(worst, error_of_state(deviators(i), branches(j), find_sand(trim(names(1 + modulo(k, 3))))))
      end do
      write (*, '(a, es8.1, a, i0, a, es9.2)') 'deviator ', deviators(i), ' p, branch ', branches(j), ': ', worst
      if (.not. worst < bound) failures = failures + 1
    end do
  end do
  deallocate (seed)
  if (failures > 0) error stop 'a derivative of the rate is wrong'
  write (*, '(a)') 'all derivatives agree'

contains

  !> Largest relative error over the six variations of one random state.
  !> @param deviatoric size of the deviator over p; 0: variations of stress are isotropic too, because the stress factor
  !>                   has a cone on the isotropic axis
  function error_of_state(deviatoric, branch, sand) result(error)
    real(wp), intent(in) :: deviatoric
    integer, intent(in) :: branch, sand
    real(wp) :: error
    type(material_type) :: m
    real(wp) :: stress(6), delta(6), void_ratio, d(6), d_stress(6, 6), d_delta(6, 6), d_void_ratio(6)
    real(wp) :: rate(6), variation(6, 6), forth(6), back(6), unit(6), h, p, u(3)
    integer :: v, status

    m = material_from_props(real(sands(sand)%props, wp))
    call random_number(u)
    p = 10.0_wp + 300.0_wp * u(1)
    call random_tensor(stress)
    stress = deviator(stress)
    stress = deviatoric * p * stress / norm(stress) - p * unit_tensor
    void_ratio = (m%e_d0 + (0.05_wp + 0.9_wp * u(2)) * (m%e_i0 - m%e_d0)) * exp(-(3.0_wp * p / m%h_s)**m%n)
    call random_tensor(delta)
    call random_tensor(d)
    d = d / norm(d)
    if ((ddot(delta, d) > 0.0_wp) .neqv. branch == branch_loading) delta = -delta
    delta = (0.1_wp + 0.8_wp * u(3)) * m%R * delta / norm(delta)
    do v = 1, 6
      call random_tensor(d_stress(v, :))
      if (.not. deviatoric > 0.0_wp) d_stress(v, :) = d_stress(v, 1) * unit_tensor
      call random_tensor(d_delta(v, :))
    end do
    d_stress = p * min(1.0_wp, max(deviatoric, 1.0e-10_wp)) * d_stress
    d_delta = m%R * d_delta
    call random_number(d_void_ratio)

    call vary_rate_of_stress(m, stress, void_ratio, intergranular_direction(m, delta), d, branch, d_stress, d_delta, &
                             d_void_ratio, rate, variation, status)
    if (status /= status_ok) error stop 'a state is outside the domain'
    h = 1.0e-12_wp
    error = 0.0_wp
    do v = 1, 6
      unit = 0.0_wp
      unit(v) = 1.0_wp
      forth = rate_at(m, branch, stress + h * d_stress(v, :), void_ratio + h * d_void_ratio(v), &
                      delta + h * d_delta(v, :), d + h * unit)
      back = rate_at(m, branch, stress - h * d_stress(v, :), void_ratio - h * d_void_ratio(v), &
                     delta - h * d_delta(v, :), d - h * unit)
      error = max(error, norm((forth - back) / (2.0_wp * h) - variation(v, :)) / norm(variation(v, :)))
    end do
  end function error_of_state

  !> The stress rate of a state inside the domain.
  function rate_at(m, branch, stress, void_ratio, delta, d) result(rate)
    type(material_type), intent(in) :: m
    integer, intent(in) :: branch
    real(wp), intent(in) :: stress(6), void_ratio, delta(6), d(6)
    real(wp) :: rate(6)
    integer :: status
    call rate_of_stress(m, stress, void_ratio, intergranular_direction(m, delta), d, branch, rate, status)
    if (status /= status_ok) error stop 'a state is outside the domain'
  end function rate_at

  !> Six components between -1 and 1.
  subroutine random_tensor(t)
    real(wp), intent(out) :: t(6)
    call random_number(t)
    t = 2.0_wp * t - 1.0_wp
  end subroutine random_tensor

end program test_variation
