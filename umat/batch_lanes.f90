!> Where the numbers of a material point sit while many points are integrated side by side (batch.f90, batch_kernel.F90).
!>
!> A point occupies a lane; lanes(lane, field) keeps each field of neighbouring lanes together, as vector registers want.
module umat_batch_lanes
  use, intrinsic :: iso_fortran_env, only: int64
  implicit none
  public

  !> Lanes of a group, and lanes that a kernel works on at once: a multiple of the widest vector register. No result
  !> depends on them.
  integer, parameter :: n_lanes = 136, width = 16

  !> Fields. Tensors take six; those of delta and void ratio belong to the start of the present segment, a part of the
  !> increment on one branch.
  integer, parameter :: l_stress = 1, l_delta = 7, l_e = 13
  integer, parameter :: l_strain = 14 !< the increment; from begin_increment on its direction
  integer, parameter :: l_along = l_strain
  integer, parameter :: l_across = 20 !< direction of the part of delta/R normal to the strain; straight: that part of delta
  integer, parameter :: l_kappa = 26 !< first integral of a plane path; straight: square of the normal part of delta
  integer, parameter :: l_start = 27 !< straight: delta:d at its start
  integer, parameter :: l_power = 28 !< power of the path's elementary function that is rho
  integer, parameter :: l_x = 29, l_h = 30 !< the path's parameter and the step in it
  integer, parameter :: l_length = 31, l_done = 32 !< length of strain of the segment, and done in it
  integer, parameter :: l_rest = 33 !< length of strain that follows after the segment
  integer, parameter :: l_trace = 34 !< trace of the direction
  integer, parameter :: l_smallest = 35 !< |stress| below which the path is on its way to zero
  integer, parameter :: l_evaluations = 36, l_refused = 37 !< rate evaluations, steps refused
  integer, parameter :: l_exponent = 38, l_amplitude = 39 !< the speed of the path is amplitude rho^exponent
  integer, parameter :: n_fields = 39

  !> Tags: kind of path, as in delta_path.f90, and what became of an attempted step. As wide as a field, so that they fill
  !> masks without conversion.
  integer, parameter :: t_kind = 1, t_outcome = 2, n_tags = 2
  integer(int64), parameter :: kind_fixed = 0_int64, kind_straight = 1_int64, kind_axis = 2_int64, kind_plane = 3_int64
  !> special: the scalar update must decide; begin: the segment is to begin.
  integer(int64), parameter :: outcome_going = 0_int64, outcome_segment_done = 1_int64, outcome_special = 2_int64, &
                               outcome_begin = 3_int64
end module umat_batch_lanes
