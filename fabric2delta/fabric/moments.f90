!> Weighted moments of directions: sum w, sum w n n, sum w n n n n.
module hypofab_moments
  use, intrinsic :: iso_c_binding, only: wp => c_double
  use hypofab_rank4, only: fourth_power
  implicit none
  private
  public :: moments_t, add_direction, add_unweighted

  !> contact_moments of description_sums.h, member by member.
  type, bind(C) :: moments_t
    real(wp) :: directions = 0.0_wp  !< how many were added
    real(wp) :: total = 0.0_wp       !< sum w
    real(wp) :: second(6) = 0.0_wp   !< sum w n n
    real(wp) :: fourth(15) = 0.0_wp  !< sum w n n n n
  end type moments_t

contains

  !> Add one direction.
  !> @param moments in and out
  !> @param n       unit vector; its sense does not matter
  !> @param weight  w, in any unit
  pure subroutine add_direction(moments, n, weight)
    type(moments_t), intent(inout) :: moments
    real(wp), intent(in) :: n(3), weight

    moments%directions = moments%directions + 1.0_wp
    moments%total = moments%total + weight
    moments%second = moments%second + &
                     weight*[n(1) * n(1), n(2) * n(2), n(3) * n(3), n(1) * n(2), n(1) * n(3), n(2) * n(3)]
    moments%fourth = moments%fourth + weight * fourth_power(n)
  end subroutine add_direction

  !> add_direction with weight 1 for C.
  pure subroutine add_unweighted(n, moments) bind(C, name='hypofab_add_direction')
    real(wp), intent(in) :: n(3)
    type(moments_t), intent(inout) :: moments
    call add_direction(moments, n, 1.0_wp)
  end subroutine add_unweighted

end module hypofab_moments
