# The optimised library must call the vector forms of exp and log for every instruction set that the kernel has; a loop that
# the compiler no longer vectorises calls the scalar ones instead. cmake -DLIBRARY=libhypofab_umat.so -P check_vectorised.cmake
execute_process(COMMAND nm -D --undefined-only ${LIBRARY} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
foreach(function IN ITEMS _ZGVbN2v_exp _ZGVbN2v_log _ZGVdN4v_exp _ZGVdN4v_log _ZGVeN8v_exp _ZGVeN8v_log)
  if(NOT symbols MATCHES "${function}")
    message(FATAL_ERROR "${LIBRARY} does not use ${function}: the kernel (umat/batch) is not vectorised")
  endif()
endforeach()
