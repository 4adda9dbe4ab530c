!> One finite strain increment: adaptive integration of the rate at a constant direction of strain.
!>
!> delta along a constant direction is known in closed form (delta_path.f90), the void ratio too; what is left to
!> integrate is the stress, and the length of the strain path where delta_path uses another parameter. The pair of
!> Dormand and Prince, 5(4), does it. The branch of the intergranular strain changes once at most, from reversal to loading,
!> at a place known in closed form, and no step crosses it.
module umat_update
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use umat_delta_path, only: delta_path_type, delta_path, delta_at, speed_at
  use umat_kinds, only: wp
  use umat_material, only: material_type
  use umat_rate, only: state_type, rate_of_stress, choose_branch, continuum_stiffness
  use umat_status, only: status_ok, status_out_of_domain, status_step_limit, status_bad_state, status_bad_argument, &
                         branch_plain, branch_loading, branch_reversal
  use umat_tensor, only: ddot, norm, trace
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

  !> Largest strain increment accepted: beyond it a small strain increment has no meaning.
  real(wp), parameter :: largest_increment = 1.0_wp
  !> A smaller fraction of the increment than this is not tried.
  real(wp), parameter :: smallest_substep = 1.0e-10_wp
  !> A stress that falls to this part of its start on a straight path is on its way to zero, which is outside the domain.
  real(wp), parameter :: vanishing = 1.0e-8_wp
  !> Part of the tolerance that one substep may use: errors of many substeps and of later increments add up.
  real(wp), parameter :: share = 0.1_wp

  !> Dormand and Prince (1980), Table 2: nodes, weights of the stages, of the step and of its error.
  integer, parameter :: n_stages = 7
  real(wp), parameter :: c(n_stages) = [0.0_wp, 1.0_wp / 5.0_wp, 3.0_wp / 10.0_wp, 4.0_wp / 5.0_wp, 8.0_wp / 9.0_wp, &
                                        1.0_wp, 1.0_wp]
  real(wp), parameter :: a2(1) = [1.0_wp / 5.0_wp]
  real(wp), parameter :: a3(2) = [3.0_wp / 40.0_wp, 9.0_wp / 40.0_wp]
  real(wp), parameter :: a4(3) = [44.0_wp / 45.0_wp, -56.0_wp / 15.0_wp, 32.0_wp / 9.0_wp]
  real(wp), parameter :: a5(4) = [19372.0_wp / 6561.0_wp, -25360.0_wp / 2187.0_wp, 64448.0_wp / 6561.0_wp, &
                                  -212.0_wp / 729.0_wp]
  real(wp), parameter :: a6(5) = [9017.0_wp / 3168.0_wp, -355.0_wp / 33.0_wp, 46732.0_wp / 5247.0_wp, &
                                  49.0_wp / 176.0_wp, -5103.0_wp / 18656.0_wp]
  real(wp), parameter :: b(6) = [35.0_wp / 384.0_wp, 0.0_wp, 500.0_wp / 1113.0_wp, 125.0_wp / 192.0_wp, &
                                 -2187.0_wp / 6784.0_wp, 11.0_wp / 84.0_wp]
  real(wp), parameter :: error_weight(n_stages) = [71.0_wp / 57600.0_wp, 0.0_wp, -71.0_wp / 16695.0_wp, &
                                                   71.0_wp / 1920.0_wp, -17253.0_wp / 339200.0_wp, 22.0_wp / 525.0_wp, &
                                                   -1.0_wp / 40.0_wp]

