!> Influence of the strain increment on the stress along a path: the variational equations of the integration, from which
!> the consistent tangent follows.
!>
!> The increment is L (d + eta); carried is the derivative of the stress with respect to eta at a fixed fraction of the
!> increment. theory.md, section 4.
module umat_influence
  use umat_collocation, only: nodes_type, decay
  use umat_delta_path, only: kappa_slope, delta_influence
  use umat_kinds, only: wp
  use umat_leg, only: leg_type
  use umat_lobatto, only: lobatto_type, most_nodes
  use umat_material, only: material_type
  use umat_status, only: branch_plain
  use umat_tensor, only: multiplicity
  use umat_variation, only: vary_operands, vary_with_operands, linearise, on_each
  use umat_wolffersdorff, only: hypoplastic_type, sensitivities, apply_L
  implicit none
  private
  public :: influence_type, influence_step

  !> What is carried along a path.
  type :: influence_type
    real(wp) :: on_stress(6, 6) = 0.0_wp !< (component of eta, component of stress) [stress]
    real(wp) :: integral = 0.0_wp !< of kappa_slope over the path's parameter, from the start of the branch
  end type influence_type

  !> Most passes; a step that needs more is too long.
  integer, parameter :: most_passes = 20
  !> Parts of the tolerance for what further passes would change, and for what the nodes leave out.
  real(wp), parameter :: enough = 0.05_wp, share = 0.1_wp

contains

  !> Carry the influence over a step whose stress is known.
  !> @param x, h      start of the step and its size in the path's parameter
  !> @param before    length of strain of the leg before the step [strain]
  !> @param end       where in the step the influence is wanted: 1, or near it
  !> @param nodes     of the step
  !> @param tensors   L and N at the nodes
  !> @param influence at the start of the step, then at its end
  !> @param error     relative to the influence at the end of the leg
  pure subroutine influence_step(m, rule, leg, x, h, before, end, nodes, tensors, influence, error)
    type(material_type), intent(in) :: m
    type(lobatto_type), intent(in) :: rule
    type(leg_type), intent(in) :: leg
    real(wp), intent(in) :: x, h, before, end
    type(nodes_type), intent(in) :: nodes
    type(hypoplastic_type), intent(in) :: tensors(0:most_nodes)
    type(influence_type), intent(inout) :: influence
    real(wp), intent(out) :: error
    real(wp), dimension(6, 6, 0:most_nodes) :: direct, total, y, by_stress
    real(wp) :: integral(0:most_nodes), slope(0:most_nodes), done(0:most_nodes), old(6, 6)
    real(wp) :: x_h(6), weight_h, rate(6), by_void_ratio(6), change, previous, at_end, left, highest, ratio
    integer :: k, i, pass, n

    n = rule%n
    do k = 0, n
      slope(k) = h * kappa_slope(m, nodes%point(k))
    end do
    integral(0) = influence%integral
    do k = 1, n
      integral(k) = influence%integral + dot_product(rule%a(:n, k), slope(:n))
    end do
    done(:n) = leg%turn + before + nodes%length(:n)
    left = max(0.0_wp, leg%length - before - nodes%length(n))
    do k = 0, n
      x_h = nodes%strain(k) * nodes%x(:, k)
      weight_h = nodes%strain(k) * nodes%weight(k)
      rate = apply_L(tensors(k), x_h) + weight_h * tensors(k)%N
      call linearise(m, tensors(k), sensitivities(m, nodes%void_ratio(k), tensors(k)), x_h, weight_h, rate, &
                     by_stress(:, :, k), by_void_ratio)
      direct(:, :, k) = nodes%strain(k) * direct_influence(k)
      do i = 1, 6 ! d(1 + e) = (1 + e) tr(eta) lambda
        direct(:3, i, k) = direct(:3, i, k) + by_void_ratio(i) * (1.0_wp + nodes%void_ratio(k)) * done(k)
      end do
      total(:, :, k) = direct(:, :, k) + on_each(by_stress(:, :, k), influence%on_stress)
    end do
    call integrate_influence(rule, influence%on_stress, total, y)
    error = huge(error)
    previous = error
    do pass = 1, most_passes
      do k = 1, n
        total(:, :, k) = direct(:, :, k) + on_each(by_stress(:, :, k), y(:, :, k))
      end do
      old = y(:, :, n)
      call integrate_influence(rule, influence%on_stress, total, y)
      change = size_of(y(:, :, n) - old)
      at_end = size_of(y(:, :, n)) + left / nodes%strain(n) * size_of(total(:, :, n))
      ! The first change is at most of the order of the change of stress, and the changes fall faster than geometrically.
      if (pass > 1 .and. change * change <= enough * leg%tolerance * at_end * previous) exit
      previous = change
    end do
    call decay([size_of(mode(0)), size_of(mode(1)), size_of(mode(2))], highest, ratio)
    error = highest * ratio**n / (share * at_end) ! the rule misses mode 2 n
    if (pass > most_passes) error = max(error, change / at_end)
    influence%on_stress = y(:, :, n) + (end - 1.0_wp) * total(:, :, n)
    influence%integral = integral(n) + (end - 1.0_wp) * slope(n)

  contains

    !> Change of the rate at node k through delta and D.
    pure function direct_influence(k) result(variation)
      integer, intent(in) :: k
      real(wp) :: variation(6, 6), d_delta(6, 6), dx(6, 6), dweight(6)
      d_delta = 0.0_wp
      if (leg%branch /= branch_plain) &
        d_delta = delta_influence(m, leg%path, x + rule%c(k) * h, nodes%point(k), done(k), integral(k))
      call vary_operands(m, nodes%point(k)%g, leg%direction, leg%branch, d_delta, dx, dweight)
      variation = vary_with_operands(tensors(k), dx, dweight)
    end function direct_influence

    !> Coefficient of the i-th mode from the highest.
    pure function mode(i) result(coefficient)
      integer, intent(in) :: i
      real(wp) :: coefficient(6, 6)
      integer :: j
      coefficient = 0.0_wp
      do j = 0, n
        coefficient = coefficient + rule%mode(j, i) * total(:, :, j)
      end do
    end function mode

  end subroutine influence_step

  !> Integrals from the start of the step to its nodes, added to the influence at the start. As vectors: this is where much
  !> of the time goes.
  pure subroutine integrate_influence(rule, start, total, y)
    type(lobatto_type), intent(in) :: rule
    real(wp), intent(in) :: start(36), total(36, 0:most_nodes)
    real(wp), intent(inout) :: y(36, 0:most_nodes)
    integer :: i, j
    do j = 1, rule%n
      associate (a => rule%a(:, j))
        if (rule%n == 2) then
          do i = 1, 36
            y(i, j) = start(i) + (a(1) * total(i, 0) + a(2) * total(i, 1) + a(3) * total(i, 2))
          end do
        else
          do i = 1, 36
            y(i, j) = start(i) + ((a(1) * total(i, 0) + a(2) * total(i, 1)) + &
                                  (a(3) * total(i, 2) + a(4) * total(i, 3) + a(5) * total(i, 4)))
          end do
        end if
      end associate
    end do
  end subroutine integrate_influence

  !> Size of an influence: a fourth-order tensor's norm, so that it does not depend on the axes.
  pure function size_of(influence) result(s)
    real(wp), intent(in) :: influence(6, 6)
    real(wp) :: s
    integer :: i
    s = 0.0_wp
    do i = 1, 6
      s = s + multiplicity(i) * sum(influence(:, i)**2 / multiplicity)
    end do
    s = sqrt(s)
  end function size_of

end module umat_influence
