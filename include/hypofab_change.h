/**
 * @file hypofab_change.h
 * @brief Part of hypofab.h: what changes between two contact lists, and how certain a fabric is (docs/changes.md,
 * docs/uncertainty.md).
 */
#ifndef HYPOFAB_CHANGE_H
#define HYPOFAB_CHANGE_H

#include "hypofab_fabric.h"

HYPOFAB_BEGIN

/* ------------------------------------------------------------- fabric change */

/** What changes a fabric tensor between two states of a sample (paper 001, Eq. 4). */
typedef enum hypofab_mechanism {
  HYPOFAB_LOSS = 0,
  HYPOFAB_GAIN = 1,
  HYPOFAB_REORIENTATION = 2, /**< of contacts that persist */
  HYPOFAB_N_MECHANISMS = 3
} hypofab_mechanism;

/** Most bins of a rose. */
#define HYPOFAB_MAX_BINS 180

/** Histogram of contact orientations in a plane, over half a turn (a normal has no sense), and its harmonic fit. */
typedef struct hypofab_rose {
  int bins;                        /**< of equal width, from the first axis of the plane towards the second */
  int64_t count[HYPOFAB_MAX_BINS]; /**< contacts in each bin */
  int64_t contacts;                /**< sum of the bins; contacts normal to the plane are in none */
  double anisotropy;               /**< a of the fit: density (contacts/180 deg) [1 + a cos 2(angle - direction)] */
  double direction;                /**< of the fit's largest density [deg], from 0 to 180 */
} hypofab_rose;

/** Change of contact fabric between two snapshots: dF = dF^g - dF^l + dF^r (paper 001, Eq. 4). */
typedef struct hypofab_fabric_change {
  int64_t particles;                            /**< N_p of F = (2/N_p) sum n n (paper 001, Eq. 1) */
  int64_t contacts_before, contacts_after;      /**< N_c */
  int64_t contacts[HYPOFAB_N_MECHANISMS];       /**< lost, gained, persisting */
  double fabric_before[6], fabric_after[6];     /**< F; its trace is the coordination number Z */
  double change[6];                             /**< dF */
  double by_mechanism[HYPOFAB_N_MECHANISMS][6]; /**< dF^l, dF^g, dF^r */
  double turn;                                  /**< root-mean-square turn of the persisting normals [deg] */
  hypofab_rose rose[2];                         /**< orientations of the lost and of the gained contacts */
} hypofab_fabric_change;

/** Options of a comparison; zero in a field takes its default. */
typedef struct hypofab_change_options {
  int64_t particles; /**< N_p; 0: the particles with two contacts or more in the first snapshot, as in paper 001 */
  int axes[2];       /**< of the plane of the roses: 0, 1, 2 for x, y, z; both 0: x and y */
  int bins;          /**< of the roses; 0: 24 */
} hypofab_change_options;

/** Contacts of one state, to which others are compared. Memory grows with the number of its contacts. */
typedef struct hypofab_snapshot hypofab_snapshot;

/**
 * @brief Read the first snapshot. Contacts need ids; they are told apart by their pair of ids and, when the list has
 *        one, by the periodic image of the second particle.
 * @param path          contact list
 * @param format        NULL for the defaults
 * @param ignore_images non-zero: by the pair of ids alone, for programs that wrap particles into the cell in between
 * @param snapshot      set; to be freed with hypofab_snapshot_free. NULL on failure
 * @return HYPOFAB_BAD_FILE also for a list without ids or with a contact that stands twice
 */
hypofab_status hypofab_snapshot_read(const char *path, const hypofab_contact_format *format, int ignore_images,
                                     hypofab_snapshot **snapshot);

/**
 * @brief Compare a later snapshot to the first one. One call at a time for each first snapshot.
 * @param before  the first one
 * @param path    contact list of the later one, streamed
 * @param format  NULL for the defaults
 * @param options NULL for the defaults
 * @param change  filled
 */
hypofab_status hypofab_snapshot_compare(hypofab_snapshot *before, const char *path,
                                        const hypofab_contact_format *format, const hypofab_change_options *options,
                                        hypofab_fabric_change *change);

