/**
 * @file hypofab_fabric.h
 * @brief Part of hypofab.h: contact lists, their fabric, and the intergranular strain that follows
 * (docs/fabric2delta.md).
 */
#ifndef HYPOFAB_FABRIC_H
#define HYPOFAB_FABRIC_H

#include "hypofab_status.h"

HYPOFAB_BEGIN

/** Contact fabric of a sample (paper 000, Eqs. 1 to 4). */
typedef struct hypofab_fabric {
  int64_t contacts;                      /**< N_c; 0 when the fabric tensor itself was given */
  int64_t particles;                     /**< N_p; 0 when not known */
  double fabric[6];                      /**< N = (1/N_c) sum n n */
  double deviatoric_fabric[6];           /**< F = 15/2 (N - 1/3 1) */
  double anisotropy;                     /**< a = sqrt(3/2 F:F) */
  double principal_values[3];            /**< of N, largest first */
  double principal_directions[3][3];     /**< row i: unit vector of principal_values[i] */
  double coordination_number;            /**< 2 N_c/N_p; NaN when not known */
  double mechanical_coordination_number; /**< (2 N_c - N_1)/(N_p - N_0 - N_1): without particles that have
                                              fewer than two contacts (Thornton 2000); NaN when not known */
  int64_t rattlers;                      /**< N_0 + N_1, particles with fewer than two contacts; -1 when not known */
} hypofab_fabric;

/** What becomes of contacts that are wrong: not a unit vector, not finite, listed twice, ... */
typedef enum hypofab_treatment {
  HYPOFAB_REFUSE = 0, /**< the file is refused; the message names the first and counts all */
  HYPOFAB_SKIP = 1,   /**< they are left out and counted (hypofab_contact_report) */
  HYPOFAB_KEEP = 2    /**< duplicates only: they are not looked for, and cost no memory */
} hypofab_treatment;

/** What becomes of contacts with walls: particles with a negative id, named as walls, or not in the particle file. */
typedef enum hypofab_walls {
  HYPOFAB_WALLS_UNKNOWN = 0, /**< ids that are negative or not in the particle file are refused as wrong */
  HYPOFAB_WALLS_OUT = 1,     /**< contacts with walls are left out */
  HYPOFAB_WALLS_IN = 2       /**< they count as contacts of their one particle; a wall is no particle */
} hypofab_walls;

/**
 * How a contact file is to be read. NULL or 0 in a field takes its default, so that {0} reads every file that shows
 * its own format (docs/contact_files.md).
 */
typedef struct hypofab_contact_format {
  const char *id1, *id2, *nx, *ny, *nz; /**< column names, or 1-based column numbers as text; default: these names */
  char separator;                       /**< comma, semicolon, tab, blank, or 0: what the first row shows */
  int64_t particles;         /**< N_p; 0: the particle file if given, else the number of different ids in the list */
  const char *particle_file; /**< particle list: one row per particle; column "id" when it has a header */
  const char *kind;    /**< its format, one of hypofab_contact_kind ("table", "lammps", ...); NULL: what it shows */
  const char *columns; /**< more columns: "ROLE=COLUMN,ROLE=COLUMN,..." (docs/contact_files.md) */
  const char *particle_columns; /**< the same for the particle file: id, x, y, z, radius, volume, ax, ay, az */
  int dimension;                /**< 2: disks in the plane x, y, tensors have xx, yy, xy; 0 or 3: spheres */
  int has_timestep;             /**< whether `timestep` is given */
  int64_t timestep;             /**< which one, of a dump with several */
  int from_2_to_1;              /**< normals and branches of a table point from particle 2 to particle 1 */
  int force_on_1;               /**< forces of a table act on particle 1 */
  int normalise;                /**< normals of any length are taken */
  hypofab_treatment wrong;      /**< of wrong contacts: refuse or skip */
  hypofab_treatment duplicates; /**< of contacts listed twice: refuse, skip (keep one) or keep */
  int duplicate_memory;         /**< MiB for finding them; 0: 32, enough to look at every pair of 3 million */
  hypofab_walls walls;
  const char *wall_ids;      /**< ids of walls: "0-5,17" */
  double cell[3];            /**< lengths of the periodic cell; 0: not periodic, or told by the file [length] */
  double volume;             /**< of the sample, for the void ratio; 0: of the cell, or told by the file [length^3] */
  int has_box;               /**< only contacts inside a box */
  double box[6];             /**< x, y, z from, x, y, z to [length] */
  int has_sphere;            /**< only contacts inside a sphere */
  double sphere[4];          /**< centre, radius [length] */
  int threads;               /**< that parse the file; 0: as many as are there, up to 4. Results do not depend on it */
  hypofab_progress progress; /**< may be NULL */
  void *progress_user;       /**< handed to it */
} hypofab_contact_format;

/** Kind number index (0-based) of contact files, "lammps", ...; NULL past the last one. */
const char *hypofab_contact_kind(int index);

