!> One Dormand-Prince step of many material points side by side, one point per lane of the vector registers.
!>
!> The formulas are those of delta_path.f90, wolffersdorff.f90, intergranular.f90 and update.f90, written without branches:
!> what differs between points is selected, never jumped over, so that the compiler's vectoriser takes every loop over
!> lanes. Arguments of logarithms and divisors are kept positive where a lane leaves the domain; such lanes are marked and
!> done again by the scalar update. Powers are written as exp(y log(x)).
!>
!> The file is compiled once per instruction set, each time as a module of its own name (HYPOFAB_BATCH_KERNEL).
module HYPOFAB_BATCH_KERNEL
  use, intrinsic :: iso_fortran_env, only: int64, real64
  use umat_batch_lanes
  use umat_material, only: material_type
  use umat_tableau, only: n_stages, c, a, error_weight, share, vanishing, substep_of_R, plain_substep
  implicit none
  private
  public :: begin_increment, begin_segment, attempt_step

  integer, parameter :: wp = real64
  !> Stands for zero under a logarithm or in a divisor.
  real(wp), parameter :: nothing = 1.0e-290_wp
  !> Between the no and the yes of a mask.
  real(wp), parameter :: half = 0.5_wp
  !> Stands for a speed of zero [strain].
  real(wp), parameter :: slowest = 1.0e-30_wp
  !> log(rho) of rho = 0: every admissible power of it is zero.
  real(wp), parameter :: log_of_zero = -1.0e7_wp
  !> |v| only decays: what is below rounding now stays there (delta_path.f90).
  real(wp), parameter :: negligible = 10.0_wp * epsilon(1.0_wp)
  !> Outside these bounds the scalar update decides.
  real(wp), parameter :: smallest_size = 1.0e-90_wp
  real(wp), parameter :: largest_void_ratio = 50.0_wp, largest_pressure = 5.0_wp, smallest_void_ratio = 1.0e-3_wp, largest_x = 600.0_wp, margin = 1.0e-12_wp

  !> Points of the path at one node of the step.
  type :: node_type
    real(wp) :: speed(width) !< d lambda/dx [strain]
    real(wp) :: log_rho(width)
    real(wp) :: along(width), across(width) !< components of the direction of delta
  end type node_type

