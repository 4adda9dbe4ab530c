# No element of a RUNPATH may be empty: the loader would take libraries of the working folder.
#   cmake -DFILE=library or program -P check_runpath.cmake
execute_process(COMMAND readelf -d ${FILE} OUTPUT_VARIABLE dynamic COMMAND_ERROR_IS_FATAL ANY)
if(NOT dynamic MATCHES "NEEDED")
  message(FATAL_ERROR "${FILE} has no dynamic section")
endif()
if(dynamic MATCHES "R(UN)?PATH[^\n]*\\[(:|[^]\n]*::|[^]\n]*:\\]|\\])")
  message(FATAL_ERROR "${FILE} has an empty element in its RUNPATH:\n${dynamic}")
endif()
