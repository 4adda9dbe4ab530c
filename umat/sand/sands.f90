!> Built-in sands: published parameter sets, each with its source. A newcomer adds one row here.
module umat_sands
  use umat_kinds, only: wp
  use umat_material, only: n_parameters
  implicit none
  private
  public :: sand_type, find_sand

  !> One sand. Texts end with a null character for C.
  type :: sand_type
    character(len=32) :: name
    character(len=80) :: description
    character(len=200) :: source
    real(wp) :: props(n_parameters) !< order of PROPS, h_s in kPa
  end type sand_type

  character, parameter :: nul = achar(0)
  integer, parameter, public :: n_sands = 9

  character(len=*), parameter :: herle_gudehus = &
    'Herle and Gudehus (1999) Mech. Cohes.-Frict. Mater. 4, 461-486'//nul

  ! Where a source gives no intergranular strain, m_R = 0 switches it off.
  real(wp), parameter :: none(5) = [0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]

  !> The sands, in alphabetical order after that of the paper. Numbers: phi_c, p_t, h_s, n, e_d0, | e_c0, e_i0, alpha,
  !> beta, | m_R, m_T, R, beta_r, chi, K_w, e_0. docs/sands.md says how each was checked.
  type(sand_type), parameter, public :: sands(n_sands) = [ &
    sand_type('paper000'//nul, 'typical sand of the paper on contact fabric'//nul, &
              'Paper 000, Table 2 (values typical of sands in the literature)'//nul, &
              [30.0_wp, 0.0_wp, 230.0e3_wp, 0.5_wp, 0.579_wp, &
               0.865_wp, 0.995_wp, 0.13_wp, 2.4_wp, 5.0_wp, 3.0_wp, 1.0e-4_wp, 0.3_wp, 1.0_wp, 0.0_wp, 0.0_wp]), &
    sand_type('hochstetten'//nul, 'Hochstetten sand, calibration of 1996, with intergranular strain'//nul, &
    'von Wolffersdorff (1996) Mech. Cohes.-Frict. Mater. 1, 251-271; Niemunis and Herle (1997) ibid. 2, 279-299'//nul, &
              [33.0_wp, 0.0_wp, 1000.0e3_wp, 0.25_wp, 0.55_wp, &
               0.95_wp, 1.05_wp, 0.25_wp, 1.5_wp, 5.0_wp, 2.0_wp, 1.0e-4_wp, 0.5_wp, 6.0_wp, 0.0_wp, 0.0_wp]), &
    sand_type('hochstetten_1999'//nul, 'Hochstetten sand, calibration of 1999'//nul, &
              herle_gudehus, &
              [33.0_wp, 0.0_wp, 1500.0e3_wp, 0.28_wp, 0.55_wp, &
               0.95_wp, 1.05_wp, 0.25_wp, 1.0_wp, none, 0.0_wp, 0.0_wp]), &
    sand_type('hochstetten_gravel'//nul, 'Hochstetten gravel'//nul, &
              herle_gudehus, &
              [36.0_wp, 0.0_wp, 32000.0e3_wp, 0.18_wp, 0.26_wp, &
               0.45_wp, 0.5_wp, 0.1_wp, 1.8_wp, none, 0.0_wp, 0.0_wp]), &
    sand_type('hostun'//nul, 'Hostun sand'//nul, &
              herle_gudehus, &
              [31.0_wp, 0.0_wp, 1000.0e3_wp, 0.29_wp, 0.61_wp, &
               0.96_wp, 1.09_wp, 0.13_wp, 2.0_wp, none, 0.0_wp, 0.0_wp]), &
    sand_type('karlsruhe'//nul, 'Karlsruhe sand'//nul, &
              herle_gudehus, &
              [30.0_wp, 0.0_wp, 5800.0e3_wp, 0.28_wp, 0.53_wp, &
               0.84_wp, 1.0_wp, 0.13_wp, 1.05_wp, none, 0.0_wp, 0.0_wp]), &
    sand_type('karlsruhe_fine'//nul, 'Karlsruhe fine sand, with intergranular strain'//nul, &
              'Wichtmann, Fuentes and Triantafyllidis (2019) Soil Dyn. Earthq. Eng. 124, 172-183'//nul, &
              [33.1_wp, 0.0_wp, 4000.0e3_wp, 0.27_wp, 0.677_wp, &
               1.054_wp, 1.212_wp, 0.14_wp, 2.5_wp, 2.2_wp, 1.1_wp, 1.0e-4_wp, 0.1_wp, 5.5_wp, 0.0_wp, 0.0_wp]), &
    sand_type('lausitz'//nul, 'Lausitz sand'//nul, &
              herle_gudehus, &
              [33.0_wp, 0.0_wp, 1600.0e3_wp, 0.19_wp, 0.44_wp, &
               0.85_wp, 1.0_wp, 0.25_wp, 1.0_wp, none, 0.0_wp, 0.0_wp]), &
    sand_type('toyoura'//nul, 'Toyoura sand'//nul, &
              herle_gudehus, &
              [30.0_wp, 0.0_wp, 2600.0e3_wp, 0.27_wp, 0.61_wp, &
               0.98_wp, 1.1_wp, 0.18_wp, 1.1_wp, none, 0.0_wp, 0.0_wp])]

contains

  !> Position of a sand in the table, 0 when there is none of that name.
  pure function find_sand(name) result(found)
    character(len=*), intent(in) :: name
    integer :: found
    do found = n_sands, 1, -1
      if (sands(found)%name == name//nul) return
    end do
  end function find_sand

end module umat_sands
