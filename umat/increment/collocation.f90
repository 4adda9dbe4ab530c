!> One step of the stress along a path of strain, by collocation at Lobatto's nodes.
!>
!> Along a path delta and the void ratio are known beforehand; only the stress has to be found. With u the change of stress
!> since the start of the step, the step solves u_j = sum_k a(k, j) f_k(u_k), f_k the rate of stress at node k times the
!> strain per unit of the step (theory.md, section 4). The rate is the same L and N everywhere but for its operands, so
!> linearising it at the start costs one evaluation for all nodes: that is the prediction. Each sweep then evaluates the rate at the
!> nodes and corrects with the same linear model, which gains about three digits a sweep.
module umat_collocation
  use umat_delta_path, only: delta_path_type, path_point_type, path_point
  use umat_intergranular, only: operands
  use umat_kinds, only: wp
  use umat_lobatto, only: lobatto_type, most_nodes
  use umat_material, only: material_type
  use umat_status, only: status_ok
  use umat_tensor, only: trace, norm
  use umat_variation, only: linearise
  use umat_wolffersdorff, only: hypoplastic_type, hypoplastic_tensors, sensitivity_type, sensitivities, apply_L
  implicit none
  private
  public :: nodes_type, place_nodes, start_type, start_of_step, prediction, sweep, missing_of, tail, decay

  !> What is known at the nodes of a step without the stress.
  type :: nodes_type
    type(path_point_type) :: point(0:most_nodes)
    real(wp) :: strain(0:most_nodes) !< d lambda over d c, c running from 0 to 1 through the step
    real(wp) :: length(0:most_nodes) !< lambda since the start of the step
    real(wp) :: void_ratio(0:most_nodes)
    real(wp) :: x(6, 0:most_nodes), weight(0:most_nodes) !< operands of the rate
  end type nodes_type

  !> The start of a step: state, L and N and their derivatives.
  type :: start_type
    real(wp) :: stress(6), void_ratio
    type(hypoplastic_type) :: h
    type(sensitivity_type) :: s
  end type start_type

