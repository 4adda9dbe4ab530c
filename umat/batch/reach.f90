!> How far a step of many points side by side goes, and what is known at its nodes without the stress: reach in step.f90,
!> place_nodes in collocation.f90.
!>
!> Compiled once per instruction set, each time as a module of its own name (kernel.cmake).
module umat_batch_reach_portable
  use, intrinsic :: iso_fortran_env, only: int64, real64
  use umat_batch_path_portable, only: node_type, path_node
  use umat_lanes
  use umat_many_lanes, only: n_lanes, width
  use umat_integration, only: nearly
  use umat_lobatto, only: lobatto_type, rules, rule_long, most_nodes
  use umat_material, only: material_type
  use umat_step, only: least_share, close_enough, most_trials, most_iterations, slowest, inner_square
  implicit none
  private
  public :: nodes_type, reach

  integer, parameter :: wp = real64
  type(lobatto_type), parameter :: rule = rules(rule_long)
  integer, parameter :: last_node = rule%n
  !> Stands for no length in a divisor [strain].
  real(wp), parameter :: vanishing_length = 1.0e-40_wp

  !> As nodes_type of collocation.f90, and where the step ends.
  type :: nodes_type
    real(wp) :: strain(width, 0:most_nodes) !< d lambda over d c, c running from 0 to 1 through the step
    real(wp) :: length(width, 0:most_nodes) !< lambda since the start of the step
    real(wp) :: x(width, 6, 0:most_nodes), weight(width, 0:most_nodes) !< operands of the rate, times strain
    type(node_type) :: point(0:most_nodes)
    real(wp) :: last(width) !< 1 where the leg ends with the step, otherwise 0
    real(wp) :: end(width) !< where in the step the leg ends
  end type nodes_type

