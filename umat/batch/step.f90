!> One step of many material points side by side, one point per lane of the vector registers: step.f90 and collocation.f90.
!>
!> The formulas are written without branches: what differs between points is selected, never jumped over, so that the
!> compiler's vectoriser takes every loop over lanes. Arguments of logarithms and divisors are kept positive where a lane
!> leaves the domain; such lanes are marked and done again by the scalar update.
!>
!> Compiled once per instruction set, each time as a module of its own name (kernel.cmake).
module umat_batch_step_portable
  use, intrinsic :: iso_fortran_env, only: int64, real64
  use umat_batch_errors_portable, only: missing_of, growth_after, size_of
  use umat_lanes_linear_portable, only: slopes_type, slopes_at, add_linear
  use umat_batch_path_portable, only: node_type, carry_node
  use umat_lanes_rate_portable, only: origin_type, origin_of_step, tensors_type, tensors_at, apply
  use umat_batch_reach_portable, only: nodes_type, reach
  use umat_lanes
  use umat_many_lanes, only: n_lanes, width
  use umat_border, only: part_of_pressure, reach_of_border
  use umat_lobatto, only: lobatto_type, rules, most_nodes, rule_long
  use umat_material, only: material_type
  use umat_step, only: least_share, most_share, most_sweeps, rounding, worth_trying, too_many_sweeps
  implicit none
  private
  public :: attempt_step

  integer, parameter :: wp = real64
  type(lobatto_type), parameter :: rule = rules(rule_long)
  integer, parameter :: last_node = rule%n

  !> A step in work: rates at the nodes per unit of the step and the change of stress there.
  type :: work_type
    real(wp) :: frozen(width, 6, 0:most_nodes), f(width, 6, 0:most_nodes), u(width, 6, 0:most_nodes)
    real(wp) :: d_void_ratio(width, 0:most_nodes)
    real(wp) :: scale(width) !< |stress| at the start
    real(wp) :: tolerance(width) !< what the step may use of it
    real(wp) :: going(width) !< 1 while the step may still be accepted, otherwise 0
    real(wp) :: growth(width) !< change of the step that its errors ask for
    real(wp) :: left(width) !< what further sweeps would still change [stress]
  end type work_type

