!> A leg that is short against |delta|, in one step: two evaluations of L and N, and no search for where the step ends.
!>
!> The path of delta is a power series in the length of strain, the same for loading, for a reversal and for a delta that
!> stays as it is. The stress is collocated at Radau's nodes with the rate linear in stress and void ratio about the start.
!> What the linear model leaves out grows like the square of the way and is evaluated once, at the last node. theory.md, section 4.
!>
!> The update of many points side by side (batch/short.f90) takes the same step.
module umat_short_leg
  use umat_collocation, only: start_type
  use umat_from_zero, only: from_zero_type, from_zero, terms
  use umat_intergranular, only: share_of
  use umat_kinds, only: wp
  use umat_leg, only: leg_type, void_ratio_at
  use umat_material, only: material_type
  use umat_rate, only: state_type
  use umat_status, only: status_ok, branch_plain, branch_loading
  use umat_tensor, only: ddot, deviator, norm, unit_tensor
  use umat_variation, only: linear_rate_type, linear_rate
  use umat_wolffersdorff, only: hypoplastic_type, hypoplastic_tensors, apply_L, in_domain
  implicit none
  private
  public :: short_leg
  ! For many points side by side.
  public :: order, farthest, longest_plain, c1, c2, to_end, to_node, of_square, quadrature

  !> Highest power of the length in the series of the path.
  integer, parameter :: order = 7
  !> The series converges within |delta|; a leg that is longer than this part of it is not short.
  real(wp), parameter :: farthest = 0.35_wp
  !> Longest leg of the plain model [strain].
  real(wp), parameter :: longest_plain = 3.0e-5_wp

  real(wp), parameter :: root = sqrt(6.0_wp)
  !> Radau's nodes; the start is the third.
  real(wp), parameter :: c1 = (6.0_wp - root) / 10.0_wp, c2 = (6.0_wp + root) / 10.0_wp
  !> Weights of the start and the two nodes in the integrals over the leg and up to each node.
  real(wp), parameter :: to_end(0:2) = [1.0_wp / 9.0_wp, (16.0_wp + root) / 36.0_wp, (16.0_wp - root) / 36.0_wp]
  real(wp), parameter :: to_node(0:2, 2) = reshape([ &
        (9.0_wp + root) / 75.0_wp, (24.0_wp + root) / 120.0_wp, (168.0_wp - 73.0_wp * root) / 600.0_wp, &
        (9.0_wp - root) / 75.0_wp, (168.0_wp + 73.0_wp * root) / 600.0_wp, (24.0_wp - root) / 120.0_wp], [3, 2])
  !> Integral over the leg of what is 1 at the last node and grows like the square of the way.
  real(wp), parameter :: of_square = 1.0_wp / (3.0_wp * c2**2)
  !> What the nodes leave out: this times the second power of the rate's polynomial times the third power of how the powers fall.
  real(wp), parameter :: quadrature = 1.0e-3_wp

  !> Powers of the place in the leg (0 to 1) along the path of delta: u = delta:d/R, the size of the part of delta normal to d
  !> over that at the start, u R^2/|delta|^2, rho^chi.
  type :: series_type
    real(wp), dimension(0:order) :: along, across, turn, rho_chi
  end type series_type

