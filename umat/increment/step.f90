!> One step of a leg: where it ends, whether its errors are small enough, and what they ask of the next.
module umat_step
  use umat_border, only: part_of_pressure
  use umat_collocation, only: nodes_type, place_nodes, start_type, prediction, sweep, missing_of, tail
  use umat_delta_path, only: measures_length
  use umat_influence, only: influence_type, influence_step
  use umat_kinds, only: wp
  use umat_leg, only: leg_type
  use umat_lobatto, only: rules, rule_short, rule_long, most_nodes
  use umat_material, only: material_type
  use umat_status, only: status_ok, status_out_of_domain
  use umat_tensor, only: norm
  use umat_wolffersdorff, only: hypoplastic_type, is_admissible
  implicit none
  private
  public :: step_type, reach, try, growth_of
  ! The update of many points side by side (batch/step.f90) takes the same steps.
  public :: least_share, most_share, most_sweeps, good_sweeps, rounding, close_enough, worth_trying, too_many_sweeps
  public :: least_growth, most_growth, safety, most_trials, most_iterations, slowest, inner_square

  !> A step and where it stands.
  type :: step_type
    integer :: rule !< which of the rules
    real(wp) :: x, h !< start and size, in the path's parameter
    real(wp) :: done = 0.0_wp !< length of strain of the leg before the step
    logical :: last = .false. !< does the leg end with it?
    real(wp) :: end = 1.0_wp !< where in the step the leg ends
    type(start_type) :: start
    type(nodes_type) :: nodes
    real(wp) :: stress(6) !< at the end of an accepted step
    type(influence_type) :: influence !< at the end of an accepted step, at the start of any other
    integer :: evaluations = 0 !< rate evaluations so far
    logical :: outside = .false. !< was the stress outside the domain in a step so far?
    integer :: obstacle !< why the end of the leg cannot be reached, if it cannot: a status
  end type step_type

  !> Part of the tolerance that a step may use: errors of many steps and of later increments add up. A step over the whole
  !> leg may use the most.
  real(wp), parameter :: least_share = 0.05_wp, most_share = 0.5_wp
  !> Sweeps tried before the step is shortened, and the number that a step of good size needs.
  integer, parameter :: most_sweeps = 5, good_sweeps = 2
  !> Trials of the length of a last step.
  integer, parameter :: most_trials = 6
  !> Iterations to the place where a length is reached, and the part of the last speed below which none is taken for one.
  integer, parameter :: most_iterations = 4
  real(wp), parameter :: slowest = 1.0e-3_wp
  !> Square of the place of the inner nodes of the long rule, between -1 and 1.
  real(wp), parameter :: inner_square = 3.0_wp / 7.0_wp
  !> Bounds of the change of a step, and the part of it that is taken.
  real(wp), parameter :: least_growth = 0.1_wp, most_growth = 5.0_wp, safety = 0.9_wp
  !> A step whose prediction asks for less than this part of it is not tried: sweeps hardly change what the nodes leave out.
  !> One that needs more sweeps is shortened to the other part.
  real(wp), parameter :: worth_trying = safety, too_many_sweeps = 0.4_wp
  !> Steps below this part of the leg are accepted whatever the error of the tangent: where the stress nearly vanishes its
  !> derivative has no bound, and the stress must not fail for that.
  real(wp), parameter :: tangent_gives_way = 1.0e-8_wp
  !> The tangent is taken at the stress before the last correction, which may be this part of the tolerance: it errs by a seventh
  !> of that at most (measured).
  real(wp), parameter :: last_correction = 3.0_wp
  !> A correction of this part of the stress is rounding: nothing can be told from how it compares with the one before.
  real(wp), parameter :: rounding = 1.0e2_wp * epsilon(1.0_wp)
  !> Where a last step ends may be off the last node by this part of the root of the tolerance: an Euler step makes up for it,
  !> whose error is of second order.
  real(wp), parameter :: close_enough = 0.1_wp

