!> What the errors of a step of many points side by side are, and what they ask of the next: missing_of, tail and growth_after
!> of collocation.f90 and step.f90.
!>
!> Compiled once per instruction set, each time as a module of its own name (HYPOFAB_BATCH_ERRORS).
module HYPOFAB_BATCH_ERRORS
  use, intrinsic :: iso_fortran_env, only: real64
  use HYPOFAB_BATCH_REACH, only: nodes_type
  use umat_batch_lanes
  use umat_lobatto, only: rules, most_nodes, rule_short, rule_long
  use umat_material, only: material_type
  use umat_step, only: good_sweeps, least_growth, most_growth, safety
  implicit none
  private
  public :: missing_of, growth_after, size_of

  integer, parameter :: wp = real64
  !> Exponent of theta in growth_after of step.f90.
  integer, parameter :: order_of_sweeps = 2 * good_sweeps + 3

contains

  !> What the nodes leave out, of the change of stress relative to a size and of the length of strain relative to R.
  pure function missing_of(m, rule, nodes, f, coupling, scale) result(missing)
    type(material_type), intent(in) :: m
    integer, intent(in) :: rule
    type(nodes_type), intent(in) :: nodes
    real(wp), intent(in) :: f(width, 6, 0:most_nodes), coupling(width), scale(width)
    real(wp) :: missing(width)
    real(wp) :: modes(width, 0:2), mode0, mode1, mode2, factor, none(width)
    integer :: i, comp
    modes = 0.0_wp
    do comp = 1, 6
      factor = merge(1.0_wp, 2.0_wp, comp <= 3)
      !GCC$ ivdep
      do i = 1, width
        mode0 = mode_of(rule, 0, f(i, comp, 0), f(i, comp, 1), f(i, comp, 2), f(i, comp, 3), f(i, comp, 4))
        mode1 = mode_of(rule, 1, f(i, comp, 0), f(i, comp, 1), f(i, comp, 2), f(i, comp, 3), f(i, comp, 4))
        mode2 = mode_of(rule, 2, f(i, comp, 0), f(i, comp, 1), f(i, comp, 2), f(i, comp, 3), f(i, comp, 4))
        modes(i, 0) = modes(i, 0) + factor * mode0**2
        modes(i, 1) = modes(i, 1) + factor * mode1**2
        modes(i, 2) = modes(i, 2) + factor * mode2**2
      end do
    end do
    modes = sqrt(modes)
    missing = tail(rule, modes, coupling) / scale
    if (.not. m%intergranular) return
    none = 0.0_wp
    ! Where the path measures length nothing is missing: the strain is the same at all nodes.
    !GCC$ ivdep
    do i = 1, width
    modes(i, 0) = abs(mode_of(rule, 0, nodes%strain(i, 0), nodes%strain(i, 1), nodes%strain(i, 2), nodes%strain(i, 3), &
                                nodes%strain(i, 4)))
    modes(i, 1) = abs(mode_of(rule, 1, nodes%strain(i, 0), nodes%strain(i, 1), nodes%strain(i, 2), nodes%strain(i, 3), &
                                nodes%strain(i, 4)))
    modes(i, 2) = abs(mode_of(rule, 2, nodes%strain(i, 0), nodes%strain(i, 1), nodes%strain(i, 2), nodes%strain(i, 3), &
                                nodes%strain(i, 4)))
    end do
    missing = max(missing, tail(rule, modes, none) * (1.0_wp / m%R))
  end function missing_of

  !> A coefficient of the polynomial through values at the nodes; the last two are those of the long rule.
  !> @param i as in lobatto_type
  elemental function mode_of(rule, i, f0, f1, f2, f3, f4) result(mode)
    integer, intent(in) :: rule, i
    real(wp), intent(in) :: f0, f1, f2, f3, f4
    real(wp) :: mode
    if (rule == rule_short) then
      mode = rules(rule_short)%mode(0, i) * f0 + rules(rule_short)%mode(1, i) * f1 + rules(rule_short)%mode(2, i) * f2
    else
      mode = rules(rule_long)%mode(0, i) * f0 + rules(rule_long)%mode(1, i) * f1 + rules(rule_long)%mode(2, i) * f2 + &
             rules(rule_long)%mode(3, i) * f3 + rules(rule_long)%mode(4, i) * f4
    end if
  end function mode_of

  !> As tail in collocation.f90.
  pure function tail(rule, modes, coupling) result(missing)
    integer, intent(in) :: rule
    real(wp), intent(in) :: modes(width, 0:2), coupling(width)
    real(wp) :: missing(width)
    real(wp) :: highest, falls, ratio, to_next
    real(wp), parameter :: trust = 0.3_wp
    integer :: i
    !GCC$ ivdep
    do i = 1, width
      falls = min(1.0_wp, modes(i, 1) / max(modes(i, 2), nothing))
      highest = max(modes(i, 0), merge(trust * modes(i, 1) * falls, 0.0_wp, modes(i, 2) > 0.0_wp))
      ratio = sqrt(min(1.0_wp, highest / max(modes(i, 2), nothing)))
      if (rule == rule_short) then
        to_next = min(1.0_wp, highest / max(modes(i, 1), nothing))
        ratio = merge(to_next, ratio, highest > ratio * modes(i, 1))
        missing(i) = highest * ratio * max(ratio, coupling(i))
      else
        missing(i) = highest * ratio * max(ratio**2, coupling(i))
      end if
    end do
  end function tail

  !> Size of a tensor in every lane.
  pure function size_of(t) result(size)
    real(wp), intent(in) :: t(width, 6)
    real(wp) :: size(width)
    size = sqrt(t(:, 1)**2 + t(:, 2)**2 + t(:, 3)**2 + 2.0_wp * (t(:, 4)**2 + t(:, 5)**2 + t(:, 6)**2))
  end function size_of

  !> As growth_after in step.f90. Powers are taken only where a lane asks for another size.
  !> @param asked 1 in lanes that matter
  pure subroutine growth_after(tolerance, rule, missing, theta, asked, growth)
    real(wp), intent(in) :: tolerance(width), missing(width), theta(width), asked(width)
    integer, intent(in) :: rule
    real(wp), intent(out) :: growth(width)
    real(wp) :: error, sweeping, bound, order, needed(width)
    integer :: i
    order = rules(rule)%n + 3
    bound = (safety / most_growth)**(rules(rule)%n + 3)
    growth = most_growth
    !GCC$ ivdep
    do i = 1, width
      error = missing(i) / tolerance(i)
      sweeping = 0.5_wp * theta(i)**order_of_sweeps / tolerance(i)
      needed(i) = asked(i) * merge(1.0_wp, 0.0_wp, max(error - bound, sweeping - (safety / most_growth)**order_of_sweeps) > 0.0_wp)
    end do
    if (.not. any(needed > half)) return
    !GCC$ ivdep
    do i = 1, width
      error = max(bound, missing(i) / tolerance(i))
      sweeping = max((safety / most_growth)**order_of_sweeps, 0.5_wp * theta(i)**order_of_sweeps / tolerance(i))
      error = max(least_growth, safety * exp(-max(log(error) / order, log(sweeping) * (1.0_wp / order_of_sweeps))))
      growth(i) = chosen(needed(i), min(most_growth, error), most_growth)
    end do
  end subroutine growth_after

  include 'batch_series.inc'

end module HYPOFAB_BATCH_ERRORS
