!> The path of the intergranular strain of many points side by side: delta_path.f90 at the nodes of a step, and how far the
!> step goes.
!>
!> Where a step is short against the path, as most are, the path at a node follows by series from what is known at the
!> step's start: no logarithm or exponential is taken. Lanes for which the series do not reach are done in full.
!>
!> Compiled once per instruction set, each time as a module of its own name (kernel.cmake).
module umat_batch_path_portable
  use, intrinsic :: iso_fortran_env, only: int64, real64
  use umat_lanes
  use umat_many_lanes, only: n_lanes, width
  use umat_delta_path, only: axis_power
  use umat_material, only: material_type
  implicit none
  private
  public :: node_type, path_node, carry_node

  integer, parameter :: wp = real64
  !> log(rho) of rho = 0: every admissible power of it is zero.
  real(wp), parameter :: log_of_zero = -1.0e7_wp
  !> Steps of the path's parameter, and changes of what rho is a power of, that the series bridge.
  real(wp), parameter :: reach_of_step = 0.25_wp, lowest_change = -0.22_wp, highest_change = 0.28_wp

  !> A point of the path.
  type :: node_type
    real(wp) :: speed(width) !< d lambda/dx [strain]
    real(wp) :: along(width), across(width) !< components of the direction of delta
    real(wp) :: rho_chi(width), rho(width), left(width), decay(width) !< as in the fields of the same names
  end type node_type

