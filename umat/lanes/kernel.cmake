# A part of the kernel under the names of an instruction set: `portable` in the names of its modules gives way.
#   cmake -DSOURCE=step.f90 -DINSTRUCTIONS=avx2 -DOUTPUT=step_avx2.f90 -P kernel.cmake
file(READ ${SOURCE} text)
string(REPLACE "_portable" "_${INSTRUCTIONS}" text "${text}")
file(WRITE ${OUTPUT} "! Generated from ${SOURCE}, where corrections belong.\n${text}")
