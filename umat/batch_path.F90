!> The path of the intergranular strain of many points side by side: delta_path.f90 at the nodes of a step.
!>
!> Where a step is short against the path, as most are, the path at a node follows by series from what is known at the
!> step's start: no logarithm or exponential is taken. Lanes for which the series do not reach are done in full.
!>
!> Compiled once per instruction set, each time as a module of its own name (HYPOFAB_BATCH_PATH).
module HYPOFAB_BATCH_PATH
  use, intrinsic :: iso_fortran_env, only: int64, real64
  use umat_batch_lanes
  use umat_material, only: material_type
  use umat_tableau, only: n_stages, c, a
  implicit none
  private
  public :: node_type, path_end_type, place_nodes

  integer, parameter :: wp = real64
  !> Stands for a speed of zero [strain].
  real(wp), parameter :: slowest = 1.0e-30_wp
  !> log(rho) of rho = 0: every admissible power of it is zero.
  real(wp), parameter :: log_of_zero = -1.0e7_wp
  !> A path further out is left to the scalar update.
  real(wp), parameter :: largest_x = 600.0_wp
  !> Steps of the path's parameter, and changes of what rho is a power of, that the series bridge.
  real(wp), parameter :: reach_of_step = 0.25_wp, lowest_change = -0.22_wp, highest_change = 0.28_wp

  !> A point of the path.
  type :: node_type
    real(wp) :: speed(width) !< d lambda/dx [strain]
    real(wp) :: along(width), across(width) !< components of the direction of delta
    real(wp) :: log_rho(width) !< change of log(rho) since the step's start; where far: log(rho) itself
    real(wp) :: rho_chi(width) !< rho^chi
    real(wp) :: far(width) !< 1 where the series do not reach, otherwise 0
  end type node_type

  !> What else is known at the end of a step.
  type :: path_end_type
    real(wp) :: rho(width), rho_beta(width) !< rho, rho^beta_r
    real(wp) :: short(width) !< length of strain that the step still lacks, to be made up for by the rates [strain]
    real(wp) :: last(width) !< 1 where the step ends the segment, otherwise 0
  end type path_end_type

