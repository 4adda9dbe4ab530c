/**
 * @file hypofab_describe.h
 * @brief Part of hypofab.h: everything that is computed from the contacts of one sample (docs/descriptors.md).
 *
 * Tensors of rank 2 are xx yy zz xy xz yz. Fully symmetric tensors of rank 4 are fifteen numbers: xxxx xxxy xxxz xxyy
 * xxyz xxzz xyyy xyyz xyzz xzzz yyyy yyyz yyzz yzzz zzzz. In the plane (dimension 2) components with a z are 0. Where
 * something is not known (no forces given, ...) numbers are NaN and counts 0.
 */
#ifndef HYPOFAB_DESCRIBE_H
#define HYPOFAB_DESCRIBE_H

#include "hypofab_fabric.h"

HYPOFAB_BEGIN

/** What contacts are counted by. */
typedef enum hypofab_contact_weight {
  HYPOFAB_BY_NUMBER = 0,        /**< each by one */
  HYPOFAB_BY_NORMAL_FORCE = 1,  /**< by f_n */
  HYPOFAB_BY_AREA = 2,          /**< by the contact's area */
  HYPOFAB_BY_BRANCH_LENGTH = 3, /**< by |branch| */
  HYPOFAB_N_WEIGHTS = 4
} hypofab_contact_weight;

/** Harmonics of even degree 0, 2, 4, 6, 8: the number of degrees, and of harmonics on the sphere (circle: 9). */
#define HYPOFAB_N_DEGREES 5
#define HYPOFAB_N_HARMONICS 45

/** Fabric tensors of one set of directions (Kanatani 1984). */
typedef struct hypofab_direction_fabric {
  int64_t count;                  /**< directions */
  double total;                   /**< sum of their weights */
  double first2[6], first4[15];   /**< first kind: moments `<n n>`, `<n n n n>` */
  double second2[6], second4[15]; /**< second kind: density f0 F:nn, f0 F::nnnn */
  double third2[6], third4[15];   /**< third kind: density f0 (1 + D:nn + D::nnnn), traceless */
  double anisotropy; /**< of D of rank 2: sqrt(3/2 D:D), paper 000's a; in the plane sqrt(1/2 D:D), paper 003's a_n */
  double deviator;   /**< largest minus smallest principal value of N (paper 002) */
  double principal_values[3];        /**< of N, largest first; in the plane the third is 0, along z */
  double principal_directions[3][3]; /**< row i: unit vector of principal_values[i] */
  double angle; /**< in the plane: the first of them from x towards y [deg], (-90, 90]; NaN in space */
} hypofab_direction_fabric;

/** Density of contact normals as a series of harmonics, and how well it fits (by degree: [k] is degree 2 k). */
typedef struct hypofab_harmonics {
  double coefficient[HYPOFAB_N_HARMONICS]; /**< density = f0 sum c_i Y_i(n), <Y_i^2> = 1; order: harmonics.f90 */
  double power[HYPOFAB_N_DEGREES];         /**< sum of c_i^2 of this degree */
  double isotropy_p[HYPOFAB_N_DEGREES];    /**< probability of at least this power if normals were isotropic and
                                                independent; NaN for degree 0 */
  double r_squared[HYPOFAB_N_DEGREES];   /**< share of the scatter of bin counts explained by degrees up to this one */
  double chi_squared[HYPOFAB_N_DEGREES]; /**< sum (count - expected)^2/expected over the bins */
  double chi_squared_p[HYPOFAB_N_DEGREES];   /**< probability of at least this chi_squared if the series were right */
  int degrees_of_freedom[HYPOFAB_N_DEGREES]; /**< of chi_squared; 0: too few bins for this degree, the above are NaN */
  int bins;                                  /**< bins of equal size on the hemisphere or half circle */
} hypofab_harmonics;

/** Anisotropy over directions of contacts, normal forces, tangential forces (paper 003, Eqs. 3, 5, 6) and branch
 * lengths. */
typedef struct hypofab_force_anisotropy {
  double mean_normal_force;                    /**< f0, the average over directions (not over contacts) [force] */
  double contact[6], normal[6], tangential[6]; /**< tensors: E0 (1 + P:nn), f0 (1 + Q:nn), f0 (T n - (n.T n) n) */
  double branch[6];                            /**< l0 (1 + B:nn) of branch lengths */
  double a_n, a_f, a_t, a_b;                   /**< their sizes: sqrt(3/2 a:a), in the plane sqrt(1/2 a:a) */
  double direction_n[3], direction_f[3], direction_t[3]; /**< directions of their largest principal values */
  double phi_n, phi_f, phi_t;                            /**< the same in the plane, from x towards y [deg] */
  double sin_phi;                  /**< mobilised friction of the stress they stand for, from its principal values */
  double sin_phi_short;            /**< the same without products of anisotropies */
  double q_over_p, q_over_p_short; /**< its stress ratio, in space */
  double sin_phi_coaxial;          /**< in the plane: (a_n + a_f + a_t)/(2 + a_n a_f), paper 003, Eq. 8 */
  double sin_phi_coaxial_short;    /**< in the plane: (a_n + a_f + a_t)/2, paper 003, Eq. 9 */
} hypofab_force_anisotropy;

