!> One finite strain increment: adaptive integration of the rate at a constant direction of strain.
!>
!> delta along a constant direction is known in closed form (delta_path.f90), the void ratio too; what is left to
!> integrate is the stress, and the length of the strain path where delta_path uses another parameter. The pair of
!> Dormand and Prince, 5(4), does it. The branch of the intergranular strain changes once at most, from reversal to loading,
!> at a place known in closed form, and no step crosses it.
!>
!> The consistent tangent is integrated along with the stress: the variational equations of the same path, for the six
!> components of the increment, with analytic derivatives (variation.f90).
module umat_update
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use umat_delta_path, only: delta_path_type, delta_path, path_point_type, path_point, delta_of, speed_at, &
                             measures_length, kappa_slope, delta_influence
  use umat_intergranular, only: slack_of_delta
  use umat_kinds, only: wp
  use umat_material, only: material_type
  use umat_rate, only: state_type, rate_of_stress, choose_branch, continuum_stiffness
  use umat_status, only: status_ok, status_out_of_domain, status_step_limit, status_bad_state, status_bad_argument, &
                         branch_plain, branch_loading, branch_reversal
  use umat_tableau, only: n_stages, c, a, error_weight, share, vanishing, largest_increment, substep_of_R, plain_substep
  use umat_tensor, only: ddot, norm, trace, unit_tensor, multiplicity
  use umat_variation, only: vary_rate_of_stress
  use umat_wolffersdorff, only: in_domain
  implicit none
  private
  public :: options_type, report_type, update_state

  !> Options of an update.
  type :: options_type
    real(wp) :: tolerance = 1.0e-6_wp !< relative error of stress, delta (of R) and void ratio
    integer :: max_evaluations = 20000 !< bound on rate evaluations
    real(wp) :: first_substep = 0.0_wp !< |strain| of the first substep; 0: chosen here
  end type options_type

  !> What an update did.
  type :: report_type
    integer :: evaluations = 0 !< rate evaluations
    integer :: branch = branch_plain !< branch at the end
    real(wp) :: substep = 0.0_wp !< |strain| that the error control suggests for the next substep; 0: none was made
  end type report_type

  !> A smaller fraction of the increment than this is not tried.
  real(wp), parameter :: smallest_substep = 1.0e-10_wp
  !> share for the tangent, whose errors grow along paths on which the stress nearly vanishes.
  real(wp), parameter :: share_of_tangent = 0.05_wp

  !> What is integrated: stress, length of strain done; with the tangent also the integral that delta_influence needs, and
  !> the influence of the increment on stress, (component of eta, component of stress).
  integer, parameter :: n_stress = 7, i_length = 7, i_integral = 8, n_tangent = 44
  !> An increment shorter than this has the stiffness of its branch as its tangent, to rounding.
  real(wp), parameter :: shortest_tangent = 1.0e-14_wp

