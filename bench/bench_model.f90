!> Cost of one rate, and of one UMAT call over increments of several sizes, in ns and in rates.
!>
!> Random states of three sands: stress up to a mobilised friction near the critical one, delta zero, partial or fully
!> mobilised, random directions of strain. Medians over the states. Also the errors of stress and tangent, against the same
!> update at a tight tolerance.
program bench_model
  use, intrinsic :: iso_fortran_env, only: int64, real64
  use bench_statistics, only: median, quantile
  use umat_kinds, only: wp
  use umat_material, only: material_type, material_from_props
  use umat_rate, only: state_type, state_rate
  use umat_sands, only: sands, find_sand
  use umat_status, only: status_ok
  use umat_tensor, only: norm, deviator
  use umat_update, only: options_type, report_type, update_state
  implicit none

  integer, parameter :: n_states = 1000, n_sizes = 6
  real(wp), parameter :: sizes(n_sizes) = [1.0e-6_wp, 1.0e-5_wp, 1.0e-4_wp, 1.0e-3_wp, 3.0e-3_wp, 1.0e-2_wp]
  character(len=16), parameter :: names(3) = [character(len=16) :: 'paper000', 'hochstetten', 'karlsruhe_fine']
  type(material_type) :: materials(n_states)
  type(state_type) :: states(n_states)
  real(wp) :: props(16, n_states), directions(6, n_states), rate_cost
  integer, parameter :: n_repeats = 7
  real(wp), parameter :: tolerances(2) = [1.0e-6_wp, 3.0e-5_wp]
  integer :: i, j

  call make_states()
  call time_rates(rate_cost)
  write (*, '(a, f0.1, a)') 'one rate: ', rate_cost, ' ns'
  do j = 1, size(tolerances)
    write (*, '(/, a, es8.1)') 'tolerance ', tolerances(j)
    write (*, '(a)') '               stress only                     with tangent                    '// &
      'stress error (relative)          tangent error (relative)'
    write (*, '(a)') '|strain|  median ns  in rates  evaluations  median ns  in rates  evaluations     '// &
      'median   99 %     worst     median   99 %     worst   failed'
    do i = 1, n_sizes
      call time_updates(sizes(i), tolerances(j))
    end do
  end do
  write (*, '(/, a)') 'UMAT call, default tolerance'
  write (*, '(a)') '|strain|  median ns  in rates'
  do i = 1, n_sizes
    call time_umat(sizes(i))
  end do

