!> VUMAT for Abaqus/Explicit: unpack, call, pack, for a block of points. No physics here.
!>
!> PROPS(16) and state variables 1 to 13 are those of the UMAT (docs/umat.md), engineering shear and order 11 22 33 12 13
!> 23 of delta included, so that both share their initial conditions. Stress and strain follow the host: order
!> 11 22 33 12 23 13, tensor shear. The host's axes turn with the material, so delta needs no rotation here.
!>
!> The arguments are addresses because Abaqus/Explicit works in single precision unless asked for double: the arrays
!> then are reals of four bytes, and nothing in the argument list says so. Nothing is printed or kept between calls.
module umat_vumat
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_float, c_int, c_ptr
  use umat_block, only: update_block, largest_block
  use umat_host_state, only: n_statev, sv_evaluations, tensor_from_host, unpack_state, pack_stress, pack_statev, &
                             swap_shear
  use umat_kinds, only: wp
  use umat_material, only: material_type, material_from_props, check_props, parameters, n_parameters, i_phi_c, i_n, &
                           i_e_d0, i_e_c0, i_e_i0
  use umat_rate, only: state_type
  use umat_status, only: status_ok, status_bad_state, status_bad_argument
  use umat_tensor, only: multiplicity, trace, unit_tensor
  use umat_update, only: report_type
  implicit none
  private
  public :: vumat

  !> State variable that counts the increments a point did not follow, where the host has it.
  integer, parameter :: sv_dropped = 14

  !> An array of the host, one row per point, in the precision of the host; no array where the address was null.
  type :: host_array
    real(c_double), pointer :: double(:, :) => null()
    real(c_float), pointer :: single(:, :) => null()
  end type host_array

  !> What is read and written of a block.
  type :: block_type
    integer :: n_components !< 6 or 4
    integer :: n_statev
    type(host_array) :: density, strain_inc, stress_old, state_old, intern_old, inelas_old
    type(host_array) :: stress_new, state_new, intern_new, inelas_new
  end type block_type