contains

  !> Place the nodes of a step that ends where the leg ends if it reaches so far.
  !> @param aimed is the step meant to reach the end?
  pure subroutine reach(m, leg, aimed, step)
    type(material_type), intent(in) :: m
    type(leg_type), intent(in) :: leg
    logical, intent(in) :: aimed
    type(step_type), intent(inout) :: step
    real(wp) :: ahead, covered
    integer :: i
    ahead = leg%length - step%done
    step%end = 1.0_wp
    if (measures_length(leg%path)) then
      step%last = step%h >= ahead
      step%h = min(step%h, ahead)
      call place(m, leg, step)
      return
    end if
    step%last = aimed
    do i = 1, most_trials
      call place(m, leg, step)
      associate (n => rules(step%rule)%n)
        covered = step%nodes%length(n)
        step%last = step%last .or. covered > ahead
        if (.not. step%last) return
        if (abs(ahead - covered) <= close_enough * sqrt(least_share * leg%tolerance) * ahead) then
          step%end = 1.0_wp + (ahead - covered) / step%nodes%strain(n)
          return
        end if
        step%h = step%h * place_of(n, step%nodes%strain(:n), ahead)
      end associate
    end do
    ! No smooth path: go on with a step that surely ends before the leg does, for the speed grows along a path.
    step%last = .false.
    step%h = step%h * 0.5_wp * min(1.0_wp, ahead / covered)
    call place(m, leg, step)
  end subroutine reach

  !> Place the nodes.
  pure subroutine place(m, leg, step)
    type(material_type), intent(in) :: m
    type(leg_type), intent(in) :: leg
    type(step_type), intent(inout) :: step
    call place_nodes(m, rules(step%rule), leg%path, leg%direction, leg%branch, step%x, step%h, step%start%void_ratio, &
                     step%nodes)
  end subroutine place

  !> Where in the step a length of strain is reached, 0 to 1 or a little beyond: Newton's method on the integral of the
  !> polynomial through the speeds at the nodes, from the end; the length is convex, for the speed grows.
  !> @param n      nodes behind the start
  !> @param strain length per unit of the step at the nodes
  !> @param length to be reached
  pure function place_of(n, strain, length) result(place)
    integer, intent(in) :: n
    real(wp), intent(in) :: strain(0:n), length
    real(wp) :: place
    real(wp) :: even(2), odd(2), before, covered, speed, t
    integer :: i
    ! Powers of t, which runs from -1 to 1, in two pairs.
    even = 0.5_wp * (strain(n) + strain(0)) - strain(n / 2)
    odd = 0.5_wp * (strain(n) - strain(0))
    if (n == 4) then
      even(2) = (inner_square * even(1) - 0.5_wp * (strain(3) + strain(1)) + strain(2)) / (inner_square * (1.0_wp - inner_square))
      even(1) = even(1) - even(2)
      odd(2) = (odd(1) - 0.5_wp * (strain(3) - strain(1)) / sqrt(inner_square)) / (1.0_wp - inner_square)
      odd(1) = odd(1) - odd(2)
    else
      even(2) = 0.0_wp
      odd(2) = 0.0_wp
    end if
    before = strain(n / 2) - odd(1) / 2.0_wp + even(1) / 3.0_wp - odd(2) / 4.0_wp + even(2) / 5.0_wp
    t = 1.0_wp
    do i = 1, most_iterations
      speed = strain(n / 2) + t * (odd(1) + t * (even(1) + t * (odd(2) + t * even(2))))
      covered = before + t * (strain(n / 2) + t * (odd(1) / 2.0_wp + t * (even(1) / 3.0_wp + &
                                                                         t * (odd(2) / 4.0_wp + t * even(2) / 5.0_wp))))
      t = t + (2.0_wp * length - covered) / max(speed, slowest * strain(n))
      t = max(-0.8_wp, min(3.0_wp, t))
    end do
    place = 0.5_wp * (1.0_wp + t)
  end function place_of

  !> Try a step whose nodes are placed.
  !> @param step     stress and influence at its end, when accepted; a rule that is too short is exchanged
  !> @param accepted are the errors small enough?
  !> @param growth   change of the step that the errors ask for; below 1 when not accepted, or 1 with another rule
  pure subroutine try(m, leg, step, accepted, growth)
    type(material_type), intent(in) :: m
    type(leg_type), intent(in) :: leg
    type(step_type), intent(inout) :: step
    logical, intent(out) :: accepted
    real(wp), intent(out) :: growth
    type(hypoplastic_type) :: tensors(0:most_nodes)
    type(influence_type) :: influence
    real(wp) :: by_stress(6, 6, most_nodes), f(6, 0:most_nodes), u(6, 0:most_nodes)
    real(wp) :: tolerance, scale, theta, missing, left, error
    integer :: n, k

    accepted = .false.
    n = rules(step%rule)%n
    tolerance = tolerance_of(leg, step)
    scale = size_of(m, step%start)
    call prediction(m, rules(step%rule), step%nodes, step%start, by_stress, f, u)
    ! A first look that costs no evaluation of the rate.
    theta = norm(u(:, n)) / scale
    missing = missing_of(rules(step%rule), f, theta) / scale
    if (m%intergranular) missing = max(missing, missing_length(leg, step) / m%R)
    if (missing > tolerance .and. step%rule == rule_short) then
      step%rule = rule_long
      growth = 1.0_wp
      return
    end if
    growth = growth_after(missing, theta, tolerance, n)
    if (missing > tolerance .or. growth < worth_trying) return

    call sweeps(m, leg, step, by_stress, tensors, f, u, left, growth)
    if (growth < 1.0_wp) return
    theta = norm(u(:, n)) / scale
    scale = max(scale, norm(step%start%stress + u(:, n)))
    missing = missing_of(rules(step%rule), f, theta) / scale
    if (m%intergranular) missing = max(missing, missing_length(leg, step) / m%R)
    error = missing + left / scale
    growth = growth_after(missing, theta, tolerance, n)
    if (error > tolerance) then
      growth = merge(1.0_wp, min(growth, 0.9_wp), step%rule == rule_short)
      step%rule = rule_long
      return
    end if
    step%stress = step%start%stress + u(:, n) + (step%end - 1.0_wp) * f(:, n)
    if (.not. is_admissible(m, step%stress, step%nodes%void_ratio(n))) then
      step%obstacle = status_out_of_domain
      growth = 0.25_wp
      return
    end if
    accepted = .true.
    step%outside = step%outside .or. step%start%h%outside
    do k = 1, n
      step%outside = step%outside .or. tensors(k)%outside
    end do
    if (.not. leg%with_tangent) return
    tensors(0) = step%start%h
    influence = step%influence
    call influence_step(m, rules(step%rule), leg, step%x, step%h, step%done, step%end, step%nodes, tensors, &
                        influence, error)
    accepted = error <= leg%tolerance .or. step%nodes%length(n) < tangent_gives_way * leg%length
    if (accepted) step%influence = influence
    if (.not. accepted) growth = min(0.9_wp, growth, growth_of(error / leg%tolerance, n + 3))
  end subroutine try

  !> Sweeps until the corrections are small enough.
  !> @param left   what further sweeps would still change, by estimate [stress]
  !> @param growth below 1 if the step must be shortened
  pure subroutine sweeps(m, leg, step, by_stress, tensors, f, u, left, growth)
    type(material_type), intent(in) :: m
    type(leg_type), intent(in) :: leg
    type(step_type), intent(inout) :: step
    real(wp), intent(in) :: by_stress(6, 6, most_nodes)
    type(hypoplastic_type), intent(inout) :: tensors(0:most_nodes)
    real(wp), intent(inout) :: f(6, 0:most_nodes), u(6, 0:most_nodes)
    real(wp), intent(out) :: left, growth
    real(wp) :: scale, change, previous, ratio
    integer :: i, n, status
    n = rules(step%rule)%n
    scale = size_of(m, step%start)
    previous = huge(previous)
    left = previous
    do i = 1, most_sweeps
      growth = 0.25_wp
      call sweep(m, rules(step%rule), step%nodes, step%start, by_stress, tensors, f, u, change, status)
      step%evaluations = step%evaluations + n
      if (status /= status_ok) then
        step%obstacle = status
        return
      end if
      growth = too_many_sweeps
      ! The prediction is off by terms of third order in the change of stress, and so a sweep gains twice that, relatively.
      ratio = max(2.0_wp * change / max(norm(u(:, n)), tiny(ratio)), change / previous)
      left = change * min(1.0_wp, ratio)
      if (ratio > 0.5_wp .and. left > rounding * scale) return
      if (left <= 0.5_wp * tolerance_of(leg, step) * scale) then
        growth = 1.0_wp
        if (.not. leg%with_tangent .or. change <= last_correction * leg%tolerance * scale) return
        growth = too_many_sweeps
      end if
      previous = change
    end do
  end subroutine sweeps

  !> Size of the stress at the start, to which errors are relative [stress]. Where p_t holds a stress near zero, the pressure
  !> that the model sees; and where there is an answer to stress zero, a size below which stresses mean nothing.
  pure function size_of(m, start) result(scale)
    type(material_type), intent(in) :: m
    type(start_type), intent(in) :: start
    real(wp) :: scale
    scale = max(norm(start%stress), part_of_pressure * max(start%h%pressure, m%soft_pressure))
  end function size_of

  !> What a step may use of the tolerance.
  pure function tolerance_of(leg, step) result(tolerance)
    type(leg_type), intent(in) :: leg
    type(step_type), intent(in) :: step
    real(wp) :: tolerance
    tolerance = leg%tolerance * (least_share + (most_share - least_share) * &
                                 min(1.0_wp, step%nodes%length(rules(step%rule)%n) / leg%length))
  end function tolerance_of

  !> Size of what the nodes leave out of the length of strain.
  pure function missing_length(leg, step) result(missing)
    type(leg_type), intent(in) :: leg
    type(step_type), intent(in) :: step
    real(wp) :: missing
    missing = 0.0_wp
    if (measures_length(leg%path)) return
    associate (n => rules(step%rule)%n, mode => rules(step%rule)%mode, strain => step%nodes%strain)
      missing = tail(abs(dot_product(mode(:n, 0), strain(:n))), abs(dot_product(mode(:n, 1), strain(:n))), &
                     abs(dot_product(mode(:n, 2), strain(:n))), abs(dot_product(mode(:n, 3), strain(:n))), n, 0.0_wp)
    end associate
  end function missing_length

  !> Change of the step that the nodes and the change of stress ask for.
  !> @param missing what the nodes leave out, relative
  !> @param theta   change of stress, relative
  pure function growth_after(missing, theta, tolerance, n) result(growth)
    real(wp), intent(in) :: missing, theta, tolerance
    integer, intent(in) :: n
    real(wp) :: growth
    integer, parameter :: order = 2 * good_sweeps + 3
    ! Prediction: theta^3/2 is left; each sweep gains theta^2.
    growth = min(growth_of(missing / tolerance, n + 3), growth_of(0.5_wp * theta**order / tolerance, order))
  end function growth_after

  !> Change of the step after an error (1: just acceptable) that grows with a power of the step.
  pure function growth_of(error, order) result(growth)
    real(wp), intent(in) :: error
    integer, intent(in) :: order
    real(wp) :: growth
    growth = most_growth
    if (error > (safety / most_growth)**order) growth = max(least_growth, safety * error**(-1.0_wp / order))
  end function growth_of

end module umat_step
