!> Anisotropy of contact forces over directions, and the stress it stands for.
!>
!> Densities over directions n, with P, Q, B, T symmetric and traceless (Rothenburg and Bathurst 1989, Geotechnique 39,
!> 601-614, in the plane; Ouadfel and Rothenburg 2001, Mech. Mater. 33, 201-221, and Guo and Zhao 2013, Comput. Geotech.
!> 47, 1-15, in space):
!>   contacts          E(n) = E0 (1 + P:nn)
!>   normal force      f(n) = f0 (1 + Q:nn)
!>   branch length     l(n) = l0 (1 + B:nn)
!>   tangential force  t(n) = f0 (T n - (n.T n) n)
!> In the plane P = a_n (cos 2 phi_n, -cos 2 phi_n, sin 2 phi_n), and so on: paper 003, Eqs. 3, 5 and 6. Force is positive in
!> compression and acts on particle 2, to which n points. Averages over directions are written < >.
module hypofab_force_anisotropy
  use, intrinsic :: iso_c_binding, only: wp => c_double, c_int
  use hypofab_rank4, only: components_of, double_contraction, symmetric_product, unit_tensor
  implicit none
  private
  public :: anisotropy_from_moments, tangential_from_moment, predict_stress, scalar_anisotropy

contains

  !> Size of a traceless tensor as a scalar: sqrt(3/2 a:a) in space (paper 000, Eq. 4), sqrt(1/2 a:a) in the plane, where
  !> it is the amplitude of cos 2 phi (paper 003, Eq. 4).
  pure function scalar_anisotropy(dimension, a) result(s) bind(C, name='hypofab_scalar_anisotropy')
    integer(c_int), value, intent(in) :: dimension
    real(wp), intent(in) :: a(6)
    real(wp) :: s
    s = sqrt(merge(1.5_wp, 0.5_wp, dimension == 3) * double_contraction(a, a))
  end function scalar_anisotropy

  !> Anisotropy of a scalar over directions from its second moment: f = f0 (1 + Q:nn) has <f nn> = f0 (1/3 1 + 2/15 Q) in
  !> space and f0 (1/2 1 + 1/4 Q) in the plane.
  !> @param dimension  3, or 2 for the plane xy
  !> @param moment     (6): <f nn>
  !> @param mean       filled: f0 = <f>
  !> @param anisotropy (6): filled, Q
  pure subroutine anisotropy_from_moments(dimension, moment, mean, anisotropy) &
    bind(C, name='hypofab_anisotropy_from_moments')
    integer(c_int), value, intent(in) :: dimension
    real(wp), intent(in) :: moment(6)
    real(wp), intent(out) :: mean, anisotropy(6)

    mean = sum(moment(1:3))
    anisotropy = merge(7.5_wp, 4.0_wp, dimension == 3) * (moment / mean - unit_tensor(dimension) / dimension)
  end subroutine anisotropy_from_moments

  !> T from the moment of the tangential force: <t n> = f0 T/5 in space, f0 T/4 in the plane.
  !> @param dimension 3, or 2 for the plane xy
  !> @param moment    (3,3): <t_i n_j>; its symmetric traceless part is used
  !> @param mean      f0
  !> @param tangential (6): filled, T
  pure subroutine tangential_from_moment(dimension, moment, mean, tangential) &
    bind(C, name='hypofab_tangential_from_moment')
    integer(c_int), value, intent(in) :: dimension
    real(wp), intent(in) :: moment(3, 3)
    real(wp), value, intent(in) :: mean
    real(wp), intent(out) :: tangential(6)

    tangential = components_of(moment)
    tangential = tangential - sum(tangential(1:3)) / dimension * unit_tensor(dimension)
    tangential = merge(5.0_wp, 4.0_wp, dimension == 3) / mean * tangential
  end subroutine tangential_from_moment

  !> Stress <E f n n + E t n> of the densities, over its mean value, positive in compression; branch vectors are taken for
  !> equally long and along n.
  !>
  !> Full: with the products of anisotropies, exact for these densities. In the plane and for common directions it is
  !> paper 003, Eq. 8, sin phi = (a_n + a_f + a_t)/(2 + a_n a_f). Brief: linear in the anisotropies, Eq. 9 in the plane; in
  !> space the deviator is 2/5 (P + Q + 3/2 T), hence q/p = 2/5 (a_n + a_f + 3/2 a_t) for common directions.
  !> @param dimension 3, or 2 for the plane xy
  !> @param p,q,t     (6): P, Q, T
  !> @param full,brief (6): filled
  pure subroutine predict_stress(dimension, p, q, t, full, brief) bind(C, name='hypofab_predict_stress')
    integer(c_int), value, intent(in) :: dimension
    real(wp), intent(in) :: p(6), q(6), t(6)
    real(wp), intent(out) :: full(6), brief(6)
    real(wp) :: of_four, of_six

    ! <n n n n> = of_four times the sum over the 3 pairings of its indices, <n n n n n n> = of_six times that over 15.
    of_four = 1.0_wp / (dimension * (dimension + 2))
    of_six = of_four / (dimension + 4)
    brief = unit_tensor(dimension) / dimension + 2.0_wp * of_four * (p + q - t) + t / dimension
    full = brief + of_six * (twice_over(dimension, p, q) - twice_over(dimension, p, t)) + 2.0_wp * of_four * symmetric_product(t, p)
    full = full * dimension / sum(full(1:3))
    brief = brief * dimension / sum(brief(1:3))
  end subroutine predict_stress

  !> What the fifteen pairings leave of a:nn b:nn nn for traceless a and b.
  pure function twice_over(dimension, a, b) result(c)
    integer, intent(in) :: dimension
    real(wp), intent(in) :: a(6), b(6)
    real(wp) :: c(6)
    c = 2.0_wp * double_contraction(a, b) * unit_tensor(dimension) + 8.0_wp * symmetric_product(a, b)
  end function twice_over

end module hypofab_force_anisotropy
