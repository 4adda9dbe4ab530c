!> Influence of the strain increment on the stress over a step at the border of the domain (border.f90), where the derivative of
!> the rate with respect to stress is a full matrix: the nodes' equations by passes. influence.f90 has the ordinary step.
module umat_influence_in_full
  use umat_collocation, only: decay
  use umat_kinds, only: wp
  use umat_lobatto, only: lobatto_type, most_nodes
  use umat_tensor, only: multiplicity
  implicit none
  private
  public :: influence_in_full, size_of

  !> Most passes; a step that needs more is too long.
  integer, parameter :: most_passes = 20
  !> Parts of the tolerance for what further passes would change, and for what the nodes leave out.
  real(wp), parameter :: enough = 0.05_wp, share = 0.1_wp

contains

  !> The influence at the end of a step: J (component of eta, component of stress) of influence.f90.
  !> @param direct    rates at the nodes but for the influence through the stress, c running from 0 to 1 through the step
  !> @param by_stress derivative of the rate at the nodes with respect to stress
  !> @param tolerance relative
  !> @param left      what is left of the leg, in steps
  !> @param start     influence at the start of the step
  !> @param at_end, rate influence at the last node, and its rate there
  !> @param error     relative to the influence at the end of the leg
  pure subroutine influence_in_full(rule, direct, by_stress, tolerance, left, start, at_end, rate, error)
    type(lobatto_type), intent(in) :: rule
    real(wp), intent(in) :: direct(6, 6, 0:most_nodes), by_stress(6, 6, 0:most_nodes), tolerance, left, start(6, 6)
    real(wp), intent(out) :: at_end(6, 6), rate(6, 6), error
    real(wp), dimension(6, 6, 0:most_nodes) :: total, y
    real(wp) :: mode(6, 6), sizes(0:2), change, previous, size, highest, ratio
    integer :: i, k, n, pass
    n = rule%n
    do k = 0, n
      total(:, :, k) = direct(:, :, k) + on_each(by_stress(:, :, k), start)
    end do
    call integrate_to_nodes(rule, start, total, y)
    previous = huge(previous)
    do pass = 1, most_passes
      do k = 1, n
        total(:, :, k) = direct(:, :, k) + on_each(by_stress(:, :, k), y(:, :, k))
      end do
      at_end = y(:, :, n)
      call integrate_to_nodes(rule, start, total, y)
      change = size_of(y(:, :, n) - at_end)
      size = size_of(y(:, :, n)) + left * size_of(total(:, :, n))
      ! The first change is at most of the order of the change of stress, and the changes fall faster than geometrically.
      if (pass > 1 .and. change * change <= enough * tolerance * size * previous) exit
      previous = change
    end do
    at_end = y(:, :, n)
    rate = total(:, :, n)
    do i = 0, 2
      mode = rule%mode(0, i) * total(:, :, 0)
      do k = 1, n
        mode = mode + rule%mode(k, i) * total(:, :, k)
      end do
      sizes(i) = size_of(mode)
    end do
    call decay(sizes(0), sizes(1), sizes(2), 0.0_wp, highest, ratio)
    error = highest * ratio**n / (share * max(size, tiny(size))) ! the rule misses mode 2 n
    if (pass > most_passes) error = max(error, change / max(size, tiny(size)))
  end subroutine influence_in_full

  !> A matrix on the stress of each component of eta.
  pure function on_each(matrix, y) result(answer)
    real(wp), intent(in) :: matrix(6, 6), y(6, 6)
    real(wp) :: answer(6, 6)
    integer :: i, j
    do i = 1, 6
      answer(:, i) = matrix(i, 1) * y(:, 1)
      do j = 2, 6
        answer(:, i) = answer(:, i) + matrix(i, j) * y(:, j)
      end do
    end do
  end function on_each

  !> Integrals from the start of the step to its nodes, added to the influence at the start.
  pure subroutine integrate_to_nodes(rule, start, total, y)
    type(lobatto_type), intent(in) :: rule
    real(wp), intent(in) :: start(6, 6), total(6, 6, 0:most_nodes)
    real(wp), intent(out) :: y(6, 6, 0:most_nodes)
    integer :: j, k
    y(:, :, 0) = start
    do j = 1, rule%n
      y(:, :, j) = start
      do k = 0, rule%n
        y(:, :, j) = y(:, :, j) + rule%a(k, j) * total(:, :, k)
      end do
    end do
  end subroutine integrate_to_nodes

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

end module umat_influence_in_full
