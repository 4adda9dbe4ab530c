/**
 * @file generic.c
 * @brief What the behaviour "hypofab" is, for hosts that load it through MGIS: symbols only, read by dlsym.
 *
 * The names are those of the "generic" interface of MFront (api version 1): `<behaviour>_<property>`. The calls are in
 * generic.f90. Lists that follow from others elsewhere: material properties from PROPS (material.f90), internal
 * state variables from STATEV (host_state.f90).
 */

/* Types of variables in that interface. */
enum { SCALAR = 0, SYMMETRIC_TENSOR = 1 };

typedef const char *const name;
typedef const unsigned short number;

/* A symbol is declared before it is defined, since no other C file sees it. */
#define COUNT_OF(list) (sizeof(list) / sizeof *(list))
#define TEXT(symbol, value) \
  extern name symbol;       \
  name symbol = value
#define NUMBER(symbol, value) \
  extern number symbol;       \
  number symbol = value
#define NAMES(list, ...) \
  extern name list[];    \
  name list[] = {__VA_ARGS__}
#define TYPES(list, ...)   \
  extern const int list[]; \
  const int list[] = {__VA_ARGS__}
#define NONE(property)                   \
  NUMBER(hypofab_n##property, 0);        \
  extern name *const hypofab_##property; \
  name *const hypofab_##property = (void *)0

/* What it is and where it is from. */
NUMBER(hypofab_mfront_mkt, 1); /* a behaviour, not a material property or a model */
TEXT(hypofab_mfront_interface, "Generic");
NUMBER(hypofab_api_version, 1);
TEXT(hypofab_tfel_version, "4.2.0"); /* the release whose interface this follows */
TEXT(hypofab_unit_system, "");       /* any consistent units */
TEXT(hypofab_src, "hypofab");
TEXT(hypofab_author, "hypofab");
TEXT(hypofab_date, "");
TEXT(hypofab_validator, "");
TEXT(hypofab_build_id, "");

NUMBER(hypofab_BehaviourType, 1);      /* strain based */
NUMBER(hypofab_BehaviourKinematic, 1); /* small strain */
NUMBER(hypofab_SymmetryType, 0);       /* no axes of its own: anisotropy is in delta */
NUMBER(hypofab_ElasticSymmetryType, 0);
NUMBER(hypofab_UsableInPurelyImplicitResolution, 1);
NUMBER(hypofab_requiresStiffnessTensor, 0);
NUMBER(hypofab_requiresThermalExpansionCoefficientTensor, 0);
NUMBER(hypofab_ComputesInternalEnergy, 0);
NUMBER(hypofab_ComputesDissipatedEnergy, 0);
NUMBER(hypofab_TemperatureRemovedFromExternalStateVariables, 1); /* hosts pass a temperature; it is not read */

NAMES(hypofab_ModellingHypotheses, "Tridimensional", "PlaneStrain", "Axisymmetrical", "GeneralisedPlaneStrain",
      "AxisymmetricalGeneralisedPlaneStrain");
NUMBER(hypofab_nModellingHypotheses, COUNT_OF(hypofab_ModellingHypotheses));

/* Strain in, stress out, and the derivative of the one with respect to the other. */
NAMES(hypofab_Gradients, "Strain");
TYPES(hypofab_GradientsTypes, SYMMETRIC_TENSOR);
NUMBER(hypofab_nGradients, COUNT_OF(hypofab_Gradients));
NAMES(hypofab_ThermodynamicForces, "Stress");
TYPES(hypofab_ThermodynamicForcesTypes, SYMMETRIC_TENSOR);
NUMBER(hypofab_nThermodynamicForces, COUNT_OF(hypofab_ThermodynamicForces));
NAMES(hypofab_TangentOperatorBlocks, "Stress", "Strain");
NUMBER(hypofab_nTangentOperatorBlocks, COUNT_OF(hypofab_TangentOperatorBlocks));

/* PROPS(1..16). */
NAMES(hypofab_MaterialProperties, "phi_c", "p_t", "h_s", "n", "e_d0", "e_c0", "e_i0", "alpha", "beta", "m_R", "m_T",
      "R", "beta_r", "chi", "K_w", "e_0");
NUMBER(hypofab_nMaterialProperties, COUNT_OF(hypofab_MaterialProperties));

/* delta, then STATEV(7..13). A void ratio of zero is replaced by that of e_0. */
NAMES(hypofab_InternalStateVariables, "IntergranularStrain", "VoidRatio", "PorePressure", "MeanEffectiveStress",
      "RateEvaluations", "MobilisedFrictionAngle", "IntergranularStrainMobilisation", "Substep");
TYPES(hypofab_InternalStateVariablesTypes, SYMMETRIC_TENSOR, SCALAR, SCALAR, SCALAR, SCALAR, SCALAR, SCALAR, SCALAR);
NUMBER(hypofab_nInternalStateVariables, COUNT_OF(hypofab_InternalStateVariables));

NONE(ExternalStateVariables);
TYPES(hypofab_ExternalStateVariablesTypes, SCALAR); /* not read */
NONE(Parameters);
TYPES(hypofab_ParametersTypes, SCALAR); /* not read */
NONE(InitializeFunctions);
NONE(PostProcessings);
