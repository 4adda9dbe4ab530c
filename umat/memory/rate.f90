!> State -> rate of state: the one function everything else calls.
module umat_rate
  use umat_kinds, only: wp
  use umat_intergranular, only: intergranular_type, intergranular_direction, branch_of, turn_of, scale_of, operands, delta_rate
  use umat_material, only: material_type
  use umat_status, only: status_ok, branch_plain, branch_loading, branch_reversal
  use umat_tensor, only: norm, trace, multiplicity
  use umat_wolffersdorff, only: hypoplastic_type, hypoplastic_tensors, apply_L, matrix_of_L
  implicit none
  private
  public :: state_type, state_rate, rate_of_stress, choose_branch, linear_parts, continuum_stiffness

  !> State of a material point, or its rate.
  type :: state_type
    real(wp) :: stress(6) !< effective stress T, tension positive [stress]
    real(wp) :: delta(6) !< intergranular strain, tensor components [-]
    real(wp) :: void_ratio
  end type state_type

contains

  !> The branch that a stretching takes in a state.
  pure function choose_branch(m, delta, stretching) result(branch)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: delta(6), stretching(6)
    integer :: branch
    if (m%intergranular) then
      branch = branch_of(intergranular_direction(m, delta), stretching)
    else
      branch = branch_plain
    end if
  end function choose_branch

  !> Rate of stress on a given branch; theory.md Eq. (11) for the plain model, Eq. (13) otherwise. Corotational.
  !>
  !> The branch is an argument, so that an integrator can stay on a smooth right-hand side.
  !> @param m           material
  !> @param stress, void_ratio inside the model's domain
  !> @param g           direction and mobilisation of delta; without meaning for the plain model
  !> @param stretching  D [1/time]
  !> @param branch      from choose_branch
  !> @param stress_rate [stress/time]; zero on failure
  !> @param status      status_ok or status_out_of_domain
  pure subroutine rate_of_stress(m, stress, void_ratio, g, stretching, branch, stress_rate, status)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: stress(6), void_ratio
    type(intergranular_type), intent(in) :: g
    real(wp), intent(in) :: stretching(6)
    integer, intent(in) :: branch
    real(wp), intent(out) :: stress_rate(6)
    integer, intent(out) :: status
    type(hypoplastic_type) :: h
    real(wp) :: x(6), weight

    stress_rate = 0.0_wp
    call hypoplastic_tensors(m, stress, void_ratio, h, status)
    if (status /= status_ok) return
    call operands(m, g, stretching, branch, x, weight)
    stress_rate = apply_L(h, x) + weight * h%N
  end subroutine rate_of_stress

  !> Rates of stress, delta and void ratio: theory.md Eqs. (11) or (13), (14) and (15). Rates of tensors are corotational.
  !> @param rate   rate of the state [per time]; zero on failure
  !> @param branch the branch taken
  pure subroutine state_rate(m, state, stretching, rate, branch, status)
    type(material_type), intent(in) :: m
    type(state_type), intent(in) :: state
    real(wp), intent(in) :: stretching(6)
    type(state_type), intent(out) :: rate
    integer, intent(out) :: branch, status

    type(intergranular_type) :: g

    rate = state_type(0.0_wp, 0.0_wp, 0.0_wp)
    g = intergranular_type(0.0_wp, 0.0_wp, 0.0_wp)
    branch = branch_plain
    if (m%intergranular) then
      g = intergranular_direction(m, state%delta)
      branch = branch_of(g, stretching)
    end if
    call rate_of_stress(m, state%stress, state%void_ratio, g, stretching, branch, rate%stress, status)
    if (status /= status_ok) return
    if (m%intergranular) rate%delta = delta_rate(m, g, stretching, branch)
    rate%void_ratio = (1.0_wp + state%void_ratio) * trace(stretching) ! Eq. (15): grains keep their volume
  end subroutine state_rate

  !> The linear parts of the stress rate.
  !>
  !> Tdot = reversal D, plus jump (direction:D) where direction:D > 0. Plain model: Tdot = reversal D + jump |D|.
  !> @param reversal  matrix on tensor components, shear counted twice in the columns [stress]
  !> @param jump      [stress]
  !> @param direction deltahat, or zero
  !> @param status    status_ok or status_out_of_domain
  pure subroutine linear_parts(m, state, reversal, jump, direction, status)
    type(material_type), intent(in) :: m
    type(state_type), intent(in) :: state
    real(wp), intent(out) :: reversal(6, 6), jump(6), direction(6)
    integer, intent(out) :: status
    type(hypoplastic_type) :: h
    type(intergranular_type) :: g
    real(wp) :: turn(6)
    integer :: j

    reversal = 0.0_wp
    jump = 0.0_wp
    direction = 0.0_wp
    call hypoplastic_tensors(m, state%stress, state%void_ratio, h, status)
    if (status /= status_ok) return
    reversal = matrix_of_L(h)
    jump = h%N
    if (.not. m%intergranular) return
    g = intergranular_direction(m, state%delta)
    turn = turn_of(m, h, g, branch_reversal)
    reversal = scale_of(m, g) * reversal
    do j = 1, 6
      reversal(:, j) = reversal(:, j) + turn * multiplicity(j) * g%direction(j)
    end do
    jump = turn_of(m, h, g, branch_loading) - turn
    direction = g%direction
  end subroutine linear_parts

  !> Continuum stiffness d Tdot/d D of the branch that a stretching takes.
  !>
  !> Without a stretching (D = 0) it is the stiffness of a reversal, without intergranular strain it is L: the stiffest
  !> and smoothest answer the model gives.
  !> @param stiffness matrix on tensor components, shear counted twice in the columns [stress]
  !> @param status    status_ok or status_out_of_domain
  pure subroutine continuum_stiffness(m, state, stretching, stiffness, status)
    type(material_type), intent(in) :: m
    type(state_type), intent(in) :: state
    real(wp), intent(in) :: stretching(6)
    real(wp), intent(out) :: stiffness(6, 6)
    integer, intent(out) :: status
    real(wp) :: jump(6), direction(6), size
    integer :: j

    call linear_parts(m, state, stiffness, jump, direction, status)
    if (status /= status_ok) return
    size = norm(stretching)
    if (.not. size > 0.0_wp) return
    if (.not. m%intergranular) then
      direction = stretching / size
    else if (choose_branch(m, state%delta, stretching) == branch_reversal) then
      return
    end if
    do j = 1, 6
      stiffness(:, j) = stiffness(:, j) + jump * multiplicity(j) * direction(j)
    end do
  end subroutine continuum_stiffness

end module umat_rate
