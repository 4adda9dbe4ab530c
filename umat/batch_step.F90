!> One Dormand-Prince step of many material points side by side, one point per lane of the vector registers.
!>
!> The formulas are those of update.f90, written without branches: what differs between points is selected, never jumped
!> over, so that the compiler's vectoriser takes every loop over lanes. Arguments of logarithms and divisors are kept
!> positive where a lane leaves the domain; such lanes are marked and done again by the scalar update. Powers are written as
!> exp(y log(x)).
!>
!> Compiled once per instruction set, each time as a module of its own name (HYPOFAB_BATCH_STEP).
module HYPOFAB_BATCH_STEP
  use, intrinsic :: iso_fortran_env, only: int64, real64
  use HYPOFAB_BATCH_PATH, only: node_type, path_end_type, place_nodes
  use HYPOFAB_BATCH_RATE, only: origin_type, origin_of_step, stress_rate
  use umat_batch_lanes
  use umat_material, only: material_type
  use umat_tableau, only: n_stages, a, error_weight, share
  implicit none
  private
  public :: attempt_step

  integer, parameter :: wp = real64
  !> Stands for a speed of zero [strain].
  real(wp), parameter :: slowest = 1.0e-30_wp

contains

  !> One step of every lane that is going: choose its size so that it ends with the segment or as the error control wants,
  !> do it, accept or refuse it.
  !> @param n         number of lanes, a multiple of width
  !> @param tolerance relative error per step, as in options_type
  !> @param lanes     outcome_going lanes are stepped; outcome says what became of them
  pure subroutine attempt_step(m, tolerance, n, lanes, tags)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: tolerance
    integer, intent(in) :: n
    real(wp), intent(inout) :: lanes(n_lanes, n_fields)
    integer(int64), intent(inout) :: tags(n_lanes, n_tags)
    integer :: first
    do first = 0, n - 1, width
      call attempt_block(m, tolerance, first, lanes, tags)
    end do
  end subroutine attempt_step

  !> The same for one block of lanes.
  !> @param b lanes b + 1 to b + width
  pure subroutine attempt_block(m, tolerance, b, lanes, tags)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: tolerance
    integer, intent(in) :: b
    real(wp), intent(inout) :: lanes(n_lanes, n_fields)
    integer(int64), intent(inout) :: tags(n_lanes, n_tags)
    type(node_type) :: nodes(n_stages - 1) !< the last two stages share their node
    type(path_end_type) :: goal
    type(origin_type) :: origin
    real(wp) :: y(width, 7), k(width, 6, n_stages), to_along(width, n_stages - 1), to_across(width, n_stages - 1), &
                to_N(width, n_stages - 1), bad(width), h(width)
    real(wp) :: component, turning, through, m_T, m_R
    integer(int64) :: tag
    integer :: i, j, s, comp

    m_T = m%m_T
    m_R = m%m_R
    bad = 0.0_wp
    if (m%intergranular) then
      call place_nodes(m, b, lanes, tags, nodes, goal, bad)
      do s = 1, n_stages - 1
        !GCC$ ivdep
        do i = 1, width
          tag = tags(b + i, t_kind)
          component = nodes(s)%along(i) * nodes(s)%rho_chi(i) ! (deltahat:D) rho^chi
          turning = nodes(s)%speed(i) * component * merge(m_R - m_T, 1.0_wp - m_T, tag == kind_straight)
          to_along(i, s) = nodes(s)%speed(i) * (m_R + nodes(s)%rho_chi(i) * (m_T - m_R)) + turning * nodes(s)%along(i)
          to_across(i, s) = turning * nodes(s)%across(i)
          to_N(i, s) = nodes(s)%speed(i) * merge(0.0_wp, component, tag == kind_straight)
        end do
      end do
    else
      goal%short = 0.0_wp
      !GCC$ ivdep
      do i = 1, width
        through = lanes(b + i, l_length) - lanes(b + i, l_done)
        goal%last(i) = merge(1.0_wp, 0.0_wp, lanes(b + i, l_h) >= through)
        lanes(b + i, l_h) = min(lanes(b + i, l_h), through)
      end do
      do s = 1, n_stages - 1
        nodes(s)%speed = 1.0_wp
        to_along(:, s) = 1.0_wp
        to_across(:, s) = 0.0_wp
        to_N(:, s) = 1.0_wp
      end do
    end if

    call origin_of_step(m, b, lanes, origin)
    h = lanes(b + 1:b + width, l_h)
    do s = 1, n_stages
      call stage_state(b, s, lanes, nodes, k, y)
      j = min(s, n_stages - 1)
      call stress_rate(m, b, lanes, origin, y, to_along(:, j), to_across(:, j), to_N(:, j), k(:, :, s), bad)
    end do
    if (m%intergranular) then
      do comp = 1, 6
        !GCC$ ivdep
        do i = 1, width
          y(i, comp) = y(i, comp) + goal%short(i) / max(nodes(6)%speed(i), slowest) * k(i, comp, 7)
        end do
      end do
    end if
    call decide(m, tolerance, b, lanes, tags, k, nodes, y, goal, bad)
    if (m%intergranular) call move_delta(m, b, lanes, tags, nodes(6), goal)
    if (any(tags(b + 1:b + width, t_outcome) == outcome_segment_done)) then
      !GCC$ ivdep
      do i = 1, width
