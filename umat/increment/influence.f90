!> Influence of the strain increment on the stress along a path: the variational equations of the integration, from which
!> the consistent tangent follows.
!>
!> The increment is L (d + eta); carried is J, the derivative of the stress with respect to eta at a fixed fraction of the
!> increment. theory.md, section 4.
module umat_influence
  use umat_collocation, only: nodes_type, decay
  use umat_delta_path, only: delta_influence_type, delta_influence, kappa_slope
  use umat_influence_in_full, only: influence_in_full, size_of
  use umat_kinds, only: wp
  use umat_leg, only: leg_type
  use umat_lobatto, only: lobatto_type, most_nodes
  use umat_material, only: material_type
  use umat_status, only: branch_plain, branch_reversal
  use umat_tensor, only: ddot, deviator, norm, multiplicity, unit_tensor
  use umat_variation, only: linear_rate_type, linear_rate, linearise, operand_influence_type, operand_influence, &
                            direct_parts, &
                            part_d, part_normal, part_that, part_unit
  use umat_wolffersdorff, only: hypoplastic_type, sensitivities
  implicit none
  private
  public :: influence_type, influence_step

  !> What is carried along a path.
  type :: influence_type
    real(wp) :: on_stress(6, 6) = 0.0_wp !< J (component of eta, component of stress) [stress]
    real(wp) :: integral = 0.0_wp !< of kappa_slope over the path's parameter, from the start of the branch
  end type influence_type

  !> dJ/dc at the nodes of a step, c running from 0 to 1 through it: with y the influence at the node,
  !>   diagonal y + factor (identity) + dyads of directions d, its normal, 1 and That with part(:, p).
  type :: rates_type
    real(wp) :: diagonal(0:most_nodes), factor(0:most_nodes), part(6, 4, 0:most_nodes)
    real(wp) :: x(2, 0:most_nodes) !< X, with the length of strain, along d and its normal
    real(wp) :: frame(6, 2) !< d and its normal
    real(wp) :: that(6, 0:most_nodes)
    type(linear_rate_type) :: linear(0:most_nodes)
  end type rates_type

  !> Most unknown vectors of a step: what That, X and 1 are multiplied with, at each node.
  integer, parameter :: most_rows = 3 * most_nodes, most_columns = most_rows + 6
  !> A pivot of the nodes' system is near 1; below this the step is too long.
  real(wp), parameter :: least_pivot = 0.1_wp
  !> Part of the tolerance for what the nodes leave out.
  real(wp), parameter :: share = 0.5_wp

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
    type(rates_type) :: rates
    real(wp) :: slope(0:most_nodes), weight(0:most_nodes, most_nodes), at_end(6, 6), rate(6, 6)
    real(wp) :: integral, size, left, highest, ratio
    integer :: k, n
    logical :: solved, outside

    n = rule%n
    do k = 0, n
      slope(k) = h * kappa_slope(m, nodes%point(k))
    end do
    rates%frame(:, 1) = leg%path%along
    rates%frame(:, 2) = leg%path%normal
    rates%diagonal = 0.0_wp
    do k = 0, n
      rates%that(:, k) = tensors(k)%that
      integral = influence%integral
      if (k > 0) integral = integral + dot_product(rule%a(:n, k), slope(:n))
      call direct_rate(k, integral, rates)
    end do
    left = max(0.0_wp, leg%length - before - nodes%length(n)) / nodes%strain(n)
    outside = .false.
    do k = 0, n
      outside = outside .or. tensors(k)%outside
    end do
    if (outside) then
      call at_border(at_end, rate, error)
      influence%on_stress = at_end + (end - 1.0_wp) * rate
      influence%integral = influence%integral + dot_product(rule%a(:n, n), slope(:n)) + (end - 1.0_wp) * slope(n)
      return
    end if
    call propagators(rule, rates%diagonal, weight)
    call solve(n, merge(2, 3, leg%branch == branch_reversal), weight, influence%on_stress, rates, solved)
    error = huge(error)
    if (.not. solved) return

    at_end = combined(n, weight(:, n), 1.0_wp + dot_product(weight(:n, n), rates%diagonal(:n)), influence%on_stress, rates)
    rate = rate_at(n, at_end, rates)
    size = size_of(at_end) + left * size_of(rate)
    call decay(mode_size(0), mode_size(1), mode_size(2), 0.0_wp, highest, ratio)
    ! The rule misses mode 2 n of the rates.
    error = (highest * ratio**n / size + turn_missed(n, rates%that(:, 0), rates%that(:, n))) / share
    influence%on_stress = at_end + (end - 1.0_wp) * rate
    influence%integral = influence%integral + dot_product(rule%a(:n, n), slope(:n)) + (end - 1.0_wp) * slope(n)

  contains

    !> The step where the stress is at the border of the domain, or beyond.
    pure subroutine at_border(at_end, rate, error)
      real(wp), intent(out) :: at_end(6, 6), rate(6, 6), error
      real(wp), dimension(6, 6, 0:most_nodes) :: direct, by_stress
      real(wp) :: none(6, 6), by_void_ratio(6)
      integer :: k
      none = 0.0_wp
      do k = 0, n
        direct(:, :, k) = rate_at(k, none, rates)
        call linearise(m, tensors(k), sensitivities(m, nodes%void_ratio(k), tensors(k)), nodes%strain(k) * nodes%x(:, k), &
                       nodes%strain(k) * nodes%weight(k), by_stress(:, :, k), by_void_ratio)
      end do
      call influence_in_full(rule, direct, by_stress, leg%tolerance, left, influence%on_stress, at_end, rate, error)
    end subroutine at_border

    !> Node k's rates but for the influence through the stress.
    pure subroutine direct_rate(k, integral, rates)
      integer, intent(in) :: k
      real(wp), intent(in) :: integral
      type(rates_type), intent(inout) :: rates
      type(delta_influence_type) :: on_delta
      type(operand_influence_type) :: on_operands
      real(wp) :: done, strain
      strain = nodes%strain(k)
      rates%linear(k) = linear_rate(m, tensors(k), sensitivities(m, nodes%void_ratio(k), tensors(k)), &
                                    strain * nodes%x(:, k), strain * nodes%weight(k))
      rates%diagonal(k) = rates%linear(k)%diagonal
      rates%x(:, k) = strain * in_frame(nodes%x(:, k))
      done = leg%turn + before + nodes%length(k)
      if (leg%branch /= branch_plain) on_delta = delta_influence(m, leg%path, x + rule%c(k) * h, nodes%point(k), done, integral)
      associate (g => nodes%point(k)%g, direction => in_frame(nodes%point(k)%g%direction))
        on_operands = operand_influence(m, g, direction(1), direction(2), leg%branch, on_delta)
      end associate
      on_operands%factor = strain * on_operands%factor
      on_operands%plane = strain * on_operands%plane
      on_operands%weight = strain * on_operands%weight
      ! d(1 + e) = (1 + e) tr(eta) lambda
      call direct_parts(m, tensors(k), rates%linear(k), rates%frame, rates%x(:, k), on_operands, &
                        (1.0_wp + nodes%void_ratio(k)) * done, rates%factor(k), rates%part(:, :, k))
    end subroutine direct_rate

    !> Components of a tensor in the plane of the path.
    pure function in_frame(t) result(components)
      real(wp), intent(in) :: t(6)
      real(wp) :: components(2)
      components = [ddot(t, rates%frame(:, 1)), ddot(t, rates%frame(:, 2))]
    end function in_frame

    !> Size of the i-th mode of the rates from the highest, the diagonal term left out.
    pure function mode_size(i) result(size)
      integer, intent(in) :: i
      real(wp) :: size
      real(wp) :: factor, part(6, 4)
      integer :: k
      factor = dot_product(rule%mode(:n, i), rates%factor(:n))
      part = 0.0_wp
      do k = 0, n
        part = part + rule%mode(k, i) * rates%part(:, :, k)
      end do
        size = sqrt(6.0_wp * factor**2 + sum((part(:, part_d)**2 + part(:, part_normal)**2 + part(:, part_that)**2 / 3.0_wp + &
                                            part(:, part_unit)**2 * 3.0_wp) / multiplicity))
    end function mode_size

  end subroutine influence_step

  !> What the nodes miss where T*hat turns within the step, relative.
  !>
  !> F has a cone at T*hat = 0. On a path past it the derivative of F turns like an angle seen from a passing point, which has a
  !> pole beside the step; the share of that derivative in the influence is the change of That.
  pure function turn_missed(n, start, end) result(missed)
    integer, intent(in) :: n
    real(wp), intent(in) :: start(6), end(6)
    real(wp) :: missed
    real(wp) :: change, distance
    change = norm(end - start)
    distance = norm(deviator(start)) + norm(deviator(end))
    missed = 0.0_wp
    if (change > 0.0_wp) missed = change * (change / (distance + change))**(2 * n)
  end function turn_missed

  !> How the other terms of the rates at the nodes come to the influence at the nodes, the diagonal term being taken care of:
  !> weight(k, j) from node k to node j. Solves weight(k, j) = a(k, j) + sum_i a(i, j) diagonal_i weight(k, i), i > 0;
  !> the diagonal is the change of stress in the step, relative, and small.
  pure subroutine propagators(rule, diagonal, weight)
    type(lobatto_type), intent(in) :: rule
    real(wp), intent(in) :: diagonal(0:most_nodes)
    real(wp), intent(out) :: weight(0:most_nodes, most_nodes)
    real(wp) :: matrix(most_nodes, most_nodes), factor
    integer :: j, k
    ! With as many unknowns as there may be: weights of nodes that a rule has not are zero.
    weight = rule%a
    do j = 1, most_nodes
      matrix(:, j) = -rule%a(1:, j) * diagonal(1:)
      matrix(j, j) = matrix(j, j) + 1.0_wp
    end do
    do k = 1, rule%n
      factor = 1.0_wp / matrix(k, k)
      matrix(:, k) = factor * matrix(:, k)
      weight(:, k) = factor * weight(:, k)
      do j = 1, rule%n
        if (j == k) cycle
        factor = matrix(k, j)
        matrix(:, j) = matrix(:, j) - factor * matrix(:, k)
        weight(:, j) = weight(:, j) - factor * weight(:, k)
      end do
    end do
  end subroutine propagators

  !> Complete the parts of the rates by what the stress has in them.
  !>
  !> The unknowns are linear(k)%on(:, i):y at the nodes. A contraction of the expression for y gives one equation for each.
  !> @param kinds  how many of the dyads of the linear rates there are
  !> @param weight from propagators
  !> @param start  influence at the start of the step
  pure subroutine solve(n, kinds, weight, start, rates, solved)
    integer, intent(in) :: n, kinds
    real(wp), intent(in) :: weight(0:most_nodes, most_nodes), start(6, 6)
    type(rates_type), intent(inout) :: rates
    logical, intent(out) :: solved
    real(wp) :: system(most_columns, most_rows), right(6), part(6, 3), carried, factor
    real(wp) :: directions(8, 6), dots(8) ! That at the nodes, d, its normal and 1
    integer :: i, j, k, row
    logical :: started

    started = any(abs(start) > 0.0_wp)
    do i = 1, merge(kinds, 0, started) ! the start's own
      call add(i, 0, contracted(start, rates%linear(0)%on(:, i)), rates)
    end do
    directions = 0.0_wp
    do i = 1, 6
      directions(:n + 1, i) = rates%that(i, :n)
      directions(6:8, i) = [rates%frame(i, 1), rates%frame(i, 2), unit_tensor(i)]
    end do
    do j = 1, n
      part = 0.0_wp
      carried = 1.0_wp
      factor = 0.0_wp
      do k = 0, n
        part = part + weight(k, j) * rates%part(:, :3, k)
        carried = carried + weight(k, j) * rates%diagonal(k)
        factor = factor + weight(k, j) * rates%factor(k)
      end do
      do i = 1, kinds
        row = (i - 1) * n + j
        associate (on => rates%linear(j)%on(:, i))
          dots = 0.0_wp
          do k = 1, 6
            dots = dots + on(k) * directions(:, k)
          end do
            right = factor * on + dots(6) * part(:, part_d) + dots(7) * part(:, part_normal) + dots(8) * part(:, part_unit)
            if (started) right = right + carried * contracted(start, on)
          do k = 0, n
            right = right + weight(k, j) * dots(k + 1) * rates%part(:, part_that, k)
          end do
          system(:6, row) = right
          system(7:, row) = 0.0_wp
          do k = 1, n
            system(6 + k, row) = -weight(k, j) * dots(k + 1)
            system(6 + n + k, row) = -weight(k, j) * (dots(6) * rates%x(1, k) + dots(7) * rates%x(2, k))
            if (kinds == 3) system(6 + 2 * n + k, row) = -weight(k, j) * dots(8)
          end do
          system(6 + row, row) = system(6 + row, row) + 1.0_wp
        end associate
      end do
    end do
    call eliminate(kinds * n, system, solved)
    do j = 1, n
      do i = 1, kinds
        call add(i, j, system(:6, (i - 1) * n + j), rates)
      end do
    end do
  end subroutine solve

  !> Add the i-th dyad of the linear rate at node k.
  pure subroutine add(i, k, on, rates)
    integer, intent(in) :: i, k
    real(wp), intent(in) :: on(6)
    type(rates_type), intent(inout) :: rates
    select case (i)
    case (1)
      rates%part(:, part_that, k) = rates%part(:, part_that, k) + on
    case (2)
      rates%part(:, part_d, k) = rates%part(:, part_d, k) + rates%x(1, k) * on
      rates%part(:, part_normal, k) = rates%part(:, part_normal, k) + rates%x(2, k) * on
    case default
      rates%part(:, part_unit, k) = rates%part(:, part_unit, k) + on
    end select
  end subroutine add

  !> Influence from that at the start of a step and the rates.
  !> @param weight  of the rates at the nodes
  !> @param carried weight of the influence at the start
  pure function combined(n, weight, carried, start, rates) result(y)
    integer, intent(in) :: n
    real(wp), intent(in) :: weight(0:most_nodes), carried, start(6, 6)
    type(rates_type), intent(in) :: rates
    real(wp) :: y(6, 6)
    real(wp) :: part(6, 3), factor
    integer :: i, k
    factor = dot_product(weight(:n), rates%factor(:n))
    part = 0.0_wp
    do k = 0, n
      part(:, 1) = part(:, 1) + weight(k) * rates%part(:, part_d, k)
      part(:, 2) = part(:, 2) + weight(k) * rates%part(:, part_normal, k)
      part(:, 3) = part(:, 3) + weight(k) * rates%part(:, part_unit, k)
    end do
    do i = 1, 6
      y(:, i) = carried * start(:, i) + rates%frame(i, 1) * part(:, 1) + rates%frame(i, 2) * part(:, 2) + &
                unit_tensor(i) * part(:, 3)
      do k = 0, n
        y(:, i) = y(:, i) + weight(k) * rates%that(i, k) * rates%part(:, part_that, k)
      end do
      y(i, i) = y(i, i) + factor
    end do
  end function combined

  !> dJ/dc at node k.
  !> @param y influence at the node
  pure function rate_at(k, y, rates) result(rate)
    integer, intent(in) :: k
    real(wp), intent(in) :: y(6, 6)
    type(rates_type), intent(in) :: rates
    real(wp) :: rate(6, 6)
    integer :: i
    associate (part => rates%part(:, :, k))
      do i = 1, 6
        rate(:, i) = rates%diagonal(k) * y(:, i) + rates%frame(i, 1) * part(:, part_d) + &
                     rates%frame(i, 2) * part(:, part_normal) + rates%that(i, k) * part(:, part_that) + &
                     unit_tensor(i) * part(:, part_unit)
        rate(i, i) = rate(i, i) + rates%factor(k)
      end do
    end associate
  end function rate_at

  !> Solve a system that is near the identity, for six right sides, by Gauss's elimination without a search for pivots.
  !>
  !> In blocks of six columns, whose loops the compiler unrolls: what they do beyond need costs less than loops of any length.
  !> @param n      unknowns
  !> @param system (column, block, row): the right sides, the first six unknowns, the others; the right sides become the solution
  !> @param solved false when a pivot is small
  pure subroutine eliminate(n, system, solved)
    integer, intent(in) :: n
    real(wp), intent(inout) :: system(6, 3, most_rows)
    logical, intent(out) :: solved
    real(wp) :: factor
    integer :: i, k, column, block
    solved = .false.
    ! From the last unknown to the first, so that whole blocks are done with at the end.
    do k = n, 1, -1
      block = 2 + (k - 1) / 6
      column = k - 6 * (block - 2)
      if (.not. system(column, block, k) > least_pivot) return
      factor = 1.0_wp / system(column, block, k)
      system(:, :block, k) = factor * system(:, :block, k)
      do i = 1, k - 1
        call subtract(system(column, block, i), system(:, 1, k), system(:, 1, i))
        call subtract(system(column, block, i), system(:, 2, k), system(:, 2, i))
        if (block == 3) call subtract(system(column, block, i), system(:, 3, k), system(:, 3, i))
      end do
    end do
    do k = 1, n - 1
      block = 2 + (k - 1) / 6
      column = k - 6 * (block - 2)
      do i = k + 1, n
        call subtract(system(column, block, i), system(:, 1, k), system(:, 1, i))
      end do
    end do
    solved = .true.
  end subroutine eliminate

  !> Subtract a multiple of six numbers.
  pure subroutine subtract(factor, what, from)
    real(wp), value :: factor
    real(wp), intent(in) :: what(6)
    real(wp), intent(inout) :: from(6)
    from = from - factor * what
  end subroutine subtract

  !> Contraction with the stress side of an influence.
  pure function contracted(influence, on) result(on_eta)
    real(wp), intent(in) :: influence(6, 6), on(6)
    real(wp) :: on_eta(6)
    integer :: i
    on_eta = on(1) * influence(:, 1)
    do i = 2, 6
      on_eta = on_eta + on(i) * influence(:, i)
    end do
  end function contracted

end module umat_influence
