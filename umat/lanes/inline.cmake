# inline_includes(VARIABLE): the files of this folder that a Fortran text includes, in place of the lines that include them.
function(inline_includes variable)
  set(result "${${variable}}")
  foreach(name IN ITEMS series tail)
    file(READ ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/${name}.inc included)
    string(REPLACE "  include '${name}.inc'\n" "${included}" result "${result}")
  endforeach()
  set(${variable} "${result}" PARENT_SCOPE)
endfunction()