lanes(b + i, l_e) = merge((1.0_wp + lanes(b + i, l_e)) * exp(lanes(b + i, l_trace) * lanes(b + i, l_length)) - 1.0_wp, &
                                  lanes(b + i, l_e), tags(b + i, t_outcome) == outcome_segment_done)
      end do
    end if
  end subroutine attempt_block

  !> Stress at a stage, and the length of strain done. Zeros of the tableau are left out by hand.
  !> @param s stage
  !> @param y stress, length
  pure subroutine stage_state(b, s, lanes, nodes, k, y)
    integer, intent(in) :: b, s
    real(wp), intent(in) :: lanes(n_lanes, n_fields), k(width, 6, n_stages)
    type(node_type), intent(in) :: nodes(n_stages - 1)
    real(wp), intent(out) :: y(width, 7)
    real(wp) :: total(width)
    integer :: comp
    do comp = 1, 6
      select case (s)
      case (1)
        total = 0.0_wp
      case (2)
        total = a(1, 2) * k(:, comp, 1)
      case (3)
        total = a(1, 3) * k(:, comp, 1) + a(2, 3) * k(:, comp, 2)
      case (4)
        total = a(1, 4) * k(:, comp, 1) + a(2, 4) * k(:, comp, 2) + a(3, 4) * k(:, comp, 3)
      case (5)
        total = a(1, 5) * k(:, comp, 1) + a(2, 5) * k(:, comp, 2) + a(3, 5) * k(:, comp, 3) + a(4, 5) * k(:, comp, 4)
      case (6)
       total = a(1, 6) * k(:, comp, 1) + a(2, 6) * k(:, comp, 2) + a(3, 6) * k(:, comp, 3) + a(4, 6) * k(:, comp, 4) + &
                a(5, 6) * k(:, comp, 5)
      case default
       total = a(1, 7) * k(:, comp, 1) + a(3, 7) * k(:, comp, 3) + a(4, 7) * k(:, comp, 4) + a(5, 7) * k(:, comp, 5) + &
                a(6, 7) * k(:, comp, 6)
      end select
      y(:, comp) = lanes(b + 1:b + width, l_stress - 1 + comp) + lanes(b + 1:b + width, l_h) * total
    end do
    call length_done(a(:, s), 0.0_wp, nodes, total)
    y(:, 7) = lanes(b + 1:b + width, l_done) + lanes(b + 1:b + width, l_h) * total
  end subroutine stage_state

  !> The weighted sum of the speeds at the nodes.
  !> @param weights of the first six stages
  !> @param seventh of the last, whose node is the sixth's
  pure subroutine length_done(weights, seventh, nodes, total)
    real(wp), intent(in) :: weights(6), seventh
    type(node_type), intent(in) :: nodes(n_stages - 1)
    real(wp), intent(out) :: total(width)
    total = weights(1) * nodes(1)%speed + weights(2) * nodes(2)%speed + weights(3) * nodes(3)%speed + &
            weights(4) * nodes(4)%speed + weights(5) * nodes(5)%speed + (weights(6) + seventh) * nodes(6)%speed
  end subroutine length_done

  !> Accept or refuse the step, and choose the next one's size.
  !> @param y stress and length at the step's end
  pure subroutine decide(m, tolerance, b, lanes, tags, k, nodes, y, goal, bad)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: tolerance
    integer, intent(in) :: b
    real(wp), intent(inout) :: lanes(n_lanes, n_fields)
    integer(int64), intent(inout) :: tags(n_lanes, n_tags)
    real(wp), intent(in) :: k(width, 6, n_stages), y(width, 7), bad(width)
    type(node_type), intent(in) :: nodes(n_stages - 1)
    type(path_end_type), intent(in) :: goal
    real(wp) :: off(width, 6), off_length(width), error(width), h, squares, before, after, relative, going, accepted, lost, &
                per_tolerance, per_R
    integer(int64) :: outcome
    integer :: i, comp

    do comp = 1, 6
  off(:, comp) = error_weight(1) * k(:, comp, 1) + error_weight(3) * k(:, comp, 3) + error_weight(4) * k(:, comp, 4) + &
                     error_weight(5) * k(:, comp, 5) + error_weight(6) * k(:, comp, 6) + error_weight(7) * k(:, comp, 7)
    end do
    call length_done(error_weight(:6), error_weight(7), nodes, off_length)
    per_tolerance = 1.0_wp / (share * tolerance)
    per_R = merge(1.0_wp / m%R, 0.0_wp, m%intergranular)
    !GCC$ ivdep
    do i = 1, width
      h = lanes(b + i, l_h)
      squares = off(i, 1)**2 + off(i, 2)**2 + off(i, 3)**2 + 2.0_wp * (off(i, 4)**2 + off(i, 5)**2 + off(i, 6)**2)
      before = lanes(b + i, l_stress)**2 + lanes(b + i, l_stress + 1)**2 + lanes(b + i, l_stress + 2)**2 + &
               2.0_wp * (lanes(b + i, l_stress + 3)**2 + lanes(b + i, l_stress + 4)**2 + lanes(b + i, l_stress + 5)**2)
      after = y(i, 1)**2 + y(i, 2)**2 + y(i, 3)**2 + 2.0_wp * (y(i, 4)**2 + y(i, 5)**2 + y(i, 6)**2)
      relative = h * per_tolerance * max(sqrt(squares / max(max(before, after), nothing)), abs(off_length(i)) * per_R)
      error(i) = relative
      going = merge(1.0_wp, 0.0_wp, tags(b + i, t_outcome) == outcome_going)
      accepted = merge(going, 0.0_wp, relative <= 1.0_wp)
      lost = bad(i) + merge(accepted, 0.0_wp, after < lanes(b + i, l_smallest)**2) + merge(0.0_wp, 1.0_wp, relative < 1.0e30_wp)
      outcome = merge(outcome_segment_done, tags(b + i, t_outcome), accepted * goal%last(i) > half)
      tags(b + i, t_outcome) = merge(outcome_special, outcome, going * lost > half)
      lanes(b + i, l_evaluations) = lanes(b + i, l_evaluations) + going * (n_stages - 1)
      lanes(b + i, l_refused) = lanes(b + i, l_refused) + going - accepted
      lanes(b + i, l_x) = lanes(b + i, l_x) + accepted * h
      lanes(b + i, l_done) = chosen(accepted, y(i, 7), lanes(b + i, l_done))
      lanes(b + i, l_stress) = chosen(accepted, y(i, 1), lanes(b + i, l_stress))
      lanes(b + i, l_stress + 1) = chosen(accepted, y(i, 2), lanes(b + i, l_stress + 1))
      lanes(b + i, l_stress + 2) = chosen(accepted, y(i, 3), lanes(b + i, l_stress + 2))
      lanes(b + i, l_stress + 3) = chosen(accepted, y(i, 4), lanes(b + i, l_stress + 3))
      lanes(b + i, l_stress + 4) = chosen(accepted, y(i, 5), lanes(b + i, l_stress + 4))
      lanes(b + i, l_stress + 5) = chosen(accepted, y(i, 6), lanes(b + i, l_stress + 5))
    end do
    if (.not. any(tags(b + 1:b + width, t_outcome) == outcome_going)) return
    ! Where it goes on: the path at the next step's start, and its size.
    !GCC$ ivdep
    do i = 1, width
      accepted = merge(merge(1.0_wp, 0.0_wp, error(i) <= 1.0_wp), 0.0_wp, tags(b + i, t_outcome) == outcome_going)
      relative = max(0.2_wp, min(5.0_wp, 0.9_wp * exp(-0.2_wp * log(max(error(i), 1.0e-8_wp)))))
      lanes(b + i, l_h) = lanes(b + i, l_h) * merge(relative, 1.0_wp, tags(b + i, t_outcome) == outcome_going)
      if (.not. m%intergranular) cycle
      lanes(b + i, l_speed) = chosen(accepted, nodes(6)%speed(i), lanes(b + i, l_speed))
      lanes(b + i, l_node_along) = chosen(accepted, nodes(6)%along(i), lanes(b + i, l_node_along))
      lanes(b + i, l_node_across) = chosen(accepted, nodes(6)%across(i), lanes(b + i, l_node_across))
      lanes(b + i, l_rho_chi) = chosen(accepted, nodes(6)%rho_chi(i), lanes(b + i, l_rho_chi))
      lanes(b + i, l_rho) = chosen(accepted, goal%rho(i), lanes(b + i, l_rho))
      lanes(b + i, l_rho_beta) = chosen(accepted, goal%rho_beta(i), lanes(b + i, l_rho_beta))
    end do
  end subroutine decide

  !> delta where the segment ends; Eq. (14) for what the step lacks of the length.
  pure subroutine move_delta(m, b, lanes, tags, node, goal)
    type(material_type), intent(in) :: m
    integer, intent(in) :: b
    real(wp), intent(inout) :: lanes(n_lanes, n_fields)
    integer(int64), intent(in) :: tags(n_lanes, n_tags)
    type(node_type), intent(in) :: node
    type(path_end_type), intent(in) :: goal
    real(wp) :: along(width), across(width), size, R
    integer :: i, comp
    R = m%R
    !GCC$ ivdep
    do i = 1, width
      size = R * goal%rho(i) - goal%rho_beta(i) * node%along(i) * goal%short(i)
      along(i) = size * node%along(i) + goal%short(i)
      across(i) = size * node%across(i)
    end do
    do comp = 0, 5
      !GCC$ ivdep
      do i = 1, width
        lanes(b + i, l_delta + comp) = merge(along(i) * lanes(b + i, l_along + comp) + across(i) * lanes(b + i, l_across + comp), &
                                           lanes(b + i, l_delta + comp), tags(b + i, t_outcome) == outcome_segment_done)
      end do
    end do
  end subroutine move_delta

  include 'batch_series.inc'

end module HYPOFAB_BATCH_STEP
