!> One finite strain increment: adaptive integration of the rate at a constant direction of strain.
!>
!> Embedded Runge-Kutta pair of Dormand and Prince, 5(4). Along a constant direction the branch of the intergranular
!> strain changes once at most, from reversal to loading, and delta is linear before that: the place is known in closed
!> form and no step crosses it.
module hypofab_update
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use hypofab_kinds, only: wp
  use hypofab_material, only: material_type
  use hypofab_rate, only: state_type, state_rate, choose_branch, continuum_stiffness
  use hypofab_status, only: status_ok, status_out_of_domain, status_step_limit, status_bad_state, status_bad_argument, &
                            branch_plain, branch_loading, branch_reversal
  use hypofab_tensor, only: ddot, norm
  use hypofab_wolffersdorff, only: in_domain
  implicit none
  private
  public :: options_type, report_type, update_state

  !> Options of an update.
  type :: options_type
    real(wp) :: tolerance = 1.0e-6_wp !< relative error of stress, delta (of R) and void ratio per substep
    integer :: max_evaluations = 20000 !< bound on rate evaluations
    real(wp) :: first_substep = 0.0_wp !< |strain| of the first substep; 0: chosen here
  end type options_type

  !> What an update did.
  type :: report_type
    integer :: evaluations = 0 !< rate evaluations
    integer :: branch = branch_plain !< branch at the end
    real(wp) :: substep = 1.0_wp !< fraction of the increment that the error control suggests next
  end type report_type

  !> Largest strain increment accepted: beyond it a small strain increment has no meaning.
  real(wp), parameter :: largest_increment = 1.0_wp
  !> A smaller fraction of the increment than this is not tried.
  real(wp), parameter :: smallest_substep = 1.0e-12_wp

  !> Dormand-Prince 5(4), as 13 numbers a state: the tableau (Dormand and Prince 1980, Table 2).
  real(wp), parameter :: a21 = 1.0_wp / 5.0_wp
  real(wp), parameter :: a3(2) = [3.0_wp / 40.0_wp, 9.0_wp / 40.0_wp]
  real(wp), parameter :: a4(3) = [44.0_wp / 45.0_wp, -56.0_wp / 15.0_wp, 32.0_wp / 9.0_wp]
  real(wp), parameter :: a5(4) = [19372.0_wp / 6561.0_wp, -25360.0_wp / 2187.0_wp, 64448.0_wp / 6561.0_wp, &
                                  -212.0_wp / 729.0_wp]
  real(wp), parameter :: a6(5) = [9017.0_wp / 3168.0_wp, -355.0_wp / 33.0_wp, 46732.0_wp / 5247.0_wp, &
                                  49.0_wp / 176.0_wp, -5103.0_wp / 18656.0_wp]
  real(wp), parameter :: b(6) = [35.0_wp / 384.0_wp, 0.0_wp, 500.0_wp / 1113.0_wp, 125.0_wp / 192.0_wp, &
                                 -2187.0_wp / 6784.0_wp, 11.0_wp / 84.0_wp]
  real(wp), parameter :: error_weight(7) = [71.0_wp / 57600.0_wp, 0.0_wp, -71.0_wp / 16695.0_wp, 71.0_wp / 1920.0_wp, &
                                            -17253.0_wp / 339200.0_wp, 22.0_wp / 525.0_wp, -1.0_wp / 40.0_wp]
  integer, parameter :: n_stages = 7
  integer, parameter :: n_state = 13

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
    real(wp) :: turn, size

    call check_input(m, state, strain, status)
    if (status /= status_ok) return
    work = state
    size = norm(strain)
    report%branch = choose_branch(m, work%delta, strain)
    if (size > 0.0_wp) then
      if (report%branch == branch_reversal) then
        ! delta + s strain is normal to strain at s = turn; written with a unit direction to stay clear of underflow.
        turn = -ddot(work%delta, strain / size) / size
        call integrate(m, options, branch_reversal, strain, min(turn, 1.0_wp), work, report, status)
        if (status /= status_ok) return
        if (turn < 1.0_wp) then
          work%delta = without_component(work%delta, strain / size, m%R)
          report%branch = branch_loading
          call integrate(m, options, branch_loading, strain, 1.0_wp - turn, work, report, status)
        end if
      else
        call integrate(m, options, report%branch, strain, 1.0_wp, work, report, status)
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

  !> delta at the change of branch: exactly normal to the strain direction, and zero where only rounding is left.
  pure function without_component(delta, direction, R) result(normal)
    real(wp), intent(in) :: delta(6), direction(6), R
    real(wp) :: normal(6)
    normal = delta - ddot(delta, direction) * direction
    if (norm(normal) < 1.0e-14_wp * R) normal = 0.0_wp
  end function without_component

  !> Integrate over a part of the increment on one branch.
  !> @param branch   the branch to stay on
  !> @param strain   the whole increment
  !> @param fraction the part of it to integrate, 0 .. 1
  !> @param state    in: start, out: end; undefined on failure
  !> @param report   evaluations are added, the suggested substep is updated
  pure subroutine integrate(m, options, branch, strain, fraction, state, report, status)
    type(material_type), intent(in) :: m
    type(options_type), intent(in) :: options
    integer, intent(in) :: branch
    real(wp), intent(in) :: strain(6), fraction
    type(state_type), intent(inout) :: state
    type(report_type), intent(inout) :: report
    integer, intent(out) :: status
    real(wp) :: y(n_state), y_new(n_state), k(n_state, n_stages), done, h, error
    logical :: last

    status = status_ok
    if (.not. fraction > 0.0_wp) return
    y = packed(state)
    call evaluate(y, k(:, 1), status)
    report%evaluations = report%evaluations + 1
    if (status /= status_ok) return
    h = first_substep(m, options, strain)
    done = 0.0_wp
    do
      last = done + h * (1.0_wp + 1.0e-10_wp) >= fraction
      if (last) h = fraction - done
      call step(y, k, h, y_new, status)
      report%evaluations = report%evaluations + n_stages - 1
      error = huge(error)
      if (status == status_ok) error = relative_error(m, y, y_new, h * matmul(k, error_weight)) / options%tolerance
      if (error <= 1.0_wp) then
        done = done + h
        y = y_new
        k(:, 1) = k(:, n_stages) ! the last stage is the first of the next step
        if (last) exit
      else
        if (h < smallest_substep) then
          if (status == status_ok) status = status_step_limit
          return
        end if
      end if
      if (report%evaluations + n_stages > options%max_evaluations) then
        status = status_step_limit
        return
      end if
      h = h * factor(error)
    end do
    report%substep = min(1.0_wp, h * factor(error))
    state = unpacked(y)

  contains

    !> One Runge-Kutta step; k(:,1) is given, the others are filled.
    pure subroutine step(y, k, h, y_new, status)
      real(wp), intent(in) :: y(n_state), h
      real(wp), intent(inout) :: k(n_state, n_stages)
      real(wp), intent(out) :: y_new(n_state)
      integer, intent(out) :: status
      y_new = y
      call evaluate(y + h * a21 * k(:, 1), k(:, 2), status)
      if (status /= status_ok) return
      call evaluate(y + h * matmul(k(:, :2), a3), k(:, 3), status)
      if (status /= status_ok) return
      call evaluate(y + h * matmul(k(:, :3), a4), k(:, 4), status)
      if (status /= status_ok) return
      call evaluate(y + h * matmul(k(:, :4), a5), k(:, 5), status)
      if (status /= status_ok) return
      call evaluate(y + h * matmul(k(:, :5), a6), k(:, 6), status)
      if (status /= status_ok) return
      y_new = y + h * matmul(k(:, :6), b)
      call evaluate(y_new, k(:, 7), status)
    end subroutine step

    !> Rate of the packed state.
    pure subroutine evaluate(y, rate, status)
      real(wp), intent(in) :: y(n_state)
      real(wp), intent(out) :: rate(n_state)
      integer, intent(out) :: status
      type(state_type) :: state_rates
      call state_rate(m, unpacked(y), strain, branch, state_rates, status)
      rate = packed(state_rates)
    end subroutine evaluate

  end subroutine integrate

  !> First guess of the substep, as a fraction of the increment: a part of the range in which delta turns.
  pure function first_substep(m, options, strain) result(h)
    type(material_type), intent(in) :: m
    type(options_type), intent(in) :: options
    real(wp), intent(in) :: strain(6)
    real(wp) :: h
    h = 1.0e-4_wp
    if (m%intergranular) h = 0.5_wp * m%R
    if (options%first_substep > 0.0_wp) h = options%first_substep
    h = min(1.0_wp, h / norm(strain))
  end function first_substep

  !> The largest of the relative errors of stress, delta and void ratio. Norms keep it independent of the axes.
  pure function relative_error(m, y, y_new, difference) result(error)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: y(n_state), y_new(n_state), difference(n_state)
    real(wp) :: error
    error = norm(difference(1:6)) / max(norm(y(1:6)), norm(y_new(1:6)))
    if (m%intergranular) error = max(error, norm(difference(7:12)) / m%R)
    error = max(error, abs(difference(13)) / y(13))
  end function relative_error

  !> Change of the step size after an error (1: just acceptable) of a fifth-order step.
  pure function factor(error)
    real(wp), intent(in) :: error
    real(wp) :: factor
    factor = 5.0_wp
    if (error > 1.0e-8_wp) factor = max(0.2_wp, min(5.0_wp, 0.9_wp * error**(-0.2_wp)))
  end function factor

  !> A state as a vector.
  pure function packed(state) result(y)
    type(state_type), intent(in) :: state
    real(wp) :: y(n_state)
    y = [state%stress, state%delta, state%void_ratio]
  end function packed

  !> A vector as a state.
  pure function unpacked(y) result(state)
    real(wp), intent(in) :: y(n_state)
    type(state_type) :: state
    state = state_type(y(1:6), y(7:12), y(13))
  end function unpacked

end module hypofab_update
