!> Status codes of the library, the same numbers as hypofab_status in hypofab.h.
!>
!> 1..99: a physical finding, 100..199: bad input, from 200: internal error.
module umat_status
  implicit none
  public

  integer, parameter :: status_ok = 0
  integer, parameter :: status_out_of_domain = 3
  integer, parameter :: status_step_limit = 4
  integer, parameter :: status_bad_material = 100
  integer, parameter :: status_bad_state = 101
  integer, parameter :: status_bad_argument = 102

  !> Branches of the model, the same numbers as hypofab_branch in hypofab.h.
  integer, parameter :: branch_plain = 0
  integer, parameter :: branch_loading = 1
  integer, parameter :: branch_reversal = 2
end module umat_status
