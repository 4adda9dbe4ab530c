!> All derivatives of the rates, in quadruple precision, against central differences of the rates themselves.
!>
!> This program is the model compiled with HYPOFAB_QUADRUPLE; differences with h = 1e-12 are exact to about 1e-20 there.
!> Prints the worst error of each case and stops with an error where a bound is exceeded.
program test_rate_derivative
  use umat_intergranular, only: intergranular_direction, delta_rate
  use umat_kinds, only: wp
  use umat_material, only: material_type, material_from_props, n_parameters, i_p_t
  use umat_rate, only: rate_of_stress
  use umat_rate_derivative, only: rate_derivative_type, derive_rates
  use umat_sands, only: sands, find_sand
  use umat_status, only: status_ok, branch_plain, branch_loading, branch_reversal
  use umat_tensor, only: norm, deviator, ddot, unit_tensor
  implicit none

  !> How far a stress is from the isotropic axis.
  integer, parameter :: n_cases = 3
  real(wp), parameter :: deviators(n_cases) = [0.6_wp, 1.0e-3_wp, 0.0_wp]
  character(len=24), parameter :: names(3) = [character(len=24) :: 'paper000', 'hochstetten', 'karlsruhe_fine']
  integer, parameter :: branches(3) = [branch_plain, branch_loading, branch_reversal]
  real(wp), parameter :: bound = 1.0e-12_wp, h = 1.0e-12_wp
  real(wp) :: worst
  integer :: i, j, k, n_seed, failures
  integer, allocatable :: seed(:)

  !> All that the rates depend on, as one vector: stretching, stress, delta, void ratio, parameters.
  integer, parameter :: at_stress = 6, at_delta = 12, at_void_ratio = 19, n_all = at_void_ratio + n_parameters

  if (precision(1.0_wp) < 30) error stop 'compiled without HYPOFAB_QUADRUPLE'
  call random_seed(size=n_seed)
  allocate (seed(n_seed), source=11)
  call random_seed(put=seed)
  failures = 0
  do i = 1, n_cases
    do j = 1, size(branches)
      worst = 0.0_wp
      do k = 1, 30
        worst = max(worst, error_of_state(deviators(i), branches(j), find_sand(trim(names(1 + modulo(k, 3))))))
      end do
      write (*, '(a, es8.1, a, i0, a, es9.2)') 'deviator ', deviators(i), ' p, branch ', branches(j), ': ', worst
      if (.not. worst < bound) failures = failures + 1
    end do
  end do
  deallocate (seed)
  if (failures > 0) error stop 'a derivative of the rates is wrong'
  write (*, '(a)') 'all derivatives agree'

