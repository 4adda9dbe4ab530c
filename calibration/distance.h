/**
 * @file distance.h
 * @brief Distance of a point from a polyline.
 */
#ifndef HYPOFAB_CALIBRATION_DISTANCE_H
#define HYPOFAB_CALIBRATION_DISTANCE_H

#include "hypofab.h"

/** Square of the distance of two points. */
double square_distance(int axes, const double *a, const double *b);

/** The point of a polyline that is nearest to a given one. */
typedef struct foot {
  int segment;                     /**< between vertices `segment` and `segment + 1` */
  double share;                    /**< 0 .. 1 along it */
  int is_end;                      /**< an end of the polyline, beyond which the given point lies */
  double direction[HYPOFAB_N_LAB]; /**< unit vector along the segment */
  double offset[HYPOFAB_N_LAB];    /**< from the foot to the given point */
} foot;

/**
 * @brief The nearest point of the polyline through vertices first .. last.
 * @param vertex all vertices, `axes` coordinates each; last >= first. One vertex is a polyline, too
 */
foot find_foot(int axes, double (*vertex)[HYPOFAB_N_LAB], int first, int last, const double *point);

#endif
