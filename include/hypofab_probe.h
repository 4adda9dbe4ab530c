/**
 * @file hypofab_probe.h
 * @brief Part of hypofab.h: response envelopes, probes and stability of a state (docs/probes.md, docs/stability.md).
 */
#ifndef HYPOFAB_PROBE_H
#define HYPOFAB_PROBE_H

#include "hypofab_element_test.h"

HYPOFAB_BEGIN

/* ------------------------------------------------------------------ envelope */

/** One strain-rate probe in the axisymmetric plane and its response. */
typedef struct hypofab_probe {
  double angle;         /**< [deg] axial part cos(angle), lateral parts sin(angle)/sqrt(2) each */
  double stretching[6]; /**< unit strain rate (or the direction of the strain increment) */
  double response[6]; /**< stress rate; for a finite probe the stress increment over the size of the strain increment */
} hypofab_probe;

/**
 * @brief Response envelope (Gudehus 1979): unit strain-rate probes in the axisymmetric plane of one state.
 * @param material parameters (m_R <= 0.5: without intergranular strain)
 * @param state    the state probed
 * @param axis     0, 1, 2: the axis of symmetry x, y, z
 * @param size     0: rates; > 0: finite strain increments of this Frobenius norm
 * @param n        number of probes, angle_k = 360 deg k/n
 * @param probes   n entries, filled
 */
hypofab_status hypofab_envelope(const hypofab_material *material, const hypofab_state *state, int axis, double size,
                                int n, hypofab_probe *probes);

/* -------------------------------------------------------------------- probes */

/**
 * A linear space of probe directions: all combinations of `dimension` orthonormal tensors. Coordinates in it are
 * isometric: the norm of a tensor in the space is the length of its coordinates.
 */
typedef struct hypofab_subspace {
  int dimension; /**< 2 (a plane), 3 (principal directions) or 6 (all components) */
  double basis[6][6];
} hypofab_subspace;

/**
 * @brief The axisymmetric plane: axial part, lateral parts alike.
 * @param axis 0, 1, 2: the axis of symmetry x, y, z. Coordinates: axial component, sqrt(2) times the lateral one.
 */
hypofab_status hypofab_subspace_axisymmetric(int axis, hypofab_subspace *space);

/**
 * @brief The plane that two tensors span.
 * @param first  tensor of any length; the first basis tensor is along it
 * @param second tensor of any length, not parallel to the first; the second basis tensor is what is left of it after
 * that
 */
hypofab_status hypofab_subspace_plane(const double first[6], const double second[6], hypofab_subspace *space);

/**
 * @brief The space of tensors with given principal directions; coordinates are the principal values.
 * @param axes of this tensor, the basis in the order of its principal values, lowest first; NULL: x, y, z
 */
hypofab_status hypofab_subspace_principal(const double axes[6], hypofab_subspace *space);

/** All six components; coordinates xx, yy, zz, sqrt(2) xy, sqrt(2) xz, sqrt(2) yz. */
void hypofab_subspace_all(hypofab_subspace *space);

/** Coordinates of a tensor's projection on a space: `dimension` numbers. */
void hypofab_subspace_coordinates(const hypofab_subspace *space, const double tensor[6], double *coordinates);

/**
 * @brief Evenly distributed directions of a space: unit tensors.
 *
 * Plane: angles 360 deg k/n from the first basis tensor to the second. Three dimensions: zones of equal area around
 * the hydrostatic axis (Leopardi 2006), from -(1,1,1)/sqrt(3) to +(1,1,1)/sqrt(3), both included. Six: pairs of
 * opposite directions, one of each from a Sobol sequence made normal.
 * @param n          1 or more; 5 or more in three dimensions; even in six
 * @param directions n entries, filled
 */
hypofab_status hypofab_directions(const hypofab_subspace *space, int n, double (*directions)[6]);