/** What was found while reading contacts. */
typedef struct hypofab_contact_report {
  int64_t listed;            /**< contacts in the file */
  int64_t used;              /**< of them delivered */
  int64_t not_finite;        /**< left out: NaN or infinity in a column that is read */
  int64_t zero_normals;      /**< left out: a normal without length */
  int64_t not_unit;          /**< left out: a normal whose length differs from 1 by more than 0.001 */
  int64_t with_themselves;   /**< left out: twice the same particle */
  int64_t duplicates;        /**< left out: the same pair of particles and periodic image once more */
  int64_t unknown_ids;       /**< left out: a particle that is not in the particle file, or a negative id */
  int64_t walls;             /**< contacts with walls, left out or used */
  int64_t outside;           /**< left out: outside the box or sphere */
  int64_t second_listings;   /**< left out: listed from the other side too, as the file format has it */
  int64_t duplicates_one_in; /**< duplicates were looked for among one in so many pairs; 0: not at all */
} hypofab_contact_report;

/**
 * @brief Fabric of a contact file, streamed: memory grows with the number of particles, not with that of contacts.
 * @param path   the file: text, NumPy or legacy VTK, plain or compressed by gzip or zstd
 * @param format NULL for the defaults
 * @param fabric filled; of two dimensions when the format says so
 * @return HYPOFAB_BAD_FILE with file, line, column and what was expected in the message
 */
hypofab_status hypofab_fabric_read(const char *path, const hypofab_contact_format *format, hypofab_fabric *fabric);

/** What the fabric needs of the contacts of one or more files. Exact: parts merged in any order give the same bits. */
typedef struct hypofab_fabric_sum hypofab_fabric_sum;

/** What a particle file and the reading tell beside the fabric. */
typedef struct hypofab_sample {
  double volume;       /**< of the sample; in two dimensions an area; NaN when not known [length^3] */
  double solid_volume; /**< of all particles; NaN when the particle file has no radii or volumes [length^3] */
  double void_ratio;   /**< volume/solid_volume - 1, overlaps not taken off; NaN when not known, or with a region */
  hypofab_contact_report report; /**< of all parts together */
} hypofab_sample;

/** Sum a contact file. Arguments and errors as hypofab_fabric_read; *sum is to be freed, and NULL on failure. */
hypofab_status hypofab_fabric_sum_read(const char *path, const hypofab_contact_format *format,
                                       hypofab_fabric_sum **sum);

/**
 * @brief Add the contacts of another part of the same sample.
 *
 * Parts with a particle file must have the same one. Contacts listed in two parts are not found out.
 * @return HYPOFAB_BAD_ARGUMENT when the parts do not belong together; nothing has changed then
 */
hypofab_status hypofab_fabric_sum_merge(hypofab_fabric_sum *sum, const hypofab_fabric_sum *part);

/** Write a sum to a file, to be merged later; whole or not at all. */
hypofab_status hypofab_fabric_sum_write(const hypofab_fabric_sum *sum, const char *path);

/** Read what hypofab_fabric_sum_write has written. */
hypofab_status hypofab_fabric_sum_load(const char *path, hypofab_fabric_sum **sum);

/** Fabric and sample of a sum; sample may be NULL. */
hypofab_status hypofab_fabric_sum_result(const hypofab_fabric_sum *sum, hypofab_fabric *fabric, hypofab_sample *sample);

/** Free a sum; NULL is allowed. */
void hypofab_fabric_sum_free(hypofab_fabric_sum *sum);

/** Fabric from a given fabric tensor N (trace 1 within 0.02, positive semi-definite). */
hypofab_status hypofab_fabric_from_tensor(const double N[6], hypofab_fabric *fabric);

/** Initial intergranular strain of a fabric (paper 000, Eqs. 6 and 7). */
typedef struct hypofab_initial_delta {
  double weight;             /**< f(a), 1 - exp(-a/c) unless another weight function was chosen */
  double weighted_fabric[6]; /**< A = (1 - f) 1 + f F */
  double delta[6];           /**< R A/|A| */
} hypofab_initial_delta;

/**
 * @brief Map a fabric to the initial intergranular strain.
 * @param R  size of the elastic strain range, > 0
 * @param c  parameter of the weight function, > 0 (0.05 in paper 000)
 */
hypofab_status hypofab_fabric_to_delta(const hypofab_fabric *fabric, double R, double c, hypofab_initial_delta *result);

/** Name of weight function number index (0-based), "exponential" first; NULL past the last one. */
const char *hypofab_weight_name(int index);

/** Its formula, e.g. "1 - exp(-a/c)"; NULL past the last one. */
const char *hypofab_weight_formula(int index);

/**
 * @brief Map a fabric to the initial intergranular strain with a chosen weight function.
 * @param weight its name; NULL: "exponential", that of paper 000. All have f(0) = 0, the slope 1/c there, and the
 * limit 1.
 */
hypofab_status hypofab_fabric_to_delta_weighted(const hypofab_fabric *fabric, double R, double c, const char *weight,
                                                hypofab_initial_delta *result);

/**
 * @brief A fabric in other axes: F, principal directions and all that follows from it turn along, counts stay.
 * @param rotation row i is the new axis i in the old axes; orthonormal within 1e-6 (a mirror image is allowed)
 * @param turned   filled; may be `fabric`
 */
hypofab_status hypofab_fabric_rotate(const hypofab_fabric *fabric, const double rotation[3][3], hypofab_fabric *turned);

HYPOFAB_END

#endif