contains

  !> Place the nodes of a step that ends where the leg ends if it reaches so far.
  !> @param b     lanes b + 1 to b + width
  !> @param lanes in: step wanted; out: step
  !> @param bad   set to 1 where no step is found
  pure subroutine reach(m, tolerance, b, lanes, tags, nodes, bad)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: tolerance
    integer, intent(in) :: b
    real(wp), intent(inout) :: lanes(n_lanes, n_fields), bad(width)
    integer(int64), intent(in) :: tags(n_lanes, n_tags)
    type(nodes_type), intent(inout) :: nodes
    real(wp) :: open_(width), place(width), ahead, covered, close_by, ends
    integer :: i, trial

    close_by = close_enough * sqrt(least_share * tolerance)
    !GCC$ ivdep
    do i = 1, width
      ahead = lanes(b + i, l_length) - lanes(b + i, l_done)
      nodes%end(i) = 1.0_wp
      open_(i) = merge(0.0_wp, 1.0_wp, tags(b + i, t_kind) <= kind_straight)
      nodes%last(i) = merge(1.0_wp, 0.0_wp, chosen(open_(i), lanes(b + i, l_wanted) - nearly * ahead, &
                                                   lanes(b + i, l_h) - ahead) >= 0.0_wp)
      lanes(b + i, l_h) = chosen(open_(i), lanes(b + i, l_h), min(lanes(b + i, l_h), ahead))
    end do
    call start_node(b, lanes, nodes)
    do trial = 1, most_trials
      call place_nodes(m, b, lanes, tags, nodes)
      if (.not. any(open_ > half)) exit
      !GCC$ ivdep
      do i = 1, width
        ahead = lanes(b + i, l_length) - lanes(b + i, l_done)
        covered = nodes%length(i, last_node)
        nodes%last(i) = max(nodes%last(i), open_(i) * merge(1.0_wp, 0.0_wp, covered > ahead))
        ends = open_(i) * nodes%last(i) * merge(1.0_wp, 0.0_wp, abs(ahead - covered) <= close_by * ahead)
        nodes%end(i) = chosen(ends, 1.0_wp + (ahead - covered) / max(nodes%strain(i, last_node), vanishing_length), nodes%end(i))
        open_(i) = open_(i) * nodes%last(i) - ends
      end do
      if (.not. any(open_ > half)) exit
      call place_of(b, lanes, nodes, place)
      lanes(b + 1:b + width, l_h) = chosen(open_, lanes(b + 1:b + width, l_h) * place, lanes(b + 1:b + width, l_h))
    end do
    !GCC$ ivdep
    do i = 1, width
      bad(i) = max(bad(i), open_(i), merge(1.0_wp, 0.0_wp, tags(b + i, t_kind) > kind_straight .and. &
                                           lanes(b + i, l_x) + lanes(b + i, l_h) > largest_x))
    end do
    call operands(m, b, lanes, tags, nodes)
  end subroutine reach

  !> Node 0: the start.
  pure subroutine start_node(b, lanes, nodes)
    integer, intent(in) :: b
    real(wp), intent(in) :: lanes(n_lanes, n_fields)
    type(nodes_type), intent(inout) :: nodes
    nodes%point(0)%speed = lanes(b + 1:b + width, l_speed)
    nodes%point(0)%along = lanes(b + 1:b + width, l_node_along)
    nodes%point(0)%across = lanes(b + 1:b + width, l_node_across)
    nodes%point(0)%rho_chi = lanes(b + 1:b + width, l_rho_chi)
    nodes%length(:, 0) = 0.0_wp
  end subroutine start_node

  !> The path at the nodes of the step, and the lengths of strain up to them.
  pure subroutine place_nodes(m, b, lanes, tags, nodes)
    type(material_type), intent(in) :: m
    integer, intent(in) :: b
    real(wp), intent(in) :: lanes(n_lanes, n_fields)
    integer(int64), intent(in) :: tags(n_lanes, n_tags)
    type(nodes_type), intent(inout) :: nodes
    real(wp) :: place(width)
    integer :: k, j
    nodes%strain(:, 0) = lanes(b + 1:b + width, l_h) * nodes%point(0)%speed
    do k = 1, last_node
      place = rule%c(k)
      if (m%intergranular) then
        call path_node(m, b, lanes, tags, place, nodes%point(k))
      else
        nodes%point(k)%speed = 1.0_wp
      end if
      nodes%strain(:, k) = lanes(b + 1:b + width, l_h) * nodes%point(k)%speed
    end do
    do k = 1, last_node
      nodes%length(:, k) = rule%a(0, k) * nodes%strain(:, 0)
      do j = 1, last_node
        nodes%length(:, k) = nodes%length(:, k) + rule%a(j, k) * nodes%strain(:, j)
      end do
    end do
  end subroutine place_nodes

  !> Where in the step the leg ends; place_of in step.f90.
  pure subroutine place_of(b, lanes, nodes, place)
    integer, intent(in) :: b
    real(wp), intent(in) :: lanes(n_lanes, n_fields)
    type(nodes_type), intent(in) :: nodes
    real(wp), intent(out) :: place(width)
    real(wp) :: ahead, middle, even1, even2, odd1, odd2, before, covered, speed, t
    integer :: i, round
    !GCC$ ivdep
    do i = 1, width
      ahead = lanes(b + i, l_length) - lanes(b + i, l_done)
      middle = nodes%strain(i, 2)
      even1 = 0.5_wp * (nodes%strain(i, 4) + nodes%strain(i, 0)) - middle
      odd1 = 0.5_wp * (nodes%strain(i, 4) - nodes%strain(i, 0))
      even2 = (inner_square * even1 - 0.5_wp * (nodes%strain(i, 3) + nodes%strain(i, 1)) + middle) * &
              (1.0_wp / (inner_square * (1.0_wp - inner_square)))
      odd2 = (odd1 - (nodes%strain(i, 3) - nodes%strain(i, 1)) * (0.5_wp / sqrt(inner_square))) * (1.0_wp / (1.0_wp - inner_square))
      even1 = even1 - even2
      odd1 = odd1 - odd2
      before = middle - odd1 * (1.0_wp / 2) + even1 * (1.0_wp / 3) - odd2 * (1.0_wp / 4) + even2 * (1.0_wp / 5)
      t = 1.0_wp
      !GCC$ unroll 8
      do round = 1, most_iterations
        speed = middle + t * (odd1 + t * (even1 + t * (odd2 + t * even2)))
        covered = before + t * (middle + t * (odd1 * (1.0_wp / 2) + &
                                     t * (even1 * (1.0_wp / 3) + t * (odd2 * (1.0_wp / 4) + t * even2 * (1.0_wp / 5)))))
        t = t + (2.0_wp * ahead - covered) / max(speed, slowest * nodes%strain(i, 4), vanishing_length)
        t = max(-0.8_wp, min(3.0_wp, t))
      end do
      place(i) = 0.5_wp * (1.0_wp + t)
    end do
  end subroutine place_of

  !> X and weight of theory.md Eq. (13) at the nodes, times strain per unit of the step; operands in intergranular.f90.
  pure subroutine operands(m, b, lanes, tags, nodes)
    type(material_type), intent(in) :: m
    integer, intent(in) :: b
    real(wp), intent(in) :: lanes(n_lanes, n_fields)
    integer(int64), intent(in) :: tags(n_lanes, n_tags)
    type(nodes_type), intent(inout) :: nodes
    real(wp) :: mobilised, turning, along, across, m_T, m_R, straight
    integer :: i, k, comp
    m_T = m%m_T
    m_R = m%m_R
    if (.not. m%intergranular) then
      do k = 0, last_node
        nodes%weight(:, k) = nodes%strain(:, k)
        do comp = 1, 6
          nodes%x(:, comp, k) = nodes%strain(:, k) * lanes(b + 1:b + width, l_along - 1 + comp)
        end do
      end do
      return
    end if
    do k = 0, last_node
      !GCC$ ivdep
      do i = 1, width
        straight = merge(1.0_wp, 0.0_wp, tags(b + i, t_kind) == kind_straight)
        mobilised = nodes%point(k)%rho_chi(i) * nodes%point(k)%along(i) * nodes%strain(i, k)
        turning = mobilised * chosen(straight, m_R - m_T, 1.0_wp - m_T)
        nodes%weight(i, k) = chosen(straight, 0.0_wp, mobilised)
        along = nodes%strain(i, k) * (m_R + nodes%point(k)%rho_chi(i) * (m_T - m_R)) + turning * nodes%point(k)%along(i)
        across = turning * nodes%point(k)%across(i)
        nodes%x(i, 1, k) = along * lanes(b + i, l_along) + across * lanes(b + i, l_across)
        nodes%x(i, 2, k) = along * lanes(b + i, l_along + 1) + across * lanes(b + i, l_across + 1)
        nodes%x(i, 3, k) = along * lanes(b + i, l_along + 2) + across * lanes(b + i, l_across + 2)
        nodes%x(i, 4, k) = along * lanes(b + i, l_along + 3) + across * lanes(b + i, l_across + 3)
        nodes%x(i, 5, k) = along * lanes(b + i, l_along + 4) + across * lanes(b + i, l_across + 4)
        nodes%x(i, 6, k) = along * lanes(b + i, l_along + 5) + across * lanes(b + i, l_across + 5)
      end do
    end do
  end subroutine operands

  include 'series.inc'

end module umat_batch_reach_portable
