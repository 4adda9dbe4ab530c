!> Where the numbers of a material point sit while points are integrated side by side, and what the kernels have in common.
!>
!> A point occupies a lane; lanes(lane, field) keeps each field of neighbouring lanes together, as vector registers want. How
!> many lanes there are many_lanes.f90 and one_lane.f90 say: kernels that serve a single point too are compiled with both.
module umat_lanes
  use, intrinsic :: iso_fortran_env, only: int64, real64
  implicit none
  public

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
  integer, parameter :: l_wanted = 38 !< length of strain that the next step should cover
  !> The path at the step's start: speed, components of the direction of delta, rho^chi, rho, 1 - rho^beta_r, and exp(-x)
  !> of an axis.
  integer, parameter :: l_speed = 39, l_node_along = 40, l_node_across = 41, l_rho_chi = 42, l_rho = 43, l_left = 44, l_decay = 45
  integer, parameter :: l_error = 46 !< of the segment in one step, where that was accepted (short.f90)
  integer, parameter :: n_fields = 46

  !> Tags: kind of path, as in delta_path.f90, what became of an attempted step, and whether the segment has been tried in one
  !> step (short.f90). As wide as a field, so that they fill masks without conversion.
  integer, parameter :: t_kind = 1, t_outcome = 2, t_short = 3, n_tags = 3
  integer(int64), parameter :: short_untried = 0_int64, short_tried = 1_int64
  integer(int64), parameter :: kind_fixed = 0_int64, kind_straight = 1_int64, kind_axis = 2_int64, kind_plane = 3_int64
  !> special: the scalar update must decide; begin: the segment is to begin.
  integer(int64), parameter :: outcome_going = 0_int64, outcome_segment_done = 1_int64, outcome_special = 2_int64, &
                               outcome_begin = 3_int64

  !> Between the no and the yes of a mask.
  real(real64), parameter :: half = 0.5_real64
  !> Stands for zero under a logarithm or in a divisor.
  real(real64), parameter :: nothing = 1.0e-290_real64
  !> A path further out is left to the scalar update.
  real(real64), parameter :: largest_x = 600.0_real64
  !> Pressures below this part of h_s, or of the size of stress, are left to the scalar update.
  real(real64), parameter :: smallest_pressure = 1.0e-20_real64, smallest_share = 1.0e-12_real64
  !> Reach of the series in series.inc.
  real(real64), parameter :: reach_of_exp = 0.25_real64, reach_of_log = 0.125_real64
end module umat_lanes
