!> One lane, for a point alone.
module umat_one_lane
  implicit none
  public

  !> As in many_lanes.f90.
  integer, parameter :: width = 1, n_lanes = 1
end module umat_one_lane