contains

  !> The path at a parameter, by series about the step's start.
  !> @param b     lanes b + 1 to b + width
  !> @param place place in the step, 0 to 1 or a little more, of each lane
  pure subroutine path_node(m, b, lanes, tags, place, node)
    type(material_type), intent(in) :: m
    integer, intent(in) :: b
    real(wp), intent(in) :: lanes(n_lanes, n_fields), place(width)
    integer(int64), intent(in) :: tags(n_lanes, n_tags)
    type(node_type), intent(out) :: node
    real(wp) :: far(width) !< 1 where the series do not reach, otherwise 0
    real(wp) :: x, turned, square, cosh_less_one, sinh_, growth, both, inverse, along, across, left, change, reached, log_rho
    real(wp) :: rho, beta_r, chi, largest, gained, speed, decay, u, R, plane, axis, straight
    integer(int64) :: tag
    integer :: i
    beta_r = m%beta_r
    chi = m%chi
    R = m%R
    !GCC$ ivdep
    do i = 1, width
      tag = tags(b + i, t_kind)
      plane = merge(1.0_wp, 0.0_wp, tag == kind_plane)
      axis = merge(1.0_wp, 0.0_wp, tag == kind_axis)
      straight = merge(1.0_wp, 0.0_wp, tag == kind_straight)
      x = place(i) * lanes(b + i, l_h)
      along = lanes(b + i, l_node_along)
      across = lanes(b + i, l_node_across)
      left = lanes(b + i, l_left)
      turned = min(x, reach_of_step)
      square = turned * turned
      cosh_less_one = square * (1.0_wp / 2 + square * (1.0_wp / 24 + square * (1.0_wp / 720 + square * (1.0_wp / 40320))))
      sinh_ = turned * (1.0_wp + square * (1.0_wp / 6 + square * (1.0_wp / 120 + square * (1.0_wp / 5040))))
      ! sech(x_0 + x) = sech(x_0)/(1 + growth), tanh likewise.
      growth = cosh_less_one + along * sinh_
      growth = plane * growth
      both = 1.0_wp / ((1.0_wp + growth) * (2.0_wp + growth))
      inverse = both * (2.0_wp + growth)
      ! What rho is a power of grows by the factor 1 + change; 1 - exp(-x) = sinh x - (cosh x - 1).
      change = left * exp_less_one(-beta_r * log_of_ratio(growth * both * (1.0_wp + growth)))
      decay = lanes(b + i, l_decay)
      gained = decay * (sinh_ - cosh_less_one) / max(1.0_wp - decay, 1.0e-100_wp)
      change = chosen(axis, gained, change)
      u = lanes(b + i, l_start) + lanes(b + i, l_x) + x
      gained = x * (2.0_wp * u - x) * across**2
      change = chosen(straight, gained, change)
      reached = max(lowest_change, min(highest_change, change))
      log_rho = lanes(b + i, l_power) * log_of_ratio(reached / (2.0_wp + reached))
      largest = max(1.0_wp, chi) * abs(log_rho)
      far(i) = merge(0.0_wp, 1.0_wp, max(largest - reach_of_exp, abs(reached - change), x - reach_of_step) <= 0.0_wp)
      log_rho = merge(log_rho, 0.0_wp, largest <= reach_of_exp)
      rho = lanes(b + i, l_rho) * (1.0_wp + exp_less_one(log_rho))
      node%rho(i) = rho
      node%rho_chi(i) = lanes(b + i, l_rho_chi) * (1.0_wp + exp_less_one(chi * log_rho))
      gained = exp_less_one(beta_r * log_rho)
      node%left(i) = left - (1.0_wp - left) * gained
      node%decay(i) = decay * (1.0_wp - (sinh_ - cosh_less_one))
      ! On a plane path the speed is R rho; on a straight one it is 1, and so is the part across times rho.
      speed = lanes(b + i, l_speed)
      reached = R * rho
      node%speed(i) = chosen(plane, reached, speed)
      reached = 1.0_wp + exp_less_one(-log_rho)
      across = across * chosen(straight, reached, inverse)
      reached = (along * (1.0_wp + cosh_less_one) + sinh_) * inverse
      along = chosen(plane, reached, along)
      reached = u * across
      node%along(i) = chosen(straight, reached, along)
      node%across(i) = across
    end do
    if (any(tags(b + 1:b + width, t_kind) == kind_axis)) then
      !GCC$ ivdep
      do i = 1, width
        gained = (1.0_wp - node%decay(i)) / max(1.0_wp - lanes(b + i, l_decay), 1.0e-100_wp)
        gained = merge(1.0_wp, min(gained, 2.0_wp), far(i) > half)**3 * node%decay(i) * lanes(b + i, l_left) / &
                 max(lanes(b + i, l_decay) * node%left(i), 1.0e-100_wp)
        node%speed(i) = merge(lanes(b + i, l_speed) * gained, node%speed(i), tags(b + i, t_kind) == kind_axis)
      end do
    end if
    if (any(far > half)) call path_node_in_full(m, b, lanes, tags, place, far, node)
  end subroutine path_node

  !> The same without series, for some lanes: path_point of delta_path.f90.
  !> @param far 1 in lanes to be done
  pure subroutine path_node_in_full(m, b, lanes, tags, place, far, node)
    type(material_type), intent(in) :: m
    integer, intent(in) :: b
    real(wp), intent(in) :: lanes(n_lanes, n_fields), place(width), far(width)
    integer(int64), intent(in) :: tags(n_lanes, n_tags)
    type(node_type), intent(inout) :: node
    real(wp) :: x, decay, inverse, sine, argument, log_rho, u, kappa, beta_r, chi, R, along, across, speed
    real(wp) :: rho, left, lost, ahead, power
    integer(int64) :: tag
    integer :: i
    beta_r = m%beta_r
    chi = m%chi
    R = m%R
    power = axis_power * beta_r
    !GCC$ ivdep
    do i = 1, width
      tag = tags(b + i, t_kind)
      kappa = lanes(b + i, l_kappa)
      x = lanes(b + i, l_x) + place(i) * lanes(b + i, l_h)
      u = lanes(b + i, l_start) + x
      decay = exp(-min(x, largest_x))
      inverse = 1.0_wp / (1.0_wp + decay * decay)
      sine = 2.0_wp * decay * inverse
      ! rho is a power of this; 1 where delta stays at |delta| = R.
      argument = 1.0_wp + kappa * exp(beta_r * log(sine))
      argument = merge(argument, merge(1.0_wp - decay, 1.0_wp, tag == kind_axis), tag == kind_plane)
      argument = merge((kappa + u * u) / R**2, argument, tag == kind_straight)
      log_rho = lanes(b + i, l_power) * log(max(argument, nothing))
      log_rho = merge(log_rho, log_of_zero, argument > nothing)
      rho = exp(log_rho)
      left = 1.0_wp - exp(beta_r * log_rho)
      along = merge((1.0_wp - decay * decay) * inverse, 1.0_wp, tag == kind_plane)
      across = merge(sine, 0.0_wp, tag == kind_plane)
      lost = loss(decay, power, 1.0_wp - left)
      ahead = 1.0_wp - decay
      speed = merge(R * rho, 1.0_wp, tag == kind_plane)
      speed = merge(R * axis_power * ahead**(axis_power - 1) / max(lost, 1.0e-100_wp), speed, tag == kind_axis)
      left = merge(decay * lost, left, tag == kind_axis)
      inverse = 1.0_wp / sqrt(max(kappa + u * u, nothing))
      node%rho(i) = chosen(far(i), rho, node%rho(i))
      node%rho_chi(i) = chosen(far(i), exp(chi * log_rho), node%rho_chi(i))
      node%left(i) = chosen(far(i), left, node%left(i))
      node%decay(i) = chosen(far(i), decay, node%decay(i))
      node%speed(i) = chosen(far(i), speed, node%speed(i))
      node%along(i) = chosen(far(i), merge(u * inverse, along, tag == kind_straight), node%along(i))
      node%across(i) = chosen(far(i), merge(inverse, across, tag == kind_straight), node%across(i))
    end do
  end subroutine path_node_in_full

  !> The end of an accepted step is the start of the next.
  !> @param accepted 1 for yes, 0 for no
  pure subroutine carry_node(b, node, accepted, lanes)
    integer, intent(in) :: b
    type(node_type), intent(in) :: node
    real(wp), intent(in) :: accepted(width)
    real(wp), intent(inout) :: lanes(n_lanes, n_fields)
    integer :: i
    !GCC$ ivdep
    do i = 1, width
      lanes(b + i, l_speed) = chosen(accepted(i), node%speed(i), lanes(b + i, l_speed))
      lanes(b + i, l_node_along) = chosen(accepted(i), node%along(i), lanes(b + i, l_node_along))
      lanes(b + i, l_node_across) = chosen(accepted(i), node%across(i), lanes(b + i, l_node_across))
      lanes(b + i, l_rho_chi) = chosen(accepted(i), node%rho_chi(i), lanes(b + i, l_rho_chi))
      lanes(b + i, l_rho) = chosen(accepted(i), node%rho(i), lanes(b + i, l_rho))
      lanes(b + i, l_left) = chosen(accepted(i), node%left(i), lanes(b + i, l_left))
      lanes(b + i, l_decay) = chosen(accepted(i), node%decay(i), lanes(b + i, l_decay))
    end do
  end subroutine carry_node

  include 'series.inc'

end module umat_batch_path_portable
