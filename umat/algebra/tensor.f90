!> Symmetric second-order tensors as six tensor components in the order xx yy zz xy xz yz.
!>
!> Shear components are tensor components (eps_xy, not gamma_xy), so every double contraction counts them twice. Nothing
!> here knows a sign convention or a unit.
module umat_tensor
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use umat_kinds, only: pi, wp
  implicit none
  private
  public :: ddot, norm, trace, deviator, trace_of_cube, squared, is_negative_definite, rotate, diagonalise
  public :: principal_values, friction_angle

  !> The unit tensor.
  real(wp), parameter, public :: unit_tensor(6) = [1.0_wp, 1.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]
  !> How often a component occurs in a double contraction.
  real(wp), parameter, public :: multiplicity(6) = [1.0_wp, 1.0_wp, 1.0_wp, 2.0_wp, 2.0_wp, 2.0_wp]

contains

  !> Double contraction a:b.
  pure function ddot(a, b) result(s)
    real(wp), intent(in) :: a(6), b(6)
    real(wp) :: s
    s = a(1) * b(1) + a(2) * b(2) + a(3) * b(3) + 2.0_wp * (a(4) * b(4) + a(5) * b(5) + a(6) * b(6))
  end function ddot

  !> Frobenius norm sqrt(a:a), without overflow or underflow of the squares.
  pure function norm(a) result(s)
    real(wp), intent(in) :: a(6)
    real(wp) :: s
    real(wp) :: largest
    largest = maxval(abs(a))
    if (largest > 1.0e-100_wp .and. largest < 1.0e100_wp) then
      s = sqrt(ddot(a, a))
    else if (largest > 0.0_wp .and. largest <= huge(largest)) then
      s = largest * sqrt(ddot(a / largest, a / largest))
    else
      s = largest
    end if
  end function norm

  !> Trace.
  pure function trace(a) result(s)
    real(wp), intent(in) :: a(6)
    real(wp) :: s
    s = a(1) + a(2) + a(3)
  end function trace

  !> Deviatoric part a - tr(a)/3 1.
  pure function deviator(a) result(d)
    real(wp), intent(in) :: a(6)
    real(wp) :: d(6)
    d = a - trace(a) / 3.0_wp * unit_tensor
  end function deviator

  !> tr(d d d) of a deviatoric tensor d, which is three times its determinant.
  pure function trace_of_cube(d) result(s)
    real(wp), intent(in) :: d(6)
    real(wp) :: s
    s = 3.0_wp * determinant(d)
  end function trace_of_cube

  !> a a, the single contraction.
  pure function squared(a) result(b)
    real(wp), intent(in) :: a(6)
    real(wp) :: b(6)
    b = [a(1) * a(1) + a(4) * a(4) + a(5) * a(5), a(4) * a(4) + a(2) * a(2) + a(6) * a(6), &
         a(5) * a(5) + a(6) * a(6) + a(3) * a(3), a(1) * a(4) + a(4) * a(2) + a(5) * a(6), &
         a(1) * a(5) + a(4) * a(6) + a(5) * a(3), a(4) * a(5) + a(2) * a(6) + a(6) * a(3)]
  end function squared

  !> Determinant.
  pure function determinant(a) result(s)
    real(wp), intent(in) :: a(6)
    real(wp) :: s
    s = a(1) * (a(2) * a(3) - a(6) * a(6)) - a(4) * (a(4) * a(3) - a(5) * a(6)) + a(5) * (a(4) * a(6) - a(5) * a(2))
  end function determinant

  !> Are all principal values negative (all principal stresses compressive)? False for NaN.
  !> @param least if above zero: are they all below -least? No is said too where one is barely so, or two are small
  pure function is_negative_definite(a, least) result(yes)
    real(wp), intent(in) :: a(6), least
    logical :: yes
    real(wp) :: b(6), size
    yes = .false.
    if (.not. all(ieee_is_finite(a))) return ! before any comparison: one with NaN would trap
    size = maxval(abs(a))
    if (.not. size > 0.0_wp) return
    b = a / size
    ! Sylvester's criterion on -b. Its smallest principal value is at least the third invariant over the second, of which
    ! the latter is at most (tr b)^2/3.
    yes = b(1) < 0.0_wp .and. b(1) * b(2) - b(4) * b(4) > 0.0_wp .and. &
          determinant(b) < -least / size * trace(b)**2 / 3.0_wp
  end function is_negative_definite

  !> Q a Q^T.
  !> @param a tensor
  !> @param q rotation matrix, q(i,j)
  pure function rotate(a, q) result(b)
    real(wp), intent(in) :: a(6), q(3, 3)
    real(wp) :: b(6)
    real(wp) :: m(3, 3)
    m = reshape([a(1), a(4), a(5), a(4), a(2), a(6), a(5), a(6), a(3)], [3, 3])
    m = matmul(q, matmul(m, transpose(q)))
    b = [m(1, 1), m(2, 2), m(3, 3), m(1, 2), m(1, 3), m(2, 3)]
  end function rotate

  !> Principal values in ascending order, by Jacobi's rotations: exact to rounding also where two of them coincide,
  !> where the closed form loses half the digits. Meant for output; the model itself works with invariants.
  pure function principal_values(a) result(values)
    real(wp), intent(in) :: a(6)
    real(wp) :: values(3)
    call diagonalise(a, values)
    if (values(1) > values(2)) values(1:2) = values([2, 1])
    if (values(2) > values(3)) values(2:3) = values([3, 2])
    if (values(1) > values(2)) values(1:2) = values([2, 1])
  end function principal_values

  !> Principal values in no particular order, and the directions that belong to them.
  !> @param axes the directions, as columns
  pure subroutine diagonalise(a, values, axes)
    real(wp), intent(in) :: a(6)
    real(wp), intent(out) :: values(3)
    real(wp), intent(out), optional :: axes(3, 3)
    real(wp) :: m(3, 3), negligible, cotangent, t, c, along_p(3)
    integer :: sweep, p, q, r
    if (present(axes)) axes = reshape([1, 0, 0, 0, 1, 0, 0, 0, 1] * 1.0_wp, [3, 3])
    m = reshape([a(1), a(4), a(5), a(4), a(2), a(6), a(5), a(6), a(3)], [3, 3])
    negligible = max(tiny(t), epsilon(t)**2 * maxval(abs(a)))
    do sweep = 1, 10 ! converges quadratically; six sweeps reach rounding for any input
      if (max(abs(m(1, 2)), abs(m(1, 3)), abs(m(2, 3))) <= negligible) exit
      do p = 1, 2
        do q = p + 1, 3
          if (abs(m(p, q)) <= negligible) cycle
          cotangent = (m(q, q) - m(p, p)) / (2.0_wp * m(p, q))
          t = sign(1.0_wp, cotangent) / (abs(cotangent) + sqrt(1.0_wp + cotangent**2))
          c = 1.0_wp / sqrt(1.0_wp + t**2)
          m(p, p) = m(p, p) - t * m(p, q)
          m(q, q) = m(q, q) + t * m(p, q)
          m(p, q) = 0.0_wp
          r = 6 - p - q ! the axis that stays; the upper triangle is kept
          associate (pr => m(min(p, r), max(p, r)), qr => m(min(q, r), max(q, r)))
            along_p(1) = pr
            pr = c * (pr - t * qr)
            qr = c * (t * along_p(1) + qr)
          end associate
          if (present(axes)) then
            along_p = axes(:, p)
            axes(:, p) = c * (along_p - t * axes(:, q))
            axes(:, q) = c * (t * along_p + axes(:, q))
          end if
        end do
      end do
    end do
    values = [m(1, 1), m(2, 2), m(3, 3)]
  end subroutine diagonalise

  !> Mobilised friction angle asin((s1 - s3)/(s1 + s3)) [deg] of a stress tensor (tension positive); 90 outside the
  !> range where it is defined.
  pure function friction_angle(stress) result(phi)
    real(wp), intent(in) :: stress(6)
    real(wp) :: phi
    real(wp) :: s(3), sine
    s = principal_values(stress)
    if (s(1) + s(3) < 0.0_wp) then
      sine = (s(3) - s(1)) / (-(s(1) + s(3)))
    else
      sine = 1.0_wp
    end if
    phi = asin(max(0.0_wp, min(1.0_wp, sine))) * 180.0_wp / pi
  end function friction_angle

end module umat_tensor