/** Free a snapshot; NULL is allowed. */
void hypofab_snapshot_free(hypofab_snapshot *snapshot);

/** A strain probe in a plane and its fabric response per unit of strain (paper 001, Eqs. 7 and 10). */
typedef struct hypofab_fabric_probe {
  double angle;                    /**< alpha [deg]: eps_11 = |eps| cos alpha, eps_22 = |eps| sin alpha */
  double dZ[HYPOFAB_N_MECHANISMS]; /**< tr dF^m/|eps| */
  double dA[HYPOFAB_N_MECHANISMS]; /**< (dF^m_22 - dF^m_11)/|eps| */
} hypofab_fabric_probe;

/**
 * @brief Rates of change of a probe.
 * @param change of its contacts
 * @param angle  alpha [deg]
 * @param strain size of the strain increment, > 0 [-]
 * @param axes   plane of the probe: axes 1 and 2 as 0, 1, 2 for x, y, z; NULL: x and y
 * @param probe  filled
 */
hypofab_status hypofab_fabric_probe_rates(const hypofab_fabric_change *change, double angle, double strain,
                                          const int axes[2], hypofab_fabric_probe *probe);

/** Fewest probes of a fit. */
#define HYPOFAB_MIN_PROBES 3

/** A fitted number and its standard error, NaN when the fit has no degrees of freedom left. */
typedef struct hypofab_estimate {
  double value, error;
} hypofab_estimate;

/** Coefficients of one mechanism (paper 001, Eq. 14). */
typedef struct hypofab_mechanism_fit {
  hypofab_estimate B, C, D, E, G;
  hypofab_estimate dZ_extension, dZ_shear, dZ_compression; /**< dZ at alpha = 45, 135 and 225 deg (Eq. 16) */
  double r2_dZ, r2_dA; /**< share of the variation over the probes that the fit explains; NaN without variation */
} hypofab_mechanism_fit;

/** Fabric response to a fan of strain probes (paper 001, section 4). */
typedef struct hypofab_fabric_response {
  hypofab_mechanism_fit mechanism[HYPOFAB_N_MECHANISMS];
  hypofab_estimate a[5];      /**< a1 .. a5 of the total change (Eq. 19) */
  hypofab_estimate linear[3]; /**< B^g - B^l, D^g - D^l, G^g - G^l + G^r: all zero for an incrementally linear
                                   response (Eq. 18) */
} hypofab_fabric_response;

/**
 * @brief Least-squares fit of the representation theorem to a fan of probes (paper 001, Eqs. 14 to 19).
 *
 * dZ = (2B + G) + (2C + E)(cos + sin) + 2(D + G) cos sin, dA = E (sin - cos) + G (sin^2 - cos^2). The signs of dA are
 * those that Eqs. 10 and 11 demand; Eqs. 13 and 15 print the opposite ones (docs/changes.md).
 * Reorientation has E alone (G = D = B = 0, C = -E/2), as it changes no coordination number.
 * @param n        number of probes, HYPOFAB_MIN_PROBES or more, at angles that determine the coefficients
 * @param probes   n probes
 * @param printed  non-zero: the signs of dA as Eqs. 13 and 15 print them, which turns the signs of E and G
 * @param response filled
 * @return HYPOFAB_BAD_ARGUMENT when the angles do not determine the coefficients
 */
hypofab_status hypofab_fabric_fit(int n, const hypofab_fabric_probe *probes, int printed,
                                  hypofab_fabric_response *response);

/**
 * @brief Probe directions without gain or loss, from the mean change of contact forces (paper 001, Appendix A).
 *
 * The force in direction theta changes by dp/p [1 + cos 2 theta (a_n + 2 dq/dp - 2 q/p)] with dq/dp = tan(alpha - 45
 * deg); no contact is lost where that is positive for all theta, none gained where it is negative.
 * @param a_n          anisotropy of the normal contact forces; 0: isotropic
 * @param stress_ratio q/p; 0: isotropic
 * @param no_gain      filled: between these angles [deg]; 18.43 and 71.57 when isotropic
 * @param no_loss      filled: between these angles [deg]; 198.43 and 251.57 when isotropic
 */
