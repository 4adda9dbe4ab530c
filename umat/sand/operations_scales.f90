!> The sand's operations that need no rate: sizes of its memory and of strain, limiting void ratios, and the places where its rate
!> has kinks. hypofab_model_row.h says what they do.
module umat_sand_operations_scales
  use, intrinsic :: iso_c_binding, only: c_double
  use umat_material, only: intergranular_is_on, n_parameters, i_h_s, i_n, i_e_d0, i_e_c0, i_e_i0, i_m_R, i_p_t, i_R, i_beta_r
  use umat_sand_operations, only: c_state
  use umat_tensor, only: deviator, norm, trace
  implicit none
  private

  !> hypofab_growth
  type, bind(C) :: c_growth
    real(c_double) :: length, along, across
  end type c_growth

  !> The strain over which the stress of a material without intergranular strain changes its course.
  real(c_double), parameter :: plain_scale = 1.0e-4_c_double

  !> A deviator below this part of the stress is that of an isotropic stress; how far to look along the path then.
  real(c_double), parameter :: isotropic = 1.0e-10_c_double, ahead = 1.0e-8_c_double

contains

  !> R, or zero without intergranular strain.
  pure function memory_size(props) result(largest) bind(C, name='hypofab_sand_memory_size')
    real(c_double), intent(in) :: props(n_parameters)
    real(c_double) :: largest
    largest = merge(props(i_R), 0.0_c_double, intergranular_is_on(props))
  end function memory_size

  !> The convention of the public UMAT.
  pure subroutine memory_off(props) bind(C, name='hypofab_sand_memory_off')
    real(c_double), intent(inout) :: props(n_parameters)
    props(i_m_R) = 0.0_c_double
  end subroutine memory_off

  pure function strain_scale(props) result(scale) bind(C, name='hypofab_sand_strain_scale')
    real(c_double), intent(in) :: props(n_parameters)
    real(c_double) :: scale
    scale = merge(props(i_R), plain_scale, intergranular_is_on(props))
  end function strain_scale

  !> Near delta = 0, delta = a d + b with b normal to the direction of strain d obeys R rho' = 1 - rho^beta_r and
  !> b ~ (1 - rho^beta_r)^(1/beta_r); theory.md, section 4.
  pure subroutine growth(props, rho, grown) bind(C, name='hypofab_sand_growth')
    real(c_double), intent(in) :: props(n_parameters)
    real(c_double), value :: rho
    type(c_growth), intent(out) :: grown
    real(c_double) :: drawn, total, term
    integer :: j
    drawn = rho**props(i_beta_r)
    ! Length of the path: the integral of R/(1 - rho^beta_r), a geometric series.
    total = 0.0_c_double
    term = 1.0_c_double
    j = 0
    do while (term > 1.0e-17_c_double * total)
      total = total + term / (1.0_c_double + j * props(i_beta_r))
      term = term * drawn
      j = j + 1
    end do
    grown%length = props(i_R) * rho * total
    grown%along = 1.0_c_double - drawn
    grown%across = grown%along**(1.0_c_double / props(i_beta_r))
  end subroutine growth

  !> On the isotropic axis, where F has a cone, a place just ahead: the path leaves along one of its slopes.
  pure subroutine smooth_place(props, state, rate, place) bind(C, name='hypofab_sand_smooth_place')
    real(c_double), intent(in) :: props(n_parameters)
    type(c_state), intent(in) :: state, rate
    type(c_state), intent(inout) :: place
    real(c_double) :: speed, pressure
    place = state
    speed = norm(deviator(rate%stress))
    pressure = abs(trace(state%stress) / 3.0_c_double - props(i_p_t))
    if (norm(deviator(state%stress)) > isotropic * pressure .or. speed <= isotropic * norm(rate%stress)) return
    place%stress = state%stress + ahead * pressure / speed * rate%stress
  end subroutine smooth_place

  !> Bauer's law; theory.md Eq. (6).
  pure subroutine limiting_void_ratios(props, p, limit) bind(C, name='hypofab_sand_limiting_void_ratios')
    real(c_double), intent(in) :: props(n_parameters)
    real(c_double), value :: p
    real(c_double), intent(out) :: limit(3)
    limit = props([i_e_d0, i_e_c0, i_e_i0]) * exp(-(3.0_c_double * max(p, 0.0_c_double) / props(i_h_s))**props(i_n))
  end subroutine limiting_void_ratios

end module umat_sand_operations_scales
