!> The derivatives of the stress rate, in quadruple precision, against central differences of the rate itself.
!>
!> This program is the model compiled with HYPOFAB_QUADRUPLE; differences with h = 1e-12 are exact to about 1e-20 there.
!> Prints the worst error of each case and stops with an error where a bound is exceeded.
program test_variation
  use umat_delta_path, only: delta_influence_type
  use umat_intergranular, only: intergranular_type, intergranular_direction, operands
  use umat_kinds, only: wp
  use umat_material, only: material_type, material_from_props
  use umat_rate, only: rate_of_stress
  use umat_sands, only: sands, find_sand
  use umat_status, only: status_ok, branch_plain, branch_loading, branch_reversal
  use umat_tensor, only: norm, deviator, ddot, trace, unit_tensor, diagonalise, rotate
  use umat_variation, only: linear_rate_type, linear_rate, linearise, operand_influence_type, operand_influence, &
                            direct_parts, part_d, &
                            part_normal, part_that, part_unit
  use umat_wolffersdorff, only: hypoplastic_type, hypoplastic_tensors, sensitivities
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
  do j = 1, size(branches)
    worst = 0.0_wp
    do k = 1, 120
      worst = max(worst, error_at_border(branches(j), find_sand(trim(names(1 + modulo(k, 3))))))
    end do
    write (*, '(a, i0, a, es9.2)') 'at the border, branch ', branches(j), ': ', worst
    if (.not. worst < bound) failures = failures + 1
  end do
  deallocate (seed)
  if (failures > 0) error stop 'a derivative of the rate is wrong'
  write (*, '(a)') 'all derivatives agree'

