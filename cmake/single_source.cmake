# Write modules, in the order given, as one Fortran file for a host whose users compile the model themselves.
#   cmake -DSOURCES="a.f90;b.f90" -DHOST=abaqus -DVERSION=1.2.3 -DOUTPUT=file -P single_source.cmake
# Changed on the way: included files stand in place of the lines that include them; the choice of precision is made; and for
# Abaqus the modules' own symbols umat_ and vumat_ make room for those that the user's compiler gives to the external
# procedures of umat/hosts/abaqus.f90.
string(CONCAT text "!DIR$ FREEFORM\n" "! hypofab ${VERSION}: hypoplasticity of sand with intergranular strain, for ${HOST}.\n"
              "! Generated from the folder umat of hypofab, where corrections belong. How to use it: docs/${HOST}.md.\n")
include(${CMAKE_CURRENT_LIST_DIR}/../umat/lanes/inline.cmake)
foreach(source IN LISTS SOURCES)
  file(READ ${source} content)
  inline_includes(content)
  string(REGEX REPLACE "#ifdef HYPOFAB_QUADRUPLE\n.*#else\n(.*)#endif\n" "\\1" content "${content}")
  if(HOST STREQUAL abaqus)
    string(REPLACE "bind(C, name='umat_')" "bind(C, name='hypofab_umat_entry')" content "${content}")
    string(REPLACE "bind(C, name='vumat_')" "bind(C, name='hypofab_vumat_entry')" content "${content}")
  endif()
  string(APPEND text "\n${content}")
endforeach()
if(text MATCHES "\n#|/[*]") # Abaqus runs the file through a preprocessor, to which the latter begins a comment
  message(FATAL_ERROR "a preprocessor line or the beginning of a C comment is in the text for ${OUTPUT}")
endif()
file(WRITE ${OUTPUT} "${text}")
