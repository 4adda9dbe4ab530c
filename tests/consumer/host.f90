!> A finite element host in miniature: one material point, driven through `umat` with the argument list of Abaqus.
!>
!> Oedometer test on Hochstetten sand as published with OpenSees' UMAT material: from isotropic 100 kPa, e = 0.70,
!> delta = 0, to 0.5 % axial compression in increments of 1e-4. The exact axial stress is 294.2746 kPa.
program host
  use, intrinsic :: iso_fortran_env, only: real64
  implicit none

  interface
    subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, stran, dstran, time, dtime, &
                    temp, dtemp, predef, dpred, cmname, ndi, nshr, ntens, nstatv, props, nprops, coords, drot, pnewdt, &
                    celent, dfgrd0, dfgrd1, noel, npt, layer, kspt, kstep, kinc)
      import :: real64
      integer, intent(in) :: ndi, nshr, ntens, nstatv, nprops, noel, npt, layer, kspt, kstep, kinc
      real(real64), intent(inout) :: stress(ntens), statev(nstatv), ddsdde(ntens, ntens), sse, spd, scd, rpl
      real(real64), intent(inout) :: ddsddt(ntens), drplde(ntens), drpldt, pnewdt
      real(real64), intent(in) :: stran(ntens), dstran(ntens), time(2), dtime, temp, dtemp, predef(1), dpred(1)
      character(len=80), intent(in) :: cmname
      real(real64), intent(in) :: props(nprops), coords(3), drot(3, 3), celent, dfgrd0(3, 3), dfgrd1(3, 3)
    end subroutine umat
  end interface

  integer, parameter :: n_increments = 50
  real(real64), parameter :: exact_axial_stress = -294.2746_real64
  real(real64), parameter :: props(16) = [33.0_real64, 0.0_real64, 1.0e6_real64, 0.25_real64, 0.55_real64, &
                                          0.95_real64, 1.05_real64, 0.25_real64, 1.5_real64, 5.0_real64, 2.0_real64, &
                                          1.0e-4_real64, 0.5_real64, 6.0_real64, 0.0_real64, 0.70_real64]
  real(real64), parameter :: identity(3, 3) = reshape([1.0_real64, 0.0_real64, 0.0_real64, 0.0_real64, 1.0_real64, &
                                                       0.0_real64, 0.0_real64, 0.0_real64, 1.0_real64], [3, 3])
  real(real64), parameter :: nothing(1) = 0.0_real64, origin(3) = 0.0_real64
  real(real64) :: stress(6), statev(13), ddsdde(6, 6), stran(6), dstran(6), time(2), pnewdt
  real(real64) :: sse, spd, scd, rpl, ddsddt(6), drplde(6), drpldt
  character(len=80) :: cmname
  integer :: increment

  stress = [-100.0_real64, -100.0_real64, -100.0_real64, 0.0_real64, 0.0_real64, 0.0_real64]
  statev = 0.0_real64
  stran = 0.0_real64
  dstran = [0.0_real64, 0.0_real64, -1.0e-4_real64, 0.0_real64, 0.0_real64, 0.0_real64]
  time = 0.0_real64
  sse = 0.0_real64
  spd = 0.0_real64
  scd = 0.0_real64
  rpl = 0.0_real64
  ddsddt = 0.0_real64
  drplde = 0.0_real64
  drpldt = 0.0_real64
  cmname = "HOCHSTETTEN"
  do increment = 1, n_increments
    pnewdt = 1.0_real64
    call umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, stran, dstran, time, 1.0_real64, &
              0.0_real64, 0.0_real64, nothing, nothing, cmname, 3, 3, 6, 13, props, 16, origin, identity, pnewdt, &
              1.0_real64, identity, identity, 1, 1, 1, 1, 1, increment)
    if (pnewdt < 1.0_real64) error stop "the UMAT asks for a smaller increment"
    stran = stran + dstran
    time = time + 1.0_real64
  end do
  print '(a, f10.4)', "axial stress [kPa]:", stress(3)
  if (.not. abs(stress(3) / exact_axial_stress - 1.0_real64) <= 1.0e-5_real64) error stop "wrong axial stress"
end program host
