!> What the model sees of a stress at and beyond the border of its domain, for hosts that must go on there.
!>
!> Principal stresses above -2 c, c being a tiny confinement, are seen as compressive all the same: a = -sigma (of T - p_t 1) as
!>   g(a) = a (a >= 2 c),  c + a^2/(4 c) (0 <= a <= 2 c),  c (a <= 0),
!> which is continuous with its slope. So the rate of stress is, everywhere, that of a state of the domain, and continuous;
!> inside it is the model's own. Where all three are tensile the model sees the isotropic stress -c 1, whose stiffness is tiny.
!> There N fades out as well: N would make the stiffness in closing a gap less than that in opening it, and the grains would
!> not meet again where they parted. docs/umat.md, near zero stress.
module umat_border
  use umat_kinds, only: wp
  use umat_tensor, only: diagonalise, rotate
  implicit none
  private
  public :: seen_stress, seen_principal, seen_change, share_of_N, share_of_N_slope, softening, softening_slope

  !> Largest compression that is seen as more than it is, over the confinement.
  real(wp), parameter, public :: reach_of_border = 2.0_wp
  !> Part of -tr(T - p_t 1) below which the size of the stress says nothing; below 1/sqrt(3), so that it acts with p_t alone.
  real(wp), parameter, public :: part_of_pressure = 0.5_wp
  !> Range of -tr T in which N fades out, over the confinement.
  real(wp), parameter :: width = 3.0_wp * (reach_of_border - 1.0_wp)