contains

  !> Largest relative error over the six components of eta, of one random state.
  !> @param deviatoric size of the deviator over p; 0: variations of stress are isotropic too, because the stress factor
  !>                   has a cone on the isotropic axis
  function error_of_state(deviatoric, branch, sand) result(error)
    real(wp), intent(in) :: deviatoric
    integer, intent(in) :: branch, sand
    real(wp) :: error
    type(material_type) :: m
    type(delta_influence_type) :: on_delta
    real(wp) :: stress(6), delta(6), void_ratio, frame(6, 2), d_stress(6, 6), d_delta(6), by_volume, on_frame(2)
    real(wp) :: variation(6), forth(6), back(6), eta(6), h, p, u(3)
    integer :: v

    m = material_from_props(real(sands(sand)%props, wp))
    call random_number(u)
    p = 10.0_wp + 300.0_wp * u(1)
    call random_tensor(stress)
    stress = deviator(stress)
    stress = deviatoric * p * stress / norm(stress) - p * unit_tensor
    void_ratio = (m%e_d0 + (0.05_wp + 0.9_wp * u(2)) * (m%e_i0 - m%e_d0)) * exp(-(3.0_wp * p / m%h_s)**m%n)
    call random_tensor(delta)
    call random_tensor(frame(:, 1))
    frame(:, 1) = frame(:, 1) / norm(frame(:, 1))
    if ((ddot(delta, frame(:, 1)) > 0.0_wp) .neqv. branch == branch_loading) delta = -delta
    delta = (0.1_wp + 0.8_wp * u(3)) * m%R * delta / norm(delta)
    frame(:, 2) = delta - ddot(delta, frame(:, 1)) * frame(:, 1)
    frame(:, 2) = frame(:, 2) / norm(frame(:, 2))
    do v = 1, 6
      call random_tensor(d_stress(v, :))
      if (.not. deviatoric > 0.0_wp) d_stress(v, :) = d_stress(v, 1) * unit_tensor
    end do
    d_stress = p * min(1.0_wp, max(deviatoric, 1.0e-10_wp)) * d_stress
    call random_number(on_delta%factor)
    call random_number(on_delta%plane)
    on_delta = delta_influence_type(m%R * on_delta%factor, m%R * (on_delta%plane - 0.5_wp))
    call random_number(by_volume)

    h = 1.0e-12_wp
    error = 0.0_wp
    do v = 1, 6
      eta = 0.0_wp
      eta(v) = 1.0_wp
      on_frame = [ddot(frame(:, 1), eta), ddot(frame(:, 2), eta)]
      d_delta = on_delta%factor * eta + matmul(frame, matmul(on_delta%plane, on_frame))
      variation = variation_at(m, branch, stress, void_ratio, delta, frame, on_delta, by_volume, eta, d_stress(v, :))
      forth = rate_at(m, branch, stress + h * d_stress(v, :), void_ratio + h * by_volume * trace(eta), &
                      delta + h * d_delta, frame(:, 1) + h * eta)
      back = rate_at(m, branch, stress - h * d_stress(v, :), void_ratio - h * by_volume * trace(eta), &
                     delta - h * d_delta, frame(:, 1) - h * eta)
      error = max(error, norm((forth - back) / (2.0_wp * h) - variation) / norm(variation))
    end do
  end function error_of_state

  !> The same for the derivative with respect to stress alone, at and beyond the border of the domain, where hosts get an answer.
  function error_at_border(branch, sand) result(error)
    integer, intent(in) :: branch, sand
    real(wp) :: error
    type(material_type) :: m
    type(hypoplastic_type) :: tensors
    real(wp) :: stress(6), delta(6), d(6), d_stress(6), values(3), axes(3, 3), x(6), weight, by_stress(6, 6), by_e(6), u(3), kind(3)
    real(wp) :: variation(6), forth(6), back(6), h
    integer :: i, status

    m = material_from_props(real(sands(sand)%props, wp), regularised=.true.)
    call random_tensor(stress)
    call diagonalise(stress, values, axes)
    call random_number(u)
    call random_number(kind)
    ! Principal stresses of the size of the confinement, tensile or not, of the soft pressure, and ordinary ones.
    values = merge(m%confinement * (4.0_wp * u - 2.5_wp), merge(m%soft_pressure * (u - 0.7_wp), -100.0_wp * u, kind < 0.8_wp), &
                   kind < 0.6_wp)
    stress = rotate([values(1), values(2), values(3), 0.0_wp, 0.0_wp, 0.0_wp], axes)
    call random_tensor(delta)
    call random_tensor(d)
    if ((ddot(delta, d) > 0.0_wp) .neqv. branch == branch_loading) delta = -delta
    delta = 0.6_wp * m%R * delta / norm(delta)
    call hypoplastic_tensors(m, stress, m%e_c0, tensors, status)
    if (status /= status_ok) error stop 'a state at the border has no answer'
    call operands(m, intergranular_direction(m, delta), d, branch, x, weight)
    call linearise(m, tensors, sensitivities(m, m%e_c0, tensors), x, weight, by_stress, by_e)
    h = 1.0e-7_wp
    error = 0.0_wp
    do i = 1, 6
      call random_tensor(d_stress)
      d_stress = m%confinement * d_stress
      variation = matmul(by_stress, d_stress)
      forth = rate_at(m, branch, stress + h * d_stress, m%e_c0, delta, d)
      back = rate_at(m, branch, stress - h * d_stress, m%e_c0, delta, d)
      error = max(error, norm((forth - back) / (2.0_wp * h) - variation) / max(norm(variation), 1.0e-6_wp * norm(forth)))
    end do
  end function error_at_border

  !> Derivative of the stress rate in the direction of one eta and the change of stress that goes with it, put together from
  !> its factors.
  function variation_at(m, branch, stress, void_ratio, delta, frame, on_delta, by_volume, eta, d_stress) result(variation)
    type(material_type), intent(in) :: m
    integer, intent(in) :: branch
    real(wp), intent(in) :: stress(6), void_ratio, delta(6), frame(6, 2), by_volume, eta(6), d_stress(6)
    type(delta_influence_type), intent(in) :: on_delta
    real(wp) :: variation(6)
    type(hypoplastic_type) :: h
    type(intergranular_type) :: g
    type(linear_rate_type) :: linear
    type(operand_influence_type) :: on_operands
    real(wp) :: x(6), weight, factor, part(6, 4)
    integer :: status
    call hypoplastic_tensors(m, stress, void_ratio, h, status)
    if (status /= status_ok) error stop 'a state is outside the domain'
    g = intergranular_direction(m, delta)
    call operands(m, g, frame(:, 1), branch, x, weight)
    linear = linear_rate(m, h, sensitivities(m, void_ratio, h), x, weight)
    on_operands = operand_influence(m, g, ddot(g%direction, frame(:, 1)), ddot(g%direction, frame(:, 2)), branch, on_delta)
    call direct_parts(m, h, linear, frame, [ddot(x, frame(:, 1)), ddot(x, frame(:, 2))], on_operands, by_volume, factor, part)
    variation = factor * eta + dot_product(part(:, part_d), eta) * frame(:, 1) + &
                dot_product(part(:, part_normal), eta) * frame(:, 2) + dot_product(part(:, part_that), eta) * h%that + &
                dot_product(part(:, part_unit), eta) * unit_tensor + linear%diagonal * d_stress + &
                dot_product(linear%on(:, 1), d_stress) * h%that + dot_product(linear%on(:, 2), d_stress) * x + &
                dot_product(linear%on(:, 3), d_stress) * unit_tensor
  end function variation_at

  !> The stress rate of a state.
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
