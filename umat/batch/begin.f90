!> The start of an increment, and of a segment on one branch, of many points side by side: update.f90 and delta_path.f90,
!> written without branches.
!>
!> Compiled once per instruction set, each time as a module of its own name (kernel.cmake).
module umat_batch_begin_portable
  use, intrinsic :: iso_fortran_env, only: int64, real64
  use umat_lanes
  use umat_many_lanes, only: n_lanes
  use umat_material, only: material_type
  use umat_delta_path, only: axis_power
  use umat_integration, only: options_type, vanishing, first_step, first_from_zero
  implicit none
  private
  public :: begin_increment, begin_segment

  integer, parameter :: wp = real64
  !> log(rho) of rho = 0: every admissible power of it is zero.
  real(wp), parameter :: log_of_zero = -1.0e7_wp
  !> |v| only decays: what is below rounding now stays there (delta_path.f90).
  real(wp), parameter :: negligible = 10.0_wp * epsilon(1.0_wp)
  !> Sizes below are left to the scalar update.
  real(wp), parameter :: smallest_size = 1.0e-90_wp
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
    real(wp) :: pressure, p_t, lowest
    integer :: i
    p_t = m%p_t
    lowest = smallest_pressure * m%h_s
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
      lanes(i, l_done) = 0.0_wp
      lanes(i, l_evaluations) = 0.0_wp
      lanes(i, l_refused) = 0.0_wp
      tags(i, t_kind) = merge(kind_straight, kind_plane, turn > 0.0_wp)
      pressure = 3.0_wp * p_t - (lanes(i, l_stress) + lanes(i, l_stress + 1) + lanes(i, l_stress + 2))
      ! Sizes whose squares would overflow or vanish, an increment or delta above 1, and a stress that is no pressure go to
      ! the scalar update.
      tags(i, t_outcome) = merge(outcome_begin, outcome_special, &
                                 min(min(largest, size), smallest_delta) > smallest_size .and. &
                                 max(max(largest, size * 1.0e-90_wp), switch * largest_delta) < 1.0_wp .and. &
                                 pressure > max(lowest, smallest_share * size))
    end do
  end subroutine begin_increment

  !> The path of delta in a segment, and the first step; as delta_path and first_substep do. Lanes that are not to begin a
  !> segment keep everything.
  !> @param n     number of lanes, a multiple of width
  !> @param lanes in: kind_straight for a reversal, otherwise loading
  pure subroutine begin_segment(m, options, n, lanes, tags)
    type(material_type), intent(in) :: m
    type(options_type), intent(in) :: options
    integer, intent(in) :: n
    real(wp), intent(inout) :: lanes(n_lanes, n_fields)
    integer(int64), intent(inout) :: tags(n_lanes, n_tags)
    real(wp) :: begins, straight, plane, axis, unfit !< 1 for yes, 0 for no: the vectoriser has no use for logicals
    real(wp) :: R, beta_r, inverse_R, inverse_beta, u, v, d1, d2, d3, d4, d5, d6, square, ahead, rho_square, log_rho, rho_beta
    real(wp) :: inverse_v, ratio, x, kappa, power, speed, wanted, scale, whole, inverse, chi, decay, left
    real(wp) :: slope, h, guess, first, from_zero
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
        lanes(i, l_h) = chosen(begins, lanes(i, l_length), lanes(i, l_h))
        lanes(i, l_wanted) = chosen(begins, lanes(i, l_length), lanes(i, l_wanted))
        lanes(i, l_speed) = 1.0_wp
        lanes(i, l_rho) = 1.0_wp
        lanes(i, l_done) = chosen(begins, 0.0_wp, lanes(i, l_done))
        lanes(i, l_evaluations) = lanes(i, l_evaluations) + begins
        tags(i, t_kind) = kind_fixed
        tags(i, t_outcome) = merge(outcome_going, tags(i, t_outcome), begins > half)
      end do
      return
    end if
    R = m%R
    first = first_step(options, with_tangent=.false.) * R
    from_zero = first_from_zero(options) * R
    chi = m%chi
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
      ahead = chosen(straight, u, max(0.0_wp, u)) * inverse_R
      rho_square = ahead**2 + v**2
      log_rho = 0.5_wp * log(max(rho_square, nothing))
      log_rho = chosen(straight, log_rho, min(log_rho, 0.0_wp))
      log_rho = merge(log_rho, log_of_zero, rho_square > nothing)
      rho_beta = exp(beta_r * log_rho)
      plane = merge(1.0_wp - straight, 0.0_wp, v > negligible)
      axis = merge(1.0_wp - straight - plane, 0.0_wp, ahead < 1.0_wp - negligible)
      inverse_v = 1.0_wp / max(v, negligible)
      ratio = max(ahead, 0.0_wp) * inverse_v
      decay = axis * (1.0_wp - sqrt(sqrt(min(1.0_wp, max(ahead, 0.0_wp))))) ! the root of order axis_power
      x = log(merge(ratio + sqrt(ratio**2 + 1.0_wp), 1.0_wp / max(decay, negligible), plane > half))
      x = merge(x, 0.0_wp, plane + axis > half)
      kappa = plane * (1.0_wp - rho_beta) * exp(beta_r * log(inverse_v))
      kappa = merge(square, kappa, straight > half)
      power = axis_power * axis - plane * inverse_beta + half * straight
      left = chosen(axis, decay * loss(decay, axis_power * beta_r, rho_beta), 1.0_wp - rho_beta)
      speed = chosen(plane, R * min(1.0_wp, sqrt(rho_square)), 1.0_wp)
      speed = chosen(axis, R * axis_power * (1.0_wp - decay)**(axis_power - 1) / &
                     max(1.0e-100_wp, loss(decay, axis_power * beta_r, rho_beta)), speed)
      ! The direction of delta: tanh x and sech x on a plane path, parts of d and of the normal part of delta on a straight one.
      whole = sqrt(rho_square)
      inverse = 1.0_wp / max(whole, negligible)
      lanes(i, l_node_along) = chosen(begins, chosen(plane + straight, ahead * inverse, 1.0_wp), lanes(i, l_node_along))
      lanes(i, l_node_across) = chosen(begins, chosen(plane, v * inverse, straight * inverse_R * inverse), &
                                       lanes(i, l_node_across))
      lanes(i, l_speed) = chosen(begins, speed, lanes(i, l_speed))
      lanes(i, l_rho) = chosen(begins, chosen(straight, whole, min(whole, 1.0_wp)), lanes(i, l_rho))
      lanes(i, l_left) = chosen(begins, left, lanes(i, l_left))
      lanes(i, l_decay) = chosen(begins, decay, lanes(i, l_decay))
      lanes(i, l_rho_chi) = chosen(begins, exp(chi * log_rho), lanes(i, l_rho_chi))
      ! first_guess of delta_path.f90.
      wanted = min(first, lanes(i, l_length))
      wanted = merge(wanted, min(wanted, from_zero), max(x, half - axis) > 0.0_wp)
      slope = speed * chosen(plane, left * lanes(i, l_node_along), (axis_power - 1) * decay / max(1.0_wp - decay, 1.0e-100_wp))
      h = 2.0_wp * wanted / max(speed + sqrt(speed**2 + 2.0_wp * slope * wanted), 1.0e-100_wp)
      guess = log(max(decay, negligible) / &
                  max(negligible, 1.0_wp - sqrt(sqrt(min(0.9_wp, max(ahead, 0.0_wp) + wanted * inverse_R)))))
      guess = merge(guess, 1.0e100_wp, guess > 0.0_wp)
      h = chosen(axis, min(guess, merge(h, 1.0e100_wp, speed > 0.0_wp)), h)
      h = chosen(plane + axis, h, wanted)
      ! For the scalar update: delta longer than R; no first guess; a reversal straight back
      ! through delta = 0, after which nothing but rounding tells where the loading starts.
      unfit = merge(1.0_wp, 0.0_wp, rho_square > 1.0_wp + 1.0e-9_wp) + &
              merge(0.0_wp, 1.0_wp, h < 1.0e50_wp) + &
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
      lanes(i, l_h) = chosen(begins, h, lanes(i, l_h))
      lanes(i, l_wanted) = chosen(begins, wanted, lanes(i, l_wanted))
      lanes(i, l_done) = chosen(begins, 0.0_wp, lanes(i, l_done))
      lanes(i, l_evaluations) = lanes(i, l_evaluations) + begins
      tags(i, t_kind) = merge(kind, tags(i, t_kind), begins > half)
      tags(i, t_outcome) = merge(merge(outcome_special, outcome_going, unfit > half), tags(i, t_outcome), begins > half)
    end do
  end subroutine begin_segment

  include 'series.inc'

end module umat_batch_begin_portable
