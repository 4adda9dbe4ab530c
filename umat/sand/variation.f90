!> The derivatives of the stress rate, in factors.
!>
!> theory.md, section 4: both branches and the plain model are one form,
!>   Tdot = L:X + weight N,
!> where X = scale D + share c deltahat and weight (c rho^chi, 0 or |D|) depend on delta and D alone, L and N on T and e
!> alone. All that L, N and X can answer with lies along That, X and the unit tensor, but for a multiple of the variation itself.
!> So every derivative is a multiple of the identity and a few dyads, which is how it is kept.
module umat_variation
  use umat_border, only: seen_change
  use umat_delta_path, only: delta_influence_type
  use umat_intergranular, only: intergranular_type, scale_of, share_of
  use umat_kinds, only: wp
  use umat_material, only: material_type
  use umat_status, only: branch_plain, branch_loading
  use umat_tensor, only: ddot, multiplicity, unit_tensor
  use umat_wolffersdorff, only: hypoplastic_type, sensitivity_type
  implicit none
  private
  public :: linear_rate_type, linear_rate, linearise, operand_influence_type, operand_influence, direct_parts

  !> Derivative of the rate L:X + weight N with respect to stress and void ratio at given X and weight:
  !>   d rate = diagonal dT + That (on(:, 1) dT) + X (on(:, 2) dT) + 1 (on(:, 3) dT) + (That, X, 1) by_void_ratio de.
  type :: linear_rate_type
    real(wp) :: diagonal
    real(wp) :: on(6, 3) !< on the components of dT, multiplicities included
    real(wp) :: by_void_ratio(3)
  end type linear_rate_type

  !> Derivative of X and weight with respect to eta, with frame = (d, unit direction normal to d), D = d + eta:
  !>   dX = factor eta + sum_ij frame_i plane(i, j) (frame_j:eta),  dweight = sum_j weight(j) (frame_j:eta).
  type :: operand_influence_type
    real(wp) :: factor, plane(2, 2), weight(2)
  end type operand_influence_type

  !> Where the parts of a derivative of the rate point: d, the direction normal to it, 1 and That.
  integer, parameter, public :: part_d = 1, part_normal = 2, part_unit = 3, part_that = 4