contains

  !> Integrate one strain increment.
  !> @param m       material
  !> @param options tolerance and bounds
  !> @param state   in: start, out: end; untouched on failure
  !> @param strain  strain increment, tensor components
  !> @param report  filled, also on failure
  !> @param status  status_ok; status_bad_state or status_bad_argument for input that is not finite, |delta| > R
  !>                or a strain increment above 1; status_out_of_domain when the path leaves it; status_step_limit
  !> @param tangent d stress/d strain increment, the derivative of the integrated stress; for a vanishing increment the
  !>                continuum stiffness of a reversal, or L without intergranular strain. Matrix on tensor components
  !>                [stress]
  pure subroutine update_state(m, options, state, strain, report, status, tangent)
    type(material_type), intent(in) :: m
    type(options_type), intent(in) :: options
    type(state_type), intent(inout) :: state
    real(wp), intent(in) :: strain(6)
    type(report_type), intent(out) :: report
    integer, intent(out) :: status
    real(wp), intent(out), optional :: tangent(6, 6)
    type(state_type) :: work
    real(wp) :: direction(6), length, turn
    real(wp) :: influence(6, 6) !< of eta on stress, the increment being length (direction + eta)
    integer :: n

    call check_input(m, state, strain, status)
    if (status /= status_ok) return
    work = state
    length = norm(strain)
    influence = 0.0_wp
    n = merge(n_tangent, n_stress, present(tangent))
    if (length < shortest_tangent) n = n_stress
    report%branch = choose_branch(m, work%delta, strain)
    if (length > 0.0_wp) then
      direction = strain / length
      turn = 0.0_wp
      if (report%branch == branch_reversal) then
        ! delta + turn direction is normal to the direction of strain.
        turn = -ddot(work%delta, direction)
        call integrate(m, options, branch_reversal, direction, 0.0_wp, min(turn, length), n, work, influence, report, &
                       status)
        if (status /= status_ok) return
        if (turn < length) report%branch = branch_loading
      end if
      if (report%branch /= branch_reversal) then
        call integrate(m, options, report%branch, direction, turn, length - turn, n, work, influence, report, status)
        if (status /= status_ok) return
      end if
    end if
    if (n == n_tangent) then
      tangent = transpose(influence) / length
    else if (present(tangent)) then
      call continuum_stiffness(m, work, strain, tangent, status)
      if (status /= status_ok) return
    end if
    state = work
  end subroutine update_state

  !> Is the input finite and inside the model's domain?
  pure subroutine check_input(m, state, strain, status)
    type(material_type), intent(in) :: m
    type(state_type), intent(in) :: state
    real(wp), intent(in) :: strain(6)
    integer, intent(out) :: status
    status = status_bad_argument
    if (.not. all(ieee_is_finite(strain))) return
    if (maxval(abs(strain)) > largest_increment) return
    status = status_bad_state
    if (.not. (all(ieee_is_finite(state%stress)) .and. all(ieee_is_finite(state%delta)))) return
    if (.not. ieee_is_finite(state%void_ratio)) return
    if (m%intergranular) then
      if (norm(state%delta) > slack_of_delta * m%R) return
    end if
    status = status_out_of_domain
    if (.not. in_domain(m, state%stress, state%void_ratio)) return
    status = status_ok
  end subroutine check_input

  !> Integrate over a length of strain on one branch.
  !> @param branch    the branch to stay on
  !> @param direction unit strain direction
  !> @param turn      length of strain already done in reversal
  !> @param length    length of the strain path
  !> @param n         n_stress, or n_tangent to carry the influence too
  !> @param state     in: start, out: end; undefined on failure
  !> @param influence of eta on stress, in: start, out: end
  !> @param report    evaluations are added, the suggested substep is updated
  pure subroutine integrate(m, options, branch, direction, turn, length, n, state, influence, report, status)
    type(material_type), intent(in) :: m
    type(options_type), intent(in) :: options
    integer, intent(in) :: branch, n
    real(wp), intent(in) :: direction(6), turn, length
    type(state_type), intent(inout) :: state
    real(wp), intent(inout) :: influence(6, 6)
    type(report_type), intent(inout) :: report
    integer, intent(out) :: status
    type(delta_path_type) :: path
    real(wp) :: y(n_tangent), y_new(n_tangent), k(n_tangent, n_stages), difference(n_tangent), x, h, error
    integer :: obstacle !< why the end cannot be reached, if it cannot
    logical :: last

    status = status_ok
    if (.not. length > 0.0_wp) return
    path = delta_path(m, state%delta, direction, branch, turn)
    x = path%start
    y(1:6) = state%stress
    y(i_length:i_integral) = 0.0_wp
    if (n == n_tangent) y(i_integral + 1:) = reshape(influence, [36])
    call evaluate(x, y, k(:, 1), status)
    report%evaluations = report%evaluations + 1
    if (status /= status_ok) return
    h = first_substep(m, options, path, length)
    obstacle = status_step_limit
    do
      call shorten_to_length(m, path, x, length - y(i_length), h, last)
      call step(x, y, k, h, y_new, status)
      report%evaluations = report%evaluations + n_stages - 1
      if (status == status_ok) then
        call combine(difference, k, h, error_weight, n_stages)
        error = relative_error(m, y, y_new, difference) / share
        if (n == n_tangent) &
          error = max(error, influence_error(y_new, k(:, n_stages), length, difference) / share_of_tangent)
        error = error / options%tolerance
      else
        error = huge(error)
        obstacle = status
      end if
      if (error <= 1.0_wp) then
        x = x + h
        y(:n) = y_new(:n)
        k(:n, 1) = k(:n, n_stages) ! the last stage is the first of the next step
        if (last) exit
        if (norm(y(1:6)) < vanishing * norm(state%stress)) then
          status = status_out_of_domain
          return
        end if
      else if (h * speed_at(m, path, x + h) < smallest_substep * length) then
        status = obstacle
        return
      end if
      if (report%evaluations + n_stages > options%max_evaluations) then
        status = obstacle
        return
      end if
      h = h * factor(error)
    end do
    report%substep = h * factor(error) * speed_at(m, path, x)
    if (m%intergranular) state%delta = delta_of(m, path_point(m, path, x))
    state%void_ratio = void_ratio_at(length)
    state%stress = y(1:6)
    if (n == n_tangent) influence = reshape(y(i_integral + 1:), [6, 6])

  contains

    !> One Runge-Kutta step; k(:,1) is given, the others are filled.
    pure subroutine step(x, y, k, h, y_new, status)
      real(wp), intent(in) :: x, y(n_tangent), h
      real(wp), intent(inout) :: k(n_tangent, n_stages)
      real(wp), intent(out) :: y_new(n_tangent)
      integer, intent(out) :: status
      integer :: i
      do i = 2, n_stages
        call combine(y_new, k, h, a(:, i), i - 1)
        y_new(:n) = y(:n) + y_new(:n)
        call evaluate(x + c(i) * h, y_new, k(:, i), status)
        if (status /= status_ok) return
      end do
    end subroutine step

    !> h times the weighted sum of the first stages. Written without temporary arrays, which would be allocated.
    pure subroutine combine(total, k, h, weights, count)
      real(wp), intent(out) :: total(n_tangent)
      real(wp), intent(in) :: k(n_tangent, n_stages), h, weights(*)
      integer, intent(in) :: count
      integer :: j
      total(:n) = (h * weights(1)) * k(:n, 1)
      do j = 2, count
        total(:n) = total(:n) + (h * weights(j)) * k(:n, j)
      end do
    end subroutine combine

    !> Derivatives of what is integrated with respect to the parameter of the path.
    pure subroutine evaluate(x, y, rate, status)
      real(wp), intent(in) :: x, y(n_tangent)
      real(wp), intent(out) :: rate(n_tangent)
      integer, intent(out) :: status
      type(path_point_type) :: point
      real(wp) :: void_ratio, d_delta(6, 6), done
      point = path_point(m, path, x)
      void_ratio = void_ratio_at(y(i_length))
      if (n == n_tangent) then
        done = turn + y(i_length)
        d_delta = 0.0_wp
        if (m%intergranular) d_delta = delta_influence(m, path, x, point, done, y(i_integral))
        call vary_rate_of_stress(m, y(1:6), void_ratio, point%g, direction, branch, y(i_integral + 1), d_delta, &
                                 (1.0_wp + void_ratio) * done * unit_tensor, rate(1:6), rate(i_integral + 1), status)
      else
        call rate_of_stress(m, y(1:6), void_ratio, point%g, direction, branch, rate(1:6), status)
      end if
      rate(i_length:i_integral) = 1.0_wp
      rate(:n) = point%speed * rate(:n)
      if (n == n_tangent) rate(i_integral) = kappa_slope(m, point)
    end subroutine evaluate

    !> Void ratio after a length of strain in this part; theory.md Eq. (15) integrated.
    pure function void_ratio_at(done) result(e)
      real(wp), intent(in) :: done
      real(wp) :: e
      e = (1.0_wp + state%void_ratio) * exp(trace(direction) * done) - 1.0_wp
    end function void_ratio_at

  end subroutine integrate

  !> Length of strain that a step of the parameter covers, by the same quadrature as in the step itself.
  pure function length_of_step(m, path, x, h) result(length)
    type(material_type), intent(in) :: m
    type(delta_path_type), intent(in) :: path
    real(wp), intent(in) :: x, h
    real(wp) :: length
    integer :: i
    length = 0.0_wp
    do i = 1, 6
      if (i /= 2) length = length + h * a(i, n_stages) * speed_at(m, path, x + c(i) * h)
    end do
  end function length_of_step

  !> Shorten a step of the parameter to one that covers a length of strain, by Newton's method, if it covers more.
  !> @param h    step
  !> @param last does the step cover the length?
  pure subroutine shorten_to_length(m, path, x, length, h, last)
    type(material_type), intent(in) :: m
    type(delta_path_type), intent(in) :: path
    real(wp), intent(in) :: x, length
    real(wp), intent(inout) :: h
    logical, intent(out) :: last
    real(wp) :: lower, upper, excess
    integer :: i
    if (measures_length(path)) then
      last = h >= length
      if (last) h = length
      return
    end if
    ! The speed grows along a path, so its value at the end bounds the length covered.
    last = h * speed_at(m, path, x + h) >= length
    if (.not. last) return
    excess = length_of_step(m, path, x, h) - length
    last = excess >= 0.0_wp
    if (.not. last) return
    lower = 0.0_wp
    upper = h
    do i = 1, 60
      if (abs(excess) <= 1.0e3_wp * epsilon(length) * length) exit
      if (excess > 0.0_wp) then
        upper = h
      else
        lower = h
      end if
      h = h - excess / speed_at(m, path, x + h)
      if (h <= lower .or. h >= upper) h = 0.5_wp * (lower + upper)
      excess = length_of_step(m, path, x, h) - length
    end do
  end subroutine shorten_to_length

  !> First guess of the substep, as a step of the path's parameter: a part of the range in which delta turns.
  pure function first_substep(m, options, path, length) result(h)
    type(material_type), intent(in) :: m
    type(options_type), intent(in) :: options
    type(delta_path_type), intent(in) :: path
    real(wp), intent(in) :: length
    real(wp) :: h, wanted
    wanted = plain_substep
    if (m%intergranular) wanted = substep_of_R * m%R
    ! A suggestion from outside is taken, but not one that would only waste work.
    if (options%first_substep > 0.0_wp) wanted = max(options%first_substep, 1.0e-3_wp * wanted)
    wanted = min(wanted, length)
    h = wanted / max(speed_at(m, path, path%start), wanted)
  end function first_substep

  !> The larger of the relative errors of stress, and of the length of strain relative to R: the latter bounds those of
  !> delta and void ratio. Norms keep it independent of the axes.
  pure function relative_error(m, y, y_new, difference) result(error)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: y(n_tangent), y_new(n_tangent), difference(n_tangent)
    real(wp) :: error
    error = norm(difference(1:6)) / max(norm(y(1:6)), norm(y_new(1:6)))
    if (m%intergranular) error = max(error, abs(difference(7)) / m%R)
  end function relative_error

  !> The error of the influence of the increment on stress, relative to what it will be at the end: relative to what it is
  !> now would not do, because it starts from zero.
  pure function influence_error(y_new, rate, length, difference) result(error)
    real(wp), intent(in) :: y_new(n_tangent), rate(n_tangent), length, difference(n_tangent)
    real(wp) :: error
    real(wp) :: per_length, at_end
    per_length = sqrt(squared_size(rate(i_integral + 1))) / max(rate(i_length), tiny(error))
    at_end = sqrt(squared_size(y_new(i_integral + 1))) + max(0.0_wp, length - y_new(i_length)) * per_length
    error = sqrt(squared_size(difference(i_integral + 1))) / at_end
  end function influence_error

  !> Square of the size of an influence: a fourth-order tensor's norm, so that it does not depend on the axes.
  pure function squared_size(influence) result(s)
    real(wp), intent(in) :: influence(6, 6)
    real(wp) :: s
    integer :: i
    s = 0.0_wp
    do i = 1, 6
      s = s + multiplicity(i) * sum(influence(:, i)**2 / multiplicity)
    end do
  end function squared_size

  !> Change of the step size after an error (1: just acceptable) of a fifth-order step.
  pure function factor(error)
    real(wp), intent(in) :: error
    real(wp) :: factor
    factor = 5.0_wp
    if (error > 1.0e-8_wp) factor = max(0.2_wp, min(5.0_wp, 0.9_wp * error**(-0.2_wp)))
  end function factor

end module umat_update