hypofab_status hypofab_fabric_zones(double a_n, double stress_ratio, double no_gain[2], double no_loss[2]);

/** Contacts of one bin of directions (a normal has no sense: n and -n are in one bin). */
typedef struct hypofab_direction_bin {
  double polar[2];   /**< limits of the angle from z [deg], 0 to 90; in two dimensions both 90 */
  double azimuth[2]; /**< limits of the angle from x towards y [deg]; in two dimensions 0 to 180 */
  int64_t contacts;
  double density;        /**< contacts over what an isotropic sample of as many contacts would have: 1 on average */
  double normal_force;   /**< mean of its contacts, > 0: compression; NaN without contacts or forces [force] */
  double shear_force[3]; /**< mean, on the particle towards which the bin's direction points; NaN likewise [force] */
} hypofab_direction_bin;

/**
 * @brief Histogram of contact directions: bins of equal area on the hemisphere z >= 0, or of equal angle on the half
 *        circle y >= 0 in two dimensions (format->dimension 2). Streamed.
 * @param wanted about as many bins, 4 to 10000; 0: 100, in two dimensions 18. On the hemisphere they are 4 k^2: rings
 * of equal width in Lambert's projection with 4 (2 k + 1) sectors
 * @param count  set to their number
 * @param bins   set to `count` bins, to be freed with hypofab_contact_directions_free; NULL on failure
 */
hypofab_status hypofab_contact_directions(const char *path, const hypofab_contact_format *format, int wanted,
                                          int *count, hypofab_direction_bin **bins);

/** Free bins; NULL is allowed. */
void hypofab_contact_directions_free(hypofab_direction_bin *bins);

/* --------------------------------------------------------------- uncertainty */

/** How far an anisotropy stands out of the noise of a finite number of contacts (docs/uncertainty.md). */
typedef struct hypofab_significance {
  double noise;     /**< root-mean-square a of N_c independent contacts without preferred direction: 7.5/sqrt(N_c);
                         in two dimensions 2/sqrt(N_c) */
  double corrected; /**< a without the noise in it: sqrt(max(0, a^2 - 84.375 (1 - N:N)/(N_c - 1))); 8 for 84.375 in two
                         dimensions */
  double statistic; /**< N_c a^2/11.25, of chi-square distribution with 5 degrees of freedom without anisotropy; N_c
                         a^2/2 and 2 in two dimensions */
  double p_value;   /**< probability of this a or more without anisotropy, contacts being independent */
} hypofab_significance;

/**
 * @brief Test a fabric against isotropy.
 * @param fabric with its number of contacts
 * @return HYPOFAB_BAD_ARGUMENT when it has fewer than two (a given fabric tensor has none)
 */
hypofab_status hypofab_fabric_significance(const hypofab_fabric *fabric, hypofab_significance *significance);

/**
 * @brief The fabric without the noise in its anisotropy: same directions, F and a reduced.
 * @param fabric    N_c is needed when noise2 is negative
 * @param noise2    what noise adds to a^2, >= 0; negative: 84.375 (1 - N:N)/(N_c - 1), that of independent contacts
 * @param corrected filled; a = 0 where noise explains all of it. May be `fabric`.
 */
hypofab_status hypofab_fabric_correct(const hypofab_fabric *fabric, double noise2, hypofab_fabric *corrected);

/** What a bootstrap draws again, with replacement. */
typedef enum hypofab_resampling {
  HYPOFAB_CONTACTS = 0, /**< contacts, as if independent: weights of Poisson distribution, streamed */
  HYPOFAB_BLOCKS = 1,   /**< cubes of the sample with all contacts in them; contacts need positions */
  HYPOFAB_SAMPLES = 2   /**< whole contact lists, of samples made alike */
} hypofab_resampling;

/** Options of a bootstrap. */
typedef struct hypofab_bootstrap_options {
  hypofab_resampling units;
  int replicates;     /**< 20 or more */
  unsigned long seed; /**< equal seeds give equal results */
  int blocks;         /**< of HYPOFAB_BLOCKS: along each edge of the box that holds all contacts, 2 to 40 */
} hypofab_bootstrap_options;