contains

  !> Direction, length and first segment of an increment.
  !> @param n     number of lanes, a multiple of width
  !> @param lanes in: stress, delta, void ratio, strain, finite; out: direction, lengths of the first segment and of the
  !>              rest; outcome_begin, or outcome_special
  pure subroutine begin_increment(m, n, lanes, tags)
    type(material_type), intent(in) :: m
    integer, intent(in) :: n
    real(wp), intent(inout) :: lanes(n_lanes, n_fields)
    integer(int64), intent(inout) :: tags(n_lanes, n_tags)
    real(wp) :: largest, length, inverse, along(6), size, turn, largest_delta, smallest_delta, first_length, switch
    integer :: i
    switch = merge(1.0_wp, 0.0_wp, m%intergranular)
    !GCC$ ivdep
    do i = 1, n
      largest = max(abs(lanes(i, l_strain)), abs(lanes(i, l_strain + 1)), abs(lanes(i, l_strain + 2)), &
                    abs(lanes(i, l_strain + 3)), abs(lanes(i, l_strain + 4)), abs(lanes(i, l_strain + 5)))
      length = sqrt(max(1.0e-200_wp, lanes(i, l_strain)**2 + lanes(i, l_strain + 1)**2 + lanes(i, l_strain + 2)**2 + &
                        2.0_wp * (lanes(i, l_strain + 3)**2 + lanes(i, l_strain + 4)**2 + lanes(i, l_strain + 5)**2)))
      inverse = 1.0_wp / length
      along(1) = lanes(i, l_strain) * inverse
      along(2) = lanes(i, l_strain + 1) * inverse
      along(3) = lanes(i, l_strain + 2) * inverse
      along(4) = lanes(i, l_strain + 3) * inverse
      along(5) = lanes(i, l_strain + 4) * inverse
      along(6) = lanes(i, l_strain + 5) * inverse
      lanes(i, l_along) = along(1)
      lanes(i, l_along + 1) = along(2)
      lanes(i, l_along + 2) = along(3)
      lanes(i, l_along + 3) = along(4)
      lanes(i, l_along + 4) = along(5)
      lanes(i, l_along + 5) = along(6)
      lanes(i, l_trace) = along(1) + along(2) + along(3)
      size = sqrt(lanes(i, l_stress)**2 + lanes(i, l_stress + 1)**2 + lanes(i, l_stress + 2)**2 + &
                  2.0_wp * (lanes(i, l_stress + 3)**2 + lanes(i, l_stress + 4)**2 + lanes(i, l_stress + 5)**2))
      lanes(i, l_smallest) = vanishing * size
      largest_delta = max(abs(lanes(i, l_delta)), abs(lanes(i, l_delta + 1)), abs(lanes(i, l_delta + 2)), &
                          abs(lanes(i, l_delta + 3)), abs(lanes(i, l_delta + 4)), abs(lanes(i, l_delta + 5)))
      ! delta + turn along is normal to the direction of strain.
      turn = -(lanes(i, l_delta) * along(1) + lanes(i, l_delta + 1) * along(2) + lanes(i, l_delta + 2) * along(3) + &
               2.0_wp * (lanes(i, l_delta + 3) * along(4) + lanes(i, l_delta + 4) * along(5) + &
                         lanes(i, l_delta + 5) * along(6)))
      smallest_delta = merge(largest_delta, 1.0_wp, largest_delta > 0.0_wp)
      turn = switch * turn
      first_length = merge(min(turn, length), length, turn > 0.0_wp)
      lanes(i, l_length) = first_length
      lanes(i, l_rest) = length - first_length
      lanes(i, l_evaluations) = 0.0_wp
      lanes(i, l_refused) = 0.0_wp
      tags(i, t_kind) = merge(kind_straight, kind_plane, turn > 0.0_wp)
      ! Sizes whose squares would overflow or vanish, and an increment or delta above 1, go to the scalar update.
      tags(i, t_outcome) = merge(outcome_begin, outcome_special, &
                                 min(min(largest, size), smallest_delta) > smallest_size .and. &
                                 max(max(largest, size * 1.0e-90_wp), switch * largest_delta) < 1.0_wp)
    end do
  end subroutine begin_increment

  !> The path of delta in a segment, and the first step; as delta_path and first_substep do. Lanes that are not to begin a
  !> segment keep everything.
  !> @param n     number of lanes, a multiple of width
  !> @param lanes in: kind_straight for a reversal, otherwise loading
  pure subroutine begin_segment(m, n, lanes, tags)
    type(material_type), intent(in) :: m
    integer, intent(in) :: n
    real(wp), intent(inout) :: lanes(n_lanes, n_fields)
    integer(int64), intent(inout) :: tags(n_lanes, n_tags)
    real(wp) :: begins, straight, plane, axis, unfit !< 1 for yes, 0 for no: the vectoriser has no use for logicals
    real(wp) :: R, beta_r, inverse_R, inverse_beta, u, v, d1, d2, d3, d4, d5, d6, square, ahead, rho_square, log_rho, rho_beta
    real(wp) :: inverse_v, ratio, x, kappa, power, exponent, amplitude, speed, wanted, scale
    integer(int64) :: kind
    integer :: i

    inverse_R = 1.0_wp / m%R
    inverse_beta = 1.0_wp / m%beta_r
    if (.not. m%intergranular) then
      !GCC$ ivdep
      do i = 1, n
        begins = merge(1.0_wp, 0.0_wp, tags(i, t_outcome) == outcome_begin)
        lanes(i, l_across) = 0.0_wp
        lanes(i, l_across + 1) = 0.0_wp
        lanes(i, l_across + 2) = 0.0_wp
        lanes(i, l_across + 3) = 0.0_wp
        lanes(i, l_across + 4) = 0.0_wp
        lanes(i, l_across + 5) = 0.0_wp
        lanes(i, l_x) = 0.0_wp
        lanes(i, l_h) = chosen(begins, min(plain_substep, lanes(i, l_length)), lanes(i, l_h))
        lanes(i, l_done) = chosen(begins, 0.0_wp, lanes(i, l_done))
        lanes(i, l_evaluations) = lanes(i, l_evaluations) + begins
        tags(i, t_kind) = kind_fixed
        tags(i, t_outcome) = merge(outcome_going, tags(i, t_outcome), begins > half)
      end do
      return
    end if
    R = m%R
    beta_r = m%beta_r
    !GCC$ ivdep
    do i = 1, n
      begins = merge(1.0_wp, 0.0_wp, tags(i, t_outcome) == outcome_begin)
      straight = merge(1.0_wp, 0.0_wp, tags(i, t_kind) == kind_straight)
      d1 = lanes(i, l_delta)
      d2 = lanes(i, l_delta + 1)
      d3 = lanes(i, l_delta + 2)
      d4 = lanes(i, l_delta + 3)
      d5 = lanes(i, l_delta + 4)
      d6 = lanes(i, l_delta + 5)
      u = d1 * lanes(i, l_along) + d2 * lanes(i, l_along + 1) + d3 * lanes(i, l_along + 2) + &
          2.0_wp * (d4 * lanes(i, l_along + 3) + d5 * lanes(i, l_along + 4) + d6 * lanes(i, l_along + 5))
      d1 = d1 - u * lanes(i, l_along)
      d2 = d2 - u * lanes(i, l_along + 1)
      d3 = d3 - u * lanes(i, l_along + 2)
      d4 = d4 - u * lanes(i, l_along + 3)
      d5 = d5 - u * lanes(i, l_along + 4)
      d6 = d6 - u * lanes(i, l_along + 5)
      square = d1**2 + d2**2 + d3**2 + 2.0_wp * (d4**2 + d5**2 + d6**2)
      v = sqrt(square) * inverse_R
      ahead = max(0.0_wp, u) * inverse_R
      rho_square = ahead**2 + v**2
      log_rho = 0.5_wp * log(min(1.0_wp, max(rho_square, nothing)))
      log_rho = merge(log_rho, log_of_zero, rho_square > nothing)
      rho_beta = exp(beta_r * log_rho)
      plane = merge(1.0_wp - straight, 0.0_wp, v > negligible)
      axis = merge(1.0_wp - straight - plane, 0.0_wp, rho_beta < 1.0_wp)
      inverse_v = 1.0_wp / max(v, negligible)
      ratio = ahead * inverse_v
      x = log(merge(ratio + sqrt(ratio**2 + 1.0_wp), 1.0_wp / max(1.0_wp - rho_beta, negligible), plane > half))
      x = merge(x, 0.0_wp, plane + axis > half)
      kappa = plane * (1.0_wp - rho_beta) * exp(beta_r * log(inverse_v))
      kappa = merge(square, kappa, straight > half)
      power = (axis - plane) * inverse_beta + half * straight
      exponent = plane + axis * (1.0_wp - beta_r)
      amplitude = merge(R * merge(inverse_beta, 1.0_wp, axis > half), 1.0_wp, plane + axis > half)
      speed = amplitude * exp(min(100.0_wp, exponent * log_rho))
      lanes(i, l_exponent) = chosen(begins, exponent, lanes(i, l_exponent))
      lanes(i, l_amplitude) = chosen(begins, amplitude, lanes(i, l_amplitude))
      wanted = min(substep_of_R * R, lanes(i, l_length))
      ! For the scalar update: delta longer than R; delta = 0 where the speed has no limit there; a reversal straight back
      ! through delta = 0, after which nothing but rounding tells where the loading starts.
      unfit = merge(1.0_wp, 0.0_wp, rho_square > 1.0_wp + 1.0e-9_wp) + &
              merge(axis, 0.0_wp, max(1.0_wp - beta_r, rho_beta) <= 0.0_wp) + &
              merge(straight, 0.0_wp, max(v, 1.0e-5_wp - lanes(i, l_rest) * inverse_R) < 1.0e-5_wp)
      kind = merge(kind_plane, merge(kind_axis, kind_fixed, axis > half), plane > half)
      kind = merge(kind_straight, kind, straight > half)
      scale = merge(inverse_v * inverse_R, 1.0_wp, plane > half)
      lanes(i, l_across) = chosen(begins, d1 * scale, lanes(i, l_across))
      lanes(i, l_across + 1) = chosen(begins, d2 * scale, lanes(i, l_across + 1))
      lanes(i, l_across + 2) = chosen(begins, d3 * scale, lanes(i, l_across + 2))
      lanes(i, l_across + 3) = chosen(begins, d4 * scale, lanes(i, l_across + 3))
      lanes(i, l_across + 4) = chosen(begins, d5 * scale, lanes(i, l_across + 4))
      lanes(i, l_across + 5) = chosen(begins, d6 * scale, lanes(i, l_across + 5))
      lanes(i, l_kappa) = chosen(begins, kappa, lanes(i, l_kappa))
      lanes(i, l_start) = chosen(begins, u, lanes(i, l_start))
      lanes(i, l_power) = chosen(begins, power, lanes(i, l_power))
      lanes(i, l_x) = chosen(begins, x, lanes(i, l_x))
      lanes(i, l_h) = chosen(begins, wanted / max(speed, wanted), lanes(i, l_h))
      lanes(i, l_done) = chosen(begins, 0.0_wp, lanes(i, l_done))
      lanes(i, l_evaluations) = lanes(i, l_evaluations) + begins
      tags(i, t_kind) = merge(kind, tags(i, t_kind), begins > half)
      tags(i, t_outcome) = merge(merge(outcome_special, outcome_going, unfit > half), tags(i, t_outcome), begins > half)
    end do
  end subroutine begin_segment

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
    real(wp) :: y(width, 7), k(width, 6, n_stages), to_along(width, n_stages - 1), to_across(width, n_stages - 1), &
         to_N(width, n_stages - 1), bad(width), last(width), short(width), h(width), total(width, 7), error(width)
    real(wp) :: rho_chi, turning, component, squares, before, after, relative, through, speed, size
    real(wp) :: going, accepted, lost !< 1 for yes, 0 for no
    real(wp) :: chi, beta_r, m_T, m_R, R, per_tolerance, per_R
    integer(int64) :: outcome, tag
    integer :: i, j, s, comp

    chi = m%chi
    beta_r = m%beta_r
    short = 0.0_wp
    m_T = m%m_T
    m_R = m%m_R
    R = m%R
    bad = 0.0_wp
    if (m%intergranular) then
      call fit_to_length(m, b, lanes, tags, nodes, last, short, bad)
      do s = 1, n_stages - 1
        !GCC$ ivdep
        do i = 1, width
          tag = tags(b + i, t_kind)
          rho_chi = exp(chi * nodes(s)%log_rho(i))
          component = nodes(s)%along(i) * rho_chi ! (deltahat:D) rho^chi
          turning = component * merge(m_R - m_T, 1.0_wp - m_T, tag == kind_straight)
          speed = nodes(s)%speed(i)
          to_along(i, s) = speed * (rho_chi * m_T + (1.0_wp - rho_chi) * m_R + turning * nodes(s)%along(i))
          to_across(i, s) = speed * turning * nodes(s)%across(i)
          to_N(i, s) = speed * merge(0.0_wp, component, tag == kind_straight)
        end do
      end do
    else
      !GCC$ ivdep
      do i = 1, width
        through = lanes(b + i, l_length) - lanes(b + i, l_done)
        last(i) = merge(1.0_wp, 0.0_wp, lanes(b + i, l_h) >= through)
        lanes(b + i, l_h) = min(lanes(b + i, l_h), through)
      end do
      do s = 1, n_stages - 1
        nodes(s)%speed = 1.0_wp
        to_along(:, s) = 1.0_wp
        to_across(:, s) = 0.0_wp
        to_N(:, s) = 1.0_wp
      end do
    end if

    !GCC$ ivdep
    do i = 1, width
      h(i) = lanes(b + i, l_h)
    end do
    k = 0.0_wp
    do s = 1, n_stages
      call combine(k, nodes, a(:, s), 0.0_wp, total)
      do comp = 1, 6
        do i = 1, width
          y(i, comp) = lanes(b + i, l_stress - 1 + comp) + h(i) * total(i, comp)
        end do
      end do
      do i = 1, width
        y(i, 7) = lanes(b + i, l_done) + h(i) * total(i, 7)
      end do
      j = min(s, n_stages - 1)
      call stress_rate(m, b, lanes, y, to_along(:, j), to_across(:, j), to_N(:, j), k(:, :, s), bad)
    end do
    call combine(k, nodes, error_weight(:6), error_weight(7), total)

    if (m%intergranular) then
      do comp = 1, 6
        !GCC$ ivdep
        do i = 1, width
          y(i, comp) = y(i, comp) + short(i) / max(nodes(6)%speed(i), slowest) * k(i, comp, 7)
        end do
      end do
    end if
    per_tolerance = 1.0_wp / (share * tolerance)
    per_R = merge(1.0_wp / m%R, 0.0_wp, m%intergranular)
    !GCC$ ivdep
    do i = 1, width
      squares = total(i, 1)**2 + total(i, 2)**2 + total(i, 3)**2 + &
              2.0_wp * (total(i, 4)**2 + total(i, 5)**2 + total(i, 6)**2)
      before = lanes(b + i, l_stress)**2 + lanes(b + i, l_stress + 1)**2 + lanes(b + i, l_stress + 2)**2 + &
               2.0_wp * (lanes(b + i, l_stress + 3)**2 + lanes(b + i, l_stress + 4)**2 + lanes(b + i, l_stress + 5)**2)
      after = y(i, 1)**2 + y(i, 2)**2 + y(i, 3)**2 + 2.0_wp * (y(i, 4)**2 + y(i, 5)**2 + y(i, 6)**2)
    relative = h(i) * per_tolerance * max(sqrt(squares / max(max(before, after), nothing)), abs(total(i, 7)) * per_R)
      error(i) = relative
      going = merge(1.0_wp, 0.0_wp, tags(b + i, t_outcome) == outcome_going)
      accepted = merge(going, 0.0_wp, relative <= 1.0_wp)
      lost = bad(i) + merge(accepted, 0.0_wp, after < lanes(b + i, l_smallest)**2) + merge(0.0_wp, 1.0_wp, relative < 1.0e30_wp)
      outcome = merge(outcome_segment_done, tags(b + i, t_outcome), accepted * last(i) > half)
      tags(b + i, t_outcome) = merge(outcome_special, outcome, going * lost > half)
      lanes(b + i, l_evaluations) = lanes(b + i, l_evaluations) + going * (n_stages - 1)
      lanes(b + i, l_refused) = lanes(b + i, l_refused) + going - accepted
      lanes(b + i, l_x) = lanes(b + i, l_x) + accepted * h(i)
      lanes(b + i, l_done) = chosen(accepted, y(i, 7), lanes(b + i, l_done))
      lanes(b + i, l_stress) = chosen(accepted, y(i, 1), lanes(b + i, l_stress))
      lanes(b + i, l_stress + 1) = chosen(accepted, y(i, 2), lanes(b + i, l_stress + 1))
      lanes(b + i, l_stress + 2) = chosen(accepted, y(i, 3), lanes(b + i, l_stress + 2))
      lanes(b + i, l_stress + 3) = chosen(accepted, y(i, 4), lanes(b + i, l_stress + 3))
      lanes(b + i, l_stress + 4) = chosen(accepted, y(i, 5), lanes(b + i, l_stress + 4))
      lanes(b + i, l_stress + 5) = chosen(accepted, y(i, 6), lanes(b + i, l_stress + 5))
    end do
    ! The next step's size, or the end of the segment.
    if (any(tags(b + 1:b + width, t_outcome) == outcome_going)) then
      !GCC$ ivdep
      do i = 1, width
        relative = max(0.2_wp, min(5.0_wp, 0.9_wp * exp(-0.2_wp * log(max(error(i), 1.0e-8_wp)))))
        lanes(b + i, l_h) = h(i) * merge(relative, 1.0_wp, tags(b + i, t_outcome) == outcome_going)
      end do
    end if
    if (m%intergranular) then
      !GCC$ ivdep
      do i = 1, width
        ! Where delta ends; Eq. (14) for what the step lacks of the length.
        size = R * exp(nodes(6)%log_rho(i))
        turning = exp(beta_r * nodes(6)%log_rho(i)) * nodes(6)%along(i) * short(i)
        to_along(i, 1) = (size - turning) * nodes(6)%along(i) + short(i)
        to_across(i, 1) = (size - turning) * nodes(6)%across(i)
      end do
      do comp = 0, 5
        !GCC$ ivdep
        do i = 1, width
          lanes(b + i, l_delta + comp) = merge(to_along(i, 1) * lanes(b + i, l_along + comp) + &
                                        to_across(i, 1) * lanes(b + i, l_across + comp), lanes(b + i, l_delta + comp), &
                                               tags(b + i, t_outcome) == outcome_segment_done)
        end do
      end do
    end if
    !GCC$ ivdep
    do i = 1, width
