!> What is summed over contacts to describe a sample, in two passes: the second needs results of the first.
!>
!> Every member of a sum is a real number that adds, so two sums of parts of a sample make the sum of the whole, member by
!> member. Normals are divided by their length, which printed lists give to a few digits only.
module hypofab_description_sums
  use, intrinsic :: iso_c_binding, only: wp => c_double, c_int, c_int64_t
  use hypofab_harmonics, only: harmonics_of, most_harmonics
  use hypofab_moments, only: moments_t, add_direction
  use hypofab_rank4, only: double_contraction
  implicit none
  private
  public :: add_first_pass, add_second_pass

  !> contact of contact.h, member by member.
  type, bind(C), public :: contact_t
    integer(c_int64_t) :: id1, id2
    real(wp) :: normal(3), branch(3), position(3), normal_force, shear_force(3), area
    integer(c_int) :: cell(3), has
  end type contact_t

  !> network_sums of description_sums.h: contacts of one network. stress(i, j) = sum f_i l_j, column-major.
  type, bind(C), public :: network_t
    type(moments_t) :: directions
    real(wp) :: normal_force = 0.0_wp, stress(3, 3) = 0.0_wp
  end type network_t

  !> first_sums of description_sums.h.
  type, bind(C), public :: first_sums_t
    type(moments_t) :: by_number, by_force, by_area, by_length, branch
    type(network_t) :: sliding
    real(wp) :: normal_force = 0.0_wp, shear_force = 0.0_wp, branch_length = 0.0_wp
    real(wp) :: stress_normal(3, 3) = 0.0_wp, stress_tangential(3, 3) = 0.0_wp
    real(wp) :: harmonics(most_harmonics) = 0.0_wp
  end type first_sums_t

  !> second_sums of description_sums.h. chi: sums over 1 + a:nn, the density of contacts in the direction of n.
  type, bind(C), public :: second_sums_t
    type(network_t) :: strong, weak
    real(wp) :: chi_normal(6) = 0.0_wp, chi_tangential(3, 3) = 0.0_wp, chi_branch(6) = 0.0_wp
    real(wp) :: without_density = 0.0_wp !< contacts in directions where the density is not positive
  end type second_sums_t

contains

  !> First pass: moments by every weight, harmonics, stress, sliding contacts.
  !> @param n             number of contacts in the block
  !> @param block         (n): contacts; parts that they do not have are zero and add zero
  !> @param dimension     3, or 2 for the plane xy
  !> @param sliding_limit a contact slides when |f_t| > sliding_limit f_n; negative: none is counted
  !> @param sums          in and out
  pure subroutine add_first_pass(n, block, dimension, sliding_limit, sums) bind(C, name='hypofab_add_first_pass')
    integer(c_int), value, intent(in) :: n, dimension
    type(contact_t), intent(in) :: block(n)
    real(wp), value, intent(in) :: sliding_limit
    type(first_sums_t), intent(inout) :: sums
    real(wp) :: normal(3), shear, length, harmonics(most_harmonics)
    integer :: i

    do i = 1, n
      associate (c => block(i))
        normal = c%normal / norm2(c%normal)
        shear = norm2(c%shear_force)
        length = norm2(c%branch)
        call add_direction(sums%by_number, normal, 1.0_wp)
        call add_direction(sums%by_force, normal, c%normal_force)
        call add_direction(sums%by_area, normal, c%area)
        call add_direction(sums%by_length, normal, length)
        if (length > 0.0_wp) call add_direction(sums%branch, c%branch / length, 1.0_wp)
        if (sliding_limit >= 0.0_wp .and. shear > sliding_limit * c%normal_force) call add_to_network(sums%sliding, c, normal)
        sums%normal_force = sums%normal_force + c%normal_force
        sums%shear_force = sums%shear_force + shear
        sums%branch_length = sums%branch_length + length
        sums%stress_normal = sums%stress_normal + dyad(c%normal_force * normal, c%branch)
        sums%stress_tangential = sums%stress_tangential + dyad(c%shear_force, c%branch)
        call harmonics_of(dimension, normal, harmonics)
        sums%harmonics = sums%harmonics + harmonics
      end associate
    end do
  end subroutine add_first_pass

  !> Second pass: strong and weak network, and averages over directions instead of contacts.
  !>
  !> An average over directions counts each contact by the inverse of the density 1 + a:nn of contacts around it (Ouadfel
  !> and Rothenburg 2001, Mech. Mater. 33, 201-221; Guo and Zhao 2013, Comput. Geotech. 47, 1-15).
  !> @param n          number of contacts in the block
  !> @param block      (n): contacts with forces
  !> @param anisotropy (6): a, third kind of rank 2 of the contact normals
  !> @param mean_force a contact is strong when f_n > mean_force
  !> @param sums       in and out
  pure subroutine add_second_pass(n, block, anisotropy, mean_force, sums) bind(C, name='hypofab_add_second_pass')
    integer(c_int), value, intent(in) :: n
    type(contact_t), intent(in) :: block(n)
    real(wp), intent(in) :: anisotropy(6)
    real(wp), value, intent(in) :: mean_force
    type(second_sums_t), intent(inout) :: sums
    real(wp) :: normal(3), nn(6), density
    integer :: i

    do i = 1, n
      associate (c => block(i))
        normal = c%normal / norm2(c%normal)
        if (c%normal_force > mean_force) then
          call add_to_network(sums%strong, c, normal)
        else
          call add_to_network(sums%weak, c, normal)
        end if
        nn = [normal**2, normal(1) * normal(2), normal(1) * normal(3), normal(2) * normal(3)]
        density = 1.0_wp + double_contraction(anisotropy, nn)
        if (density > 0.0_wp) then
          sums%chi_normal = sums%chi_normal + c%normal_force / density * nn
          sums%chi_branch = sums%chi_branch + norm2(c%branch) / density * nn
          sums%chi_tangential = sums%chi_tangential + dyad(c%shear_force / density, normal)
        else
          sums%without_density = sums%without_density + 1.0_wp
        end if
      end associate
    end do
  end subroutine add_second_pass

  !> Add a contact to a network.
  pure subroutine add_to_network(network, c, normal)
    type(network_t), intent(inout) :: network
    type(contact_t), intent(in) :: c
    real(wp), intent(in) :: normal(3)

    call add_direction(network%directions, normal, 1.0_wp)
    network%normal_force = network%normal_force + c%normal_force
    network%stress = network%stress + dyad(c%normal_force * normal + c%shear_force, c%branch)
  end subroutine add_to_network

  !> a_i b_j.
  pure function dyad(a, b) result(m)
    real(wp), intent(in) :: a(3), b(3)
    real(wp) :: m(3, 3)
    m = spread(a, 2, 3) * spread(b, 1, 3)
  end function dyad

end module hypofab_description_sums
