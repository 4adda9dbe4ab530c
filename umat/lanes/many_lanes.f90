!> Lanes of many points side by side.
module umat_many_lanes
  implicit none
  public

  !> Points that go through the rounds together: many, so that few registers run half empty in later rounds; and lanes
  !> that the kernel works on at once, a multiple of the widest vector register. No result depends on them.
  integer, parameter :: most_points = 256, width = 16
  !> Lanes: room to fill up registers, and a few more so that the fields of a point fall into different sets of the cache.
  integer, parameter :: n_lanes = most_points + 2 * width + 8
end module umat_many_lanes
