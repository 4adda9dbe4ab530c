!> Contact fabric of a granular sample and the initial intergranular strain it gives.
!>
!> Every formula of this room stands here. Source: paper "fabric tensor -> intergranular strain" (docs/fabric2delta.md),
!> its Eqs. 1 to 4 (fabric), 6 and 7 (map to delta); Thornton (2000) for the mechanical coordination number.
!> Symmetric tensors are six tensor components, xx yy zz xy xz yz; fabric has no unit and no sign convention, delta is
!> positive in extension.
module hypofab_fabric
  use, intrinsic :: iso_c_binding, only: wp => c_double, c_int, c_int64_t
  use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
  implicit none
  private
  public :: fabric_t, initial_delta_t
  public :: add_normals, describe_fabric, describe_plane_fabric, count_coordination, map_to_delta
  public :: find_principal, principal_axes

  real(wp), parameter :: unit_tensor(6) = [1.0_wp, 1.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]

  !> hypofab_fabric of hypofab.h, member by member. Column i of principal_directions is row i in C.
  type, bind(C) :: fabric_t
    integer(c_int64_t) :: contacts, particles
    real(wp) :: fabric(6), deviatoric_fabric(6), anisotropy
    real(wp) :: principal_values(3), principal_directions(3, 3)
    real(wp) :: coordination_number, mechanical_coordination_number
    integer(c_int64_t) :: rattlers
  end type fabric_t

  !> hypofab_initial_delta of hypofab.h, member by member.
  type, bind(C) :: initial_delta_t
    real(wp) :: weight, weighted_fabric(6), delta(6)
  end type initial_delta_t

  interface
    !> LAPACK: eigenvalues (ascending) and orthonormal eigenvectors of a real symmetric matrix.
    pure subroutine dsyev(jobz, uplo, n, a, lda, w, work, lwork, info)
      import :: wp
      character, intent(in) :: jobz, uplo
      integer, intent(in) :: n, lda, lwork
      real(wp), intent(inout) :: a(lda, *)
      real(wp), intent(out) :: w(*), work(*)
      integer, intent(out) :: info
    end subroutine dsyev
  end interface