contains

  !> One step of every lane that is going: choose its size so that it ends with the segment or as the error control wants,
  !> do it, accept or refuse it.
  !> @param n         lanes 1 to n, a multiple of width
  !> @param tolerance relative error, as in options_type
  !> @param lanes     outcome_going lanes are stepped; outcome says what became of them
  pure subroutine attempt_step(m, tolerance, n, lanes, tags)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: tolerance
    integer, intent(in) :: n
    real(wp), intent(inout) :: lanes(n_lanes, n_fields)
    integer(int64), intent(inout) :: tags(n_lanes, n_tags)
    integer :: b
    do b = 0, n - 1, width
      call attempt_block(m, tolerance, b, lanes, tags)
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
    type(nodes_type) :: nodes
    type(origin_type) :: origin
    type(slopes_type) :: slopes
    type(work_type) :: w
    real(wp) :: bad(width)
    integer :: i

    bad = 0.0_wp
    call reach(m, tolerance, b, lanes, tags, nodes, bad)
    call origin_of_step(m, b, lanes, origin, bad)
    call slopes_at(m, origin, slopes)
    !GCC$ ivdep
    do i = 1, width
      w%going(i) = merge(1.0_wp, 0.0_wp, tags(b + i, t_outcome) == outcome_going)
      w%scale(i) = sqrt(max(nothing, (part_of_pressure / origin%inverse_pressure(i))**2, &
                           lanes(b + i, l_stress)**2 + lanes(b + i, l_stress + 1)**2 + lanes(b + i, l_stress + 2)**2 + &
                            2.0_wp * (lanes(b + i, l_stress + 3)**2 + lanes(b + i, l_stress + 4)**2 + &
                                      lanes(b + i, l_stress + 5)**2)))
      w%tolerance(i) = tolerance * (least_share + (most_share - least_share) * &
                                    min(1.0_wp, nodes%length(i, last_node) / max(lanes(b + i, l_length), nothing)))
    end do
    call predict(m, b, lanes, origin, slopes, nodes, w)
    call look(m, nodes, w)
    if (any(w%going > half)) then
      call sweeps(m, b, lanes, origin, slopes, nodes, w, bad)
      call decide(m, b, lanes, tags, nodes, w, bad)
    else
      call refuse(b, nodes, w, bad, lanes, tags)
    end if
  end subroutine attempt_block

  !> Predict the change of stress at the nodes, with the rate linear in stress and void ratio about the start of the step.
  pure subroutine predict(m, b, lanes, origin, slopes, nodes, w)
    type(material_type), intent(in) :: m
    integer, intent(in) :: b
    real(wp), intent(in) :: lanes(n_lanes, n_fields)
    type(origin_type), intent(in) :: origin
    type(slopes_type), intent(in) :: slopes
    type(nodes_type), intent(in) :: nodes
    type(work_type), intent(inout) :: w
    real(wp) :: swell
    integer :: i, k
    do k = 0, last_node
      call apply(m, origin%h, nodes%x(:, :, k), nodes%weight(:, k), w%frozen(:, :, k))
      w%f(:, :, k) = w%frozen(:, :, k)
      !GCC$ ivdep
      do i = 1, width
        ! exp(swell) - 1 to the accuracy that a prediction deserves.
        swell = lanes(b + i, l_trace) * nodes%length(i, k)
        w%d_void_ratio(i, k) = origin%volume(i) * swell * (1.0_wp + swell * (1.0_wp / 2 + swell * (1.0_wp / 6 + swell * ( &
                                                                            1.0_wp / 24 + swell * (1.0_wp / 120)))))
      end do
    end do
    call integrate_to_nodes(w)
    do k = 1, last_node
      call add_linear(m, origin, slopes, nodes%x(:, :, k), nodes%weight(:, k), w%frozen(:, :, k), w%u(:, :, k), &
                      w%d_void_ratio(:, k), w%f(:, :, k))
    end do
    call integrate_to_nodes(w)
  end subroutine predict

  !> Integrals from the start of the step to its nodes.
  pure subroutine integrate_to_nodes(w)
    type(work_type), intent(inout) :: w
    integer :: j, comp
    w%u(:, :, 0) = 0.0_wp
    do j = 1, last_node
      do comp = 1, 6
        w%u(:, comp, j) = rule%a(0, j) * w%f(:, comp, 0) + rule%a(1, j) * w%f(:, comp, 1) + rule%a(2, j) * w%f(:, comp, 2) + &
                          rule%a(3, j) * w%f(:, comp, 3) + rule%a(4, j) * w%f(:, comp, 4)
      end do
    end do
  end subroutine integrate_to_nodes

  !> A first look at the prediction, which costs no evaluation of the rate: lanes that are not worth a sweep are stopped.
  pure subroutine look(m, nodes, w)
    type(material_type), intent(in) :: m
    type(nodes_type), intent(in) :: nodes
    type(work_type), intent(inout) :: w
    real(wp) :: theta(width), missing(width)
    integer :: i, n
    n = last_node
    theta = size_of(w%u(:, :, n)) / w%scale
    missing = missing_of(m, nodes, w%f, theta, w%scale)
    call growth_after(w%tolerance, missing, theta, w%going, w%growth)
    !GCC$ ivdep
    do i = 1, width
      w%going(i) = w%going(i) * merge(1.0_wp, 0.0_wp, w%growth(i) >= worth_trying .and. missing(i) <= w%tolerance(i))
    end do
  end subroutine look

  !> Sweeps until the corrections are small enough. Lanes that are settled stay as they are, so that no lane depends on its
  !> neighbours.
  pure subroutine sweeps(m, b, lanes, origin, slopes, nodes, w, bad)
    type(material_type), intent(in) :: m
    integer, intent(in) :: b
    real(wp), intent(inout) :: lanes(n_lanes, n_fields)
    type(origin_type), intent(in) :: origin
    type(slopes_type), intent(in) :: slopes
    type(nodes_type), intent(in) :: nodes
    type(work_type), intent(inout) :: w
    real(wp), intent(inout) :: bad(width)
    type(work_type) :: next
    type(tensors_type) :: h
    real(wp) :: active(width), previous(width), correction(width, 6, most_nodes), unchanged(width), change(width), final(width), &
                outside(width), ratio, fails, settled
    integer :: i, k, n, comp, round

    n = last_node
    active = w%going
    previous = huge(previous)
    unchanged = 0.0_wp
    w%left = 0.0_wp
    next%f(:, :, 0) = w%f(:, :, 0)
    do round = 1, most_sweeps
      outside = 0.0_wp
      do k = 1, n
        call tensors_at(m, b, lanes, origin, w%u(:, :, k), nodes%length(:, k), h, outside)
        call apply(m, h, nodes%x(:, :, k), nodes%weight(:, k), next%f(:, :, k))
      end do
      call integrate_to_nodes(next)
      do k = 1, n
        correction(:, :, k) = next%u(:, :, k) - w%u(:, :, k)
        call add_linear(m, origin, slopes, nodes%x(:, :, k), nodes%weight(:, k), w%frozen(:, :, k), correction(:, :, k), &
                        unchanged, next%f(:, :, k))
      end do
      call integrate_to_nodes(next)
      correction(:, :, n) = next%u(:, :, n) - w%u(:, :, n)
      change = size_of(correction(:, :, n))
      final = size_of(next%u(:, :, n))
      do k = 1, n
        do comp = 1, 6
          w%f(:, comp, k) = chosen(active, next%f(:, comp, k), w%f(:, comp, k))
          w%u(:, comp, k) = chosen(active, next%u(:, comp, k), w%u(:, comp, k))
        end do
      end do
      !GCC$ ivdep
      do i = 1, width
        bad(i) = max(bad(i), active(i) * outside(i))
        lanes(b + i, l_evaluations) = lanes(b + i, l_evaluations) + active(i) * n
        ratio = max(2.0_wp * change(i) / max(final(i), nothing), change(i) / previous(i))
        w%left(i) = chosen(active(i), change(i) * min(1.0_wp, ratio), w%left(i))
        fails = active(i) * merge(1.0_wp, 0.0_wp, min(ratio - 0.5_wp, w%left(i) - rounding * w%scale(i)) > 0.0_wp)
        settled = active(i) * (1.0_wp - fails) * merge(1.0_wp, 0.0_wp, w%left(i) <= 0.5_wp * w%tolerance(i) * w%scale(i))
        active(i) = active(i) - fails - settled
        w%going(i) = w%going(i) - fails
        w%growth(i) = chosen(fails, too_many_sweeps, w%growth(i))
        previous(i) = max(change(i), nothing)
      end do
      if (.not. any(active > half)) exit
    end do
    w%going = w%going - active
    w%growth = chosen(active, too_many_sweeps, w%growth)
  end subroutine sweeps

  !> Accept or refuse the step, and choose the next one's size.
  pure subroutine decide(m, b, lanes, tags, nodes, w, bad)
    type(material_type), intent(in) :: m
    integer, intent(in) :: b
    real(wp), intent(inout) :: lanes(n_lanes, n_fields)
    integer(int64), intent(inout) :: tags(n_lanes, n_tags)
    type(nodes_type), intent(in) :: nodes
    type(work_type), intent(inout) :: w
    real(wp), intent(inout) :: bad(width)
    real(wp) :: stress(width, 6), theta(width), missing(width), growth(width), scale(width), accepted(width), done(width), after, &
                fine, keeps, p_t, smallest, least
    integer :: i, n, comp

    n = last_node
    p_t = m%p_t
    smallest = m%soft_pressure
    least = reach_of_border * m%confinement / 3.0_wp ! as in is_negative_definite
    theta = size_of(w%u(:, :, n)) / w%scale
    do comp = 1, 6
      stress(:, comp) = lanes(b + 1:b + width, l_stress - 1 + comp) + w%u(:, comp, n)
    end do
    scale = max(w%scale, size_of(stress))
    missing = missing_of(m, nodes, w%f, theta, scale)
    call growth_after(w%tolerance, missing, theta, w%going, growth)
    do comp = 1, 6
      stress(:, comp) = stress(:, comp) + (nodes%end - 1.0_wp) * w%f(:, comp, n)
    end do
    !GCC$ ivdep
    do i = 1, width
      fine = w%going(i) * merge(1.0_wp, 0.0_wp, missing(i) + w%left(i) / scale(i) <= w%tolerance(i))
      after = stress(i, 1)**2 + stress(i, 2)**2 + stress(i, 3)**2 + &
              2.0_wp * (stress(i, 4)**2 + stress(i, 5)**2 + stress(i, 6)**2)
      done(i) = fine * nodes%last(i)
      ! What falls so far, and what is at the border, is for the scalar update.
      keeps = merge(1.0_wp, 0.0_wp, after >= lanes(b + i, l_smallest)**2)
      bad(i) = max(bad(i), fine * (1.0_wp - keeps), fine * outside_domain(stress(i, 1) - p_t, stress(i, 2) - p_t, &
                                                                       stress(i, 3) - p_t, stress(i, 4), stress(i, 5), &
                                                                          stress(i, 6), smallest, least))
      growth(i) = chosen(fine, growth(i), min(growth(i), 0.9_wp))
      w%growth(i) = chosen(w%going(i), growth(i), w%growth(i))
      accepted(i) = fine * merge(0.0_wp, 1.0_wp, bad(i) > half)
      lanes(b + i, l_stress) = chosen(accepted(i), stress(i, 1), lanes(b + i, l_stress))
      lanes(b + i, l_stress + 1) = chosen(accepted(i), stress(i, 2), lanes(b + i, l_stress + 1))
      lanes(b + i, l_stress + 2) = chosen(accepted(i), stress(i, 3), lanes(b + i, l_stress + 2))
      lanes(b + i, l_stress + 3) = chosen(accepted(i), stress(i, 4), lanes(b + i, l_stress + 3))
      lanes(b + i, l_stress + 4) = chosen(accepted(i), stress(i, 5), lanes(b + i, l_stress + 4))
      lanes(b + i, l_stress + 5) = chosen(accepted(i), stress(i, 6), lanes(b + i, l_stress + 5))
    end do
    if (any(done > half)) then
      if (m%intergranular) then
        call move_delta(m, b, done, (nodes%end - 1.0_wp) * nodes%strain(:, n), nodes%point(n), lanes)
      end if
      !GCC$ ivdep
      do i = 1, width
        after = (1.0_wp + lanes(b + i, l_e)) * exp(lanes(b + i, l_trace) * lanes(b + i, l_length)) - 1.0_wp
        lanes(b + i, l_e) = chosen(done(i), after, lanes(b + i, l_e))
        tags(b + i, t_outcome) = merge(outcome_segment_done, tags(b + i, t_outcome), done(i) > half)
      end do
    end if
    w%going = accepted - done
    if (any(w%going > half)) then
      !GCC$ ivdep
      do i = 1, width
        lanes(b + i, l_evaluations) = lanes(b + i, l_evaluations) + w%going(i)
        lanes(b + i, l_x) = lanes(b + i, l_x) + w%going(i) * lanes(b + i, l_h)
        lanes(b + i, l_done) = lanes(b + i, l_done) + w%going(i) * nodes%length(i, n)
      end do
      if (m%intergranular) call carry_node(b, nodes%point(n), w%going, lanes)
    end if
    call refuse(b, nodes, w, bad, lanes, tags)
  end subroutine decide

  !> The next step of lanes that are not done; lanes that the scalar update must do.
  !> @param w going is 1 where a step was accepted
  pure subroutine refuse(b, nodes, w, bad, lanes, tags)
    integer, intent(in) :: b
    type(nodes_type), intent(in) :: nodes
    type(work_type), intent(in) :: w
    real(wp), intent(in) :: bad(width)
    real(wp), intent(inout) :: lanes(n_lanes, n_fields)
    integer(int64), intent(inout) :: tags(n_lanes, n_tags)
    real(wp) :: goes_on
    integer :: i, n
    n = last_node
    !GCC$ ivdep
    do i = 1, width
      goes_on = merge(1.0_wp, 0.0_wp, tags(b + i, t_outcome) == outcome_going)
      lanes(b + i, l_refused) = lanes(b + i, l_refused) + goes_on * (1.0_wp - w%going(i))
      lanes(b + i, l_wanted) = chosen(goes_on, w%growth(i) * nodes%length(i, n), lanes(b + i, l_wanted))
      lanes(b + i, l_h) = lanes(b + i, l_h) * chosen(goes_on, w%growth(i), 1.0_wp)
      tags(b + i, t_outcome) = merge(outcome_special, tags(b + i, t_outcome), bad(i) > half)
    end do
  end subroutine refuse

  !> delta where the segment ends; delta_after in delta_path.f90.
  !> @param rest  length of strain behind the last node
  pure subroutine move_delta(m, b, done, rest, final, lanes)
    type(material_type), intent(in) :: m
    integer, intent(in) :: b
    real(wp), intent(in) :: done(width), rest(width)
    type(node_type), intent(in) :: final
    real(wp), intent(inout) :: lanes(n_lanes, n_fields)
    real(wp) :: size(width), along(width), across(width)
    integer :: comp
    ! Eq. (14): d delta/d lambda = d - rho^beta_r cos(theta) deltahat.
    size = m%R * final%rho - rest * (1.0_wp - final%left) * final%along
    along = size * final%along + rest
    across = size * final%across
    do comp = 0, 5
      lanes(b + 1:b + width, l_delta + comp) = chosen(done, along * lanes(b + 1:b + width, l_along + comp) + &
                                                      across * lanes(b + 1:b + width, l_across + comp), &
                                                      lanes(b + 1:b + width, l_delta + comp))
    end do
  end subroutine move_delta

  include 'series.inc'

end module umat_batch_step_portable
