!> The C face of what follows from a stress alone.
module umat_api_friction_angle
  use, intrinsic :: iso_c_binding, only: c_double
  use umat_tensor, only: friction_angle
  implicit none
  private

contains

  !> hypofab_friction_angle of hypofab_model.h.
  pure function friction_angle_c(stress) result(phi) bind(C, name='hypofab_friction_angle')
    real(c_double), intent(in) :: stress(6)
    real(c_double) :: phi
    phi = friction_angle(stress)
  end function friction_angle_c

end module umat_api_friction_angle
