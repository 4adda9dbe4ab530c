!> Cost of the update of many points side by side: ns per point and increment, also in scalar rates measured in the same
!> run, for every instruction set that the processor has; and the error reached.
!>
!> Random states of one sand, as in bench_model: delta zero, partial or fully mobilised, random directions of strain. And
!> the states after ten increments in the same direction, as an explicit code meets them most. The first argument is the
!> tolerance (1e-6): what counts is the error reached. Times are processor times, the best of many: others may use the
!> machine too.
program bench_batch
  use, intrinsic :: iso_c_binding, only: c_double, c_int, c_int64_t
  use, intrinsic :: iso_fortran_env, only: int64
  use umat_batch, only: update_points
  use bench_statistics, only: median
  use umat_kinds, only: wp
  use umat_material, only: material_type, material_from_props
  use umat_rate, only: state_type, state_rate
  use umat_sands, only: sands, find_sand
  use umat_status, only: status_ok
  use umat_tensor, only: norm, deviator
  use umat_update, only: options_type, report_type, update_state
  implicit none

  interface
    !> umat/batch/batch.c: the best instruction set of this processor
    function best_instructions() bind(C, name='hypofab_batch_best_instructions')
      import :: c_int
      integer(c_int) :: best_instructions
    end function best_instructions
  end interface

  integer, parameter :: n_points = 1280, n_repeats = 40
  integer(int64), parameter :: stride = n_points
  character(len=8), parameter :: names(0:2) = [character(len=8) :: 'portable', 'avx2', 'avx512']
  real(wp), parameter :: sizes(5) = [1.0e-7_wp, 1.0e-6_wp, 1.0e-5_wp, 1.0e-4_wp, 1.0e-3_wp]

  type :: points_type
    real(c_double) :: stress(n_points, 6), delta(n_points, 6), void_ratio(n_points)
  end type points_type

  type(points_type) :: start, worn
  type(material_type) :: m
  real(wp) :: directions(n_points, 6), rate_cost, tolerance
  character(len=32) :: argument
  integer :: i, set

  m = material_from_props(sands(find_sand('paper000'))%props)
  tolerance = 1.0e-6_wp
  if (command_argument_count() > 0) then
    call get_command_argument(1, argument)
    read (argument, *) tolerance
  end if
  call make_points()
  call time_rates(rate_cost)
  write (*, '(a, f0.1, a)') 'one scalar rate: ', rate_cost, ' ns'
  write (*, '(a)') ''
  write (*, '(a)') '                             ns per point              rates per     scalar     stress error (relative)'
  write (*, '(a)') 'set      states |strain|     and step   in rates  point, step     share      median      worst    '// &
    'scalar path, ns'
  do set = 0, best_instructions()
    do i = 1, size(sizes)
      call time_batch(set, 'random', start, sizes(i))
    end do
    do i = 1, size(sizes)
      worn = start
      call wear(sizes(i))
      call time_batch(set, 'worn', worn, sizes(i))
    end do
  end do

