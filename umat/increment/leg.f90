!> A leg of a strain increment: the part of it on one branch of the intergranular strain.
module umat_leg
  use umat_delta_path, only: delta_path_type
  use umat_kinds, only: wp
  use umat_tensor, only: trace
  implicit none
  private
  public :: leg_type, void_ratio_at

  !> What does not change along a leg.
  type :: leg_type
    type(delta_path_type) :: path !< of delta
    integer :: branch
    real(wp) :: direction(6) !< unit strain direction
    real(wp) :: turn !< length of strain that the increment has done before [strain]
    real(wp) :: length !< of the leg [strain]
    real(wp) :: void_ratio !< at its start
    real(wp) :: tolerance !< relative
    logical :: with_tangent !< carry the influence of the increment on stress too?
  end type leg_type

contains

  !> Void ratio after a length of strain: grains keep their volume; theory.md Eq. (15) integrated.
  elemental function void_ratio_at(leg, covered) result(e)
    type(leg_type), intent(in) :: leg
    real(wp), intent(in) :: covered
    real(wp) :: e
    e = (1.0_wp + leg%void_ratio) * exp(trace(leg%direction) * covered) - 1.0_wp
  end function void_ratio_at

end module umat_leg