contains

  !> Fill materials, states and directions, the same in every run.
  subroutine make_states()
    real(wp) :: u(16), p, s(6)
    integer :: k, j, n_seed
    integer, allocatable :: seed(:)
    call random_seed(size=n_seed)
    allocate (seed(n_seed), source=42)
    call random_seed(put=seed)
    do k = 1, n_states
      call random_number(u)
      j = find_sand(trim(names(1 + int(3.0_wp * u(1)))))
      props(:, k) = sands(j)%props
      materials(k) = material_from_props(props(:, k))
      p = exp(log(10.0_wp) + u(2) * log(50.0_wp))
      s = deviator(u(3:8) - 0.5_wp)
      states(k)%stress = -p*[1, 1, 1, 0, 0, 0] + 0.7_wp * u(9) * p * s / norm(s)
      associate (m => materials(k))
        states(k)%void_ratio = (m%e_d0 + u(10) * (m%e_c0 - m%e_d0)) * exp(-(3.0_wp * p / m%h_s)**m%n) * 1.001_wp
        call random_number(s)
        s = s - 0.5_wp
        states(k)%delta = m%R * 0.999999_wp * s / norm(s)
      end associate
      if (u(11) < 0.2_wp) states(k)%delta = 0.0_wp
      if (u(11) > 0.6_wp) states(k)%delta = u(12) * states(k)%delta
      call random_number(s)
      s = s - 0.5_wp
      directions(:, k) = s / norm(s)
    end do
  end subroutine make_states

  !> Cost of a rate [ns]: the best of many passes over all states.
  subroutine time_rates(cost)
    real(wp), intent(out) :: cost
    integer, parameter :: n_repeats = 200
    type(state_type) :: rate
    real(wp) :: sink
    integer(int64) :: start, finish, ticks
    integer :: k, j, branch, status
    sink = 0.0_wp
    cost = huge(cost)
    do j = 1, n_repeats
      call system_clock(start, ticks)
      do k = 1, n_states
        call state_rate(materials(k), states(k), directions(:, k), rate, branch, status)
        sink = sink + rate%stress(1)
      end do
      call system_clock(finish)
      cost = min(cost, 1.0e9_wp * real(finish - start, wp) / real(ticks, wp) / n_states)
    end do
    if (abs(sink) > huge(sink)) write (*, *) sink ! keeps the loop
  end subroutine time_rates

  !> One line: increments of a length at a tolerance.
  subroutine time_updates(length, tolerance)
    real(wp), intent(in) :: length, tolerance
    real(wp) :: time(n_states, 2), evaluations(2), error(n_states), tangent_error(n_states), tangent(6, 6), exact_tangent(6, 6)
    type(state_type) :: state, exact
    type(report_type) :: report
    type(options_type) :: options
    type(options_type), parameter :: tight = options_type(tolerance=1.0e-11_wp)
    integer(int64) :: start, finish, ticks
    integer :: k, j, with_tangent, status, failed
    options%tolerance = tolerance
    error = 0.0_wp
    tangent_error = 0.0_wp
    evaluations = 0.0_wp
    failed = 0
    time = huge(time)
    do k = 1, n_states
      do with_tangent = 1, 2
        do j = 1, n_repeats
          state = states(k)
          call system_clock(start, ticks)
          if (with_tangent == 1) then
            call update_state(materials(k), options, state, length * directions(:, k), report, status)
          else
            call update_state(materials(k), options, state, length * directions(:, k), report, status, tangent)
          end if
          call system_clock(finish)
          time(k, with_tangent) = min(time(k, with_tangent), 1.0e9_wp * real(finish - start, wp) / real(ticks, wp))
        end do
        evaluations(with_tangent) = evaluations(with_tangent) + real(report%evaluations, wp) / n_states
        if (status /= status_ok) cycle
        exact = states(k)
        if (with_tangent == 1) then
          call update_state(materials(k), tight, exact, length * directions(:, k), report, status)
          if (status == status_ok) error(k) = norm(state%stress - exact%stress) / norm(exact%stress)
        else
          call update_state(materials(k), tight, exact, length * directions(:, k), report, status, exact_tangent)
          if (status == status_ok) tangent_error(k) = maxval(abs(tangent - exact_tangent)) / maxval(abs(exact_tangent))
        end if
      end do
      if (status /= status_ok) failed = failed + 1
    end do
    write (*, '(es8.1, 2(f11.0, f10.1, f13.1), 6es11.1, i6)') length, median(time(:, 1)), median(time(:, 1)) / rate_cost, &
      evaluations(1), median(time(:, 2)), median(time(:, 2)) / rate_cost, evaluations(2), median(error), &
      quantile(error, 0.99_wp), maxval(error), median(tangent_error), quantile(tangent_error, 0.99_wp), &
      maxval(tangent_error), failed
  end subroutine time_updates

  !> One line: UMAT calls over increments of a length.
  subroutine time_umat(length)
    real(wp), intent(in) :: length
    real(wp) :: time(n_states)
    real(real64) :: stress(6), statev(13), ddsdde(6, 6), dstran(6), pnewdt
    integer(int64) :: start, finish, ticks
    integer :: k, j
    time = huge(time)
    do k = 1, n_states
      dstran = length * directions(:, k)*[1, 1, 1, 2, 2, 2]
      do j = 1, n_repeats
        stress = states(k)%stress
        statev = 0.0_real64
        statev(1:6) = states(k)%delta*[1, 1, 1, 2, 2, 2]
        statev(7) = states(k)%void_ratio
        pnewdt = 1.0_real64
        call system_clock(start, ticks)
        call call_umat(stress, statev, ddsdde, dstran, props(:, k), pnewdt)
        call system_clock(finish)
        time(k) = min(time(k), 1.0e9_wp * real(finish - start, wp) / real(ticks, wp))
      end do
    end do
    write (*, '(es8.1, f11.0, f10.1)') length, median(time), median(time) / rate_cost
  end subroutine time_umat

  !> The entry as a host with PNEWDT and without the rest calls it.
  subroutine call_umat(stress, statev, ddsdde, dstran, props, pnewdt)
    use umat_entry, only: umat
    real(real64), intent(inout) :: stress(6), statev(13), ddsdde(6, 6), pnewdt
    real(real64), intent(in) :: dstran(6), props(16)
    call umat(stress, statev, ddsdde, dstran=dstran, ndi=3, nshr=3, ntens=6, nstatv=13, props=props, nprops=16, &
              pnewdt=pnewdt)
  end subroutine call_umat

end program bench_model
