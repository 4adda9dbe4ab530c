/**
 * @file integrate_method.h
 * @brief What the integrators of SUNDIALS have in common, and the functions in which they differ. For
 * driver/integrate*.c alone.
 */
#ifndef HYPOFAB_DRIVER_INTEGRATE_METHOD_H
#define HYPOFAB_DRIVER_INTEGRATE_METHOD_H

#include <nvector/nvector_serial.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <sundials/sundials_types.h>
#include <sundials/sundials_version.h>

#include "driver/control/control.h"
#include "driver/quantity/state.h"

/** An integrator, as in integrate.h. */
typedef struct integrator integrator;

/** One integrator of SUNDIALS. Functions return its flag: 0 or more for success. */
typedef struct integrator_method {
  /** Start, or start again, at it->y; creates the solver on the first call. */
  int (*start)(integrator *it, double time, double first_step);
  /** One internal step, not beyond stop; it->y and *reached are set. */
  int (*advance)(integrator *it, double stop, double *reached);
  /** Length of the next step, 0 when none is known. */
  double (*next_step)(const integrator *it);
  /** The state at a time inside the last step, from the integrator's own polynomial. NULL: it has none of full order.
   */
  int (*interpolate)(integrator *it, double time, N_Vector state);
  /** The same to a lower order if need be. */
  int (*glimpse)(integrator *it, double time, N_Vector state);
  void (*free)(integrator *it);
} integrator_method;

extern const integrator_method integrator_erk, integrator_cvode, integrator_ida;

struct integrator {
  const integrator_method *method;
  const hypofab_material *material;
  int length; /* of the state as a vector */
  const hypofab_step *step;
  hypofab_branch branch;
  double tolerance;
  long max_steps;  /* in one step of the test */
  long step_count; /* since integrator_new_leg */
  long n_steps, n_evaluations;
  hypofab_status obstacle; /* why the right-hand side last failed */
  int is_fresh;            /* conditions or branch were set since the last start */
  test_state evaluated;    /* where rates were evaluated last, and their `along` */
  double along;
  double before, now; /* the last step of the integrator went from one to the other */
  SUNContext context;
  N_Vector y, absolute;
  void *memory; /* of the solver */
  /* Implicit methods alone. */
  N_Vector rate, inside; /* y', and a place for interpolated states */
  SUNMatrix matrix;
  SUNLinearSolver linear_solver;
  double stiffness; /* scales the residual of IDA [stress] */
};

/** Right-hand side: the rates under the conditions of the step, on the branch of the current segment. */
int integrator_rates(sunrealtype time, N_Vector y, N_Vector ydot, void *it);

/** A context of SUNDIALS that prints nothing; 0 for success. */
int integrator_context(SUNContext *context);

/** Components below these are integrated to an absolute error of tolerance times these; filled, times the tolerance. */
void integrator_absolute(const hypofab_material *material, double tolerance, const test_state *state,
                         test_state *absolute);

/** Create the dense linear solver of an implicit method; 0 for success. */
int integrator_create_linear_solver(integrator *it);

#if SUNDIALS_VERSION_MAJOR < 7
/** An error handler that keeps quiet: errors come back as return values; a library does not print. */
void integrator_say_nothing(int code, const char *module, const char *function, char *message, void *user);
#endif

#endif