contains

  !> The stress that the model sees.
  !> @param stress      T - p_t 1 [stress]
  !> @param confinement c [stress], above zero
  !> @param seen        [stress]
  !> @param compression its principal values, compression positive [stress]
  pure subroutine seen_stress(stress, confinement, seen, compression)
    real(wp), intent(in) :: stress(6), confinement
    real(wp), intent(out) :: seen(6), compression(3)
    real(wp) :: axes(3, 3), more(3)
    call principal(stress, confinement, compression, more, axes)
    ! Only what is added is turned back: a stress that is seen as it is stays the same to the last bit.
    seen = stress - rotate([more(1), more(2), more(3), 0.0_wp, 0.0_wp, 0.0_wp], axes)
  end subroutine seen_stress

  !> Principal values, compression positive, of the stress that the model sees, and their directions.
  !> @param stress, confinement as in seen_stress
  !> @param compression [stress]
  !> @param axes        the directions, as columns
  pure subroutine seen_principal(stress, confinement, compression, axes)
    real(wp), intent(in) :: stress(6), confinement
    real(wp), intent(out) :: compression(3), axes(3, 3)
    real(wp) :: more(3)
    call principal(stress, confinement, compression, more, axes)
  end subroutine seen_principal

  !> The same, and what they are more than those of the stress [stress].
  pure subroutine principal(stress, confinement, compression, more, axes)
    real(wp), intent(in) :: stress(6), confinement
    real(wp), intent(out) :: compression(3), more(3), axes(3, 3)
    real(wp) :: values(3), z(3)
    call diagonalise(stress, values, axes)
    z = -values / confinement
    more = confinement*[added(z(1)), added(z(2)), added(z(3))]
    compression = merge(more - values, confinement, z > 0.0_wp)
  end subroutine principal

  !> d seen/d stress, as a matrix on tensor components.
  !>
  !> The derivative of a tensor function of principal values: in their axes each component is multiplied by the divided
  !> difference of the two principal values it belongs to, also where these coincide.
  !> @param stress, confinement as in seen_stress
  pure function seen_change(stress, confinement) result(change)
    real(wp), intent(in) :: stress(6), confinement
    real(wp) :: change(6, 6)
    real(wp) :: values(3), axes(3, 3), back(3, 3), z(3), factor(6), unit(6)
    integer :: j
    call diagonalise(stress, values, axes)
    back = transpose(axes) ! as an argument it would be allocated
    z = -values / confinement
    factor = [divided(z(1), z(1)), divided(z(2), z(2)), divided(z(3), z(3)), &
              divided(z(1), z(2)), divided(z(1), z(3)), divided(z(2), z(3))]
    do j = 1, 6
      unit = 0.0_wp
      unit(j) = 1.0_wp
      change(:, j) = rotate(factor * rotate(unit, back), axes)
    end do
  end function seen_change

  !> What is added to a compression z, g(z) - z; in units of the confinement.
  pure function added(z)
    real(wp), intent(in) :: z
    real(wp) :: added
    if (z >= reach_of_border) then
      added = 0.0_wp
    else if (z > 0.0_wp) then
      added = (1.0_wp - 0.5_wp * z)**2
    else
      added = 1.0_wp - z
    end if
  end function added

  !> (g(z1) - g(z2))/(z1 - z2), without cancellation.
  pure function divided(z1, z2) result(quotient)
    real(wp), intent(in) :: z1, z2
    real(wp) :: quotient
    real(wp) :: low, high
    low = min(z1, z2)
    high = max(z1, z2)
    if (low >= reach_of_border) then
      quotient = 1.0_wp
    else if (high <= 0.0_wp) then
      quotient = 0.0_wp
    else if (high <= reach_of_border .and. low >= 0.0_wp) then
      quotient = 0.25_wp * (low + high)
    else if (low >= 0.0_wp) then
      quotient = 1.0_wp - (1.0_wp - 0.5_wp * low)**2 / (high - low)
    else if (high <= reach_of_border) then
      quotient = 0.25_wp * high**2 / (high - low)
    else
      quotient = (high - 1.0_wp) / (high - low)
    end if
  end function divided

  !> Share of N that acts: 0 where all principal stresses are tensile, 1 where the stress is seen as it is.
  !> @param pressure -tr of the seen stress [stress], at least 3 c
  pure function share_of_N(pressure, confinement) result(share)
    real(wp), intent(in) :: pressure, confinement
    real(wp) :: share
    real(wp) :: t
    t = way_out(pressure, confinement)
    share = t * t * (3.0_wp - 2.0_wp * t)
  end function share_of_N

  !> d ln share_of_N/d pressure [1/stress]; zero where the share is zero.
  pure function share_of_N_slope(pressure, confinement) result(slope)
    real(wp), intent(in) :: pressure, confinement
    real(wp) :: slope
    real(wp) :: t
    t = way_out(pressure, confinement)
    slope = 0.0_wp
    if (t > 0.0_wp) slope = 6.0_wp * (1.0_wp - t) / (t * (3.0_wp - 2.0_wp * t)) / (width * confinement)
  end function share_of_N_slope

  !> How far the pressure is on its way from 3 c to where N acts in full, 0 to 1.
  pure function way_out(pressure, confinement) result(t)
    real(wp), intent(in) :: pressure, confinement
    real(wp) :: t
    t = max(0.0_wp, min(1.0_wp, (pressure / confinement - 3.0_wp) / width))
  end function way_out

  !> Factor of the stiffness at low pressure: the model's falls with the power 1 - n of the pressure, below the soft pressure
  !> it falls with the pressure itself, so that the stress there decays over a strain that is not ever smaller.
  !> @param pressure, soft_pressure -tr of the seen stress, and where softening begins [stress]
  pure function softening(pressure, soft_pressure, n) result(factor)
    real(wp), intent(in) :: pressure, soft_pressure, n
    real(wp) :: factor
    real(wp) :: y
    factor = 1.0_wp
    if (pressure >= soft_pressure) return
    y = pressure / soft_pressure
    factor = y**n * (1.0_wp + n * (1.0_wp - y)) ! with its slope continuous at y = 1
  end function softening

  !> d ln softening/d pressure [1/stress].
  pure function softening_slope(pressure, soft_pressure, n) result(slope)
    real(wp), intent(in) :: pressure, soft_pressure, n
    real(wp) :: slope
    slope = 0.0_wp
    if (pressure >= soft_pressure) return
    slope = n / pressure - n / (soft_pressure * (1.0_wp + n * (1.0_wp - pressure / soft_pressure)))
  end function softening_slope

end module umat_border
