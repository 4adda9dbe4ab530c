!> A user's program in Fortran on the C interface: the stress rate is homogeneous of degree one in the strain rate.
program rate_from_fortran
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_char, c_null_char, c_ptr, c_null_ptr
  implicit none

  !> hypofab_material of hypofab.h: a model and its parameters, of the sand in the order of PROPS; stresses in kPa.
  type, bind(c) :: material_t
    type(c_ptr) :: model
    real(c_double) :: value(32)
  end type material_t

  !> hypofab_state of hypofab.h: tensor components xx yy zz xy xz yz, tension positive. Of the sand's variables the first six
  !> numbers are delta, the seventh is the void ratio.
  type, bind(c) :: state_t
    real(c_double) :: stress(6), variable(16)
  end type state_t

  interface
    integer(c_int) function hypofab_material_built_in(name, material) bind(c)
      import :: c_int, c_char, material_t
      character(kind=c_char), intent(in) :: name(*)
      type(material_t), intent(out) :: material
    end function hypofab_material_built_in
    integer(c_int) function hypofab_rate(material, state, stretching, rate, branch) bind(c)
      import :: c_int, c_double, c_ptr, material_t, state_t
      type(material_t), intent(in) :: material
      type(state_t), intent(in) :: state
      real(c_double), intent(in) :: stretching(6)
      type(state_t), intent(out) :: rate
      type(c_ptr), value :: branch
    end function hypofab_rate
  end interface

  real(c_double), parameter :: stretching(6) = [-2.0e-1_c_double, 7.0e-2_c_double, 5.0e-2_c_double, &
                                                1.0e-2_c_double, 0.0_c_double, -3.0e-2_c_double]
  type(material_t) :: sand
  type(state_t) :: state, once, twice

  call require(hypofab_material_built_in("hochstetten"//c_null_char, sand), "hypofab_material_built_in")
  state = state_t(stress=[-100.0_c_double, -80.0_c_double, -90.0_c_double, 5.0_c_double, 0.0_c_double, 0.0_c_double], &
                  variable=0.0_c_double)
  state%variable(7) = 0.75_c_double
  call require(hypofab_rate(sand, state, stretching, once, c_null_ptr), "hypofab_rate")
  call require(hypofab_rate(sand, state, 2.0_c_double * stretching, twice, c_null_ptr), "hypofab_rate")
  print '(a, 6es12.4)', "stress rate [kPa]:", once%stress
  if (.not. maxval(abs(once%stress)) > 0.0_c_double) error stop "the stress rate vanishes"
  if (.not. maxval(abs(twice%stress - 2.0_c_double * once%stress)) <= 1.0e-12_c_double * maxval(abs(once%stress))) &
    error stop "the stress rate is not homogeneous of degree one"

contains

  !> Stop with the name of the call unless its status is 0.
  subroutine require(status, call_name)
    integer(c_int), intent(in) :: status
    character(*), intent(in) :: call_name
    if (status /= 0) then
      print '(2a, i0)', call_name, ": status ", status
      error stop 1
    end if
  end subroutine require
end program rate_from_fortran
