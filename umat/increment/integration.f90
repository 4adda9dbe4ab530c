!> Adaptive integration of the stress along one branch of the intergranular strain, at a constant direction of strain.
module umat_integration
  use umat_delta_path, only: delta_path, delta_after, first_guess, starts_at_zero
  use umat_influence, only: influence_type
  use umat_kinds, only: wp
  use umat_leg, only: leg_type, void_ratio_at
  use umat_lobatto, only: rules, rule_short, rule_long
  use umat_material, only: material_type
  use umat_rate, only: state_type
  use umat_short_leg, only: short_leg
  use umat_status, only: status_ok, status_out_of_domain, status_step_limit, branch_plain
  use umat_collocation, only: start_of_step
  use umat_step, only: step_type, reach, try, most_share, growth_of
  use umat_tensor, only: norm
  implicit none
  private
  public :: options_type, report_type, integrate
  ! For many points side by side (batch/begin.f90).
  public :: vanishing, first_step, first_from_zero, nearly

  real(wp), parameter :: usual_tolerance = 1.0e-6_wp

  !> Options of an update.
  type :: options_type
    real(wp) :: tolerance = usual_tolerance !< relative error of stress, delta (of R) and void ratio
    integer :: max_evaluations = 20000 !< bound on rate evaluations
  end type options_type

  !> What an update did.
  type :: report_type
    integer :: evaluations = 0 !< rate evaluations
    integer :: branch = branch_plain !< branch at the end
    real(wp) :: substep = 0.0_wp !< |strain| that the error control suggests for the next step; 0: none was made
    logical :: regularised = .false. !< was the stress at or beyond the border of the domain somewhere on the way?
  end type report_type

  !> A stress that falls to this part of its start on a straight path is on its way to zero, which is outside the domain.
  real(wp), parameter :: vanishing = 1.0e-8_wp
  !> A smaller fraction of the increment than this is not tried.
  real(wp), parameter :: smallest_step = 1.0e-10_wp
  !> First step tried, at the default tolerance: this part of R, in which delta turns. Where the stress changes too much the
  !> prediction shortens it.
  real(wp), parameter :: step_of_R = 0.6_wp, step_with_tangent = 0.5_wp
  !> The same from delta = 0, over the tolerance, and at least.
  real(wp), parameter :: step_from_zero = 1.0e3_wp, least_from_zero = 1.0e-5_wp
  !> With the tangent, the rule of three nodes is tried first up to this part of R, or this strain of the plain model.
  real(wp), parameter :: few_nodes_of_R = 0.05_wp, few_nodes_plain = 1.0e-6_wp

  !> A step that is meant to cover this part of what is left covers it all; above the most that is left after a rejection
  !> (step.f90).
  real(wp), parameter :: nearly = 0.95_wp

contains

  !> Integrate over a length of strain on one branch.
  !> @param branch       the branch to stay on
  !> @param direction    unit strain direction
  !> @param turn         length of strain already done in reversal
  !> @param length       length of the strain path
  !> @param with_tangent carry the influence of the increment on stress too?
  !> @param state        in: start, out: end; undefined on failure
  !> @param influence    in: start, out: end
  !> @param report       evaluations are added, the suggested substep is updated
  pure subroutine integrate(m, options, branch, direction, turn, length, with_tangent, state, influence, report, status)
    type(material_type), intent(in) :: m
    type(options_type), intent(in) :: options
    integer, intent(in) :: branch
    real(wp), intent(in) :: direction(6), turn, length
    logical, intent(in) :: with_tangent
    type(state_type), intent(inout) :: state
    type(influence_type), intent(inout) :: influence
    type(report_type), intent(inout) :: report
    integer, intent(out) :: status
    type(leg_type) :: leg
    type(step_type) :: step
    real(wp) :: wanted !< length of strain that the next step should cover
    real(wp) :: growth, covered, error
    logical :: accepted

    status = status_ok
    if (.not. length > 0.0_wp) return
    leg%branch = branch
    leg%direction = direction
    leg%turn = turn
    leg%length = length
    leg%void_ratio = state%void_ratio
    leg%tolerance = options%tolerance
    leg%with_tangent = with_tangent

    step%evaluations = 0
    if (.not. with_tangent) then
      call short_leg(m, leg, most_share * options%tolerance, state, error, accepted, step%evaluations)
      if (accepted) then
        report%evaluations = report%evaluations + step%evaluations
        report%substep = growth_of(error / (most_share * options%tolerance), 4) * length
        return
      end if
    end if
    call start_of_step(m, state%stress, state%void_ratio, step%start, status)
    step%evaluations = step%evaluations + 1

    leg%path = delta_path(m, state%delta, direction, branch, turn)
    wanted = length
    if (m%intergranular) wanted = min(length, first_step(options, with_tangent) * m%R)
    if (starts_at_zero(leg%path)) wanted = min(wanted, first_from_zero(options) * m%R)
    step%rule = rule_long
    if (with_tangent .and. wanted <= merge(few_nodes_of_R * m%R, few_nodes_plain, m%intergranular)) step%rule = rule_short
    step%x = leg%path%start
    step%h = first_guess(m, leg%path, wanted)
    step%obstacle = status_step_limit
    step%influence = influence
    step%influence%integral = 0.0_wp
    do while (status == status_ok)
      call reach(m, leg, wanted >= nearly * (length - step%done), step)
      covered = step%nodes%length(rules(step%rule)%n)
      call try(m, leg, step, accepted, growth)
      if (accepted) then
        if (step%last) exit
        step%x = step%x + step%h
        step%done = step%done + covered
        if (norm(step%stress) < vanishing * norm(state%stress) .and. .not. m%confinement > 0.0_wp) &
          status = status_out_of_domain
        if (status == status_ok) call start_of_step(m, step%stress, void_ratio_at(leg, step%done), step%start, status)
        step%evaluations = step%evaluations + 1
      else if (growth < 1.0_wp .and. covered < smallest_step * length) then
        status = step%obstacle
      end if
      if (report%evaluations + step%evaluations > options%max_evaluations) status = step%obstacle
      wanted = growth * covered
      step%h = growth * step%h
    end do
    report%evaluations = report%evaluations + step%evaluations
    if (status /= status_ok) return
    report%substep = growth * covered
    report%regularised = report%regularised .or. step%outside
    if (m%intergranular) then
      associate (n => rules(step%rule)%n)
        state%delta = delta_after(m, leg%path, step%nodes%point(n), (step%end - 1.0_wp) * step%nodes%strain(n))
      end associate
    end if
    state%void_ratio = void_ratio_at(leg, length)
    state%stress = step%stress
    influence = step%influence
  end subroutine integrate

  !> First step tried from delta = 0, as a part of R. There rho^beta_r bends the path whatever the scale, so that the error of
  !> a step is a fixed part of it.
  pure function first_from_zero(options) result(part)
    type(options_type), intent(in) :: options
    real(wp) :: part
    part = max(step_from_zero * options%tolerance, least_from_zero)
  end function first_from_zero

  !> First step tried, as a part of R; the errors of a step (step.f90) grow with its seventh power.
  pure function first_step(options, with_tangent) result(part)
    type(options_type), intent(in) :: options
    logical, intent(in) :: with_tangent
    real(wp) :: part
    part = merge(step_with_tangent, step_of_R, with_tangent) * (options%tolerance / usual_tolerance)**(1.0_wp / 7.0_wp)
  end function first_step

end module umat_integration