/**
 * @brief The closed surface of triangles on the n directions that hypofab_directions gives in three dimensions.
 * @param triangles 2 n - 4 entries, filled with indices of directions, counter-clockwise seen from outside
 */
hypofab_status hypofab_directions_triangles(int n, int (*triangles)[3]);

/** What a probe imposes. */
typedef enum hypofab_imposed { HYPOFAB_IMPOSE_STRAIN = 0, HYPOFAB_IMPOSE_STRESS = 1 } hypofab_imposed;

/** What to probe with. Zero in a field takes its default. */
typedef struct hypofab_probe_options {
  hypofab_imposed imposed; /**< strain (default) or stress */
  double size;             /**< 0: rates; > 0: increments of this Frobenius norm [-, or stress], straight and even */
  int unload;              /**< non-zero: then back by the same increment. For rates: the limit of small increments */
  double tolerance;        /**< relative tolerance of finite probes; default 1e-9 */
  int threads;             /**< OpenMP threads for finite probes; 0 or 1: none */
} hypofab_probe_options;

/** One probe and what answers it, per unit of what is imposed. NaN where the status is not 0. */
typedef struct hypofab_answer {
  double direction[6];     /**< unit tensor: of the strain (rate), or of the stress (rate) */
  double response[6];      /**< stress answer [stress], or strain answer [1/stress] */
  double irrecoverable[6]; /**< what of the response is left after unloading; NaN without unloading */
  hypofab_status status;   /**< 0, or why this probe has no answer, e.g. HYPOFAB_NOT_CONTROLLABLE beyond a peak */
} hypofab_answer;

/**
 * @brief Probe one state in many directions; every probe starts from it anew.
 * @param material   parameters
 * @param state      the state probed
 * @param options    NULL for strain rates
 * @param n          number of probes
 * @param directions n tensors of any length > 0
 * @param progress   NULL, or called from time to time with what = "probes"
 * @param user       handed to progress
 * @param answers    n entries, filled; a probe without answer keeps its status, the others are computed all the same
 * @return the status of the first probe without answer; HYPOFAB_INTERRUPTED when progress asked to stop (the rest has
 *         that status); from 100 on nothing is computed
 */
hypofab_status hypofab_probe_run(const hypofab_material *material, const hypofab_state *state,
                                 const hypofab_probe_options *options, int n, const double (*directions)[6],
                                 hypofab_progress progress, void *user, hypofab_answer *answers);

/** What follows from one answer. NaN where it is not defined. */
typedef struct hypofab_probe_measures {
  double stiffness;       /**< stress over strain, by norms, in this direction [stress] */
  double work;            /**< second-order work: cosine between stress and strain increment [-] */
  double dilatancy;       /**< of the flow: eps_v/eps_q, or p/q of its stress (tension positive) [-] */
  double angle_to_stress; /**< between deviators of flow and stress [deg] */
  double angle_to_delta;  /**< between deviators of flow and intergranular strain [deg] */
} hypofab_probe_measures;

/**
 * @brief Directional stiffness and flow direction of one answer.
 *
 * The flow is the irrecoverable part where the probe was unloaded, else the whole response.
 */
void hypofab_probe_measure(hypofab_imposed imposed, const hypofab_material *material, const hypofab_state *state,
                           const hypofab_answer *answer, hypofab_probe_measures *measures);

/** The ellipsoid (in a plane: ellipse) that is nearest to an envelope. */
typedef struct hypofab_ellipsoid {
  int dimension;       /**< of the space of directions */
  int points;          /**< answers used: those with status 0 */
  double centre[6];    /**< tensor, unit of the response */
  double semi_axis[6]; /**< `dimension` lengths, largest first */
  double axis[6][6];   /**< their directions: unit tensors */
  double distance;     /**< of the points from the ellipsoid: root mean square over that of the points [-] */
  double nonlinearity; /**< the same from the best centred ellipsoid: 0 for an incrementally linear material [-] */
  double direction[6]; /**< unit tensor along which the points scatter most about the origin */
  double straightness; /**< share of their mean square along it; 1: the envelope is a straight line [-] */
} hypofab_ellipsoid;

