# Write the one Fortran file for Abaqus: the modules in the order given, then umat/abaqus.f90.
#   cmake -DSOURCES="a.f90;b.f90" -DENTRIES=abaqus.f90 -DVERSION=1.2.3 -DOUTPUT=file -P abaqus_source.cmake
# Changed on the way: the choice of precision is made, and the modules' own symbols umat_ and vumat_ make room for those
# that the user's compiler gives to the external procedures.
string(
  CONCAT text #
         "!DIR$ FREEFORM\n" #
         "! hypofab ${VERSION}: UMAT and VUMAT for hypoplasticity of sand with intergranular strain.\n"
         "! Generated from the folder umat of hypofab, where corrections belong. How to use it: docs/abaqus.md.\n")
foreach(source IN LISTS SOURCES ENTRIES)
  file(READ ${source} content)
  string(REGEX REPLACE "#ifdef HYPOFAB_QUADRUPLE\n.*#else\n(.*)#endif\n" "\\1" content "${content}")
  string(REPLACE "bind(C, name='umat_')" "bind(C, name='hypofab_umat_entry')" content "${content}")
  string(REPLACE "bind(C, name='vumat_')" "bind(C, name='hypofab_vumat_entry')" content "${content}")
  string(APPEND text "\n${content}")
endforeach()
if(text MATCHES "\n#|/[*]") # Abaqus runs the file through a preprocessor, to which the latter begins a comment
  message(FATAL_ERROR "a preprocessor line or the beginning of a C comment is in the text for ${OUTPUT}")
endif()
foreach(label hypofab_umat_entry hypofab_vumat_entry)
  if(NOT text MATCHES "${label}")
    message(FATAL_ERROR "the entry for ${label} was not found")
  endif()
endforeach()
file(WRITE ${OUTPUT} "${text}")