contains

  !> The step's size and nodes: as shorten_to_length, the step is shortened to the length of strain that is left, by the
  !> quadrature of the step itself, if it covers more. Lanes that have converged stay as they are, so that no lane depends
  !> on its neighbours.
  !> @param b     lanes b + 1 to b + width
  !> @param lanes in: step wanted; out: step
  !> @param nodes filled
  !> @param goal  the step's end; short is a small part of the step, and zero where it does not end the segment
  !> @param bad   set to 1 where the iteration fails
  pure subroutine place_nodes(m, b, lanes, tags, nodes, goal, bad)
    type(material_type), intent(in) :: m
    integer, intent(in) :: b
    real(wp), intent(inout) :: lanes(n_lanes, n_fields), bad(width)
    integer(int64), intent(in) :: tags(n_lanes, n_tags)
    type(node_type), intent(inout) :: nodes(n_stages - 1)
    type(path_end_type), intent(out) :: goal
    !> What the square of the length's error, relative to the length or a tenth of R, may bring about: the error itself is
    !> made up for.
    real(wp), parameter :: fit = 1.0e-19_wp
    integer, parameter :: n_passes = 12
    real(wp), parameter :: b1 = a(1, 7), b3 = a(3, 7), b4 = a(4, 7), b5 = a(5, 7), b6 = a(6, 7)
    real(wp) :: largest(width), lower(width), upper(width), active(width), excess(width)
    real(wp) :: length, h, growth, change, bend, twist, quotient, beta_r, on_plane, measures, fits, open_here, next, straight_on, &
                a_tenth_of_R
    integer :: i, pass

    beta_r = m%beta_r
    a_tenth_of_R = 0.1_wp * m%R
    ! The start, and a first guess of the step by the series of the length in it; a bisection may improve it.
    !GCC$ ivdep
    do i = 1, width
      nodes(1)%speed(i) = lanes(b + i, l_speed)
      nodes(1)%along(i) = lanes(b + i, l_node_along)
      nodes(1)%across(i) = lanes(b + i, l_node_across)
      nodes(1)%log_rho(i) = 0.0_wp
      nodes(1)%rho_chi(i) = lanes(b + i, l_rho_chi)
      measures = merge(1.0_wp, 0.0_wp, tags(b + i, t_kind) <= kind_straight)
      on_plane = merge(1.0_wp, 0.0_wp, tags(b + i, t_kind) == kind_plane)
      length = lanes(b + i, l_length) - lanes(b + i, l_done)
      h = lanes(b + i, l_h)
      largest(i) = h
      lower(i) = 0.0_wp
      upper(i) = 2.0_wp * h
      goal%last(i) = merge(measures, 0.0_wp, h >= length)
      active(i) = 1.0_wp - measures
      goal%short(i) = 0.0_wp
      call growth_of_speed(beta_r, on_plane, lanes(b + i, l_rho_beta), nodes(1)%along(i), nodes(1)%across(i), growth, &
                           change, bend, twist)
      quotient = length / max(nodes(1)%speed(i), slowest)
      quotient = merge(quotient, h, abs(growth * quotient) < 1.0_wp)
      h = min(merge(inverted(quotient, growth, change, bend, twist), h, quotient < h), h)
      lanes(b + i, l_h) = chosen(measures, min(length, largest(i)), merge(h, largest(i), h > 0.0_wp))
    end do
    do pass = 1, n_passes
      call node_at(m, b, lanes, tags, c(3), nodes(3))
      call node_at(m, b, lanes, tags, c(4), nodes(4))
      call node_at(m, b, lanes, tags, c(5), nodes(5))
      call node_at(m, b, lanes, tags, c(6), nodes(6))
      !GCC$ ivdep
      do i = 1, width
        length = lanes(b + i, l_length) - lanes(b + i, l_done)
        h = lanes(b + i, l_h)
        excess(i) = h * (b1 * nodes(1)%speed(i) + b3 * nodes(3)%speed(i) + b4 * nodes(4)%speed(i) + &
                         b5 * nodes(5)%speed(i) + b6 * nodes(6)%speed(i)) - length
        ! The speed's growth in the step stands for its derivative at the end.
        growth = 3.0_wp * (1.0_wp - nodes(1)%speed(i) / max(nodes(6)%speed(i), slowest))
        open_here = active(i)
        fits = merge(open_here, 0.0_wp, excess(i)**2 * (abs(growth) + 0.1_wp) <= fit * min(length, a_tenth_of_R)**2)
        goal%last(i) = max(fits, goal%last(i))
        goal%short(i) = goal%short(i) - fits * excess(i)
        active(i) = (open_here - fits) * merge(1.0_wp, 0.0_wp, max(largest(i) - h, excess(i)) > 0.0_wp)
      end do
      call finish(m, b, lanes, nodes(6), goal)
      if (.not. any(active > half)) exit
      !GCC$ ivdep
      do i = 1, width
        h = lanes(b + i, l_h)
        on_plane = merge(1.0_wp, 0.0_wp, tags(b + i, t_kind) == kind_plane)
        call growth_of_speed(beta_r, on_plane, goal%rho_beta(i), nodes(6)%along(i), nodes(6)%across(i), growth, change, bend, twist)
        quotient = excess(i) / max(nodes(6)%speed(i), slowest)
        next = h + inverted(-quotient, growth, change, bend, twist)
        straight_on = h - quotient
        next = merge(next, straight_on, abs(growth * quotient) < 0.3_wp)
        lower(i) = merge(h, lower(i), excess(i) < 0.0_wp)
        upper(i) = merge(h, upper(i), excess(i) > 0.0_wp)
        next = merge(next, half * (lower(i) + upper(i)), min(next - lower(i), upper(i) - next) > 0.0_wp)
        lanes(b + i, l_h) = h + active(i) * (min(next, largest(i)) - h)
      end do
    end do
    !GCC$ ivdep
    do i = 1, width
      bad(i) = max(active(i), merge(1.0_wp, bad(i), lanes(b + i, l_x) + lanes(b + i, l_h) > largest_x))
    end do
    call node_at(m, b, lanes, tags, c(2), nodes(2))
  end subroutine place_nodes

  !> The path at one node of the step, as path_point, by series about the step's start.
  !> @param place place of the node in the step, 0 to 1
  pure subroutine node_at(m, b, lanes, tags, place, node)
    type(material_type), intent(in) :: m
    integer, intent(in) :: b
    real(wp), intent(in) :: lanes(n_lanes, n_fields), place
    integer(int64), intent(in) :: tags(n_lanes, n_tags)
    type(node_type), intent(inout) :: node
    real(wp) :: x, turned, square, cosh_less_one, sinh_, growth, both, inverse, along, across, left, change, reached, log_rho
    real(wp) :: stretch, beta_r, chi, largest
    integer(int64) :: tag
    integer :: i
    beta_r = m%beta_r
    chi = m%chi
    !GCC$ ivdep
    do i = 1, width
      tag = tags(b + i, t_kind)
      x = place * lanes(b + i, l_h)
      along = lanes(b + i, l_node_along)
      across = lanes(b + i, l_node_across)
      left = 1.0_wp - lanes(b + i, l_rho_beta)
      turned = min(x, reach_of_step)
      square = turned * turned
    cosh_less_one = square * (1.0_wp / 2 + square * (1.0_wp / 24 + square * (1.0_wp / 720 + square * (1.0_wp / 40320))))
      sinh_ = turned * (1.0_wp + square * (1.0_wp / 6 + square * (1.0_wp / 120 + square * (1.0_wp / 5040 + square * (1.0_wp / 362880)))))
      ! sech(x_0 + x) = sech(x_0)/(1 + growth), tanh likewise.
      growth = cosh_less_one + along * sinh_
      growth = merge(growth, 0.0_wp, tag == kind_plane)
      both = 1.0_wp / ((1.0_wp + growth) * (2.0_wp + growth))
      inverse = both * (2.0_wp + growth)
      ! What rho is a power of grows by the factor 1 + change.
      change = left * exp_less_one(-beta_r * log_of_ratio(growth * both * (1.0_wp + growth)))
   change = merge(left * (sinh_ - cosh_less_one) / max(lanes(b + i, l_rho_beta), 1.0e-100_wp), change, tag == kind_axis)
