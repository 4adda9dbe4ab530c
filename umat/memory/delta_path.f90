!> The path of the intergranular strain under a constant strain direction, in closed form.
!>
!> Along a unit direction d the evolution of delta (theory.md Eq. 14) does not depend on stress and stays in the plane of
!> d and its start value. With u = delta:d/R, v the part normal to d, rho^2 = u^2 + v^2, tan(theta) = v/u and lambda the
!> length of the strain path, loading reads
!>   R rho' = cos(theta) (1 - rho^beta_r),   R theta' = -sin(theta)/rho,
!> which has the first integral (1 - rho^beta_r)/v^beta_r = kappa (theory.md, section 4). A parameter x takes the place of
!> lambda, in which delta is an elementary function and lambda a smooth, monotonic one; this also removes the
!> singularity rho^beta_r at delta = 0, where no integrator in lambda keeps its order:
!>   plane  sinh(x) = cot(theta):        rho = (1 + kappa sech^beta_r(x))^(-1/beta_r), dlambda/dx = R rho
!>   axis   theta = 0: rho = (1 - exp(-x))^k, k = 4:        dlambda/dx = R drho/dx/(1 - rho^beta_r)
!> The power k makes rho^beta_r a term of high order at delta = 0, and there and in between a polynomial of x fits well.
!> In a reversal delta grows along d, and x is lambda itself; so it is where delta stays as it is.
!>
!> The derivative of delta at a fixed fraction of the increment with respect to the increment is known in closed form too
!> (theory.md, section 4); it enters the consistent tangent.
module umat_delta_path
  use umat_intergranular, only: intergranular_type, intergranular_direction
  use umat_kinds, only: wp
  use umat_material, only: material_type
  use umat_status, only: branch_plain, branch_loading
  use umat_tensor, only: ddot, norm
  implicit none
  private
  public :: delta_path_type, delta_path, path_point_type, path_point, delta_after, first_guess
  public :: starts_at_zero, measures_length, kappa_slope
  public :: delta_influence_type, delta_influence

  !> Below this v, Eq. (20) cancels more digits than the limit v = 0 leaves out.
  real(wp), parameter :: on_axis = sqrt(epsilon(1.0_wp))

  !> k of the axis.
  integer, parameter, public :: axis_power = 4

  integer, parameter :: kind_fixed = 0, kind_straight = 1, kind_axis = 2, kind_plane = 3

  !> A path of delta on one branch.
  type :: delta_path_type
    integer :: kind
    real(wp) :: start !< x at the start
    real(wp) :: along(6) !< unit strain direction d
    real(wp) :: across(6) !< straight: delta at x = 0; plane: unit direction of the part of delta normal to d
    real(wp) :: normal(6) !< straight and plane: unit direction of the part of delta normal to d, or zero
    real(wp) :: kappa !< first integral of the plane path
    real(wp) :: u !< delta:d/R at the start of the increment, below zero when a reversal came first
    real(wp) :: v !< size of the part of delta/R normal to d at the start
    real(wp) :: turn !< length of the reversal that came first [strain]
    type(intergranular_type) :: start_g !< fixed: direction and mobilisation of delta
  end type delta_path_type

  !> A point of a path.
  type :: path_point_type
    type(intergranular_type) :: g !< direction and mobilisation of delta
    real(wp) :: speed = 1.0_wp !< d lambda/dx [strain]
    real(wp) :: rho_beta = 1.0_wp !< rho^beta_r; loading only
    real(wp) :: cosine = 1.0_wp, sine = 0.0_wp !< of the angle between delta and d; loading only
    real(wp) :: sine_beta = 0.0_wp !< sine^beta_r
  end type path_point_type

  !> Derivative of delta with respect to eta, with frame = (d, normal):
  !>   factor eta + sum_ij frame_i plane(i, j) (frame_j:eta) [strain].
  type :: delta_influence_type
    real(wp) :: factor = 0.0_wp, plane(2, 2) = 0.0_wp
  end type delta_influence_type