contains

  !> Integrate one strain increment.
  !> @param m       material
  !> @param options tolerance and bounds
  !> @param state   in: start, out: end; untouched on failure
  !> @param strain  strain increment, tensor components
  !> @param report  filled, also on failure
  !> @param status  status_ok; status_bad_state or status_bad_argument for input that is not finite or outside the
  !>                model's domain; status_out_of_domain when the path leaves it; status_step_limit
  !> @param tangent continuum stiffness at the end, matrix on tensor components [stress]
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

    call check_input(m, state, strain, status)
    if (status /= status_ok) return
    work = state
    length = norm(strain)
    report%branch = choose_branch(m, work%delta, strain)
    if (length > 0.0_wp) then
      direction = strain / length
      if (report%branch == branch_reversal) then
        ! delta + turn direction is normal to the direction of strain.
        turn = -ddot(work%delta, direction)
        call integrate(m, options, branch_reversal, direction, min(turn, length), work, report, status)
        if (status /= status_ok) return
        if (turn < length) then
          report%branch = branch_loading
          call integrate(m, options, branch_loading, direction, length - turn, work, report, status)
        end if
      else
        call integrate(m, options, report%branch, direction, length, work, report, status)
      end if
      if (status /= status_ok) return
    end if
    if (present(tangent)) then
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
    status = status_out_of_domain
    if (.not. in_domain(m, state%stress, state%void_ratio)) return
    status = status_ok
  end subroutine check_input

  !> Integrate over a length of strain on one branch.
  !> @param branch    the branch to stay on
  !> @param direction unit strain direction
  !> @param length    length of the strain path
  !> @param state     in: start, out: end; undefined on failure
  !> @param report    evaluations are added, the suggested substep is updated
  pure subroutine integrate(m, options, branch, direction, length, state, report, status)
    type(material_type), intent(in) :: m
    type(options_type), intent(in) :: options
    integer, intent(in) :: branch
    real(wp), intent(in) :: direction(6), length
    type(state_type), intent(inout) :: state
    type(report_type), intent(inout) :: report
    integer, intent(out) :: status
    type(delta_path_type) :: path
    real(wp) :: y(7), y_new(7), k(7, n_stages), x, h, error
    integer :: obstacle !< why the end cannot be reached, if it cannot
    logical :: last

    status = status_ok
    if (.not. length > 0.0_wp) return
    path = delta_path(m, state%delta, direction, branch)
    x = path%start
    y = [state%stress, 0.0_wp] ! stress and the length of strain done
    call evaluate(x, y, k(:, 1), status)
    report%evaluations = report%evaluations + 1
    if (status /= status_ok) return
    h = first_substep(m, options, path, length)
    obstacle = status_step_limit
    do
      last = y(7) + length_of_step(path, x, h) >= length
      if (last) h = step_to_length(path, x, h, length - y(7))
      call step(x, y, k, h, y_new, status)
      report%evaluations = report%evaluations + n_stages - 1
      if (status == status_ok) then
        error = relative_error(m, y, y_new, h * matmul(k, error_weight)) / (share * options%tolerance)
      else
        error = huge(error)
        obstacle = status
      end if
      if (error <= 1.0_wp) then
        x = x + h
        y = y_new
        k(:, 1) = k(:, n_stages) ! the last stage is the first of the next step
        if (last) exit
        if (norm(y(1:6)) < vanishing * norm(state%stress)) then
          status = status_out_of_domain
          return
        end if
      else if (h * speed_at(path, x + h) < smallest_substep * length) then
        status = obstacle
        return
      end if
      if (report%evaluations + n_stages > options%max_evaluations) then
        status = obstacle
        return
      end if
      h = h * factor(error)
    end do
    report%substep = h * factor(error) * speed_at(path, x)
    state = state_type(y(1:6), delta_at(path, x), void_ratio_at(length))

  contains

    !> One Runge-Kutta step; k(:,1) is given, the others are filled.
    pure subroutine step(x, y, k, h, y_new, status)
      real(wp), intent(in) :: x, y(7), h
      real(wp), intent(inout) :: k(7, n_stages)
      real(wp), intent(out) :: y_new(7)
      integer, intent(out) :: status
      y_new = y
      call evaluate(x + c(2) * h, y + h * matmul(k(:, :1), a2), k(:, 2), status)
      if (status /= status_ok) return
      call evaluate(x + c(3) * h, y + h * matmul(k(:, :2), a3), k(:, 3), status)
      if (status /= status_ok) return
      call evaluate(x + c(4) * h, y + h * matmul(k(:, :3), a4), k(:, 4), status)
      if (status /= status_ok) return
      call evaluate(x + c(5) * h, y + h * matmul(k(:, :4), a5), k(:, 5), status)
      if (status /= status_ok) return
      call evaluate(x + c(6) * h, y + h * matmul(k(:, :5), a6), k(:, 6), status)
      if (status /= status_ok) return
      y_new = y + h * matmul(k(:, :6), b)
      call evaluate(x + h, y_new, k(:, 7), status)
    end subroutine step

    !> Derivatives of stress and length with respect to the parameter of the path.
    pure subroutine evaluate(x, y, rate, status)
      real(wp), intent(in) :: x, y(7)
      real(wp), intent(out) :: rate(7)
      integer, intent(out) :: status
      call rate_of_stress(m, state_type(y(1:6), delta_at(path, x), void_ratio_at(y(7))), direction, branch, &
                          rate(1:6), status)
      rate(7) = 1.0_wp
      rate = speed_at(path, x) * rate
    end subroutine evaluate

    !> Void ratio after a length of strain; theory.md Eq. (15) integrated.
    pure function void_ratio_at(done) result(e)
      real(wp), intent(in) :: done
      real(wp) :: e
      e = (1.0_wp + state%void_ratio) * exp(trace(direction) * done) - 1.0_wp
    end function void_ratio_at

  end subroutine integrate

  !> Length of strain that a step of the parameter covers, by the same quadrature as in the step itself.
  pure function length_of_step(path, x, h) result(length)
    type(delta_path_type), intent(in) :: path
    real(wp), intent(in) :: x, h
    real(wp) :: length
    integer :: i
    length = 0.0_wp
    do i = 1, 6
      if (i /= 2) length = length + h * b(i) * speed_at(path, x + c(i) * h)
    end do
  end function length_of_step

  !> The step of the parameter that covers a length of strain, by Newton's method.
  !> @param h a step that covers at least this length
  pure function step_to_length(path, x, h, length) result(step)
    type(delta_path_type), intent(in) :: path
    real(wp), intent(in) :: x, h, length
    real(wp) :: step
    real(wp) :: lower, upper, excess
    integer :: i
    lower = 0.0_wp
    upper = h
    step = h
    do i = 1, 60
      excess = length_of_step(path, x, step) - length
      if (abs(excess) <= 4.0_wp * epsilon(length) * length) exit
      if (excess > 0.0_wp) then
        upper = step
      else
        lower = step
      end if
      step = step - excess / speed_at(path, x + step)
      if (step <= lower .or. step >= upper) step = 0.5_wp * (lower + upper)
    end do
  end function step_to_length

  !> First guess of the substep, as a step of the path's parameter: a part of the range in which delta turns.
  pure function first_substep(m, options, path, length) result(h)
    type(material_type), intent(in) :: m
    type(options_type), intent(in) :: options
    type(delta_path_type), intent(in) :: path
    real(wp), intent(in) :: length
    real(wp) :: h, wanted
    wanted = 1.0e-4_wp
    if (m%intergranular) wanted = 0.5_wp * m%R
    if (options%first_substep > 0.0_wp) wanted = options%first_substep
    wanted = min(wanted, length)
    h = wanted / max(speed_at(path, path%start), wanted)
  end function first_substep

  !> The larger of the relative errors of stress, and of the length of strain relative to R: the latter bounds those of
  !> delta and void ratio. Norms keep it independent of the axes.
  pure function relative_error(m, y, y_new, difference) result(error)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: y(7), y_new(7), difference(7)
    real(wp) :: error
    error = norm(difference(1:6)) / max(norm(y(1:6)), norm(y_new(1:6)))
    if (m%intergranular) error = max(error, abs(difference(7)) / m%R)
  end function relative_error

  !> Change of the step size after an error (1: just acceptable) of a fifth-order step.
  pure function factor(error)
    real(wp), intent(in) :: error
    real(wp) :: factor
    factor = 5.0_wp
    if (error > 1.0e-8_wp) factor = max(0.2_wp, min(5.0_wp, 0.9_wp * error**(-0.2_wp)))
  end function factor

end module umat_update
