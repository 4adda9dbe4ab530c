!> The stress rate together with its derivatives along six variations of the state and of the stretching.
!>
!> theory.md, section 4: both branches and the plain model are one form,
!>   Tdot = L:X + weight N,
!> where X = scale D + share c deltahat and weight (c rho^chi, 0 or |D|) depend on delta and D alone, L and N on T and e
!> alone. Its derivative is L:dX + N dweight plus the derivatives of L and N, all by the chain rule.
!>
!> Six variations are carried side by side, the variation being the first index, so that the loops over them vectorise.
module umat_variation
  use umat_intergranular, only: intergranular_type, scale_of, share_of, operands
  use umat_kinds, only: wp
  use umat_material, only: material_type
  use umat_status, only: status_ok, branch_plain, branch_loading
  use umat_tensor, only: ddot, norm, deviator, multiplicity, unit_tensor
  use umat_wolffersdorff, only: hypoplastic_type, hypoplastic_tensors, sensitivity_type, sensitivities, apply_L
  implicit none
  private
  public :: vary_rate_of_stress, vary_operands, vary_with_operands, linearise, on_each

  !> Number of variations: the six components of the stretching, and with each one the changes of state that go with it.
  integer, parameter, public :: n_variations = 6

contains

  !> Rate of stress on a given branch, as rate_of_stress, and its variation.
  !> @param m         material
  !> @param stress, void_ratio, g, d as in rate_of_stress
  !> @param branch    from choose_branch
  !> @param d_stress, d_delta (variation, component), d_void_ratio (variation): variations of the state; that of the
  !>                  stretching is its k-th component, tensor component, in variation k
  !> @param rate      rate of stress [stress/time]; zero on failure
  !> @param variation of the rate, (variation, component)
  !> @param status    status_ok or status_out_of_domain
  pure subroutine vary_rate_of_stress(m, stress, void_ratio, g, d, branch, d_stress, d_delta, d_void_ratio, rate, &
                                      variation, status)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: stress(6), void_ratio, d(6)
    type(intergranular_type), intent(in) :: g
    integer, intent(in) :: branch
    real(wp), intent(in) :: d_stress(n_variations, 6), d_delta(n_variations, 6), d_void_ratio(n_variations)
    real(wp), intent(out) :: rate(6), variation(n_variations, 6)
    integer, intent(out) :: status
    type(hypoplastic_type) :: h
    real(wp) :: x(6), dx(n_variations, 6), weight, dweight(n_variations), by_stress(6, 6), by_void_ratio(6)
    integer :: i

    rate = 0.0_wp
    variation = 0.0_wp
    call hypoplastic_tensors(m, stress, void_ratio, h, status)
    if (status /= status_ok) return
    call operands(m, g, d, branch, x, weight)
    rate = apply_L(h, x) + weight * h%N
    call vary_operands(m, g, d, branch, d_delta, dx, dweight)
    call linearise(m, h, sensitivities(m, void_ratio, h), x, weight, rate, by_stress, by_void_ratio)
    variation = vary_with_operands(h, dx, dweight) + on_each(by_stress, d_stress)
    do i = 1, 6
      variation(:, i) = variation(:, i) + by_void_ratio(i) * d_void_ratio
    end do
  end subroutine vary_rate_of_stress

  !> Variation of X and weight with delta and D; theory.md Eqs. (11) and (13).
  !> @param g, d, branch, d_delta as in vary_rate_of_stress
  !> @param dx (variation, component), dweight (variation): the derivatives
  pure subroutine vary_operands(m, g, d, branch, d_delta, dx, dweight)
    type(material_type), intent(in) :: m
    type(intergranular_type), intent(in) :: g
    real(wp), intent(in) :: d(6), d_delta(n_variations, 6)
    integer, intent(in) :: branch
    real(wp), intent(out) :: dx(n_variations, 6), dweight(n_variations)
    if (branch == branch_plain) then
      call vary_plain(d, dx, dweight)
    else
      call vary_intergranular(m, g, d, branch, d_delta, dx, dweight)
    end if
  end subroutine vary_operands

  !> Of X = D, weight = |D|.
  pure subroutine vary_plain(d, dx, dweight)
    real(wp), intent(in) :: d(6)
    real(wp), intent(out) :: dx(n_variations, 6), dweight(n_variations)
    real(wp) :: size
    integer :: i
    dx = 0.0_wp
    do i = 1, 6
      dx(i, i) = 1.0_wp
    end do
    size = norm(d)
    dweight = 0.0_wp
    if (size > 0.0_wp) dweight = multiplicity * d / size
  end subroutine vary_plain

  !> Of X and weight on a branch; theory.md Eq. (13).
  pure subroutine vary_intergranular(m, g, d, branch, d_delta, dx, dweight)
    type(material_type), intent(in) :: m
    type(intergranular_type), intent(in) :: g
    real(wp), intent(in) :: d(6), d_delta(n_variations, 6)
    integer, intent(in) :: branch
    real(wp), intent(out) :: dx(n_variations, 6), dweight(n_variations)
    real(wp) :: c, scale, share, factor, loading, per_size, on_delta, on_direction(n_variations)
    real(wp) :: size_change(n_variations), dc(n_variations), dr(n_variations)
    integer :: i

    c = ddot(g%direction, d)
    scale = scale_of(m, g)
    share = share_of(m, branch)
    loading = merge(1.0_wp, 0.0_wp, branch == branch_loading)
    factor = share * g%rho_chi * c

    dc = multiplicity * g%direction
    dr = 0.0_wp
    on_delta = 0.0_wp
    on_direction = 0.0_wp
    ! At delta = 0 rho^chi kills every term but those of D. d deltahat = (d delta - deltahat d|delta|)/|delta|.
    if (g%rho > 0.0_wp) then
      per_size = 1.0_wp / (g%rho * m%R)
      size_change = contracted(d_delta, g%direction) * per_size
      dr = m%chi * g%rho_chi * size_change
      dc = dc + contracted(d_delta, d) * per_size - c * size_change
      on_delta = factor * per_size
      on_direction = -factor * size_change
    end if
    dweight = dr * c + g%rho_chi * dc
    on_direction = on_direction + share * dweight
    dweight = loading * dweight
    dr = (m%m_T - m%m_R) * dr
    do i = 1, 6
      dx(:, i) = dr * d(i) + on_direction * g%direction(i) + on_delta * d_delta(:, i)
      dx(i, i) = dx(i, i) + scale
    end do
  end subroutine vary_intergranular

  !> Variation of the rate with X and weight, L:dX + N dweight.
  pure function vary_with_operands(h, dx, dweight) result(variation)
    type(hypoplastic_type), intent(in) :: h
    real(wp), intent(in) :: dx(n_variations, 6), dweight(n_variations)
    real(wp) :: variation(n_variations, 6)
    real(wp) :: by_that(n_variations)
    integer :: i
    by_that = h%dyad * contracted(dx, h%that)
    do i = 1, 6
      variation(:, i) = by_that * h%that(i) + h%identity * dx(:, i) + dweight * h%N(i)
    end do
  end function vary_with_operands

  !> Derivatives of the rate L:X + weight N with respect to stress and void ratio at given X and weight; theory.md Eqs. (1)
  !> to (10), differentiated.
  !> @param h, s          L, N and their sensitivities
  !> @param x, weight     operands of the rate
  !> @param rate          L:X + weight N
  !> @param by_stress     matrix: change of the rate = by_stress d_stress, on tensor components
  !> @param by_void_ratio d rate/d e
  pure subroutine linearise(m, h, s, x, weight, rate, by_stress, by_void_ratio)
    type(material_type), intent(in) :: m
    type(hypoplastic_type), intent(in) :: h
    type(sensitivity_type), intent(in) :: s
    real(wp), intent(in) :: x(6), weight, rate(6)
    real(wp), intent(out) :: by_stress(6, 6), by_void_ratio(6)
    real(wp), dimension(6) :: flow, on_log, on_that, on_F, on_flow
    real(wp) :: flow_size, diagonal
    integer :: j

    flow = h%that + deviator(h%that)
    flow_size = weight * h%f_s * m%a
    ! d pressure = -tr dT; dThat = -(dT + That d pressure)/pressure, and d(That + T*hat) = 2 dThat, because tr dThat = 0.
    diagonal = -(h%dyad * ddot(h%that, x) + 2.0_wp * flow_size * h%f_d * h%F) / h%pressure
    on_F = through_that(h, s%F_that)
    on_log = through_that(h, s%log_f_s_that) - s%log_f_s_pressure * unit_tensor
    on_that = h%dyad * through_that(h, x) - diagonal * unit_tensor
    on_flow = flow_size * (h%f_d * on_F - h%F * s%f_d_pressure * unit_tensor)
    on_F = 2.0_wp * h%f_s * h%F * on_F
    do j = 1, 6
      by_stress(:, j) = on_log(j) * rate + on_that(j) * h%that + on_F(j) * x + on_flow(j) * flow
      by_stress(j, j) = by_stress(j, j) + diagonal
    end do
    by_void_ratio = s%log_f_s_e * rate + flow_size * h%F * s%f_d_e * flow
  end subroutine linearise

  !> The vector that gives t:dThat for a change of stress, multiplicities included.
  pure function through_that(h, t) result(on_stress)
    type(hypoplastic_type), intent(in) :: h
    real(wp), intent(in) :: t(6)
    real(wp) :: on_stress(6)
    on_stress = (ddot(h%that, t) * unit_tensor - multiplicity * t) / h%pressure
  end function through_that

  !> A matrix on each of six variations of a vector.
  !> @param v (variation, component)
  pure function on_each(matrix, v) result(answer)
    real(wp), intent(in) :: matrix(6, 6), v(n_variations, 6)
    real(wp) :: answer(n_variations, 6)
    integer :: i, k
    do i = 1, 6
      do k = 1, n_variations
        answer(k, i) = ((matrix(i, 1) * v(k, 1) + matrix(i, 2) * v(k, 2)) + (matrix(i, 3) * v(k, 3) + &
                                                                             matrix(i, 4) * v(k, 4))) + &
                       (matrix(i, 5) * v(k, 5) + matrix(i, 6) * v(k, 6))
      end do
    end do
  end function on_each

  !> Double contraction of each variation of a tensor with a tensor.
  pure function contracted(v, t) result(s)
    real(wp), intent(in) :: v(n_variations, 6), t(6)
    real(wp) :: s(n_variations)
    integer :: i
    s = 0.0_wp
    do i = 1, 6
      s = s + v(:, i) * (multiplicity(i) * t(i))
    end do
  end function contracted

end module umat_variation
