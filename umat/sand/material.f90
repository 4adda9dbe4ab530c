!> Material parameters: names, order, units, bounds and validation, in this one place.
!>
!> The order is that of PROPS(1..16) of the UMAT and of hypofab_material in hypofab.h.
module umat_material
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use umat_kinds, only: pi, wp
  use umat_status, only: status_ok, status_bad_material
  implicit none
  private
  public :: material_type, parameter_type, material_from_props, check_props, intergranular_is_on

  !> Number of parameters.
  integer, parameter, public :: n_parameters = 16

  !> Positions in PROPS.
  integer, parameter, public :: i_phi_c = 1, i_p_t = 2, i_h_s = 3, i_n = 4, i_e_d0 = 5, i_e_c0 = 6, i_e_i0 = 7
  integer, parameter, public :: i_alpha = 8, i_beta = 9, i_m_R = 10, i_m_T = 11, i_R = 12, i_beta_r = 13, i_chi = 14
  integer, parameter, public :: i_K_w = 15, i_e_0 = 16

  !> What a parameter belongs to, the same numbers as hypofab_parameter_role in hypofab_model.h.
  integer, parameter :: of_base = 0, of_memory = 1, of_host = 2

  !> One row of the parameter table. Texts end with a null character for C.
  type :: parameter_type
    character(len=8) :: name
    character(len=8) :: unit
    character(len=96) :: description
    real(wp) :: lower !< admissible values: lower <= x <= upper
    real(wp) :: upper
    integer :: role = of_base !< those of the memory are checked only when the intergranular strain is on
    real(wp) :: start = 0.0_wp !< value where none is given
    logical :: must_be_given = .false. !< there is no such value
    real(wp) :: usual(2) = 0.0_wp !< range of published sands with room to spare, stresses in kPa; 0 0: not to be calibrated
    integer :: companion = 0 !< a calibration may keep it at a ratio to this parameter
  end type parameter_type

  character, parameter :: nul = achar(0)
  real(wp), parameter :: big = 1.0e30_wp

  !> The parameter table. Without a value for m_R, the intergranular strain is that of Hochstetten sand.
  type(parameter_type), parameter, public :: parameters(n_parameters) = [ &
    parameter_type('phi_c'//nul, 'deg'//nul, 'critical friction angle'//nul, 1.0_wp, 60.0_wp, &
                   must_be_given=.true., usual=[20.0_wp, 45.0_wp]), &
    parameter_type('p_t'//nul, 'stress'//nul, 'shift of stress: the model sees T - p_t 1'//nul, 0.0_wp, big), &
    parameter_type('h_s'//nul, 'stress'//nul, 'granular hardness'//nul, 1.0e-6_wp, big, &
                   must_be_given=.true., usual=[1.0e4_wp, 1.0e8_wp]), &
    parameter_type('n'//nul, '-'//nul, 'exponent of the compression law'//nul, 0.01_wp, 1.0_wp, &
                   must_be_given=.true., usual=[0.05_wp, 0.8_wp]), &
    parameter_type('e_d0'//nul, '-'//nul, 'void ratio of the densest packing at p = 0'//nul, 0.01_wp, 10.0_wp, &
                   must_be_given=.true., usual=[0.2_wp, 1.0_wp], companion=i_e_c0), &
    parameter_type('e_c0'//nul, '-'//nul, 'critical void ratio at p = 0'//nul, 0.01_wp, 10.0_wp, &
                   must_be_given=.true., usual=[0.4_wp, 1.6_wp]), &
    parameter_type('e_i0'//nul, '-'//nul, 'void ratio of the loosest packing at p = 0'//nul, 0.01_wp, 10.0_wp, &
                   must_be_given=.true., usual=[0.5_wp, 2.0_wp], companion=i_e_c0), &
    parameter_type('alpha'//nul, '-'//nul, 'exponent of the density factor f_d'//nul, 0.0_wp, 5.0_wp, &
                   must_be_given=.true., usual=[0.01_wp, 1.0_wp]), &
    parameter_type('beta'//nul, '-'//nul, 'exponent of the density factor f_e'//nul, 0.0_wp, 10.0_wp, &
                   must_be_given=.true., usual=[0.1_wp, 5.0_wp]), &
    parameter_type('m_R'//nul, '-'//nul, 'stiffness factor at reversal; <= 0.5: no intergranular strain'//nul, &
                   0.0_wp, 100.0_wp, of_memory, start=5.0_wp, usual=[1.0_wp, 15.0_wp]), &
    parameter_type('m_T'//nul, '-'//nul, 'stiffness factor at a 90 degree turn'//nul, 0.1_wp, 100.0_wp, &
                   of_memory, start=2.0_wp, usual=[1.0_wp, 10.0_wp]), &
    parameter_type('R'//nul, '-'//nul, 'size of the elastic strain range, largest |delta|'//nul, 1.0e-8_wp, 0.1_wp, &
                   of_memory, start=1.0e-4_wp, usual=[1.0e-5_wp, 5.0e-4_wp]), &
    parameter_type('beta_r'//nul, '-'//nul, 'exponent of the evolution of delta'//nul, 1.0e-3_wp, 20.0_wp, &
                   of_memory, start=0.5_wp, usual=[0.02_wp, 2.0_wp]), &
    parameter_type('chi'//nul, '-'//nul, 'exponent of the interpolation in rho'//nul, 1.0e-3_wp, 100.0_wp, &
                   of_memory, start=6.0_wp, usual=[0.2_wp, 20.0_wp]), &
    parameter_type('K_w'//nul, 'stress'//nul, 'bulk stiffness of pore water (UMAT only); 0: drained'//nul, &
                   0.0_wp, big, of_host), &
    parameter_type('e_0'//nul, '-'//nul, 'initial void ratio (UMAT only), see docs/umat.md'//nul, &
                   -10.0_wp, 20.0_wp, of_host)]

  !> How two parameters that contradict each other are named.
  character(len=*), parameter :: contradiction = &
    "(a, ' = ', g0.6, ' and ', a, ' = ', g0.6, ' contradict each other, expected ', a)"

  !> A regularised material: its confinement over h_s, and the least of pressure over stiffness. The stiffness at zero stress is
  !> of the order of their quotient or less: 1e-7 h_s gives a tension that means nothing, and is enough for a solver of equations.
  real(wp), parameter :: confinement_over_h_s = 1.0e-12_wp, soft_strain = 1.0e-4_wp, soft_over_h_s = 1.0e-8_wp

  !> Parameters and the constants that follow from them.
  type :: material_type
    real(wp) :: p_t, h_s, n, e_d0, e_c0, e_i0, alpha, beta, m_R, m_T, R, beta_r, chi, K_w, e_0
    real(wp) :: a !< of the limit condition: sqrt(3) (3 - sin phi_c)/(2 sqrt(2) sin phi_c)
    real(wp) :: f_b0 !< the part of f_b that does not depend on the state [stress]
    logical :: intergranular !< is the intergranular strain on (m_R > 0.5)?
    real(wp) :: confinement !< what the model sees of a stress beyond its domain (border.f90) [stress]; 0: nothing, it refuses
    real(wp) :: soft_pressure !< -tr T below which the stiffness is lowered (border.f90) [stress]; 0 without a confinement
  end type material_type

contains

  !> Material from checked parameters.
  !> @param props       the 16 parameters, admissible (check_props)
  !> @param regularised is there to be a response beyond the domain too (border.f90)? no unless given
  pure function material_from_props(props, regularised) result(m)
    real(wp), intent(in) :: props(n_parameters)
    logical, intent(in), optional :: regularised
    type(material_type) :: m
    m%p_t = props(i_p_t)
    m%h_s = props(i_h_s)
    m%n = props(i_n)
    m%e_d0 = props(i_e_d0)
    m%e_c0 = props(i_e_c0)
    m%e_i0 = props(i_e_i0)
    m%alpha = props(i_alpha)
    m%beta = props(i_beta)
    m%m_R = props(i_m_R)
    m%m_T = props(i_m_T)
    m%R = props(i_R)
    m%beta_r = props(i_beta_r)
    m%chi = props(i_chi)
    m%K_w = props(i_K_w)
    m%e_0 = props(i_e_0)
    m%intergranular = intergranular_is_on(props)
    m%a = limit_constant(props)
    m%f_b0 = m%h_s / m%n * (m%e_i0 / m%e_c0)**m%beta / stiffness_bracket(props)
    m%confinement = 0.0_wp
    m%soft_pressure = 0.0_wp
    if (.not. present(regularised)) return
    if (.not. regularised) return
    m%confinement = confinement_over_h_s * m%h_s
    ! Pressure over stiffness, of an isotropic stress and e near e_c: theory.md Eqs. (8) to (10).
    m%soft_pressure = m%h_s * max(soft_over_h_s, (soft_strain * 3.0_wp * m%f_b0 / m%h_s * (1.0_wp + m%e_i0) / m%e_i0 * &
                                                  (1.0_wp + m%a**2 / 3.0_wp))**(1.0_wp / m%n))
  end function material_from_props

  !> Are the parameters finite, within their bounds and consistent?
  !> @param props   parameters in the order of PROPS
  !> @param status  status_ok or status_bad_material
  !> @param message names the parameter, its value and what was expected; '' when all is well
  !> @param name    of the parameter, the first of two that contradict each other; '' when all is well
  pure subroutine check_props(props, status, message, name)
    real(wp), intent(in) :: props(n_parameters)
    integer, intent(out) :: status
    character(len=*), intent(out) :: message
    character(len=*), intent(out), optional :: name
    integer :: i
    ! Written into a buffer of fixed length: with function results of deferred length, concatenated, threads of a program
    ! compiled by gfortran 12 were seen to overrun each other's texts.
    character(len=256) :: text

    status = status_bad_material
    text = ''
    if (present(name)) name = ''
    do i = 1, n_parameters
      if (parameters(i)%role == of_memory .and. i /= i_m_R .and. .not. intergranular_is_on(props)) cycle
      if (ieee_is_finite(props(i))) then ! before any comparison: one with NaN would trap
        if (props(i) >= parameters(i)%lower .and. props(i) <= parameters(i)%upper) cycle
      end if
      write (text, '(2a, g0.6, a, g0.6, 3a, g0.6)') name_of(i), ' = ', props(i), ' is not admissible, expected ', &
        parameters(i)%lower, ' <= ', name_of(i), ' <= ', parameters(i)%upper
      message = text
      if (present(name)) name = name_of(i)
      return
    end do
    if (props(i_e_d0) >= props(i_e_c0)) then
      i = i_e_d0
      write (text, contradiction) name_of(i_e_d0), props(i_e_d0), name_of(i_e_c0), props(i_e_c0), 'e_d0 < e_c0'
    else if (props(i_e_c0) > props(i_e_i0)) then
      i = i_e_c0
      write (text, contradiction) name_of(i_e_c0), props(i_e_c0), name_of(i_e_i0), props(i_e_i0), 'e_c0 <= e_i0'
    else if (stiffness_bracket(props) <= 0.0_wp) then
      i = i_phi_c
      write (text, contradiction) name_of(i_phi_c), props(i_phi_c), name_of(i_alpha), props(i_alpha), &
        '3 + a^2 - a sqrt(3) ((e_i0 - e_d0)/(e_c0 - e_d0))^alpha > 0 (stiffness would be negative)'
    else
      status = status_ok
    end if
    message = text
    if (present(name) .and. status /= status_ok) name = name_of(i)
  end subroutine check_props

  !> Name of a parameter without the null character and blanks.
  pure function name_of(i) result(name)
    integer, intent(in) :: i
    character(len=index(parameters(i)%name, nul) - 1) :: name
    name = parameters(i)%name
  end function name_of

  !> The convention of the public UMAT: m_R <= 0.5 switches the intergranular strain off.
  pure function intergranular_is_on(props) result(yes)
    real(wp), intent(in) :: props(n_parameters)
    logical :: yes
    yes = .false.
    if (ieee_is_finite(props(i_m_R))) yes = props(i_m_R) > 0.5_wp
  end function intergranular_is_on

  !> a of the limit condition; theory.md Eq. (2).
  pure function limit_constant(props) result(a)
    real(wp), intent(in) :: props(n_parameters)
    real(wp) :: a
    real(wp) :: sine
    sine = sin(props(i_phi_c) * pi / 180.0_wp)
    a = sqrt(3.0_wp) * (3.0_wp - sine) / (2.0_wp * sqrt(2.0_wp) * sine)
  end function limit_constant

  !> The bracket in the denominator of f_b; theory.md Eq. (8).
  pure function stiffness_bracket(props) result(bracket)
    real(wp), intent(in) :: props(n_parameters)
    real(wp) :: bracket
    real(wp) :: a
    a = limit_constant(props)
    bracket = 3.0_wp + a**2 - a * sqrt(3.0_wp) * &
              ((props(i_e_i0) - props(i_e_d0)) / (props(i_e_c0) - props(i_e_d0)))**props(i_alpha)
  end function stiffness_bracket

end module umat_material
