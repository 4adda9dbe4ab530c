!> UMAT and VUMAT as Abaqus links them: external procedures, whose symbols the user's compiler names as Abaqus expects.
!>
!> Not part of any library here, where the names are umat_ and vumat_ on every system. cmake/single_source.cmake puts this
!> file behind the modules, in the one source file for `abaqus job=... user=...`. Arguments are described in umat.f90 and
!> vumat.f90; those that are never read are not handed on.

!> Abaqus/Standard.
subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, stran, dstran, time, dtime, temp, &
                dtemp, predef, dpred, cmname, ndi, nshr, ntens, nstatv, props, nprops, coords, drot, pnewdt, celent, &
                dfgrd0, dfgrd1, noel, npt, layer, kspt, kstep, kinc)
  use, intrinsic :: iso_c_binding, only: c_double, c_int
  use umat_entry, only: hypofab_umat => umat
  implicit none
  integer(c_int), intent(in) :: ndi, nshr, ntens, nstatv, nprops
  real(c_double), intent(inout) :: stress(ntens), statev(nstatv), ddsdde(ntens, ntens)
  real(c_double), intent(in) :: dstran(ntens), props(nprops)
  real(c_double), intent(in), optional :: drot(3, 3)
  real(c_double), intent(inout), optional :: pnewdt
  type(*), intent(in) :: sse(*), spd(*), scd(*), rpl(*), ddsddt(*), drplde(*), drpldt(*), stran(*), time(*), dtime(*)
  type(*), intent(in) :: temp(*), dtemp(*), predef(*), dpred(*), coords(*), celent(*), dfgrd0(*), dfgrd1(*), noel(*)
  type(*), intent(in) :: npt(*), layer(*), kspt(*), kstep(*), kinc(*)
  character(len=*), intent(in) :: cmname
  call hypofab_umat(stress, statev, ddsdde, dstran=dstran, ndi=ndi, nshr=nshr, ntens=ntens, nstatv=nstatv, &
                    props=props, nprops=nprops, drot=drot, pnewdt=pnewdt)
end subroutine umat

!> Abaqus/Explicit, in double or single precision.
subroutine vumat(nblock, ndir, nshr, nstatev, nfieldv, nprops, lanneal, step_time, total_time, dt, cmname, coord_mp, &
                 char_length, props, density, strain_inc, rel_spin_inc, temp_old, stretch_old, defgrad_old, field_old, &
                 stress_old, state_old, ener_intern_old, ener_inelas_old, temp_new, stretch_new, defgrad_new, &
                 field_new, stress_new, state_new, ener_intern_new, ener_inelas_new)
  use, intrinsic :: iso_c_binding, only: c_int, c_loc, c_null_ptr
  use umat_vumat, only: hypofab_vumat => vumat
  implicit none
  integer(c_int), intent(in) :: nblock(*), ndir, nshr, nstatev, nprops
  type(*), intent(in), target :: props(*), density(*), strain_inc(*), stress_old(*), state_old(*), ener_intern_old(*)
  type(*), intent(in), target :: ener_inelas_old(*)
  type(*), intent(inout), target :: stress_new(*), state_new(*), ener_intern_new(*), ener_inelas_new(*)
  type(*), intent(in) :: nfieldv(*), lanneal(*), step_time(*), total_time(*), dt(*), coord_mp(*), char_length(*)
  type(*), intent(in) :: rel_spin_inc(*), temp_old(*), stretch_old(*), defgrad_old(*), field_old(*), temp_new(*)
  type(*), intent(in) :: stretch_new(*), defgrad_new(*), field_new(*)
  character(len=*), intent(in) :: cmname
  call hypofab_vumat(nblock(1), ndir, nshr, nstatev, c_null_ptr, nprops, c_null_ptr, c_null_ptr, c_null_ptr, &
                     c_null_ptr, c_null_ptr, c_null_ptr, c_null_ptr, c_loc(props), c_loc(density), c_loc(strain_inc), &
                     c_null_ptr, c_null_ptr, c_null_ptr, c_null_ptr, c_null_ptr, c_loc(stress_old), c_loc(state_old), &
                     c_loc(ener_intern_old), c_loc(ener_inelas_old), c_null_ptr, c_null_ptr, c_null_ptr, c_null_ptr, &
                     c_loc(stress_new), c_loc(state_new), c_loc(ener_intern_new), c_loc(ener_inelas_new))
end subroutine vumat
