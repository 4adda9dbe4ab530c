/** @file angle.h @brief The one definition of pi in C, and degrees. */
#ifndef HYPOFAB_BASE_ANGLE_H
#define HYPOFAB_BASE_ANGLE_H

/** The ratio of a circle's circumference to its diameter. */
#define HYPOFAB_PI 3.14159265358979323846

/** Degrees in a radian. */
#define HYPOFAB_DEGREES (180.0 / HYPOFAB_PI)

#endif
