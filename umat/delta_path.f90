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
!>   axis   theta = 0, exp(-x) = 1 - rho^beta_r:                      dlambda/dx = R rho^(1-beta_r)/beta_r
!> In a reversal delta grows along d, and x is lambda itself; so it is where delta stays as it is.
module umat_delta_path
  use umat_kinds, only: wp
  use umat_material, only: material_type
  use umat_status, only: branch_plain, branch_loading
  use umat_tensor, only: ddot, norm
  implicit none
  private
  public :: delta_path_type, delta_path, delta_at, speed_at

  integer, parameter :: kind_fixed = 0, kind_straight = 1, kind_axis = 2, kind_plane = 3

  !> A path of delta on one branch.
  type :: delta_path_type
    integer :: kind
    real(wp) :: start !< x at the start
    real(wp) :: along(6) !< unit strain direction d
    real(wp) :: across(6) !< fixed: delta; straight: delta at x = 0; plane: unit direction of the part of delta normal to d
    real(wp) :: kappa !< first integral of the plane path
    real(wp) :: R
    real(wp) :: beta_r
  end type delta_path_type

contains

  !> The path that starts at a delta.
  !> @param m         material
  !> @param delta     intergranular strain at the start, |delta| <= R up to rounding
  !> @param direction unit strain direction d
  !> @param branch    the branch that the whole path is on
  pure function delta_path(m, delta, direction, branch) result(path)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: delta(6), direction(6)
    integer, intent(in) :: branch
    type(delta_path_type) :: path
    real(wp) :: u, v, rho_beta, normal(6)
    ! |v| only decays: what is below rounding now stays there.
    real(wp), parameter :: negligible = 10.0_wp * epsilon(1.0_wp)

    path = delta_path_type(kind_fixed, 0.0_wp, direction, delta, 0.0_wp, m%R, m%beta_r)
    if (branch == branch_plain) return
    if (branch /= branch_loading) then
      path%kind = kind_straight
      return
    end if
    u = max(0.0_wp, ddot(delta, direction)) / m%R
    normal = delta / m%R - u * direction
    v = norm(normal)
    rho_beta = min(1.0_wp, hypot(u, v))**m%beta_r
    if (v > negligible) then
      path%kind = kind_plane
      path%start = asinh(u / v)
      path%across = normal / v
      path%kappa = (1.0_wp - rho_beta) / v**m%beta_r
    else if (rho_beta < 1.0_wp) then
      path%kind = kind_axis
      path%start = -log(1.0_wp - rho_beta)
    end if
  end function delta_path

  !> delta at a parameter x.
  pure function delta_at(path, x) result(delta)
    type(delta_path_type), intent(in) :: path
    real(wp), intent(in) :: x
    real(wp) :: delta(6)
    real(wp) :: decay
    select case (path%kind)
    case (kind_straight)
      delta = path%across + x * path%along
    case (kind_axis)
      delta = path%R * rho_on_axis(path, x) * path%along
    case (kind_plane)
      decay = exp(-2.0_wp * x)
      delta = path%R * rho_in_plane(path, x) * &
              ((1.0_wp - decay) / (1.0_wp + decay) * path%along + sech(x) * path%across)
    case default
      delta = path%across
    end select
  end function delta_at

  !> dlambda/dx at a parameter x [strain].
  pure function speed_at(path, x) result(speed)
    type(delta_path_type), intent(in) :: path
    real(wp), intent(in) :: x
    real(wp) :: speed
    select case (path%kind)
    case (kind_axis)
      speed = path%R * rho_on_axis(path, x)**(1.0_wp - path%beta_r) / path%beta_r
    case (kind_plane)
      speed = path%R * rho_in_plane(path, x)
    case default
      speed = 1.0_wp
    end select
  end function speed_at

  !> rho along the strain direction.
  pure function rho_on_axis(path, x) result(rho)
    type(delta_path_type), intent(in) :: path
    real(wp), intent(in) :: x
    real(wp) :: rho
    rho = max(0.0_wp, 1.0_wp - exp(-x))**(1.0_wp / path%beta_r)
  end function rho_on_axis

  !> rho off the strain direction.
  pure function rho_in_plane(path, x) result(rho)
    type(delta_path_type), intent(in) :: path
    real(wp), intent(in) :: x
    real(wp) :: rho
    rho = (1.0_wp + path%kappa * sech(x)**path%beta_r)**(-1.0_wp / path%beta_r)
  end function rho_in_plane

  !> 1/cosh(x) for x >= 0, without overflow.
  pure function sech(x)
    real(wp), intent(in) :: x
    real(wp) :: sech
    sech = 2.0_wp * exp(-x) / (1.0_wp + exp(-2.0_wp * x))
  end function sech

end module umat_delta_path
