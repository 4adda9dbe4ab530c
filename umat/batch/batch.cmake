# Many points side by side: batch/batch_begin.F90 and others once per instruction set, a choice between them at run time, OpenMP on request.
find_package(OpenMP COMPONENTS C)

# Sets hypofab_batch_objects for the libraries, and hypofab_batch_x86 where instruction sets of x86 are in.
set(hypofab_batch_objects)
add_library(hypofab_batch_lanes OBJECT batch/batch_lanes.f90)
target_link_libraries(hypofab_batch_lanes PRIVATE hypofab_flags)

# The vectoriser selects where Fortran branches only if selecting traps no exception; parentheses cost it nothing to keep,
# but it does not look through them.
set(kernel_options $<$<CONFIG:Release,RelWithDebInfo,MinSizeRel>:-O3> -fno-trapping-math -fno-protect-parens -fno-tree-pre
                   -Wno-unused-function)

# add_kernel(NAME OPTION...): the kernel as the modules umat_batch_begin_NAME, umat_batch_path_NAME, ...
set(kernel_parts begin path reach rate linear short errors step)
function(add_kernel name)
  add_library(hypofab_batch_${name} OBJECT)
  foreach(part ${kernel_parts})
    target_sources(hypofab_batch_${name} PRIVATE batch/batch_${part}.F90)
    string(TOUPPER ${part} macro)
    target_compile_definitions(hypofab_batch_${name} PRIVATE HYPOFAB_BATCH_${macro}=umat_batch_${part}_${name})
  endforeach()
  target_compile_options(hypofab_batch_${name} PRIVATE ${kernel_options} ${ARGN})
  target_link_libraries(hypofab_batch_${name} PRIVATE hypofab_flags)
  list(APPEND hypofab_batch_objects $<TARGET_OBJECTS:hypofab_batch_${name}>)
  set(hypofab_batch_objects ${hypofab_batch_objects} PARENT_SCOPE)
endfunction()

add_library(hypofab_batch OBJECT batch/batch.F90)
target_link_libraries(hypofab_batch PRIVATE hypofab_flags)
add_kernel(portable)
set(kernels hypofab_batch_portable)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$" AND CMAKE_Fortran_COMPILER_ID STREQUAL "GNU")
  add_kernel(avx2 -mavx2 -mfma)
  add_kernel(avx512 -mavx512f -mavx512dq -mavx512vl -mavx2 -mfma -mprefer-vector-width=512)
  list(APPEND kernels hypofab_batch_avx2 hypofab_batch_avx512)
  target_compile_definitions(hypofab_batch PRIVATE HYPOFAB_BATCH_X86)
  set(hypofab_batch_x86 TRUE)
endif()

target_link_libraries(hypofab_batch_lanes PRIVATE hypofab_model)
foreach(kernel ${kernels})
  target_link_libraries(${kernel} PRIVATE hypofab_model hypofab_batch_lanes)
endforeach()
target_link_libraries(hypofab_batch PRIVATE hypofab_model hypofab_batch_lanes ${kernels})
# CMake does not see that a part uses modules of another target: rebuild it when their sources change.
set(used batch/batch_lanes.f90 algebra/kinds.F90 algebra/status.f90 sand/material.f90 algebra/lobatto.f90 memory/delta_path.f90 sand/border.f90 sand/wolffersdorff.f90 increment/step.f90
         increment/integration.f90 memory/from_zero.f90 increment/short_leg.f90)
list(TRANSFORM used PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
set(kernel_sources ${kernel_parts})
list(TRANSFORM kernel_sources REPLACE "(.+)" "${CMAKE_CURRENT_SOURCE_DIR}/batch/batch_\\1.F90")
set_source_files_properties(${kernel_sources} PROPERTIES OBJECT_DEPENDS
                                                         "${used};${CMAKE_CURRENT_SOURCE_DIR}/batch/batch_series.inc")
list(APPEND used ${kernel_sources} ${CMAKE_CURRENT_SOURCE_DIR}/memory/rate.f90
     ${CMAKE_CURRENT_SOURCE_DIR}/increment/update.f90)
set_source_files_properties(batch/batch.F90 PROPERTIES OBJECT_DEPENDS "${used}")
set_source_files_properties(batch/batch_block.F90 hosts/vumat.f90 PROPERTIES OBJECT_DEPENDS "${used};${CMAKE_CURRENT_SOURCE_DIR}/batch/batch.F90;${CMAKE_CURRENT_SOURCE_DIR}/hosts/host_state.f90")
foreach(part hypofab_batch_lanes ${kernels} hypofab_batch)
  set_target_properties(${part} PROPERTIES Fortran_MODULE_DIRECTORY ${CMAKE_BINARY_DIR}/modules)
endforeach()

list(APPEND hypofab_batch_objects $<TARGET_OBJECTS:hypofab_batch_lanes> $<TARGET_OBJECTS:hypofab_batch>)