change = merge(x * (2.0_wp * (lanes(b + i, l_start) + lanes(b + i, l_x)) + x) * across**2, change, tag == kind_straight)
      reached = max(lowest_change, min(highest_change, change))
      log_rho = lanes(b + i, l_power) * log_of_ratio(reached / (2.0_wp + reached))
      largest = max(abs(lanes(b + i, l_exponent) * log_rho), abs(chi * log_rho))
    node%far(i) = merge(0.0_wp, 1.0_wp, max(largest - reach_of_exp, abs(reached - change), x - reach_of_step) <= 0.0_wp)
      log_rho = merge(log_rho, 0.0_wp, largest <= reach_of_exp)
      stretch = 1.0_wp + exp_less_one(lanes(b + i, l_exponent) * log_rho)
      node%log_rho(i) = log_rho
      node%rho_chi(i) = lanes(b + i, l_rho_chi) * (1.0_wp + exp_less_one(chi * log_rho))
      node%speed(i) = lanes(b + i, l_speed) * merge(1.0_wp, stretch, tag == kind_straight)
      across = across * merge(stretch, inverse, tag == kind_straight)
      along = merge((along * (1.0_wp + cosh_less_one) + sinh_) * inverse, along, tag == kind_plane)
      node%along(i) = merge((lanes(b + i, l_start) + lanes(b + i, l_x) + x) * across, along, tag == kind_straight)
      node%across(i) = across
    end do
    if (any(node%far > half)) call node_in_full(m, b, lanes, tags, place, node)
  end subroutine node_at

  !> The same without series, for some lanes.
  !> @param node far is 1 in lanes to be done
  pure subroutine node_in_full(m, b, lanes, tags, place, node)
    type(material_type), intent(in) :: m
    integer, intent(in) :: b
    real(wp), intent(in) :: lanes(n_lanes, n_fields), place
    integer(int64), intent(in) :: tags(n_lanes, n_tags)
    type(node_type), intent(inout) :: node
    real(wp) :: x, decay, inverse, sine, argument, log_rho, u, kappa, beta_r, chi, per_R_squared, along, across, speed
    integer(int64) :: tag
    integer :: i
    beta_r = m%beta_r
    chi = m%chi
    per_R_squared = 1.0_wp / m%R**2
    !GCC$ ivdep
    do i = 1, width
      tag = tags(b + i, t_kind)
      kappa = lanes(b + i, l_kappa)
      x = lanes(b + i, l_x) + place * lanes(b + i, l_h)
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
      speed = lanes(b + i, l_amplitude) * exp(max(lanes(b + i, l_exponent), 0.0_wp) * log_rho)
      along = merge((1.0_wp - decay * decay) * inverse, 1.0_wp, tag == kind_plane)
      across = merge(sine, 0.0_wp, tag == kind_plane)
      inverse = 1.0_wp / sqrt(max(kappa + u * u, nothing))
      node%log_rho(i) = chosen(node%far(i), log_rho, node%log_rho(i))
      node%rho_chi(i) = chosen(node%far(i), exp(chi * log_rho), node%rho_chi(i))
      node%speed(i) = chosen(node%far(i), merge(1.0_wp, speed, tag == kind_straight), node%speed(i))
      node%along(i) = chosen(node%far(i), merge(u * inverse, along, tag == kind_straight), node%along(i))
      node%across(i) = chosen(node%far(i), merge(inverse, across, tag == kind_straight), node%across(i))
    end do
  end subroutine node_in_full

  !> rho at the end of the step.
  pure subroutine finish(m, b, lanes, node, goal)
    type(material_type), intent(in) :: m
    integer, intent(in) :: b
    real(wp), intent(in) :: lanes(n_lanes, n_fields)
    type(node_type), intent(in) :: node
    type(path_end_type), intent(inout) :: goal
    real(wp) :: log_rho, beta_r
    integer :: i
    beta_r = m%beta_r
    !GCC$ ivdep
    do i = 1, width
      log_rho = merge(0.0_wp, node%log_rho(i), node%far(i) > half)
      goal%rho(i) = lanes(b + i, l_rho) * (1.0_wp + exp_less_one(log_rho))
      goal%rho_beta(i) = lanes(b + i, l_rho_beta) * (1.0_wp + exp_less_one(beta_r * log_rho))
    end do
    if (.not. any(node%far > half)) return
    !GCC$ ivdep
    do i = 1, width
      log_rho = node%log_rho(i)
      goal%rho(i) = chosen(node%far(i), exp(log_rho), goal%rho(i))
      goal%rho_beta(i) = chosen(node%far(i), exp(beta_r * log_rho), goal%rho_beta(i))
    end do
  end subroutine finish

  !> d ln(speed)/dx and its first three derivatives, on an axis or a plane path.
  pure subroutine growth_of_speed(beta_r, on_plane, rho_beta, cosine, sine, growth, change, bend, twist)
    real(wp), intent(in) :: beta_r, on_plane, rho_beta, cosine, sine
    real(wp), intent(out) :: growth, change, bend, twist
    real(wp) :: left, inverse, power, r1, r2, r3, r4, sine_square, inner, inner_slope, pull
    left = 1.0_wp - rho_beta
    inverse = 1.0_wp / max(rho_beta, 1.0e-12_wp) ! nearer to zero no series helps
    power = (1.0_wp - beta_r) / beta_r
    r1 = left * inverse
    r2 = -r1 * (1.0_wp + r1)
    r3 = -r2 * (1.0_wp + 2.0_wp * r1)
    r4 = -r3 * (1.0_wp + 2.0_wp * r1) - 2.0_wp * r2**2
    sine_square = sine**2
    pull = beta_r * rho_beta
    growth = left * cosine
    change = left * sine_square - pull * growth * cosine
    inner = (beta_r * growth**2 + change) * cosine + 2.0_wp * growth * sine_square
    bend = -pull * inner - 2.0_wp * left * cosine * sine_square
    inner_slope = (2.0_wp * beta_r * growth * change + bend) * cosine + &
                  (beta_r * growth**2 + 3.0_wp * change - 4.0_wp * growth * cosine) * sine_square
    twist = -pull * (beta_r * growth * inner + inner_slope) - &
            2.0_wp * sine_square * (left * (sine_square - 2.0_wp * cosine**2) - pull * growth * cosine)
    growth = chosen(on_plane, growth, power * r1)
    change = chosen(on_plane, change, power * r2)
    bend = chosen(on_plane, bend, power * r3)
    twist = chosen(on_plane, twist, power * r4)
  end subroutine growth_of_speed

  !> The step that covers quotient (length/speed), by the inverse of the series of the length in the step.
  pure function inverted(quotient, growth, change, bend, twist) result(h)
    real(wp), intent(in) :: quotient, growth, change, bend, twist
    real(wp) :: h
    real(wp) :: a2, a3, a4, a5, square
    square = growth**2
    a2 = half * growth
    a3 = (square + change) * (1.0_wp / 6.0_wp)
    a4 = (growth * (square + 3.0_wp * change) + bend) * (1.0_wp / 24.0_wp)
  a5 = (square * (square + 6.0_wp * change) + 3.0_wp * change**2 + 4.0_wp * growth * bend + twist) * (1.0_wp / 120.0_wp)
    h = quotient * (1.0_wp - quotient * (a2 - quotient * (2.0_wp * a2**2 - a3 - quotient * ( &
        5.0_wp * a2 * (a2**2 - a3) + a4 - quotient * (14.0_wp * a2**4 - 21.0_wp * a2**2 * a3 + 6.0_wp * a2 * a4 + &
                                                      3.0_wp * a3**2 - a5)))))
  end function inverted

  include 'batch_series.inc'

end module HYPOFAB_BATCH_PATH