contains

  !> Add n (x) n of a block of contact normals to running sums (paper Eq. 2, before the division by N_c).
  !>
  !> Only the direction of a normal counts: lists print a few digits, so each product is divided by n.n, which makes
  !> tr N = 1 to rounding. Sums are formed per block first, so rounding errors do not grow with the length of a list.
  !> @param n        number of normals in the block
  !> @param normals  (3, n): vectors of non-zero length, either sense
  !> @param sums     (6): in and out, sum of n (x) n
  pure subroutine add_normals(n, normals, sums) bind(C, name='hypofab_fabric_add_normals')
    integer(c_int), value, intent(in) :: n
    real(wp), intent(in) :: normals(3, n)
    real(wp), intent(inout) :: sums(6)
    real(wp) :: block(6)
    integer :: i

    block = 0.0_wp
    do i = 1, n
      associate (x => normals(1, i), y => normals(2, i), z => normals(3, i))
        block = block + [x * x, y * y, z * z, x * y, x * z, y * z] / (x * x + y * y + z * z)
      end associate
    end do
    sums = sums + block
  end subroutine add_normals

  !> Deviatoric fabric F = 15/2 (N - 1/3 1) (paper Eq. 3), anisotropy a = sqrt(3/2 F:F) (Eq. 4), principal values and
  !> directions of a fabric tensor. Counts are set to 0 (not known), coordination numbers to NaN.
  !> @param tensor  (6): fabric tensor N, finite
  !> @param fabric  filled
  !> @return 0, or LAPACK's info when the eigenvalues could not be found
  function describe_fabric(tensor, fabric) result(info) bind(C, name='hypofab_fabric_describe')
    real(wp), intent(in) :: tensor(6)
    type(fabric_t), intent(out) :: fabric
    integer(c_int) :: info

    fabric%contacts = 0
    fabric%particles = 0
    fabric%coordination_number = ieee_value(1.0_wp, ieee_quiet_nan)
    fabric%mechanical_coordination_number = ieee_value(1.0_wp, ieee_quiet_nan)
    fabric%rattlers = -1
    fabric%fabric = tensor
    fabric%deviatoric_fabric = 7.5_wp * (tensor - unit_tensor / 3.0_wp)
    fabric%anisotropy = sqrt(1.5_wp) * frobenius_norm(fabric%deviatoric_fabric)
    call find_principal(tensor, fabric%principal_values, fabric%principal_directions, info)
  end function describe_fabric

  !> The same in two dimensions: F = 4 (N - 1/2 1) with xx, yy, xy alone (Kanatani 1984) and a = sqrt(1/2 F:F), the
  !> amplitude of E(phi) = 1/(2 pi) (1 + a cos 2(phi - phi_a)). The third principal value is 0 and belongs to z.
  function describe_plane_fabric(tensor, fabric) result(info) bind(C, name='hypofab_fabric_describe_plane')
    real(wp), intent(in) :: tensor(6)
    type(fabric_t), intent(out) :: fabric
    integer(c_int) :: info

    info = describe_fabric(tensor, fabric)
    fabric%deviatoric_fabric = 4.0_wp * (tensor - [0.5_wp, 0.5_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp])
    fabric%anisotropy = sqrt(0.5_wp) * frobenius_norm(fabric%deviatoric_fabric)
  end function describe_plane_fabric

  !> Coordination number 2 N_c/N_p (paper Eq. 1) and mechanical coordination number (2 N_c - N_1)/(N_p - N_0 - N_1)
  !> (Thornton 2000), which leaves out particles with no or one contact. NaN where a denominator vanishes. A contact
  !> with a wall, or with a particle outside the region looked at, is one of one particle: 2 N_c stands for all ends.
  !> @param contacts   N_c
  !> @param ends       contacts of all particles together; 2 N_c without walls and regions
  !> @param particles  N_p, 0 when not known
  !> @param none       N_0, particles without contact; negative when contacts per particle are not known
  !> @param one        N_1, particles with one contact
  !> @param fabric     in and out: its counts and coordination numbers are set
  pure subroutine count_coordination(contacts, ends, particles, none, one, fabric) &
    bind(C, name='hypofab_fabric_count_coordination')
    integer(c_int64_t), value, intent(in) :: contacts, ends, particles, none, one
    type(fabric_t), intent(inout) :: fabric

    fabric%contacts = contacts
    fabric%particles = particles
    fabric%coordination_number = quotient(ends, particles)
    fabric%rattlers = merge(none + one, -1_c_int64_t, none >= 0)
    if (none < 0) then
      fabric%mechanical_coordination_number = quotient(0_c_int64_t, 0_c_int64_t)
    else
      fabric%mechanical_coordination_number = quotient(ends - one, particles - none - one)
    end if
  end subroutine count_coordination

  !> Initial intergranular strain of a fabric: A = (1 - f) 1 + f F, delta = R A/|A| (paper Eq. 6).
  !> @param fabric  its deviatoric fabric is used
  !> @param R       size of the elastic strain range [-], > 0
  !> @param weight  f, from 0 to 1 (weight_function.c)
  !> @param map     filled: f, A, delta (tensor components, positive in extension). Where A = 0 (only possible when
  !>                tr N differs from 1) delta has no direction and is NaN.
  pure subroutine map_to_delta(fabric, R, weight, map) bind(C, name='hypofab_fabric_map_to_delta')
    type(fabric_t), intent(in) :: fabric
    real(wp), value, intent(in) :: R, weight
    type(initial_delta_t), intent(out) :: map
    real(wp) :: norm

    map%weight = weight
    map%weighted_fabric = (1.0_wp - map%weight) * unit_tensor + map%weight * fabric%deviatoric_fabric
    norm = frobenius_norm(map%weighted_fabric)
    if (norm > 0.0_wp) then
      map%delta = (R / norm) * map%weighted_fabric
    else
      map%delta = ieee_value(1.0_wp, ieee_quiet_nan)
    end if
  end subroutine map_to_delta

  !> |x| = sqrt(x:x) of a symmetric tensor, each shear component counted twice.
  pure real(wp) function frobenius_norm(x) result(norm)
    real(wp), intent(in) :: x(6)

    norm = norm2([x(1:3), sqrt(2.0_wp) * x(4:6)])
  end function frobenius_norm

  !> a/b of two counts, NaN for b <= 0.
  pure real(wp) function quotient(a, b) result(q)
    integer(c_int64_t), intent(in) :: a, b

    if (b > 0) then
      q = real(a, wp) / real(b, wp)
    else
      q = ieee_value(1.0_wp, ieee_quiet_nan)
    end if
  end function quotient

  !> find_principal for C.
  function principal_axes(tensor, values, directions) result(info) bind(C, name='hypofab_principal_axes')
    real(wp), intent(in) :: tensor(6)
    real(wp), intent(out) :: values(3), directions(3, 3)
    integer(c_int) :: info
    call find_principal(tensor, values, directions, info)
  end function principal_axes

  !> Principal values (largest first) and directions (columns, right-handed) of a symmetric tensor.
  !>
  !> An eigenvector has no sense; to give equal results for equal input everywhere, the largest component of the first
  !> and of the second is made positive and the third completes the right-handed triad.
  pure subroutine find_principal(tensor, values, directions, info)
    real(wp), intent(in) :: tensor(6)
    real(wp), intent(out) :: values(3), directions(3, 3)
    integer(c_int), intent(out) :: info
    real(wp) :: matrix(3, 3), ascending(3), work(8)
    integer :: i, lapack_info

    matrix = reshape(tensor([1, 4, 5, 4, 2, 6, 5, 6, 3]), [3, 3])
    call dsyev('V', 'U', 3, matrix, 3, ascending, work, size(work), lapack_info)
    info = lapack_info
    values = ascending(3:1:-1)
    do i = 1, 2
      associate (v => matrix(:, 4 - i))
        directions(:, i) = sign(1.0_wp, v(maxloc(abs(v), dim=1))) * v
      end associate
    end do
    associate (u => directions(:, 1), v => directions(:, 2))
      directions(:, 3) = [u(2) * v(3) - u(3) * v(2), u(3) * v(1) - u(1) * v(3), u(1) * v(2) - u(2) * v(1)]
    end associate
  end subroutine find_principal

end module hypofab_fabric
