!> What the errors of a step of many points side by side are, and what they ask of the next: missing_of and growth_after of
!> collocation.f90 and step.f90.
!>
!> Compiled once per instruction set, each time as a module of its own name (kernel.cmake).
module umat_batch_errors_portable
  use, intrinsic :: iso_fortran_env, only: real64
  use umat_batch_reach_portable, only: nodes_type
  use umat_lanes
  use umat_many_lanes, only: width
  use umat_lobatto, only: rules, most_nodes, rule_long
  use umat_material, only: material_type
  use umat_step, only: good_sweeps, least_growth, most_growth, safety
  implicit none
  private
  public :: missing_of, growth_after, size_of

  integer, parameter :: wp = real64
  integer, parameter :: last_node = rules(rule_long)%n
  !> Weights of the modes.
  real(wp), parameter :: weight(0:most_nodes, 0:3) = rules(rule_long)%mode
  !> Exponent of theta in growth_after of step.f90.
  integer, parameter :: order_of_sweeps = 2 * good_sweeps + 3

contains

  !> What the nodes leave out, of the change of stress relative to a size and of the length of strain relative to R.
  pure function missing_of(m, nodes, f, coupling, scale) result(missing)
    type(material_type), intent(in) :: m
    type(nodes_type), intent(in) :: nodes
    real(wp), intent(in) :: f(width, 6, 0:most_nodes), coupling(width), scale(width)
    real(wp) :: missing(width)
    real(wp) :: modes(width, 0:3), factor, inverse_R
    integer :: i, k, comp
    modes = 0.0_wp
    do comp = 1, 6
      factor = merge(1.0_wp, 2.0_wp, comp <= 3)
      do k = 0, 3
        !GCC$ ivdep
        do i = 1, width
          modes(i, k) = modes(i, k) + factor * &
                        mode_of(k, f(i, comp, 0), f(i, comp, 1), f(i, comp, 2), f(i, comp, 3), f(i, comp, 4))**2
        end do
      end do
    end do
    modes = sqrt(modes)
    !GCC$ ivdep
    do i = 1, width
      missing(i) = tail(modes(i, 0), modes(i, 1), modes(i, 2), modes(i, 3), last_node, coupling(i)) / scale(i)
    end do
    if (.not. m%intergranular) return
    ! Where the path measures length nothing is missing: the strain is the same at all nodes.
    do k = 0, 3
      !GCC$ ivdep
      do i = 1, width
        modes(i, k) = abs(mode_of(k, nodes%strain(i, 0), nodes%strain(i, 1), nodes%strain(i, 2), nodes%strain(i, 3), &
                                  nodes%strain(i, 4)))
      end do
    end do
    inverse_R = 1.0_wp / m%R
    !GCC$ ivdep
    do i = 1, width
      missing(i) = max(missing(i), tail(modes(i, 0), modes(i, 1), modes(i, 2), modes(i, 3), last_node, 0.0_wp) * inverse_R)
    end do
  end function missing_of

  !> A coefficient of the polynomial through values at the nodes.
  !> @param i as in lobatto_type
  elemental function mode_of(i, f0, f1, f2, f3, f4) result(mode)
    integer, intent(in) :: i
    real(wp), intent(in) :: f0, f1, f2, f3, f4
    real(wp) :: mode
    mode = weight(0, i) * f0 + weight(1, i) * f1 + weight(2, i) * f2 + weight(3, i) * f3 + weight(4, i) * f4
  end function mode_of

  !> Size of a tensor in every lane.
  pure function size_of(t) result(size)
    real(wp), intent(in) :: t(width, 6)
    real(wp) :: size(width)
    size = sqrt(t(:, 1)**2 + t(:, 2)**2 + t(:, 3)**2 + 2.0_wp * (t(:, 4)**2 + t(:, 5)**2 + t(:, 6)**2))
  end function size_of

  !> As growth_after in step.f90. Powers are taken only where a lane asks for another size.
  !> @param asked 1 in lanes that matter
  pure subroutine growth_after(tolerance, missing, theta, asked, growth)
    real(wp), intent(in) :: tolerance(width), missing(width), theta(width), asked(width)
    real(wp), intent(out) :: growth(width)
    real(wp) :: error, sweeping, bound, order, needed(width)
    integer :: i
    order = rules(rule_long)%n + 3
    bound = (safety / most_growth)**(rules(rule_long)%n + 3)
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

  include 'series.inc'
  include 'tail.inc'

end module umat_batch_errors_portable
