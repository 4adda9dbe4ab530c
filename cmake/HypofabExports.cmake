# What the shared libraries export: their documented names alone, so that two libraries with modules of the same names, such
# as two versions of this one, live in one process, each with its own numbers. For linkers of ELF systems.

# hypofab_export(TARGET NAME...): the library exports these names alone.
function(hypofab_export target)
  if(NOT UNIX OR APPLE)
    return()
  endif()
  list(JOIN ARGN " " names)
  string(REPLACE " " ";\n    " names "${names}")
  set(script ${PROJECT_BINARY_DIR}/${target}.map)
  file(CONFIGURE OUTPUT ${script} CONTENT "{\n  global:\n    ${names};\n  local:\n    *;\n};\n" @ONLY)
  target_link_options(${target} PRIVATE -Wl,--version-script=${script})
  set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS ${script})
endfunction()

# hypofab_names_of_headers(RESULT FOLDER): the functions that headers declare, each at the beginning of a line.
function(hypofab_names_of_headers result folder)
  file(GLOB headers ${folder}/*.h)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${headers})
  set(names)
  foreach(header IN LISTS headers)
    file(STRINGS ${header} lines REGEX "^([a-z][A-Za-z0-9_ ]* \\*?)?hypofab_[A-Za-z0-9_]+\\(")
    foreach(line IN LISTS lines)
      string(REGEX MATCH "hypofab_[A-Za-z0-9_]+\\(" name "${line}")
      string(REPLACE "(" "" name "${name}")
      list(APPEND names ${name})
    endforeach()
  endforeach()
  set(${result} ${names} PARENT_SCOPE)
endfunction()