contains

  !> The host's entry.
  !>
  !> A point whose increment cannot be integrated keeps its stress, state variables and energy, since Abaqus/Explicit
  !> cannot be asked for a smaller step. State variable 10 is then minus the status of hypofab.h, and state variable 14,
  !> where there is one, counts such increments.
  !> @param nblock     number of points; where it is an array, the first of it
  !> @param ndir, nshr 3 and 3, or 3 and 1 (plane strain, axisymmetric)
  !> @param nstatev    13 or more
  !> @param props      parameters as in the UMAT
  !> @param density    [mass/volume], one per point
  !> @param strain_inc strain increments [-], tensor shear, tension positive; (nblock, ndir + nshr)
  !> @param stress_old, stress_new total stress [stress], tension positive; (nblock, ndir + nshr)
  !> @param state_old, state_new state variables; (nblock, nstatev)
  !> @param ener_intern_old, ener_intern_new energy per mass, to which the stress power is added; (nblock)
  !> @param ener_inelas_old, ener_inelas_new handed on: hypoplasticity has no elastic part to tell apart; (nblock)
  subroutine vumat(nblock, ndir, nshr, nstatev, nfieldv, nprops, lanneal, step_time, total_time, dt, cmname, coord_mp, &
                 char_length, props, density, strain_inc, rel_spin_inc, temp_old, stretch_old, defgrad_old, field_old, &
                   stress_old, state_old, ener_intern_old, ener_inelas_old, temp_new, stretch_new, defgrad_new, &
                   field_new, stress_new, state_new, ener_intern_new, ener_inelas_new) bind(C, name='vumat_')
    integer(c_int), intent(in) :: nblock, ndir, nshr, nstatev, nprops
    type(c_ptr), value :: props, density, strain_inc, stress_old, state_old, ener_intern_old, ener_inelas_old
    type(c_ptr), value :: stress_new, state_new, ener_intern_new, ener_inelas_new
    ! Never read.
    type(c_ptr), value :: nfieldv, lanneal, step_time, total_time, dt, cmname, coord_mp, char_length, rel_spin_inc
    type(c_ptr), value :: temp_old, stretch_old, defgrad_old, field_old, temp_new, stretch_new, defgrad_new, field_new
    type(block_type) :: b
    type(material_type) :: m
    integer :: i, status_of_all
    logical :: single

    single = is_single(props, nprops)
    b%n_components = ndir + nshr
    b%n_statev = nstatev
    b%density = view(density, 1)
    b%strain_inc = view(strain_inc, b%n_components)
    b%stress_old = view(stress_old, b%n_components)
    b%stress_new = view(stress_new, b%n_components)
    b%state_old = view(state_old, nstatev)
    b%state_new = view(state_new, nstatev)
    b%intern_old = view(ener_intern_old, 1)
    b%intern_new = view(ener_intern_new, 1)
    b%inelas_old = view(ener_inelas_old, 1)
    b%inelas_new = view(ener_inelas_new, 1)

    call read_material(view_of(props, 1, nprops, single), nprops, m, status_of_all)
    if (ndir /= 3 .or. .not. any(nshr == [1, 3]) .or. nstatev < n_statev) status_of_all = status_bad_argument
    do i = 1, nblock, largest_block
      call advance_points(m, b, i, min(nblock - i + 1, largest_block), status_of_all)
    end do

  contains

    !> An array with a row for each point.
    function view(address, columns) result(array)
      type(c_ptr), intent(in) :: address
      integer, intent(in) :: columns
      type(host_array) :: array
      array = view_of(address, int(nblock), columns, single)
    end function view

  end subroutine vumat

  !> Are the host's reals of four bytes? Decided by the parameters, which make no sense in the other reading: the halves
  !> of a phi_c of eight bytes are no angle and a number near 3, which is no exponent and no void ratio either.
  !> @param props  address of the parameters
  !> @param nprops number of them
  function is_single(props, nprops) result(yes)
    type(c_ptr), intent(in) :: props
    integer(c_int), intent(in) :: nprops
    logical :: yes
    real(c_float), pointer :: p(:)

    yes = .false.
    if (nprops < n_parameters .or. .not. c_associated(props)) return
    call c_f_pointer(props, p, [n_parameters])
    if (.not. all(ieee_is_finite(p))) return
    yes = admissible(i_phi_c) .and. admissible(i_n) .and. admissible(i_e_d0) .and. &
          p(i_e_d0) < p(i_e_c0) .and. p(i_e_c0) <= p(i_e_i0)

  contains

    !> Is a parameter within its bounds?
    pure function admissible(i) result(inside)
      integer, intent(in) :: i
      logical :: inside
      inside = p(i) >= real(parameters(i)%lower, c_float) .and. p(i) <= real(parameters(i)%upper, c_float)
    end function admissible

  end function is_single

  !> The material of a block.
  !> @param props  one row of parameters
  !> @param nprops number of them
  !> @param m      defined when status is status_ok
  !> @param status status_ok, status_bad_material or status_bad_argument (too few parameters)
  subroutine read_material(props, nprops, m, status)
    type(host_array), intent(in) :: props
    integer(c_int), intent(in) :: nprops
    type(material_type), intent(out) :: m
    integer, intent(out) :: status
    real(wp) :: values(n_parameters)
    character(len=1) :: message

    status = status_bad_argument
    if (nprops < n_parameters) return
    call get_row(props, 1, values)
    call check_props(values, status, message)
    if (status == status_ok) m = material_from_props(values, regularised=.true.)
  end subroutine read_material

  !> The new values of a point are the old ones.
  subroutine keep_point(b, i)
    type(block_type), intent(in) :: b
    integer, intent(in) :: i
    integer :: j
    do j = 1, b%n_components
      call put(b%stress_new, i, j, get(b%stress_old, i, j))
    end do
    do j = 1, b%n_statev
      call put(b%state_new, i, j, get(b%state_old, i, j))
    end do
    call put(b%intern_new, i, 1, get(b%intern_old, i, 1))
    call put(b%inelas_new, i, 1, get(b%inelas_old, i, 1))
  end subroutine keep_point

  !> Say that a point kept its old state.
  subroutine mark_point(b, i, status)
    type(block_type), intent(in) :: b
    integer, intent(in) :: i, status
    if (b%n_statev >= sv_evaluations) call put(b%state_new, i, sv_evaluations, -real(status, wp))
    if (b%n_statev >= sv_dropped) call put(b%state_new, i, sv_dropped, get(b%state_old, i, sv_dropped) + 1.0_wp)
  end subroutine mark_point

  !> Integrate the increments of some points and write their new values; those of a point that fails are its old ones.
  !> @param m             material
  !> @param b             block
  !> @param first, n      points first to first + n - 1, up to largest_block
  !> @param status_of_all status_ok, or what is wrong with every point
  subroutine advance_points(m, b, first, n, status_of_all)
    type(material_type), intent(in) :: m
    type(block_type), intent(in) :: b
    integer, intent(in) :: first, n, status_of_all
    real(wp), dimension(largest_block, 6) :: stress, delta, strain
    real(wp) :: void_ratio(largest_block), pore_pressure(largest_block)
    integer :: point(largest_block), status(largest_block), evaluations(largest_block)
    type(state_type) :: state
    type(report_type) :: report
    real(wp) :: increment(6)
    integer :: i, k, count, one

    count = 0
    do i = first, first + n - 1
      call keep_point(b, i)
      one = status_of_all
      if (one == status_ok) call read_point(m, b, i, state, increment, pore_pressure(count + 1), one)
      if (one /= status_ok) then
        call mark_point(b, i, one)
        cycle
      end if
      count = count + 1
      point(count) = i
      stress(count, :) = state%stress
      delta(count, :) = state%delta
      void_ratio(count) = state%void_ratio
      strain(count, :) = increment
    end do
    if (count == 0) return
    call update_block(m, count, stress, delta, void_ratio, strain, status, evaluations)
    do k = 1, count
      if (status(k) /= status_ok) then
        call mark_point(b, point(k), status(k))
        cycle
      end if
      state = state_type(stress(k, :), delta(k, :), void_ratio(k))
      report%evaluations = evaluations(k)
      increment = strain(k, :)
      call write_point(m, b, point(k), state, increment, pore_pressure(k) - m%K_w * trace(increment), report)
    end do
  end subroutine advance_points

  !> The state and strain increment of a point.
  !> @param status status_ok, or status_bad_state where the old state is not finite
  subroutine read_point(m, b, i, state, strain, pore_pressure, status)
    type(material_type), intent(in) :: m
    type(block_type), intent(in) :: b
    integer, intent(in) :: i
    type(state_type), intent(out) :: state
    real(wp), intent(out) :: strain(6), pore_pressure
    integer, intent(out) :: status
    real(wp) :: old_stress(6), increment(6), old_statev(n_statev)
    integer :: n

    status = status_bad_state
    n = b%n_components
    strain = 0.0_wp
    pore_pressure = 0.0_wp
    call get_row(b%stress_old, i, old_stress(:n))
    call get_row(b%strain_inc, i, increment(:n))
    call get_row(b%state_old, i, old_statev)
    ! Hosts do pass NaN; nothing is computed with it, so that nothing traps.
    if (.not. (all(ieee_is_finite(old_stress(:n))) .and. all(ieee_is_finite(old_statev)))) return
    call swap_shear(old_stress(:n))
    call swap_shear(increment(:n))
    call unpack_state(m, old_stress(:n), old_statev, state, pore_pressure)
    strain = tensor_from_host(increment(:n), 1.0_wp)
    status = status_ok
  end subroutine read_point

  !> The new values of a point, and its energy by the stress power.
  subroutine write_point(m, b, i, state, strain, pore_pressure, report)
    type(material_type), intent(in) :: m
    type(block_type), intent(in) :: b
    integer, intent(in) :: i
    type(state_type), intent(in) :: state
    real(wp), intent(in) :: strain(6), pore_pressure
    type(report_type), intent(in) :: report
    real(wp) :: old_stress(6), new_stress(6), statev(n_statev), density
    real(c_double) :: packed_stress(6), packed_statev(n_statev)
    integer :: n

    n = b%n_components
    call get_row(b%stress_old, i, old_stress(:n))
    call swap_shear(old_stress(:n))
    call get_row(b%state_old, i, statev)
    packed_statev = real(statev, c_double)
    call pack_statev(m, state, pore_pressure, report, packed_statev)
    call put_row(b%state_new, i, real(packed_statev, wp))
    call pack_stress(state%stress - pore_pressure * unit_tensor, packed_stress(:n))
    new_stress(:n) = real(packed_stress(:n), wp)
    density = get(b%density, i, 1)
    if (ieee_is_finite(density)) then
      ! Stress power by the trapezium rule; multiplicity counts tensor shear twice.
      if (density > 0.0_wp) call put(b%intern_new, i, 1, get(b%intern_old, i, 1) + 0.5_wp / density * &
                                     sum(multiplicity(:n) * (old_stress(:n) + new_stress(:n)) * strain(:n)))
    end if
    call swap_shear(new_stress(:n))
    call put_row(b%stress_new, i, new_stress(:n))
  end subroutine write_point

  !> An array of the host.
  !> @param address       may be null
  !> @param rows, columns its shape
  !> @param single        are its reals of four bytes?
  function view_of(address, rows, columns, single) result(array)
    type(c_ptr), intent(in) :: address
    integer, intent(in) :: rows, columns
    logical, intent(in) :: single
    type(host_array) :: array
    if (.not. c_associated(address)) return
    if (single) then
      call c_f_pointer(address, array%single, [rows, columns])
    else
      call c_f_pointer(address, array%double, [rows, columns])
    end if
  end function view_of

  !> One number; zero where there is no array.
  pure function get(array, i, j) result(value)
    type(host_array), intent(in) :: array
    integer, intent(in) :: i, j
    real(wp) :: value
    value = 0.0_wp
    if (associated(array%double)) value = real(array%double(i, j), wp)
    if (associated(array%single)) value = real(array%single(i, j), wp)
  end function get

  !> The first numbers of a row.
  pure subroutine get_row(array, i, values)
    type(host_array), intent(in) :: array
    integer, intent(in) :: i
    real(wp), intent(out) :: values(:)
    integer :: j
    do j = 1, size(values)
      values(j) = get(array, i, j)
    end do
  end subroutine get_row

  !> Write one number; nothing where there is no array.
  subroutine put(array, i, j, value)
    type(host_array), intent(in) :: array
    integer, intent(in) :: i, j
    real(wp), intent(in) :: value
    if (associated(array%double)) array%double(i, j) = real(value, c_double)
    if (associated(array%single)) array%single(i, j) = real(value, c_float)
  end subroutine put

  !> Write the first numbers of a row.
  subroutine put_row(array, i, values)
    type(host_array), intent(in) :: array
    integer, intent(in) :: i
    real(wp), intent(in) :: values(:)
    integer :: j
    do j = 1, size(values)
      call put(array, i, j, values(j))
    end do
  end subroutine put_row

end module umat_vumat
