!> The stress rate together with its derivatives along six variations of the state and of the stretching.
!>
!> theory.md, section 4: both branches and the plain model are one form,
!>   Tdot = L:X + weight N,
!> where X = scale D + share c deltahat and weight (c rho^chi, 0 or |D|) depend on delta and D alone, L and N on T and e
!> alone. Its derivative is L:dX + N dweight plus the derivatives of L and N, all by the chain rule.
!>
!> Six variations are carried side by side, the variation being the first index, so that the loops over them vectorise.
module umat_variation
  use umat_intergranular, only: intergranular_type, intergranular_direction, scale_of
  use umat_kinds, only: wp
  use umat_material, only: material_type
  use umat_rate, only: state_type
  use umat_status, only: status_ok, branch_plain, branch_loading
  use umat_tensor, only: ddot, norm, deviator, multiplicity
  use umat_wolffersdorff, only: hypoplastic_type, hypoplastic_tensors, sensitivity_type, sensitivities, apply_L
  implicit none
  private
  public :: variation_type, vary_rate_of_stress

  !> Number of variations.
  integer, parameter, public :: n_variations = 6

  !> Variations of a state and of the stretching; the first index counts them.
  type :: variation_type
    real(wp) :: stress(n_variations, 6)
    real(wp) :: delta(n_variations, 6)
    real(wp) :: void_ratio(n_variations)
    real(wp) :: stretching(n_variations, 6)
  end type variation_type