contains

  !> Largest error of the derivatives of one random state, relative to the rate of stress (or delta) per relative change.
  !> @param deviatoric size of the deviator over p; 0: stress is varied along the isotropic axis alone, because the stress
  !>                   factor has a cone there (p_t shifts the stress along it)
  function error_of_state(deviatoric, branch, sand) result(error)
    real(wp), intent(in) :: deviatoric
    integer, intent(in) :: branch, sand
    real(wp) :: error
    type(material_type) :: m
    type(rate_derivative_type) :: r
    real(wp) :: all(n_all), change(n_all), forth(12), back(12), expected(12), rates(12), scale(12)
    integer :: v, status

    all = random_point(deviatoric, branch, sand)
    m = material_from_props(all(at_void_ratio + 1:))
    call derive_rates(m, all(at_stress + 1:at_stress + 6), all(at_void_ratio), &
                      intergranular_direction(m, all(at_delta + 1:at_delta + 6)), all(1:6), branch, r, status)
    if (status /= status_ok) error stop 'a state is outside the domain'
    rates = rates_at(all, branch)
    scale(1:6) = norm(rates(1:6))
    scale(7:12) = norm(all(1:6))
    error = 0.0_wp
    do v = 1, n_all
      if (branch == branch_plain .and. ((v > at_delta .and. v < at_void_ratio) .or. v > at_void_ratio + 9)) cycle
      change = 0.0_wp
      change(v) = abs(all(v))
      if (v == at_void_ratio + i_p_t) change(v) = norm(all(at_stress + 1:at_stress + 6))
      if (v > at_stress .and. v <= at_delta .and. .not. deviatoric > 0.0_wp) then
        if (v /= at_stress + 1) cycle
        change(v:v + 2) = abs(all(v))
      end if
      change = change * merge(deviatoric, 1.0_wp, v > at_stress .and. v <= at_delta .and. deviatoric > 0.0_wp)
      forth = rates_at(all + h * change, branch)
      back = rates_at(all - h * change, branch)
      expected = expected_change(r, change)
      error = max(error, maxval(abs((forth - back) / (2.0_wp * h) - expected) / scale))
    end do
  end function error_of_state

  !> Change of both rates by the derivatives.
  pure function expected_change(r, change) result(expected)
    type(rate_derivative_type), intent(in) :: r
    real(wp), intent(in) :: change(n_all)
    real(wp) :: expected(12)
    associate (d => change(1:6), stress => change(at_stress + 1:at_stress + 6), delta => change(at_delta + 1:at_delta + 6), &
               parameter => change(at_void_ratio + 1:))
      expected(1:6) = matmul(r%stress_by_stretching, d) + matmul(r%stress_by_stress, stress) + &
                      matmul(r%stress_by_delta, delta) + r%stress_by_void_ratio * change(at_void_ratio) + &
                      matmul(r%stress_by_parameter, parameter)
      expected(7:12) = matmul(r%delta_by_stretching, d) + matmul(r%delta_by_delta, delta) + &
                       matmul(r%delta_by_parameter, parameter)
    end associate
  end function expected_change

  !> A random point of a branch.
  function random_point(deviatoric, branch, sand) result(all)
    real(wp), intent(in) :: deviatoric
    integer, intent(in) :: branch, sand
    real(wp) :: all(n_all)
    type(material_type) :: m
    real(wp) :: stress(6), delta(6), d(6), p, u(4)
    all(at_void_ratio + 1:) = real(sands(sand)%props, wp)
    call random_number(u)
    all(at_void_ratio + i_p_t) = merge(5.0_wp * u(4), 0.0_wp, u(4) > 0.5_wp)
    if (branch == branch_plain) all(at_void_ratio + 10) = 0.0_wp
    m = material_from_props(all(at_void_ratio + 1:))
    p = 10.0_wp + 300.0_wp * u(1)
    call random_tensor(stress)
    stress = deviator(stress)
    all(at_stress + 1:at_stress + 6) = deviatoric * p * stress / norm(stress) - p * unit_tensor
    call random_tensor(delta)
    call random_tensor(d)
    d = d / norm(d)
    if ((ddot(delta, d) > 0.0_wp) .neqv. branch == branch_loading) delta = -delta
    all(1:6) = d
    all(at_delta + 1:at_delta + 6) = (0.1_wp + 0.8_wp * u(3)) * m%R * delta / norm(delta)
    all(at_delta + 7) = (m%e_d0 + (0.05_wp + 0.9_wp * u(2)) * (m%e_i0 - m%e_d0)) * exp(-(3.0_wp * p / m%h_s)**m%n)
  end function random_point

  !> The rates of stress and delta at a point inside the domain, delta's zero for the plain model.
  function rates_at(all, branch) result(rates)
    real(wp), intent(in) :: all(n_all)
    integer, intent(in) :: branch
    real(wp) :: rates(12)
    type(material_type) :: m
    integer :: status
    m = material_from_props(all(at_void_ratio + 1:))
    associate (g => intergranular_direction(m, all(at_delta + 1:at_delta + 6)))
      call rate_of_stress(m, all(at_stress + 1:at_stress + 6), all(at_void_ratio), g, all(1:6), branch, rates(1:6), status)
      rates(7:12) = merge(0.0_wp, delta_rate(m, g, all(1:6), branch), branch == branch_plain)
    end associate
    if (status /= status_ok) error stop 'a state is outside the domain'
  end function rates_at

  !> Six components between -1 and 1.
  subroutine random_tensor(t)
    real(wp), intent(out) :: t(6)
    call random_number(t)
    t = 2.0_wp * t - 1.0_wp
  end subroutine random_tensor

end program test_rate_derivative
