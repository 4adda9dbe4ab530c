!> Moments of directions -> fabric tensors of all kinds, anisotropy, principal values and directions.
module hypofab_direction_fabric
  use, intrinsic :: iso_c_binding, only: wp => c_double, c_int, c_int64_t
  use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
  use hypofab_fabric, only: find_principal
  use hypofab_force_anisotropy, only: scalar_anisotropy
  use hypofab_kinds, only: third_kind, second_kind
  use hypofab_moments, only: moments_t
  implicit none
  private
  public :: describe_directions, plane_angle

  !> hypofab_direction_fabric of hypofab_describe.h, member by member.
  type, bind(C) :: direction_fabric_t
    integer(c_int64_t) :: count
    real(wp) :: total
    real(wp) :: first2(6), first4(15), second2(6), second4(15), third2(6), third4(15)
    real(wp) :: anisotropy, deviator, principal_values(3), principal_directions(3, 3), angle
  end type direction_fabric_t

contains

  !> Fabric tensors of summed directions.
  !> @param dimension 3, or 2 for the plane xy
  !> @param moments   sums; when their total weight is not positive, the count is 0 and everything else NaN
  !> @param fabric    filled
  !> @return 0, or LAPACK's info when the eigenvalues could not be found
  function describe_directions(dimension, moments, fabric) result(info) bind(C, name='hypofab_describe_directions')
    integer(c_int), value, intent(in) :: dimension
    type(moments_t), intent(in) :: moments
    type(direction_fabric_t), intent(out) :: fabric
    integer(c_int) :: info

    info = 0
    fabric = nothing()
    if (.not. moments%total > 0.0_wp) return
    fabric%count = nint(moments%directions, c_int64_t)
    fabric%total = moments%total
    fabric%first2 = moments%second / moments%total
    fabric%first4 = moments%fourth / moments%total
    call third_kind(dimension, fabric%first2, fabric%first4, fabric%third2, fabric%third4)
    call second_kind(dimension, fabric%third2, fabric%third4, fabric%second2, fabric%second4)
    fabric%anisotropy = scalar_anisotropy(dimension, fabric%third2)
    call find_principal(fabric%first2, fabric%principal_values, fabric%principal_directions, info)
    ! In the plane the third principal value is that of z, 0, and the smallest.
    fabric%deviator = fabric%principal_values(1) - fabric%principal_values(dimension)
    if (dimension == 2) fabric%angle = plane_angle(fabric%third2)
  end function describe_directions

  !> Direction of the largest principal value of a traceless tensor of the plane, from x towards y [deg], in (-90, 90].
  !> (Paper 003, Eq. 4, writes an arctangent, which leaves two directions open.)
  pure function plane_angle(a) result(angle) bind(C, name='hypofab_plane_angle')
    real(wp), intent(in) :: a(6)
    real(wp) :: angle
    angle = 0.5_wp * atan2(2.0_wp * a(4), a(1) - a(2)) * 180.0_wp / acos(-1.0_wp)
  end function plane_angle

  !> No directions.
  pure function nothing() result(fabric)
    type(direction_fabric_t) :: fabric
    real(wp) :: nan
    nan = ieee_value(1.0_wp, ieee_quiet_nan)
    fabric = direction_fabric_t(0_c_int64_t, nan, nan, nan, nan, nan, nan, nan, nan, nan, &
                                nan, nan, nan)
  end function nothing

end module hypofab_direction_fabric
