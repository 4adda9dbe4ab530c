!> Intergranular strain of Niemunis and Herle (1997): the stiffness M and the rate of delta from L, N, delta and the
!> branch.
!>
!> Both branches of theory.md Eq. (13) share one form,
!>   Tdot = scale L:D + turn (deltahat:D),
!> where scale = rho^chi m_T + (1 - rho^chi) m_R and turn is, for
!>   delta:D >  0: rho^chi (1 - m_T) L:deltahat + rho^chi N   (loading)
!>   delta:D <= 0: rho^chi (m_R - m_T) L:deltahat             (reversal)
!> For a given D this is Tdot = L:X + weight N, where X and weight depend on delta and D alone, L and N on T and e alone; the
!> plain model has that form too, with X = D and weight = |D|.
module umat_intergranular
  use umat_kinds, only: wp
  use umat_material, only: material_type
  use umat_status, only: branch_plain, branch_loading, branch_reversal
  use umat_tensor, only: ddot, norm
  use umat_wolffersdorff, only: hypoplastic_type, apply_L
  implicit none
  private
  public :: intergranular_type, intergranular_direction, branch_of, turn_of, scale_of, share_of, operands, delta_rate

  !> |delta| may exceed R by this factor: published tables have three or four digits. Loading draws it back onto R at once.
  real(wp), parameter, public :: slack_of_delta = 1.001_wp

  !> Direction and mobilisation of delta.
  type :: intergranular_type
    real(wp) :: direction(6) !< deltahat; zero for delta = 0
    real(wp) :: rho !< |delta|/R
    real(wp) :: rho_chi !< rho^chi
  end type intergranular_type

contains

  !> Direction and mobilisation of delta.
  pure function intergranular_direction(m, delta) result(g)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: delta(6)
    type(intergranular_type) :: g
    real(wp) :: size
    size = norm(delta)
    if (size > 0.0_wp) then
      g%direction = delta / size
      g%rho = size / m%R
      g%rho_chi = g%rho**m%chi
    else
      g = intergranular_type(0.0_wp, 0.0_wp, 0.0_wp)
    end if
  end function intergranular_direction

  !> The branch that a stretching takes. delta = 0 counts as loading: delta grows along D at once.
  pure function branch_of(g, stretching) result(branch)
    type(intergranular_type), intent(in) :: g
    real(wp), intent(in) :: stretching(6)
    integer :: branch
    if (ddot(g%direction, stretching) > 0.0_wp .or. .not. g%rho > 0.0_wp) then
      branch = branch_loading
    else
      branch = branch_reversal
    end if
  end function branch_of

  !> Factor of L:D, common to both branches.
  pure function scale_of(m, g) result(scale)
    type(material_type), intent(in) :: m
    type(intergranular_type), intent(in) :: g
    real(wp) :: scale
    scale = g%rho_chi * m%m_T + (1.0_wp - g%rho_chi) * m%m_R
  end function scale_of

  !> Factor of deltahat:D on a branch [stress].
  pure function turn_of(m, h, g, branch) result(turn)
    type(material_type), intent(in) :: m
    type(hypoplastic_type), intent(in) :: h
    type(intergranular_type), intent(in) :: g
    integer, intent(in) :: branch
    real(wp) :: turn(6)
    turn = g%rho_chi * share_of(m, branch) * apply_L(h, g%direction)
    if (branch == branch_loading) turn = turn + g%rho_chi * h%N
  end function turn_of

  !> Factor of rho^chi L:deltahat (deltahat:D) on a branch.
  pure function share_of(m, branch) result(share)
    type(material_type), intent(in) :: m
    integer, intent(in) :: branch
    real(wp) :: share
    share = merge(1.0_wp - m%m_T, m%m_R - m%m_T, branch == branch_loading)
  end function share_of

  !> X and weight in Tdot = L:X + weight N.
  !> @param g          direction and mobilisation of delta; without meaning for the plain model
  !> @param stretching D [1/time]
  !> @param x, weight  [1/time]
  pure subroutine operands(m, g, stretching, branch, x, weight)
    type(material_type), intent(in) :: m
    type(intergranular_type), intent(in) :: g
    real(wp), intent(in) :: stretching(6)
    integer, intent(in) :: branch
    real(wp), intent(out) :: x(6), weight
    real(wp) :: mobilised
    if (branch == branch_plain) then
      x = stretching
      weight = norm(stretching)
    else
      mobilised = g%rho_chi * ddot(g%direction, stretching)
      x = scale_of(m, g) * stretching + share_of(m, branch) * mobilised * g%direction
      weight = merge(mobilised, 0.0_wp, branch == branch_loading)
    end if
  end subroutine operands

  !> Rate of delta on a branch [1/time]; theory.md Eq. (14).
  pure function delta_rate(m, g, stretching, branch) result(rate)
    type(material_type), intent(in) :: m
    type(intergranular_type), intent(in) :: g
    real(wp), intent(in) :: stretching(6)
    integer, intent(in) :: branch
    real(wp) :: rate(6)
    rate = stretching
    if (branch == branch_loading .and. g%rho > 0.0_wp) then
      rate = rate - g%rho**m%beta_r * ddot(g%direction, stretching) * g%direction
    end if
  end function delta_rate

end module umat_intergranular