contains

  !> Integrate a leg in one step, if that is accurate enough.
  !> @param leg      without the tangent; its path is not used
  !> @param start    L, N and their derivatives at the start of the leg
  !> @param scale    size of the stress, to which its error is relative [stress]
  !> @param tolerance of the leg, relative
  !> @param state    in: start, out: end, if accepted; otherwise untouched
  !> @param error    estimate, relative; beyond the tolerance where none was made
  !> @param accepted is it accurate enough, and inside the domain?
  !> @param evaluations of L and N are added
  pure subroutine short_leg(m, leg, start, scale, tolerance, state, error, accepted, evaluations)
    type(material_type), intent(in) :: m
    type(leg_type), intent(in) :: leg
    type(start_type), intent(in) :: start
    real(wp), intent(in) :: scale, tolerance
    type(state_type), intent(inout) :: state
    real(wp), intent(out) :: error
    logical, intent(out) :: accepted
    integer, intent(inout) :: evaluations
    real(wp) :: x(6, 0:2), weight(0:2), change(6), delta(6), fall, stress_error
    integer :: k, status

    accepted = .false.
    error = huge(error)
    if (start%h%outside) return ! beyond the domain the rate bends too much
    if (leg%branch == branch_plain) then
      error = merge(0.0_wp, huge(error), leg%length <= longest_plain)
      fall = 0.0_wp
      do k = 0, 2
        x(:, k) = leg%length * leg%direction
        weight(k) = leg%length
      end do
    else
      call follow_delta(m, leg, state%delta, x, weight, delta, fall, error)
    end if
    if (error > tolerance) return
    call move_stress(m, leg, start, scale, x, weight, fall, change, stress_error, status)
    evaluations = evaluations + 1
    if (status /= status_ok) return
    error = max(error, stress_error)
    if (error > tolerance) return
    if (.not. in_domain(m, state%stress + change, void_ratio_at(leg, leg%length))) return
    accepted = .true.
    state%stress = state%stress + change
    state%void_ratio = void_ratio_at(leg, leg%length)
    if (leg%branch /= branch_plain) state%delta = delta
  end subroutine short_leg

  !> delta along the leg: operands of the rate at the nodes, and delta at the end.
  !> @param delta_0   delta at the start
  !> @param x, weight operands, times the length of the leg [strain]
  !> @param delta     at the end
  !> @param fall      how the powers of the series fall at least
  !> @param error     of delta, relative to R
  pure subroutine follow_delta(m, leg, delta_0, x, weight, delta, fall, error)
    type(material_type), intent(in) :: m
    type(leg_type), intent(in) :: leg
    real(wp), intent(in) :: delta_0(6)
    real(wp), intent(out) :: x(6, 0:2), weight(0:2), delta(6), fall, error
    real(wp) :: u, rho, normal(6), length
    type(series_type) :: s
    logical :: loading

    delta = delta_0
    fall = 1.0_wp
    error = huge(error)
    loading = leg%branch == branch_loading
    length = leg%length / m%R
    u = ddot(delta_0, leg%direction) / m%R
    normal = delta_0 / m%R - u * leg%direction
    if (loading) u = max(0.0_wp, u)
    rho = sqrt(u**2 + ddot(normal, normal))
    if (loading .and. .not. rho > 0.0_wp) then
      call follow_from_zero(m, leg, x, weight, delta, error)
      fall = 0.0_wp
      return
    end if
    if (length > farthest * rho) return
    if (loading .and. rho > 1.0_wp) then
      u = u / rho
      normal = normal / rho
      rho = 1.0_wp
    end if
    fall = length / rho
    s = series(m, length, u, rho, merge(rho**m%beta_r, 0.0_wp, loading))
    error = (abs(s%along(order)) + norm(normal) * abs(s%across(order))) * fall / (1.0_wp - fall)
    delta = m%R * (sum(s%along) * leg%direction + sum(s%across) * normal)
    call operands_at(m, leg, s, normal, 0.0_wp, x(:, 0), weight(0))
    call operands_at(m, leg, s, normal, c1, x(:, 1), weight(1))
    call operands_at(m, leg, s, normal, c2, x(:, 2), weight(2))
  end subroutine follow_delta

  !> The same where delta starts from zero; theory.md Eqs. (17c). rho^chi is no polynomial there: at the nodes stands the parabola
  !> through zero that has its integral, and the integral of its product with the place.
  pure subroutine follow_from_zero(m, leg, x, weight, delta, error)
    type(material_type), intent(in) :: m
    type(leg_type), intent(in) :: leg
    real(wp), intent(out) :: x(6, 0:2), weight(0:2), delta(6), error
    type(from_zero_type) :: series
    real(wp) :: length, s, rho_chi, last, mean, moment
    integer :: k
    real(wp), parameter :: place(0:2) = [0.0_wp, c1, c2]
    delta = 0.0_wp
    error = huge(error)
    length = leg%length / m%R
    if (length > farthest) return
    series = from_zero(m)
    s = length**m%beta_r
    rho_chi = length**m%chi
    last = s**terms / (1.0_wp - s)
    error = last * (length * abs(series%rho(terms)) + rho_chi * abs(series%mean(terms)))
    delta = m%R * length * value_of(series%rho, s) * leg%direction
    mean = rho_chi * value_of(series%mean, s)
    moment = rho_chi * value_of(series%moment, s)
    do k = 0, 2
      weight(k) = leg%length * place(k) * (18.0_wp * mean - 24.0_wp * moment + &
                                           place(k) * (36.0_wp * moment - 24.0_wp * mean))
      x(:, k) = (leg%length * m%m_R + weight(k) * (1.0_wp - m%m_R)) * leg%direction
    end do
  end subroutine follow_from_zero

  !> The path of delta as a power series; theory.md Eqs. (17b).
  !> @param length of the leg, over R
  !> @param u, rho delta:d/R and |delta|/R at the start
  !> @param q      rho^beta_r at the start; zero in a reversal
  pure function series(m, length, u, rho, q) result(s)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: length, u, rho, q
    type(series_type) :: s
    real(wp), dimension(0:order) :: per_square, decay, back, growth, both !< 1/rho^2, q, q g, (1 - q) g and (2 - q) g, g the turn
    real(wp) :: step
    integer :: k
    s%along(0) = u
    s%across(0) = 1.0_wp
    s%rho_chi(0) = rho**m%chi
    decay(0) = q
    per_square(0) = 1.0_wp / rho**2
    s%turn(0) = u * per_square(0)
    do k = 0, order - 1
      back(k) = product_of(decay(0:k), s%turn(0:k))
      growth(k) = s%turn(k) - back(k)
      both(k) = s%turn(k) + growth(k)
      step = length / (k + 1)
      s%along(k + 1) = step * (merge(1.0_wp, 0.0_wp, k == 0) - product_of(s%along(0:k), back(0:k)))
      s%across(k + 1) = -step * product_of(s%across(0:k), back(0:k))
      s%turn(k + 1) = step * (per_square(k) - product_of(s%turn(0:k), both(0:k)))
      s%rho_chi(k + 1) = m%chi * step * product_of(s%rho_chi(0:k), growth(0:k))
      per_square(k + 1) = -2.0_wp * step * product_of(per_square(0:k), growth(0:k))
      decay(k + 1) = m%beta_r * step * product_of(decay(0:k), growth(0:k))
    end do
  end function series

  !> Coefficient of the highest power in the product of two series with as many terms.
  pure function product_of(a, b) result(coefficient)
    real(wp), intent(in) :: a(:), b(:)
    real(wp) :: coefficient
    integer :: i
    coefficient = 0.0_wp
    do i = 1, size(a)
      coefficient = coefficient + a(i) * b(size(b) + 1 - i)
    end do
  end function product_of

  !> Operands of the rate at a place in the leg, times its length; theory.md Eq. (13).
  !> @param normal part of delta normal to d at the start, over R
  !> @param place  0 to 1
  pure subroutine operands_at(m, leg, s, normal, place, x, weight)
    type(material_type), intent(in) :: m
    type(leg_type), intent(in) :: leg
    type(series_type), intent(in) :: s
    real(wp), intent(in) :: normal(6), place
    real(wp), intent(out) :: x(6), weight
    real(wp) :: along, rho_chi, turning, turn
    along = value_of(s%along, place)
    rho_chi = value_of(s%rho_chi, place)
    turning = value_of(s%turn, place)
    turn = share_of(m, leg%branch) * rho_chi * turning
    x = leg%length * ((rho_chi * m%m_T + (1.0_wp - rho_chi) * m%m_R + turn * along) * leg%direction + &
                      turn * value_of(s%across, place) * normal)
    weight = 0.0_wp
    ! (delta:d/|delta|)^2 is the product of along and turning.
    if (leg%branch == branch_loading) weight = leg%length * rho_chi * sqrt(max(0.0_wp, along * turning))
  end subroutine operands_at

  !> Value of a series.
  pure function value_of(series, place) result(value)
    real(wp), intent(in) :: series(0:), place
    real(wp) :: value
    integer :: k
    value = series(ubound(series, 1))
    do k = ubound(series, 1) - 1, 0, -1
      value = series(k) + place * value
    end do
  end function value_of

  !> Change of stress over the leg.
  !> @param x, weight operands at the nodes, times the length of the leg
  !> @param fall      how the powers of the operands fall at least
  !> @param change    [stress]
  !> @param error     estimate, relative
  pure subroutine move_stress(m, leg, start, scale, x, weight, fall, change, error, status)
    type(material_type), intent(in) :: m
    type(leg_type), intent(in) :: leg
    type(start_type), intent(in) :: start
    real(wp), intent(in) :: scale, x(6, 0:2), weight(0:2), fall
    real(wp), intent(out) :: change(6), error
    integer, intent(out) :: status
    type(hypoplastic_type) :: h
    real(wp) :: frozen(6, 0:2), f(6, 0:2), e(2), rest(6), theta, left, bend
    integer :: k

    do k = 0, 2
      frozen(:, k) = apply_L(start%h, x(:, k)) + weight(k) * start%h%N
    end do
    f(:, 0) = frozen(:, 0)
    e = void_ratio_at(leg, [c1, c2] * leg%length)
    do k = 1, 2
      f(:, k) = frozen(:, k) + linear_change(start%h, linear_rate(m, start%h, start%s, x(:, k), weight(k)), x(:, k), &
                                             integral(to_node(:, k), frozen), e(k) - start%void_ratio)
    end do
    call hypoplastic_tensors(m, start%stress + integral(to_node(:, 2), f), e(2), h, status)
    if (status /= status_ok) return
    rest = apply_L(h, x(:, 2)) + weight(2) * h%N - f(:, 2)
    change = integral(to_end, f) + of_square * rest

    ! A second evaluation would change the result by about theta times what the first did. Where the rate is not smooth the
    ! first itself is larger than theta^3 tells; next to the isotropic axis F is a cone.
    theta = max(norm(change) / scale, tiny(theta)**0.25_wp)
    left = of_square * norm(rest) / scale
    left = left * min(1.0_wp, max(theta, left / theta**2, 0.5_wp * theta / max(norm(deviator(start%h%that)), theta * theta)))
    bend = norm((f(:, 2) - f(:, 0)) / c2 - (f(:, 1) - f(:, 0)) / c1) / (c2 - c1) / scale
    error = left + quadrature * bend * (theta + fall)**3
  end subroutine move_stress

  !> Change of the rate with stress and void ratio, by its linear model.
  pure function linear_change(h, linear, x, d_stress, d_void_ratio) result(change)
    type(hypoplastic_type), intent(in) :: h
    type(linear_rate_type), intent(in) :: linear
    real(wp), intent(in) :: x(6), d_stress(6), d_void_ratio
    real(wp) :: change(6)
    real(wp) :: along(3)
    along = matmul(d_stress, linear%on) + d_void_ratio * linear%by_void_ratio
    change = linear%diagonal * d_stress + along(1) * h%that + along(2) * x + along(3) * unit_tensor
  end function linear_change

  !> Integral of the quadratic through values at the start and the nodes.
  pure function integral(weights, f)
    real(wp), intent(in) :: weights(0:2), f(6, 0:2)
    real(wp) :: integral(6)
    integral = weights(0) * f(:, 0) + weights(1) * f(:, 1) + weights(2) * f(:, 2)
  end function integral

end module umat_short_leg