/** Which tensor of an answer makes the envelope. */
typedef enum hypofab_envelope_part { HYPOFAB_RESPONSE = 0, HYPOFAB_IRRECOVERABLE = 1 } hypofab_envelope_part;

/**
 * @brief Fit an ellipsoid to the answers of evenly distributed probes.
 *
 * Least squares of response = A direction + centre: the ellipsoid is the image of the unit sphere of directions. An
 * incrementally linear material answers with centre = 0 and no distance; the plain model's strain-rate envelope,
 * L:D + N |D|, is an ellipsoid around N.
 * @param distances n entries, filled with each point's distance from the ellipsoid in the unit of the response (NaN
 *        for failed probes), unless NULL
 * @return HYPOFAB_BAD_ARGUMENT when fewer answers than unknowns are left or the directions do not span the space
 */
hypofab_status hypofab_probe_fit(const hypofab_subspace *space, int n, const hypofab_answer *answers,
                                 hypofab_envelope_part part, hypofab_ellipsoid *ellipsoid, double *distances);

/* ----------------------------------------------------------------- stability */

/** Stability of a state, over all strain rates and all planes (docs/stability.md). */
typedef struct hypofab_stability {
  double work;       /**< smallest second-order work Tdot:D over |D| = 1 [stress]; > 0: stable (Hill 1958) */
  double work_ratio; /**< the same over that of the state without memory (plain: over that of L): 1 for delta = 0 */
  double work_direction[6];   /**< the D that has it, |D| = 1 */
  hypofab_branch work_branch; /**< the branch this D is on */
  double acoustic;            /**< smallest determinant of the acoustic tensor over all planes and branches [stress^3];
                                   <= 0: a band can form (Rudnicki & Rice 1975) */
  double acoustic_ratio;      /**< the same over the determinant on this plane without memory (plain: of L) */
  hypofab_branch acoustic_branch; /**< the branch it belongs to */
  double band_normal[3];          /**< unit normal of that plane; its largest component is positive */
  double band_mode[3];   /**< unit relative velocity of its sides, in the sense in which the stress drives it */
  double band_angle;     /**< between normal and most compressive principal stress [deg]: the inclination of the
                              band to the plane this stress acts on; NaN for isotropic stress */
  double band_dilatancy; /**< asin(mode.normal) [deg], > 0: the band dilates */
  double bound;          /**< |L^-1 N| of the model without intergranular strain; 1 on its bound surface */
} hypofab_stability;

/** Measures of stability of a state. Errors as hypofab_state_check. */
hypofab_status hypofab_stability_state(const hypofab_material *material, const hypofab_state *state,
                                       hypofab_stability *result);

/** Stability of the path that a step prescribes at a state. */
typedef struct hypofab_control_stability {
  hypofab_branch branch; /**< the branch of the path */
  double work;           /**< second-order work Tdot:D/|D|^2 along the path [stress] */
  double work_cosine;    /**< Tdot:D/(|Tdot||D|), -1 to 1 */
  double determinant;    /**< of the six conditions, over that without memory (plain: of L): 1 for delta = 0, 0 where
                              controllability is lost */
  double condition;      /**< condition number of the six conditions, rows scaled */
} hypofab_control_stability;

/**
 * @brief Measures of stability of what a step does at a state; only the conditions of the step matter.
 * @return HYPOFAB_NOT_CONTROLLABLE, HYPOFAB_NOT_UNIQUE or HYPOFAB_OUT_OF_DOMAIN where the path has no strain rate
 */
hypofab_status hypofab_stability_control(const hypofab_material *material, const hypofab_state *state,
                                         const hypofab_step *step, hypofab_control_stability *result);

HYPOFAB_END

#endif