contains

  !> The path that starts at a delta.
  !> @param m         material
  !> @param delta     intergranular strain at the start, |delta| <= R up to rounding
  !> @param direction unit strain direction d
  !> @param branch    the branch that the whole path is on
  !> @param turn      length of strain already done in reversal [strain]
  pure function delta_path(m, delta, direction, branch, turn) result(path)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: delta(6), direction(6), turn
    integer, intent(in) :: branch
    type(delta_path_type) :: path
    real(wp) :: u, v, rho_beta, normal(6)
    ! |v| only decays: what is below rounding now stays there.
    real(wp), parameter :: negligible = 10.0_wp * epsilon(1.0_wp)

    path = delta_path_type(kind_fixed, 0.0_wp, direction, delta, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, turn, &
                           intergranular_type(0.0_wp, 0.0_wp, 0.0_wp))
    if (branch == branch_plain) return
    u = ddot(delta, direction) / m%R
    if (branch == branch_loading) u = max(0.0_wp, u)
    normal = delta / m%R - u * direction
    v = norm(normal)
    if (v > negligible) path%normal = normal / v
    if (branch /= branch_loading) then
      path%kind = kind_straight
      return
    end if
    path%u = u - turn / m%R
    path%v = v
    rho_beta = min(1.0_wp, hypot(u, v))**m%beta_r
    if (v > negligible) then
      path%kind = kind_plane
      path%start = asinh(u / v)
      path%across = path%normal
      path%kappa = (1.0_wp - rho_beta) / v**m%beta_r
    else if (u < 1.0_wp - negligible) then
      path%kind = kind_axis
      path%start = -log(1.0_wp - min(1.0_wp, u)**(1.0_wp / axis_power))
    else
      path%start_g = intergranular_type(direction, 1.0_wp, 1.0_wp)
    end if
  end function delta_path

  !> The point of a path at a parameter x.
  pure function path_point(m, path, x) result(point)
    type(material_type), intent(in) :: m
    type(delta_path_type), intent(in) :: path
    real(wp), intent(in) :: x
    type(path_point_type) :: point
    real(wp) :: decay, log_rho

    select case (path%kind)
    case (kind_straight)
      point%g = intergranular_direction(m, path%across + x * path%along)
    case (kind_axis)
      point%g = intergranular_type(path%along, 0.0_wp, 0.0_wp)
      point%rho_beta = 0.0_wp
      point%speed = 0.0_wp
      decay = exp(-x)
      if (decay < 1.0_wp) then
        log_rho = axis_power * log(1.0_wp - decay)
        point%g%rho = exp(log_rho)
        point%g%rho_chi = exp(m%chi * log_rho)
        point%rho_beta = exp(m%beta_r * log_rho)
        point%speed = m%R * axis_power * (1.0_wp - decay)**(axis_power - 1) / loss(decay, axis_power * m%beta_r)
      end if
    case (kind_plane)
      decay = exp(-x)
      point%cosine = (1.0_wp - decay**2) / (1.0_wp + decay**2)
      point%sine = 2.0_wp * decay / (1.0_wp + decay**2)
      point%sine_beta = point%sine**m%beta_r
      point%rho_beta = 1.0_wp / (1.0_wp + path%kappa * point%sine_beta)
      log_rho = log(point%rho_beta) / m%beta_r
      point%g = intergranular_type(point%cosine * path%along + point%sine * path%across, exp(log_rho), &
                                   exp(m%chi * log_rho))
      point%speed = m%R * point%g%rho
    case default
      point%g = path%start_g
    end select
  end function path_point

  !> (1 - (1 - q)^p)/q, for 0 <= q <= 1 without cancellation.
  elemental function loss(q, p) result(s)
    real(wp), intent(in) :: q, p
    real(wp) :: s
    real(wp) :: term
    integer :: i
    if (q > 0.05_wp) then
      s = (1.0_wp - (1.0_wp - q)**p) / q
    else
      ! Binomial series.
      term = p
      s = p
      do i = 1, 12
        term = -term * (p - i) / (i + 1) * q
        s = s + term
      end do
    end if
  end function loss

  !> delta a little way behind a point, along its tangent: theory.md Eq. (14).
  !> @param length of strain from the point on [strain]
  pure function delta_after(m, path, point, length) result(delta)
    type(material_type), intent(in) :: m
    type(delta_path_type), intent(in) :: path
    type(path_point_type), intent(in) :: point
    real(wp), intent(in) :: length
    real(wp) :: delta(6)
    delta = m%R * point%g%rho * point%g%direction + length * (path%along - point%rho_beta * point%cosine * point%g%direction)
  end function delta_after

  !> Does delta start from zero?
  pure function starts_at_zero(path) result(yes)
    type(delta_path_type), intent(in) :: path
    logical :: yes
    yes = path%kind == kind_axis .and. .not. path%start > 0.0_wp
  end function starts_at_zero

  !> First guess of the step of the parameter that covers a length of strain [parameter].
  pure function first_guess(m, path, length) result(h)
    type(material_type), intent(in) :: m
    type(delta_path_type), intent(in) :: path
    real(wp), intent(in) :: length
    real(wp) :: h
    type(path_point_type) :: point
    real(wp) :: slope
    h = length
    if (measures_length(path)) return
    h = huge(h)
    ! Two terms of the series of the length covered about the start, whose speed grows.
    point = path_point(m, path, path%start)
    if (path%kind == kind_plane) then
      slope = point%speed * path%kappa * point%sine_beta * point%rho_beta * point%cosine
    else
      ! The axis has its origin at delta = 0, where the speed vanishes; rho grows by less than length/R.
      h = -log(1.0_wp - min(0.9_wp, path%u + (path%turn + length) / m%R)**(1.0_wp / axis_power)) - path%start
      if (.not. h > 0.0_wp) h = huge(h)
      if (.not. point%rho_beta > 0.0_wp) return
      slope = point%speed * (axis_power - 1) * exp(-path%start) / (1.0_wp - exp(-path%start))
    end if
    h = min(h, 2.0_wp * length / (point%speed + sqrt(point%speed**2 + 2.0_wp * slope * length)))
  end function first_guess

  !> Is the parameter the length of strain itself?
  pure function measures_length(path) result(yes)
    type(delta_path_type), intent(in) :: path
    logical :: yes
    yes = path%kind == kind_fixed .or. path%kind == kind_straight
  end function measures_length

  !> d rho/d kappa at a point; zero off the plane paths.
  pure function kappa_slope(m, point) result(slope)
    type(material_type), intent(in) :: m
    type(path_point_type), intent(in) :: point
    real(wp) :: slope
    slope = -point%g%rho * point%rho_beta * point%sine_beta / m%beta_r
  end function kappa_slope

  !> Influence of the strain increment on delta, at a fixed fraction of the increment.
  !>
  !> With the increment L d, the derivative of delta with respect to eta where the increment is L (d + eta); theory.md
  !> Eqs. (18) to (20).
  !> @param path     not of the plain model
  !> @param x, point parameter and point
  !> @param done     length of strain done since the start of the increment, a reversal that came first included
  !> @param integral of kappa_slope over x, from the path's start
  pure function delta_influence(m, path, x, point, done, integral) result(influence)
    type(material_type), intent(in) :: m
    type(delta_path_type), intent(in) :: path
    real(wp), intent(in) :: x, done, integral
    type(path_point_type), intent(in) :: point
    type(delta_influence_type) :: influence

    if (path%kind == kind_straight) then
      influence%factor = done
      return
    end if
    influence%factor = influence_normal(m, path, x, point)
    ! Eq. (14) on the path: d delta/d lambda = d - rho^beta_r cos(theta) deltahat.
    associate (loss_along => point%rho_beta * point%cosine)
      influence%plane(:, 1) = done*[1.0_wp - loss_along * point%cosine, -loss_along * point%sine]
    end associate
    influence%plane(1, 1) = influence%plane(1, 1) - influence%factor
    if (path%kind == kind_plane .and. path%v >= on_axis) &
      influence%plane(:, 2) = influence_in_plane(m, path, point, integral) - [0.0_wp, influence%factor]
  end function delta_influence

  !> Factor of eta normal to the plane of the path; theory.md Eq. (19) [strain].
  pure function influence_normal(m, path, x, point) result(factor)
    type(material_type), intent(in) :: m
    type(delta_path_type), intent(in) :: path
    real(wp), intent(in) :: x
    type(path_point_type), intent(in) :: point
    real(wp) :: factor
    real(wp) :: u, v_over_start
    select case (path%kind)
    case (kind_axis)
      u = point%g%rho
      ! v/v_0 = ((1 - rho^beta_r)/(1 - rho_0^beta_r))^(1/beta_r) for a v that vanishes.
      v_over_start = (exp(-(x - path%start)) * loss(exp(-x), axis_power * m%beta_r) / &
                      loss(exp(-path%start), axis_power * m%beta_r))**(1.0_wp / m%beta_r)
    case (kind_plane)
      u = point%g%rho * point%cosine
      v_over_start = point%g%rho * point%sine / path%v
    case default
      u = path%u
      v_over_start = exp(-x / m%R)
    end select
    factor = m%R * (u - path%u * v_over_start)
  end function influence_normal

  !> Answer of delta to eta along the unit normal part of delta, along d and that; theory.md Eq. (20) [strain].
  pure function influence_in_plane(m, path, point, integral) result(answer)
    type(material_type), intent(in) :: m
    type(delta_path_type), intent(in) :: path
    type(path_point_type), intent(in) :: point
    real(wp), intent(in) :: integral
    real(wp) :: answer(2)
    real(wp) :: base, kappa_change, x_change, rho_change
    if (path%turn > 0.0_wp) then
      base = path%v
      kappa_change = m%beta_r * (path%kappa + 1.0_wp) * path%u / path%v
    else
      base = (path%u**2 + path%v**2) / path%v
      kappa_change = m%beta_r * path%kappa * path%u / path%v
    end if
    associate (rho => point%g%rho, cosine => point%cosine, sine => point%sine)
      x_change = (base - kappa_change * integral) / rho
      rho_change = path%kappa * point%sine_beta * cosine * rho * point%rho_beta * x_change + &
                   kappa_slope(m, point) * kappa_change
      answer = m%R*[rho_change * cosine + rho * x_change * sine**2 - rho * sine, &
                      rho_change * sine - rho * x_change * sine * cosine + rho * cosine]
    end associate
  end function influence_in_plane

end module umat_delta_path
