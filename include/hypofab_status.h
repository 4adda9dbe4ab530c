/**
 * @file hypofab_status.h
 * @brief Part of hypofab.h: outcome of a call, its message and its subject. Every other part includes this one.
 */
#ifndef HYPOFAB_STATUS_H
#define HYPOFAB_STATUS_H

#include <stddef.h>
#include <stdint.h>

/* Around the declarations of every part: C names for C++, and what a library that hides its symbols shows. */
#ifdef __cplusplus
#define HYPOFAB_LANGUAGE_BEGIN extern "C" {
#define HYPOFAB_LANGUAGE_END }
#else
#define HYPOFAB_LANGUAGE_BEGIN
#define HYPOFAB_LANGUAGE_END
#endif
#if defined(__GNUC__)
#define HYPOFAB_BEGIN HYPOFAB_LANGUAGE_BEGIN _Pragma("GCC visibility push(default)")
#define HYPOFAB_END _Pragma("GCC visibility pop") HYPOFAB_LANGUAGE_END
#else
#define HYPOFAB_BEGIN HYPOFAB_LANGUAGE_BEGIN
#define HYPOFAB_END HYPOFAB_LANGUAGE_END
#endif

HYPOFAB_BEGIN

/* -------------------------------------------------------------------- status */

/** Outcome of a call. 1..99: a physical finding; 100..199: bad input; 200..: internal error. */
typedef enum hypofab_status {
  HYPOFAB_OK = 0,
  HYPOFAB_NOT_CONTROLLABLE = 1,   /**< no strain rate satisfies the prescribed rates (peak, limit point) */
  HYPOFAB_NOT_UNIQUE = 2,         /**< two strain rates satisfy the prescribed rates */
  HYPOFAB_OUT_OF_DOMAIN = 3,      /**< a principal stress became tensile or zero, or void ratio left (0, inf) */
  HYPOFAB_STEP_LIMIT = 4,         /**< the bound on work (rate evaluations, integrator steps) was reached */
  HYPOFAB_TARGET_NOT_REACHED = 5, /**< a step ran its maximum time without meeting its end condition */
  HYPOFAB_INTERRUPTED = 6,        /**< the caller's callback asked to stop */
  HYPOFAB_LIQUEFACTION = 7,       /**< the mean effective stress vanished in an undrained step */
  HYPOFAB_BAD_MATERIAL = 100,     /**< a parameter is outside its admissible range, or unknown */
  HYPOFAB_BAD_STATE = 101,        /**< a state is outside the model's domain, or not finite */
  HYPOFAB_BAD_ARGUMENT = 102,     /**< another argument is wrong */
  HYPOFAB_BAD_FILE = 103,         /**< a file cannot be read, or its content is wrong */
  HYPOFAB_NO_MEMORY = 200,
  HYPOFAB_IO_ERROR = 201, /**< a result file cannot be written */
  HYPOFAB_INTERNAL_ERROR = 202
} hypofab_status;

/** One sentence for a status, e.g. "loss of controllability: ..."; never NULL. */
const char *hypofab_status_text(hypofab_status status);

/** The message of the last failed call in this thread; "" before any failure; never NULL. */
const char *hypofab_last_message(void);

/** What the message of a failed call is about. */
typedef enum hypofab_about {
  HYPOFAB_ABOUT_NOTHING = 0, /**< nothing that has a name */
  HYPOFAB_ABOUT_PARAMETER,   /**< a material parameter: name */
  HYPOFAB_ABOUT_VARIABLE,    /**< stress or a state variable: name */
  HYPOFAB_ABOUT_ARGUMENT,    /**< another argument of the call: name, and index where it is one of several */
  HYPOFAB_ABOUT_CONDITION,   /**< one of the six conditions of a step: index */
  HYPOFAB_ABOUT_STEP,        /**< a step of a test: index; name is the test's where it has one */
  HYPOFAB_ABOUT_KEY,         /**< a key of a deck or a calibration file: name is its path, e.g. "states[0].stress" */
  HYPOFAB_ABOUT_ROW,         /**< a row of a table: index */
  HYPOFAB_ABOUT_COLUMN       /**< a column of a table: name; index: the line of the cell in the file, -1: all of them */
} hypofab_about;

/** The subject of a failure: data for programs; hypofab_last_message() is for people. */
typedef struct hypofab_subject {
  hypofab_about about;
  int64_t index;  /**< 0-based; -1: none */
  char name[128]; /**< "" where there is none; cut if longer */
} hypofab_subject;

/** The subject of the last failed call in this thread; valid until the next failure; never NULL. */
const hypofab_subject *hypofab_last_subject(void);

/** Library version, "major.minor.patch". */
const char *hypofab_version(void);

/** Told how far a long call is: what is being computed and the fraction done. Non-zero asks to stop. */
typedef int (*hypofab_progress)(const char *what, double fraction, void *user);

HYPOFAB_END

#endif