/** A stress tensor averaged over the sample, tension positive. */
typedef struct hypofab_contact_stress {
  double total[3][3];       /**< -(1/V) sum f_i l_j, not quite symmetric when particles are not quite at rest */
  double normal[3][3];      /**< the part of normal forces */
  double tangential[3][3];  /**< the part of tangential forces */
  double p, q;              /**< of the symmetric part; in the plane p = -(s1 + s2)/2, q = |s1 - s2| (paper 003) */
  double q_over_p, sin_phi; /**< sin_phi = (s1 - s3)/(s1 + s3) of principal values, in the plane of the two; both are
                                 known without the volume */
  double normal_share, tangential_share; /**< of the two parts in q: projected on the deviator; they add to 1 */
} hypofab_contact_stress;

/** Contacts that form a network. */
typedef struct hypofab_network {
  double fraction;                 /**< of all contacts */
  double mean_normal_force;        /**< [force] */
  hypofab_direction_fabric fabric; /**< of its contact normals, counted by number */
  double stress[3][3];             /**< its part of the stress */
} hypofab_network;

/** Everything that is computed from the contacts of one sample. */
typedef struct hypofab_description {
  int dimension;                    /**< 3 or 2 */
  hypofab_fabric fabric;            /**< as hypofab_fabric_read gives it; in the plane with the factors of the plane:
                                         F = 4 (N - 1/2 1), a = sqrt(1/2 F:F) */
  double fabric_per_particle[6];    /**< (2/N_p) sum n n, N_p without rattlers, which have fewer than two contacts
                                         (paper 001, Eq. 1); its trace is paper 001's Z */
  double fabric_by_solid_volume[6]; /**< (1/V_s) sum over particles V_p sum over their contacts n n: independent of the
                                         volume of voids; its trace is the coordination number weighted by volume */
  hypofab_sample sample; /**< volumes and what was found while reading; of contacts in memory nothing: NaN and 0 */
  double anisotropy_per_particle; /**< paper 001's A: largest minus smallest principal value of it */
  hypofab_direction_fabric weighted[HYPOFAB_N_WEIGHTS]; /**< fabric of contact normals */
  hypofab_direction_fabric branch;                      /**< fabric of the directions of branch vectors */
  hypofab_direction_fabric long_axes;                   /**< fabric of the long axes of particles (paper 003) */
  double mean_branch_length;                            /**< [length] */
  double mean_normal_force, mean_shear_force;           /**< over contacts [force] */
  hypofab_harmonics harmonics;
  hypofab_force_anisotropy from_moments; /**< by averages over directions */
  hypofab_force_anisotropy from_bins;    /**< by least squares on bins */
  hypofab_contact_stress stress;
  hypofab_network strong, weak; /**< f_n above the mean, and the others */
  hypofab_network sliding;      /**< |f_t| > threshold mu f_n (papers 003, 004) */
} hypofab_description;

/** What to take into account. Zero in a field takes its default. */
typedef struct hypofab_describe_options {
  int dimension;            /**< 3 (default), or 2: a sample of disks in the plane xy */
  double volume;            /**< of the sample, for stress; area in the plane [length^3]; default: not known */
  double friction;          /**< mu = tan(friction angle) of the grains, for sliding; default: not known */
  double sliding_threshold; /**< 0.99 (default, paper 004); 0.9999 in paper 003 */
  int bins;                 /**< bins wanted; default 100 on the hemisphere, 18 on the half circle; most 10000. In space
                                 the nearest of 4 k^2 is taken. */
} hypofab_describe_options;

/** Contacts in memory. Pointers may be NULL, apart from normal; all arrays have `count` rows. */
typedef struct hypofab_contacts {
  size_t count;
  const double *normal;       /**< unit vectors, 3 each, from particle 1 to 2 */
  const double *branch;       /**< x2 - x1, 3 each [length] */
  const double *normal_force; /**< > 0: compression [force] */
  const double *shear_force;  /**< tangential force on particle 2, 3 each [force] */
  const double *area;         /**< [length^2] */
  const int64_t *id1, *id2;   /**< particles, 0 or more */
  int64_t particles;          /**< N_p; 0: the number of different ids */
  const double *long_axes;    /**< of particles, 3 each, any length but zero */
  size_t long_axis_count;
} hypofab_contacts;

/**
 * @brief Describe a sample whose contacts are in memory.
 * @param contacts    at least one
 * @param options     NULL for the defaults
 * @param description filled
 * @return HYPOFAB_BAD_ARGUMENT when a number is not finite, a normal is not a unit vector within 0.001, or options are
 *         out of range
 */
hypofab_status hypofab_describe(const hypofab_contacts *contacts, const hypofab_describe_options *options,
                                hypofab_description *description);

/**
 * @brief Describe a sample whose contacts are in a file, which is read twice when it holds forces.
 * @param path        contact list
 * @param format      NULL for the defaults
 * @param options     NULL for the defaults
 * @param description filled
 * @return HYPOFAB_BAD_FILE with file, line, column and what was expected in the message
 */
hypofab_status hypofab_describe_file(const char *path, const hypofab_contact_format *format,
                                     const hypofab_describe_options *options, hypofab_description *description);

/**
 * @brief Describe one sample whose contacts are spread over several files: of ranks, or of parts of a long list.
 *
 * What all files carry is taken. Parts with a particle file have the same one; contacts listed in two parts are not
 * found out.
 * @param n     files, at least one
 * @param paths their names
 * @return as hypofab_describe_file; HYPOFAB_BAD_ARGUMENT also for parts that do not belong together
 */
hypofab_status hypofab_describe_parts(int n, const char *const *paths, const hypofab_contact_format *format,
                                      const hypofab_describe_options *options, hypofab_description *description);

/** Name of component index of a tensor of rank 2 ("xx") or 4 ("xxxx"); NULL when out of range. */
const char *hypofab_component_name(int rank, int index);

HYPOFAB_END

#endif