lanes(b + i, l_e) = merge((1.0_wp + lanes(b + i, l_e)) * exp(lanes(b + i, l_trace) * lanes(b + i, l_length)) - 1.0_wp, &
                                lanes(b + i, l_e), tags(b + i, t_outcome) == outcome_segment_done)
    end do
  end subroutine attempt_block

  !> The weighted sum of the stages, and of the speeds at their nodes.
  !> @param weights of the first six stages
  !> @param seventh of the last, whose node is the sixth's
  pure subroutine combine(k, nodes, weights, seventh, total)
    real(wp), intent(in) :: k(width, 6, n_stages), weights(6), seventh
    type(node_type), intent(in) :: nodes(n_stages - 1)
    real(wp), intent(out) :: total(width, 7)
    real(wp) :: w1, w2, w3, w4, w5, w6
    integer :: i, comp
    w1 = weights(1)
    w2 = weights(2)
    w3 = weights(3)
    w4 = weights(4)
    w5 = weights(5)
    w6 = weights(6)
    do comp = 1, 6
      !GCC$ ivdep
      do i = 1, width
        total(i, comp) = w1 * k(i, comp, 1) + w2 * k(i, comp, 2) + w3 * k(i, comp, 3) + w4 * k(i, comp, 4) + &
                         w5 * k(i, comp, 5) + w6 * k(i, comp, 6) + seventh * k(i, comp, 7)
      end do
    end do
    !GCC$ ivdep
    do i = 1, width
     total(i, 7) = w1 * nodes(1)%speed(i) + w2 * nodes(2)%speed(i) + w3 * nodes(3)%speed(i) + w4 * nodes(4)%speed(i) + &
                    w5 * nodes(5)%speed(i) + (w6 + seventh) * nodes(6)%speed(i)
    end do
  end subroutine combine

  !> Rates of stress with respect to the path's parameter; theory.md Eqs. (1) to (10), (11) and (13).
  !> @param y         stress, and length of strain done in the segment
  !> @param along, across, to_N the rate is L:(along d + across d_normal) + to_N N
  !> @param rate      filled
  !> @param bad       set to 1 where the stress or the void ratio is outside the domain or near its border
  pure subroutine stress_rate(m, b, lanes, y, along, across, to_N, rate, bad)
    type(material_type), intent(in) :: m
    integer, intent(in) :: b
    real(wp), intent(in) :: lanes(n_lanes, n_fields), y(width, 7), along(width), across(width), to_N(width)
    real(wp), intent(out) :: rate(width, 6)
    real(wp), intent(inout) :: bad(width)
    real(wp) :: e, pressure, inverse, t1, t2, t3, t4, t5, t6, d1, d2, d3, square, cube, on_axis, base, F, log_p, power, growth, &
                limiting, by_both, density, f_d, f_s, z1, z2, z3, z4, z5, z6, identity, dyad, N, both, of_that
    real(wp) :: p_t, h_s, inverse_h_s, exponent, alpha, beta, limit, e_d0, e_c0, log_e_c0, inverse_range, f_b0, f_b0_by_e_i, third, &
                largest, inside
    integer :: i
    p_t = m%p_t
    h_s = m%h_s
    exponent = m%n
    alpha = m%alpha
    beta = m%beta
    limit = m%a
    e_d0 = m%e_d0
    e_c0 = m%e_c0
    log_e_c0 = log(e_c0)
    inverse_range = 1.0_wp / (e_c0 - e_d0)
    f_b0 = m%f_b0
    f_b0_by_e_i = f_b0 / m%e_i0
    inverse_h_s = 1.0_wp / h_s
    third = 1.0_wp / 3.0_wp
    largest = largest_pressure * h_s
    !GCC$ ivdep
    do i = 1, width
      e = (1.0_wp + lanes(b + i, l_e)) * exp(lanes(b + i, l_trace) * y(i, 7)) - 1.0_wp
      pressure = 3.0_wp * p_t - (y(i, 1) + y(i, 2) + y(i, 3))
      inside = merge(1.0_wp, 0.0_wp, min(pressure, largest - pressure) > nothing)
      inside = merge(inside, 0.0_wp, min(e - smallest_void_ratio, largest_void_ratio - e) > 0.0_wp)
      pressure = chosen(inside, pressure, h_s)
      e = chosen(inside, e, e_c0)
      inverse = 1.0_wp / pressure
      t1 = (p_t - y(i, 1)) * inverse
      t2 = (p_t - y(i, 2)) * inverse
      t3 = (p_t - y(i, 3)) * inverse
      t4 = -y(i, 4) * inverse
      t5 = -y(i, 5) * inverse
      t6 = -y(i, 6) * inverse
      ! Sylvester's criterion.
  inside = merge(inside, 0.0_wp, min(min(t1, t1 * t2 - t4 * t4), t1 * (t2 * t3 - t6 * t6) - t4 * (t4 * t3 - t5 * t6) + &
                                         t5 * (t4 * t6 - t5 * t2)) > margin)
      bad(i) = max(bad(i), 1.0_wp - inside)
      d1 = t1 - third
      d2 = t2 - third
      d3 = t3 - third
      square = d1 * d1 + d2 * d2 + d3 * d3 + 2.0_wp * (t4 * t4 + t5 * t5 + t6 * t6)
      cube = 3.0_wp * (d1 * (d2 * d3 - t6 * t6) - t4 * (t4 * d3 - t5 * t6) + t5 * (t4 * t6 - t5 * d2))
      ! F, Eqs. (3) to (5), with sqrt(2) tan(psi) cos(3 theta) = -6 cube/square multiplied out; the axis has none.
      on_axis = merge(1.0_wp, 0.0_wp, square <= 1.0e-60_wp)
      limiting = chosen(inside, 2.0_wp * (square + on_axis) - 6.0_wp * cube, 1.0_wp) ! positive inside the domain
      by_both = 1.0_wp / (limiting * (square + third)) ! one division for two
      base = 0.375_wp * square + (2.0_wp - 3.0_wp * square) * (square + on_axis) * (by_both * (square + third))
      F = sqrt(max(base, 0.0_wp)) - sqrt(0.375_wp * square)
      log_p = log(pressure * inverse_h_s)
      power = exp(exponent * log_p)
      growth = exp(power) ! every limiting void ratio is that of p = 0 divided by it
      density = (e * growth - e_d0) * inverse_range
      f_d = exp(alpha * log(max(density, nothing)))
      f_d = merge(f_d, 0.0_wp, density > nothing)
      ! Eqs. (7) to (9): f_e and the power of pressure in one exponential.
      f_s = (f_b0 + f_b0_by_e_i * growth) * by_both * limiting * exp((1.0_wp - exponent) * log_p + beta * (log_e_c0 - log(e) - power))
      identity = f_s * F * F
      dyad = f_s * limit * limit
      N = to_N(i) * f_s * f_d * limit * F
      z1 = along(i) * lanes(b + i, l_along) + across(i) * lanes(b + i, l_across)
      z2 = along(i) * lanes(b + i, l_along + 1) + across(i) * lanes(b + i, l_across + 1)
      z3 = along(i) * lanes(b + i, l_along + 2) + across(i) * lanes(b + i, l_across + 2)
      z4 = along(i) * lanes(b + i, l_along + 3) + across(i) * lanes(b + i, l_across + 3)
      z5 = along(i) * lanes(b + i, l_along + 4) + across(i) * lanes(b + i, l_across + 4)
      z6 = along(i) * lanes(b + i, l_along + 5) + across(i) * lanes(b + i, l_across + 5)
      of_that = dyad * (t1 * z1 + t2 * z2 + t3 * z3 + 2.0_wp * (t4 * z4 + t5 * z5 + t6 * z6))
      both = of_that + 2.0_wp * N ! T*hat is That but for a third of the unit tensor
      rate(i, 1) = identity * z1 + both * t1 - third * N
      rate(i, 2) = identity * z2 + both * t2 - third * N
      rate(i, 3) = identity * z3 + both * t3 - third * N
      rate(i, 4) = identity * z4 + both * t4
      rate(i, 5) = identity * z5 + both * t5
      rate(i, 6) = identity * z6 + both * t6
    end do
  end subroutine stress_rate

  !> The path at one node of the step, as path_point.
  !> @param node_at place of the node in the step, 0 to 1
  pure subroutine path_node(m, b, lanes, tags, node_at, node)
    type(material_type), intent(in) :: m
    integer, intent(in) :: b
    real(wp), intent(in) :: lanes(n_lanes, n_fields), node_at
    integer(int64), intent(in) :: tags(n_lanes, n_tags)
    type(node_type), intent(inout) :: node
    real(wp) :: x, decay, inverse, sine, argument, log_rho, u, kappa, beta_r, per_R_squared, held_along, held_across
    integer(int64) :: tag
    integer :: i
    beta_r = m%beta_r
    per_R_squared = 1.0_wp / m%R**2
    !GCC$ ivdep
    do i = 1, width
      tag = tags(b + i, t_kind)
      kappa = lanes(b + i, l_kappa)
      x = lanes(b + i, l_x) + node_at * lanes(b + i, l_h)
      u = lanes(b + i, l_start) + x
      decay = exp(-min(x, largest_x))
      inverse = 1.0_wp / (1.0_wp + decay * decay)
      sine = 2.0_wp * decay * inverse
      ! rho is a power of this; 1 where delta stays at |delta| = R.
      argument = 1.0_wp + kappa * exp(beta_r * log(sine))
      argument = merge(argument, merge(1.0_wp - decay, 1.0_wp, tag == kind_axis), tag == kind_plane)
      argument = merge((kappa + u * u) * per_R_squared, argument, tag == kind_straight)
      log_rho = lanes(b + i, l_power) * log(max(argument, nothing))
      log_rho = merge(log_rho, log_of_zero, argument > nothing)
      node%log_rho(i) = log_rho
      node%speed(i) = lanes(b + i, l_amplitude) * exp(lanes(b + i, l_exponent) * log_rho)
      node%along(i) = merge((1.0_wp - decay * decay) * inverse, 1.0_wp, tag == kind_plane)
      node%across(i) = merge(sine, 0.0_wp, tag == kind_plane)
    end do
    if (.not. any(tags(b + 1:b + width, t_kind) == kind_straight)) return
    !GCC$ ivdep
    do i = 1, width
      tag = tags(b + i, t_kind)
      held_along = node%along(i)
      held_across = node%across(i)
      u = lanes(b + i, l_start) + lanes(b + i, l_x) + node_at * lanes(b + i, l_h)
      inverse = 1.0_wp / sqrt(max(lanes(b + i, l_kappa) + u * u, nothing))
      node%along(i) = merge(u * inverse, held_along, tag == kind_straight)
      node%across(i) = merge(inverse, held_across, tag == kind_straight)
    end do
  end subroutine path_node

  !> The step's size and nodes: as shorten_to_length, the step is shortened to the length of strain that is left, by the
  !> quadrature of the step itself, if it covers more. Lanes that have converged stay as they are, so that no lane depends
  !> on its neighbours.
  !> @param nodes filled
  !> @param last  1 where the step covers the length, otherwise 0
  !> @param short length of strain that such a step still lacks, a small part of it that is to be added by the rates at its
  !>              end; 0 elsewhere [strain]
  !> @param bad   set to 1 where the iteration fails
  pure subroutine fit_to_length(m, b, lanes, tags, nodes, last, short, bad)
    type(material_type), intent(in) :: m
    integer, intent(in) :: b
    real(wp), intent(inout) :: lanes(n_lanes, n_fields), bad(width)
    integer(int64), intent(in) :: tags(n_lanes, n_tags)
    type(node_type), intent(inout) :: nodes(n_stages - 1)
    real(wp), intent(out) :: last(width), short(width)
    !> What the square of the relative error of the length may bring about: the error itself is made up for.
    real(wp), parameter :: fit = 1.0e-13_wp
    integer, parameter :: n_passes = 12
    real(wp), parameter :: b1 = a(1, 7), b3 = a(3, 7), b4 = a(4, 7), b5 = a(5, 7), b6 = a(6, 7)
    real(wp) :: largest(width), lower(width), upper(width), active(width)
    real(wp) :: length, h, excess, growth, change, bend, quotient, rho_beta, middle, beta_r, on_plane, measures, fits, &
                open_here, next, straight_on, below, above
    integer :: i, pass

    beta_r = m%beta_r
    call path_node(m, b, lanes, tags, c(1), nodes(1))
    ! First guess, by the series of the length in the step; a bisection may improve it.
    !GCC$ ivdep
    do i = 1, width
      measures = merge(1.0_wp, 0.0_wp, tags(b + i, t_kind) <= kind_straight)
      on_plane = merge(1.0_wp, 0.0_wp, tags(b + i, t_kind) == kind_plane)
      length = lanes(b + i, l_length) - lanes(b + i, l_done)
      h = lanes(b + i, l_h)
      largest(i) = h
      lower(i) = 0.0_wp
      upper(i) = 2.0_wp * h
      last(i) = merge(measures, 0.0_wp, h >= length)
      active(i) = 1.0_wp - measures
      short(i) = 0.0_wp
      rho_beta = exp(beta_r * nodes(1)%log_rho(i))
      call growth_of_speed(beta_r, on_plane, rho_beta, nodes(1)%along(i), nodes(1)%across(i), growth, change, bend)
      quotient = length / max(nodes(1)%speed(i), slowest)
      quotient = merge(quotient, h, abs(growth * quotient) < 1.0_wp)
      h = min(merge(inverted(quotient, growth, change, bend), h, quotient < h), h)
      lanes(b + i, l_h) = chosen(measures, min(length, largest(i)), merge(h, largest(i), h > 0.0_wp))
    end do
    do pass = 1, n_passes
      call path_node(m, b, lanes, tags, c(3), nodes(3))
      call path_node(m, b, lanes, tags, c(4), nodes(4))
      call path_node(m, b, lanes, tags, c(5), nodes(5))
      call path_node(m, b, lanes, tags, c(6), nodes(6))
      !GCC$ ivdep
      do i = 1, width
        length = lanes(b + i, l_length) - lanes(b + i, l_done)
        h = lanes(b + i, l_h)
     excess = h * (b1 * nodes(1)%speed(i) + b3 * nodes(3)%speed(i) + b4 * nodes(4)%speed(i) + b5 * nodes(5)%speed(i) + &
                      b6 * nodes(6)%speed(i)) - length
        on_plane = merge(1.0_wp, 0.0_wp, tags(b + i, t_kind) == kind_plane)
        rho_beta = exp(beta_r * nodes(6)%log_rho(i))
        call growth_of_speed(beta_r, on_plane, rho_beta, nodes(6)%along(i), nodes(6)%across(i), growth, change, bend)
        quotient = excess / max(nodes(6)%speed(i), slowest)
        next = h + inverted(-quotient, growth, change, bend)
        straight_on = h - quotient
        next = merge(next, straight_on, abs(growth * quotient) < 0.3_wp)
        open_here = active(i)
        fits = merge(open_here, 0.0_wp, excess**2 * (abs(growth * h) + 0.1_wp) <= fit * length**2)
        last(i) = max(fits, last(i))
        short(i) = short(i) - fits * excess
        active(i) = (open_here - fits) * merge(1.0_wp, 0.0_wp, max(largest(i) - h, excess) > 0.0_wp)
        below = lower(i)
        below = merge(h, below, excess < 0.0_wp)
        above = upper(i)
        above = merge(h, above, excess > 0.0_wp)
        lower(i) = below
        upper(i) = above
        middle = half * (below + above)
        next = merge(next, middle, min(next - below, above - next) > 0.0_wp)
        lanes(b + i, l_h) = h + active(i) * (min(next, largest(i)) - h)
      end do
      if (.not. any(active > half)) exit
    end do
    !GCC$ ivdep
    do i = 1, width
      bad(i) = max(active(i), merge(1.0_wp, bad(i), lanes(b + i, l_x) + lanes(b + i, l_h) > largest_x))
    end do
    call path_node(m, b, lanes, tags, c(2), nodes(2))
  end subroutine fit_to_length

  !> yes where mask is 1, no where it is 0.
  pure function chosen(mask, yes, no) result(value)
    real(wp), intent(in) :: mask, yes, no
    real(wp) :: value
    value = merge(yes, no, mask > half)
  end function chosen

  !> d ln(speed)/dx and its first two derivatives.
  pure subroutine growth_of_speed(beta_r, on_plane, rho_beta, cosine, sine, growth, change, bend)
    real(wp), intent(in) :: beta_r, on_plane, rho_beta, cosine, sine
    real(wp), intent(out) :: growth, change, bend
    real(wp) :: left, inverse, on_axis
    left = 1.0_wp - rho_beta
    inverse = 1.0_wp / max(rho_beta, 1.0e-12_wp) ! nearer to zero no series helps
    on_axis = (1.0_wp - beta_r) / beta_r * left * inverse
    growth = chosen(on_plane, left * cosine, on_axis)
    change = chosen(on_plane, left * sine**2 - beta_r * rho_beta * growth * cosine, -on_axis * inverse)
    bend = chosen(on_plane, -beta_r * rho_beta * (beta_r * growth**2 * cosine + change * cosine + 2.0_wp * growth * sine**2) - &
                  2.0_wp * left * cosine * sine**2, on_axis * inverse * (rho_beta + 2.0_wp * left) * inverse)
  end subroutine growth_of_speed

  !> The step that covers quotient (length/speed), by the inverse of the series of the length in the step.
  pure function inverted(quotient, growth, change, bend) result(h)
    real(wp), intent(in) :: quotient, growth, change, bend
    real(wp) :: h
    real(wp) :: a2, a3, a4
    a2 = half * growth
    a3 = (growth**2 + change) * (1.0_wp / 6.0_wp)
    a4 = (growth**3 + 3.0_wp * growth * change + bend) * (1.0_wp / 24.0_wp)
    h = quotient * (1.0_wp - quotient * (a2 - quotient * (2.0_wp * a2**2 - a3 - quotient * (5.0_wp * a2 * (a2**2 - a3) + a4))))
  end function inverted

end module HYPOFAB_BATCH_KERNEL