contains

  !> Derivative of the rate L:X + weight N with respect to stress and void ratio at given X and weight; theory.md Eqs. (1)
  !> to (10), differentiated.
  !> @param h, s      L, N and their sensitivities
  !> @param x, weight operands of the rate
  pure function linear_rate(m, h, s, x, weight) result(linear)
    type(material_type), intent(in) :: m
    type(hypoplastic_type), intent(in) :: h
    type(sensitivity_type), intent(in) :: s
    real(wp), intent(in) :: x(6), weight
    type(linear_rate_type) :: linear
    real(wp), dimension(6) :: on_log, on_F, on_flow
    real(wp) :: that_x, flow_size, flow, by_e

    ! weight N = flow (That + T*hat) = flow (2 That - 1/3 1), because tr That = 1.
    that_x = h%dyad * ddot(h%that, x)
    flow_size = weight * h%f_s * m%a
    flow = flow_size * h%f_d * h%F
    ! d pressure = -tr dT; dThat = -(dT + That d pressure)/pressure.
    linear%diagonal = -(that_x + 2.0_wp * flow) / h%pressure
    on_F = through_that(h, s%F_that)
    on_log = through_that(h, s%log_f_s_that) - s%log_f_s_pressure * unit_tensor
    on_flow = flow * on_log + flow_size * (h%f_d * on_F - h%F * s%f_d_pressure * unit_tensor)
    linear%on(:, 1) = that_x * on_log + h%dyad * through_that(h, x) - linear%diagonal * unit_tensor + 2.0_wp * on_flow
    linear%on(:, 2) = h%identity * on_log + 2.0_wp * h%f_s * h%F * on_F
    linear%on(:, 3) = -on_flow / 3.0_wp
    by_e = flow * s%log_f_s_e + flow_size * h%F * s%f_d_e
    linear%by_void_ratio = [that_x * s%log_f_s_e + 2.0_wp * by_e, h%identity * s%log_f_s_e, -by_e / 3.0_wp]
  end function linear_rate

  !> The vector that gives t:dThat for a change of stress, multiplicities included.
  pure function through_that(h, t) result(on_stress)
    type(hypoplastic_type), intent(in) :: h
    real(wp), intent(in) :: t(6)
    real(wp) :: on_stress(6)
    on_stress = (ddot(h%that, t) * unit_tensor - multiplicity * t) * (1.0_wp / h%pressure)
  end function through_that

  !> The same derivative with its dyads multiplied out.
  !> @param by_stress     matrix: change of the rate = by_stress d_stress, on tensor components
  !> @param by_void_ratio d rate/d e
  pure subroutine linearise(m, h, s, x, weight, by_stress, by_void_ratio)
    type(material_type), intent(in) :: m
    type(hypoplastic_type), intent(in) :: h
    type(sensitivity_type), intent(in) :: s
    real(wp), intent(in) :: x(6), weight
    real(wp), intent(out) :: by_stress(6, 6), by_void_ratio(6)
    type(linear_rate_type) :: linear
    integer :: j
    linear = linear_rate(m, h, s, x, weight)
    do j = 1, 6
      by_stress(:, j) = linear%on(j, 1) * h%that + linear%on(j, 2) * x + linear%on(j, 3) * unit_tensor
      by_stress(j, j) = by_stress(j, j) + linear%diagonal
    end do
    if (h%outside) call through_border(m, h, by_stress)
    by_void_ratio = linear%by_void_ratio(1) * h%that + linear%by_void_ratio(2) * x + linear%by_void_ratio(3) * unit_tensor
  end subroutine linearise

  !> From changes of the stress that the model sees to changes of the stress.
  !> @param by_stress matrix of a linear model: its columns are combined
  pure subroutine through_border(m, h, by_stress)
    type(material_type), intent(in) :: m
    type(hypoplastic_type), intent(in) :: h
    real(wp), intent(inout) :: by_stress(6, 6)
    real(wp) :: by_seen(6, 6), change(6, 6)
    integer :: j, k
    change = seen_change(h%unseen, m%confinement)
    by_seen = by_stress
    do j = 1, 6
      by_stress(:, j) = by_seen(:, 1) * change(1, j)
      do k = 2, 6
        by_stress(:, j) = by_stress(:, j) + by_seen(:, k) * change(k, j)
      end do
    end do
  end subroutine through_border

  !> Derivative of X and weight with respect to eta, through delta and D = d + eta; theory.md Eqs. (11) and (13).
  !> @param g        direction and mobilisation of delta, which lies in the plane of the frame; not of the plain model
  !> @param cosine, sine components of deltahat in the frame
  !> @param on_delta derivative of delta; not of the plain model
  pure function operand_influence(m, g, cosine, sine, branch, on_delta) result(influence)
    type(material_type), intent(in) :: m
    type(intergranular_type), intent(in) :: g
    real(wp), intent(in) :: cosine, sine
    integer, intent(in) :: branch
    type(delta_influence_type), intent(in) :: on_delta
    type(operand_influence_type) :: influence
    real(wp) :: per_size, share, factor, on_along, along(2), direction(2), size(2), mobilised(2), c(2), on_direction(2)

    if (branch == branch_plain) then
      influence = operand_influence_type(1.0_wp, 0.0_wp, [1.0_wp, 0.0_wp])
      return
    end if
    influence = operand_influence_type(scale_of(m, g), 0.0_wp, 0.0_wp)
    ! At delta = 0 rho^chi kills every term but those of D.
    if (.not. g%rho > 0.0_wp) return
    per_size = 1.0_wp / (g%rho * m%R)
    share = share_of(m, branch)
    direction = [cosine, sine]
    ! On eta: d:d delta and d|delta|, over |delta|; c = deltahat:D; rho^chi.
    along = per_size * (on_delta%plane(1, :) + [on_delta%factor, 0.0_wp])
    size = per_size * (matmul(direction, on_delta%plane) + on_delta%factor * direction)
    c = direction + along - cosine * size
    mobilised = m%chi * g%rho_chi * size
    influence%weight = mobilised * cosine + g%rho_chi * c
    ! d deltahat = (d delta - deltahat d|delta|)/|delta|.
    factor = share * g%rho_chi * cosine
    on_along = factor * per_size
    on_direction = share * influence%weight - factor * size
    mobilised = (m%m_T - m%m_R) * mobilised
    influence%factor = influence%factor + on_along * on_delta%factor
    influence%plane(1, :) = mobilised + cosine * on_direction + on_along * on_delta%plane(1, :)
    influence%plane(2, :) = sine * on_direction + on_along * on_delta%plane(2, :)
    if (branch /= branch_loading) influence%weight = 0.0_wp
  end function operand_influence

  !> Derivative of the rate with respect to eta at fixed stress, through X, weight and void ratio:
  !>   d rate = factor eta + sum of direction_p (part(:, p):eta) over d, its normal, 1 and That.
  !> @param h         L and N
  !> @param linear    derivative of the rate with respect to void ratio
  !> @param frame     d and the direction normal to it
  !> @param x         X in the frame
  !> @param operands  derivative of X and weight
  !> @param by_volume void ratio over tr eta
  !> @param factor, part see above; part(:, p) on the components of eta, multiplicities included
  pure subroutine direct_parts(m, h, linear, frame, x, operands, by_volume, factor, part)
    type(material_type), intent(in) :: m
    type(hypoplastic_type), intent(in) :: h
    type(linear_rate_type), intent(in) :: linear
    real(wp), intent(in) :: frame(6, 2), x(2), by_volume
    type(operand_influence_type), intent(in) :: operands
    real(wp), intent(out) :: factor, part(6, 4)
    real(wp) :: on_frame(2, 4), on_volume(4), that_plane(2), flow(2)
    integer :: p

    factor = h%identity * operands%factor
    that_plane = ddot(h%that, frame(:, 1)) * operands%plane(1, :) + ddot(h%that, frame(:, 2)) * operands%plane(2, :)
    flow = h%f_s * h%f_d * m%a * h%F * operands%weight
    on_frame(:, part_d) = h%identity * operands%plane(1, :)
    on_frame(:, part_normal) = h%identity * operands%plane(2, :)
    on_frame(:, part_that) = h%dyad * that_plane + 2.0_wp * flow
    on_frame(:, part_unit) = -flow / 3.0_wp
    on_volume(part_d) = by_volume * linear%by_void_ratio(2) * x(1)
    on_volume(part_normal) = by_volume * linear%by_void_ratio(2) * x(2)
    on_volume(part_that) = by_volume * linear%by_void_ratio(1)
    on_volume(part_unit) = by_volume * linear%by_void_ratio(3)
    do p = 1, 4
      part(:, p) = on_frame(1, p) * frame(:, 1) + on_frame(2, p) * frame(:, 2)
    end do
    part(:, part_that) = part(:, part_that) + h%dyad * operands%factor * h%that
    do p = 1, 4
      part(:, p) = multiplicity * part(:, p) + on_volume(p) * unit_tensor
    end do
  end subroutine direct_parts

end module umat_variation