contains

  !> The start of a step.
  !> @param status status_ok or status_out_of_domain
  pure subroutine start_of_step(m, stress, void_ratio, start, status)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: stress(6), void_ratio
    type(start_type), intent(out) :: start
    integer, intent(out) :: status
    start%stress = stress
    start%void_ratio = void_ratio
    call hypoplastic_tensors(m, stress, void_ratio, start%h, status)
    if (status == status_ok) start%s = sensitivities(m, void_ratio, start%h)
  end subroutine start_of_step

  !> Place the nodes of a step.
  !> @param rule       where the nodes are
  !> @param path       of delta
  !> @param direction  unit strain direction
  !> @param branch     of the whole path
  !> @param x, h       start of the step and its size in the path's parameter
  !> @param void_ratio at the start of the step
  pure subroutine place_nodes(m, rule, path, direction, branch, x, h, void_ratio, nodes)
    type(material_type), intent(in) :: m
    type(lobatto_type), intent(in) :: rule
    type(delta_path_type), intent(in) :: path
    real(wp), intent(in) :: direction(6), x, h, void_ratio
    integer, intent(in) :: branch
    type(nodes_type), intent(inout) :: nodes
    integer :: k
    do k = 0, rule%n
      nodes%point(k) = path_point(m, path, x + rule%c(k) * h)
      nodes%strain(k) = h * nodes%point(k)%speed
      call operands(m, nodes%point(k)%g, direction, branch, nodes%x(:, k), nodes%weight(k))
    end do
    nodes%length(0) = 0.0_wp
    do k = 1, rule%n
      nodes%length(k) = dot_product(rule%a(:rule%n, k), nodes%strain(:rule%n))
    end do
    ! Grains keep their volume; theory.md Eq. (15) integrated.
    nodes%void_ratio(:rule%n) = (1.0_wp + void_ratio) * exp(trace(direction) * nodes%length(:rule%n)) - 1.0_wp
  end subroutine place_nodes

  !> Predict the change of stress at the nodes, with the rate linear in stress and void ratio about the start of the step.
  !> @param by_stress matrices of the linear model at the nodes: change of the rate per unit of the step with the stress
  !> @param f         rates at the nodes per unit of the step, by the linear model
  !> @param u         change of stress at the nodes
  pure subroutine prediction(m, rule, nodes, start, by_stress, f, u)
    type(material_type), intent(in) :: m
    type(lobatto_type), intent(in) :: rule
    type(nodes_type), intent(in) :: nodes
    type(start_type), intent(in) :: start
    real(wp), intent(out) :: by_stress(6, 6, most_nodes), f(6, 0:most_nodes), u(6, 0:most_nodes)
    real(wp) :: frozen(6, 0:most_nodes), by_void_ratio(6), x(6), weight
    integer :: k
    ! Each pass gains a factor of theta, the relative change of stress in the step. The linear model itself is off by terms
    ! of order theta^3, and so is the first pass.
    do k = 0, rule%n
      x = nodes%strain(k) * nodes%x(:, k)
      weight = nodes%strain(k) * nodes%weight(k)
      frozen(:, k) = apply_L(start%h, x) + weight * start%h%N
      f(:, k) = frozen(:, k)
      if (k == 0) cycle
      call linearise(m, start%h, start%s, x, weight, by_stress(:, :, k), by_void_ratio)
      frozen(:, k) = frozen(:, k) + (nodes%void_ratio(k) - start%void_ratio) * by_void_ratio
    end do
    call integrate_to_nodes(rule, f, u)
    do k = 1, rule%n
      f(:, k) = frozen(:, k) + on_change(by_stress(:, :, k), u(:, k))
    end do
    call integrate_to_nodes(rule, f, u)
  end subroutine prediction

  !> Evaluate the rate at the nodes and correct the change of stress.
  !> @param by_stress from prediction
  !> @param h      L and N at the nodes behind the start, at the stress before the correction
  !> @param f      rates at the nodes per unit of the step, corrected by the linear model
  !> @param u      change of stress at the nodes
  !> @param change size of the correction at the end of the step [stress]
  !> @param status status_ok or status_out_of_domain
  pure subroutine sweep(m, rule, nodes, start, by_stress, h, f, u, change, status)
    type(material_type), intent(in) :: m
    type(lobatto_type), intent(in) :: rule
    type(nodes_type), intent(in) :: nodes
    type(start_type), intent(in) :: start
    real(wp), intent(in) :: by_stress(6, 6, most_nodes)
    type(hypoplastic_type), intent(inout) :: h(0:most_nodes)
    real(wp), intent(inout) :: f(6, 0:most_nodes), u(6, 0:most_nodes)
    real(wp), intent(out) :: change
    integer, intent(out) :: status
    real(wp) :: evaluated(6, 0:most_nodes), before(6, 0:most_nodes)
    integer :: k
    change = huge(change)
    do k = 1, rule%n
      call hypoplastic_tensors(m, start%stress + u(:, k), nodes%void_ratio(k), h(k), status)
      if (status /= status_ok) return
      evaluated(:, k) = nodes%strain(k) * (apply_L(h(k), nodes%x(:, k)) + nodes%weight(k) * h(k)%N)
    end do
    before(:, :rule%n) = u(:, :rule%n)
    f(:, 1:rule%n) = evaluated(:, 1:rule%n)
    call integrate_to_nodes(rule, f, u)
    do k = 1, rule%n
      f(:, k) = evaluated(:, k) + on_change(by_stress(:, :, k), u(:, k) - before(:, k))
    end do
    call integrate_to_nodes(rule, f, u)
    change = norm(u(:, rule%n) - before(:, rule%n))
  end subroutine sweep

  !> A matrix on a change of stress.
  pure function on_change(matrix, u) result(answer)
    real(wp), intent(in) :: matrix(6, 6), u(6)
    real(wp) :: answer(6)
    integer :: j
    answer = matrix(:, 1) * u(1)
    do j = 2, 6
      answer = answer + matrix(:, j) * u(j)
    end do
  end function on_change

  !> Integrals from the start of the step to its nodes. A subroutine with fixed shapes: nothing is allocated.
  pure subroutine integrate_to_nodes(rule, f, u)
    type(lobatto_type), intent(in) :: rule
    real(wp), intent(in) :: f(6, 0:most_nodes)
    real(wp), intent(out) :: u(6, 0:most_nodes)
    integer :: k, j
    u(:, 0) = 0.0_wp
    do j = 1, rule%n
      u(:, j) = rule%a(0, j) * f(:, 0)
      do k = 1, rule%n
        u(:, j) = u(:, j) + rule%a(k, j) * f(:, k)
      end do
    end do
  end subroutine integrate_to_nodes

  !> What the nodes leave out of the change of stress over the step [stress].
  !> @param f rates at the nodes per unit of the step
  !> @param coupling as in tail
  pure function missing_of(rule, f, coupling) result(missing)
    type(lobatto_type), intent(in) :: rule
    real(wp), intent(in) :: f(6, 0:most_nodes), coupling
    real(wp) :: missing
    real(wp) :: mode(6, 0:3)
    integer :: i, k
    do i = 0, 3
      mode(:, i) = rule%mode(0, i) * f(:, 0)
      do k = 1, rule%n
        mode(:, i) = mode(:, i) + rule%mode(k, i) * f(:, k)
      end do
    end do
    missing = tail(norm(mode(:, 0)), norm(mode(:, 1)), norm(mode(:, 2)), norm(mode(:, 3)), rule%n, coupling)
  end function missing_of

  include 'tail.inc'

end module umat_collocation