contains

  !> Rate of stress on a given branch, as rate_of_stress, and its variation.
  !> @param m         material
  !> @param state     inside the model's domain
  !> @param d         stretching [1/time]
  !> @param branch    from choose_branch
  !> @param v         variations
  !> @param rate      rate of stress [stress/time]; zero on failure
  !> @param variation of the rate, (variation, component)
  !> @param status    status_ok or status_out_of_domain
  pure subroutine vary_rate_of_stress(m, state, d, branch, v, rate, variation, status)
    type(material_type), intent(in) :: m
    type(state_type), intent(in) :: state
    real(wp), intent(in) :: d(6)
    integer, intent(in) :: branch
    type(variation_type), intent(in) :: v
    real(wp), intent(out) :: rate(6), variation(n_variations, 6)
    integer, intent(out) :: status
    type(hypoplastic_type) :: h
    real(wp) :: x(6), dx(n_variations, 6), weight, dweight(n_variations)

    rate = 0.0_wp
    variation = 0.0_wp
    call hypoplastic_tensors(m, state%stress, state%void_ratio, h, status)
    if (status /= status_ok) return
    if (branch == branch_plain) then
      call plain_operands(d, v, x, dx, weight, dweight)
    else
      call intergranular_operands(m, state, d, branch, v, x, dx, weight, dweight)
    end if
    rate = apply_L(h, x) + weight * h%N
    call vary_operands(h, dx, dweight, variation)
    call vary_tensors(m, state%void_ratio, h, x, weight, rate, v, variation)
  end subroutine vary_rate_of_stress

  !> X = D, weight = |D|.
  pure subroutine plain_operands(d, v, x, dx, weight, dweight)
    real(wp), intent(in) :: d(6)
    type(variation_type), intent(in) :: v
    real(wp), intent(out) :: x(6), dx(n_variations, 6), weight, dweight(n_variations)
    x = d
    dx = v%stretching
    weight = norm(d)
    dweight = 0.0_wp
    if (weight > 0.0_wp) dweight = contracted(v%stretching, d / weight)
  end subroutine plain_operands

  !> X and weight from delta and D on a branch; theory.md Eq. (13).
  pure subroutine intergranular_operands(m, state, d, branch, v, x, dx, weight, dweight)
    type(material_type), intent(in) :: m
    type(state_type), intent(in) :: state
    real(wp), intent(in) :: d(6)
    integer, intent(in) :: branch
    type(variation_type), intent(in) :: v
    real(wp), intent(out) :: x(6), dx(n_variations, 6), weight, dweight(n_variations)
    type(intergranular_type) :: g
    real(wp) :: c, scale, share, factor, on_n, size_change(n_variations), dc(n_variations), dr(n_variations)
    real(wp) :: d_direction(n_variations, 6)
    integer :: i

    g = intergranular_direction(m, state%delta)
    c = ddot(g%direction, d)
    scale = scale_of(m, g)
    share = merge(1.0_wp - m%m_T, m%m_R - m%m_T, branch == branch_loading)
    on_n = merge(1.0_wp, 0.0_wp, branch == branch_loading)
    factor = share * g%rho_chi * c
    x = scale * d + factor * g%direction
    weight = on_n * g%rho_chi * c

    dc = contracted(v%stretching, g%direction)
    dr = 0.0_wp
    d_direction = 0.0_wp
    ! At delta = 0 rho^chi kills every term below but those of D.
    if (g%rho > 0.0_wp) then
      size_change = contracted(v%delta, g%direction)
      dr = m%chi * g%rho_chi / (g%rho * m%R) * size_change
      do i = 1, 6
        d_direction(:, i) = (v%delta(:, i) - size_change * g%direction(i)) / (g%rho * m%R)
      end do
      dc = dc + contracted(d_direction, d)
    end if
    do i = 1, 6
      dx(:, i) = scale * v%stretching(:, i) + (m%m_T - m%m_R) * dr * d(i) + &
                 share * (dr * c + g%rho_chi * dc) * g%direction(i) + factor * d_direction(:, i)
    end do
    dweight = on_n * (dr * c + g%rho_chi * dc)
  end subroutine intergranular_operands

  !> Adds L:dX + N dweight.
  pure subroutine vary_operands(h, dx, dweight, variation)
    type(hypoplastic_type), intent(in) :: h
    real(wp), intent(in) :: dx(n_variations, 6), dweight(n_variations)
    real(wp), intent(inout) :: variation(n_variations, 6)
    real(wp) :: along(n_variations)
    integer :: i
    along = h%dyad * contracted(dx, h%that)
    do i = 1, 6
      variation(:, i) = variation(:, i) + h%identity * dx(:, i) + along * h%that(i) + dweight * h%N(i)
    end do
  end subroutine vary_operands

  !> Adds dL:X + weight dN; theory.md Eq. (10) with X and weight kept.
  pure subroutine vary_tensors(m, void_ratio, h, x, weight, rate, v, variation)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: void_ratio, x(6), weight, rate(6)
    type(hypoplastic_type), intent(in) :: h
    type(variation_type), intent(in) :: v
    real(wp), intent(inout) :: variation(n_variations, 6)
    type(sensitivity_type) :: s
    real(wp) :: flow(6), that_x, by_F(6), d_pressure(n_variations), d_that(n_variations, 6)
    real(wp) :: d_log_f_s(n_variations), d_f_d(n_variations), d_F(n_variations), along(n_variations), on_that
    integer :: i

    s = sensitivities(m, void_ratio, h)
    flow = h%that + deviator(h%that)
    that_x = ddot(h%that, x)
    d_pressure = -(v%stress(:, 1) + v%stress(:, 2) + v%stress(:, 3))
    do i = 1, 6
      d_that(:, i) = -(v%stress(:, i) + d_pressure * h%that(i)) / h%pressure
    end do
    d_log_f_s = s%log_f_s_pressure * d_pressure + contracted(d_that, s%log_f_s_that) + s%log_f_s_e * v%void_ratio
    d_f_d = s%f_d_pressure * d_pressure + s%f_d_e * v%void_ratio
    d_F = contracted(d_that, s%F_that)

    ! That and its deviator have the same trace-free change, so d(That + T*hat) = 2 dThat.
    by_F = h%f_s * (2.0_wp * h%F * x + weight * m%a * h%f_d * flow)
    along = h%dyad * contracted(d_that, x)
    on_that = h%dyad * that_x + 2.0_wp * weight * h%f_s * m%a * h%f_d * h%F
    do i = 1, 6
      variation(:, i) = variation(:, i) + d_log_f_s * rate(i) + d_F * by_F(i) + &
                        weight * h%f_s * m%a * h%F * flow(i) * d_f_d + along * h%that(i) + on_that * d_that(:, i)
    end do
  end subroutine vary_tensors

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
