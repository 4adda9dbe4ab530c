/**
 * @file sphere.h
 * @brief Evenly distributed points on the unit sphere, and the triangles between them.
 */
#ifndef HYPOFAB_DRIVER_SPHERE_H
#define HYPOFAB_DRIVER_SPHERE_H

/** Fewest points: two poles and a ring of three. */
enum { SPHERE_FEWEST = 5 };

/**
 * @brief n points on rings around the third axis, each in a cell of the same area (Leopardi 2006, Electronic
 * Transactions on Numerical Analysis 25, 309-327).
 * @param n      SPHERE_FEWEST or more
 * @param points n entries, filled with unit vectors; the first is (0, 0, -1), the last (0, 0, 1)
 */
void sphere_points(int n, double (*points)[3]);

/**
 * @brief The triangles of the closed surface with these points as corners.
 * @param triangles 2 n - 4 entries, filled; corners counter-clockwise seen from outside
 */
void sphere_triangles(int n, int (*triangles)[3]);

#endif