contains

  !> Fill points and directions, the same in every run.
  subroutine make_points()
    real(wp) :: u(16), p, s(6)
    integer :: k, n_seed
    integer, allocatable :: seed(:)
    call random_seed(size=n_seed)
    allocate (seed(n_seed), source=42)
    call random_seed(put=seed)
    do k = 1, n_points
      call random_number(u)
      p = exp(log(10.0_wp) + u(2) * log(50.0_wp))
      s = deviator(u(3:8) - 0.5_wp)
      start%stress(k, :) = -p*[1, 1, 1, 0, 0, 0] + 0.7_wp * u(9) * p * s / norm(s)
      start%void_ratio(k) = (m%e_d0 + u(10) * (m%e_c0 - m%e_d0)) * exp(-(3.0_wp * p / m%h_s)**m%n) * 1.001_wp
      call random_number(s)
      s = s - 0.5_wp
      start%delta(k, :) = m%R * 0.999999_wp * s / norm(s)
      if (u(11) < 0.2_wp) start%delta(k, :) = 0.0_wp
      if (u(11) > 0.6_wp) start%delta(k, :) = u(12) * start%delta(k, :)
      call random_number(s)
      s = s - 0.5_wp
      directions(k, :) = s / norm(s)
    end do
  end subroutine make_points

  !> Cost of a scalar rate [ns].
  subroutine time_rates(cost)
    real(wp), intent(out) :: cost
    type(state_type) :: rate, states(n_points)
    real(wp) :: d(6, n_points), sink
    real(wp) :: began, ended
    integer :: k, j, branch, status
    do k = 1, n_points
      states(k) = state_type(start%stress(k, :), start%delta(k, :), start%void_ratio(k))
      d(:, k) = directions(k, :)
    end do
    sink = 0.0_wp
    cost = huge(cost)
    do j = 1, 200
      call cpu_time(began)
      do k = 1, n_points
        call state_rate(m, states(k), d(:, k), rate, branch, status)
        sink = sink + rate%stress(1)
      end do
      call cpu_time(ended)
      cost = min(cost, 1.0e9_wp * (ended - began) / n_points)
    end do
    if (abs(sink) > huge(sink)) write (*, *) sink ! keeps the loop
  end subroutine time_rates

  !> Ten increments of the worn points.
  subroutine wear(length)
    real(wp), intent(in) :: length
    integer(c_int64_t) :: scalar
    integer(c_int) :: status(n_points), evaluations(n_points)
    integer :: k
    do k = 1, 10
      call update_all(0, worn, length * directions, status, evaluations, scalar)
    end do
  end subroutine wear

  !> All points.
  subroutine update_all(set, points, strain, status, evaluations, scalar)
    integer, intent(in) :: set
    type(points_type), intent(inout) :: points
    real(c_double), intent(in) :: strain(n_points, 6)
    integer(c_int), intent(out) :: status(n_points)
    integer(c_int), intent(out) :: evaluations(n_points)
    integer(c_int64_t), intent(out) :: scalar
    scalar = 0
    call update_points(sands(find_sand('paper000'))%props, tolerance, 20000_c_int, 0_c_int, int(set, c_int), &
      int(n_points, c_int), stride, points%stress, points%delta, points%void_ratio, strain, status, evaluations, scalar)
  end subroutine update_all

  !> One line.
  subroutine time_batch(set, what, points, length)
    integer, intent(in) :: set
    character(len=*), intent(in) :: what
    type(points_type), intent(in) :: points
    real(wp), intent(in) :: length
    type(points_type) :: work
    type(state_type) :: state
    type(report_type) :: report
    real(wp) :: best, best_scalar, error(n_points), strain(n_points, 6)
    integer(c_int64_t) :: scalar
    integer(c_int) :: status(n_points), evaluations(n_points)
    real(wp) :: began, ended
    integer :: k, j, outcome
    strain = length * directions
    best = huge(best)
    do j = 1, n_repeats
      work = points
      call cpu_time(began)
      call update_all(set, work, strain, status, evaluations, scalar)
      call cpu_time(ended)
      best = min(best, 1.0e9_wp * (ended - began) / n_points)
    end do
    best_scalar = huge(best_scalar)
    do j = 1, 3
      call cpu_time(began)
      do k = 1, n_points
        state = state_type(points%stress(k, :), points%delta(k, :), points%void_ratio(k))
        call update_state(m, options_type(tolerance=tolerance), state, strain(k, :), report, outcome)
      end do
      call cpu_time(ended)
      best_scalar = min(best_scalar, 1.0e9_wp * (ended - began) / n_points)
    end do
    do k = 1, n_points
      state = state_type(points%stress(k, :), points%delta(k, :), points%void_ratio(k))
      call update_state(m, options_type(tolerance=1.0e-11_wp), state, strain(k, :), report, outcome)
      error(k) = 0.0_wp
      if (status(k) == status_ok .and. outcome == status_ok) &
        error(k) = norm(work%stress(k, :) - state%stress) / norm(state%stress)
    end do
    write (*, '(a9, a7, es8.1, f13.0, f11.2, f13.1, f8.1, a, es12.1, es11.1, f19.0)') names(set), what, length, best, &
      best / rate_cost, real(sum(evaluations), wp) / n_points, 100.0_wp * real(scalar, wp) / n_points, ' %', &
      median(error), maxval(error), best_scalar
  end subroutine time_batch

end program bench_batch