/** Fabric tensors of a sample drawn again and again. */
typedef struct hypofab_bootstrap hypofab_bootstrap;

/**
 * @brief Read contact lists and draw their fabric again.
 * @param n_paths one list, or two and more for HYPOFAB_SAMPLES; several lists are pooled, contact by contact
 * @param paths   the files
 * @param format  NULL for the defaults
 * @param options what to draw
 * @param bootstrap set; to be freed with hypofab_bootstrap_free. NULL on failure
 * @return HYPOFAB_BAD_FILE as hypofab_fabric_read; HYPOFAB_BAD_ARGUMENT. Memory does not grow with the number of
 * contacts.
 */
hypofab_status hypofab_bootstrap_read(int n_paths, const char *const *paths, const hypofab_contact_format *format,
                                      const hypofab_bootstrap_options *options, hypofab_bootstrap **bootstrap);

/** Free a bootstrap; NULL is allowed. */
void hypofab_bootstrap_free(hypofab_bootstrap *bootstrap);

/** Turn sample and replicates into other axes, as hypofab_fabric_rotate. */
hypofab_status hypofab_bootstrap_rotate(hypofab_bootstrap *bootstrap, const double rotation[3][3]);

/** Number of replicates and of units (contacts, blocks with contacts in them, samples). */
int hypofab_bootstrap_replicates(const hypofab_bootstrap *bootstrap);
int64_t hypofab_bootstrap_units(const hypofab_bootstrap *bootstrap);

/** What noise adds to a^2, from the scatter of the replicates (hypofab_uncertainty). */
double hypofab_bootstrap_noise2(const hypofab_bootstrap *bootstrap);

/** The fabric of the lists as they are; coordination numbers are not known. */
hypofab_status hypofab_bootstrap_fabric(const hypofab_bootstrap *bootstrap, hypofab_fabric *fabric);

/**
 * @brief The fabric of one replicate, with as much noise in its anisotropy as the sample has, or without.
 *
 * A replicate carries the noise of the sample and once more as much: noise2 (hypofab_uncertainty) is taken off its a^2
 * once, or twice when corrected.
 * @param index     from 0
 * @param corrected non-zero: without noise
 */
hypofab_status hypofab_bootstrap_replicate(const hypofab_bootstrap *bootstrap, int index, int corrected,
                                           hypofab_fabric *fabric);

/** A range that holds the share `level` of the replicates or more, and their standard deviation. */
typedef struct hypofab_interval {
  double lower, upper, error;
} hypofab_interval;

/** Confidence in a fabric and in the delta that follows from it. */
typedef struct hypofab_uncertainty {
  double noise2;                         /**< what noise adds to a^2, from the scatter of the replicates */
  double p_value;                        /**< probability of this F or a larger one without anisotropy (Hotelling's
                                              test with the scatter of the replicates); NaN for 6 units or fewer */
  hypofab_interval fabric[6];            /**< N */
  hypofab_interval deviatoric_fabric[6]; /**< F */
  hypofab_interval anisotropy;           /**< plain a: where a of another sample like this one would be */
  hypofab_interval corrected_anisotropy; /**< a without noise: where that of the unlimited sample is */
  hypofab_interval weight;               /**< f(a); as wide on both sides of the estimate, for it bends */
  hypofab_interval delta[6];             /**< likewise */
  double delta_angle; /**< the share `level` of deltas is within this angle of the estimate, acos(d:d'/R^2) [deg] */
} hypofab_uncertainty;

/**
 * @brief Intervals of a bootstrap.
 * @param level     share of the replicates inside, e.g. 0.95
 * @param R         of the map to delta, hypofab_fabric_to_delta_weighted
 * @param c         of the map
 * @param weight    of the map; NULL: exponential
 * @param corrected non-zero: weight and delta follow from the fabric without noise
 */
hypofab_status hypofab_bootstrap_uncertainty(const hypofab_bootstrap *bootstrap, double level, double R, double c,
                                             const char *weight, int corrected, hypofab_uncertainty *uncertainty);

HYPOFAB_END

#endif
