# A part of the kernels under the names of an instruction set, or, for one lane, `single`: `portable` in the names of its
# modules gives way.
#   cmake -DSOURCE=step.f90 -DINSTRUCTIONS=avx2 -DOUTPUT=step_avx2.f90 -P kernel.cmake
file(READ ${SOURCE} text)
string(REPLACE "_portable" "_${INSTRUCTIONS}" text "${text}")
if(INSTRUCTIONS STREQUAL "single")
  string(REPLACE "umat_many_lanes" "umat_one_lane" text "${text}")
endif()
include(${CMAKE_CURRENT_LIST_DIR}/inline.cmake)
inline_includes(text)
file(WRITE ${OUTPUT} "! Generated from ${SOURCE}, where corrections belong.\n${text}")
