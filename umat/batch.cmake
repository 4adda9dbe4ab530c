# Many points side by side: batch_begin.F90 and others once per instruction set, a choice between them at run time, OpenMP on request.
find_package(OpenMP COMPONENTS C)

add_library(hypofab_batch_lanes OBJECT batch_lanes.f90)
target_link_libraries(hypofab_batch_lanes PRIVATE hypofab_flags)

# The vectoriser selects where Fortran branches only if selecting traps no exception; parentheses cost it nothing to keep,
# but it does not look through them.
set(kernel_options $<$<CONFIG:Release,RelWithDebInfo,MinSizeRel>:-O3> -fno-trapping-math -fno-protect-parens -fno-tree-pre
                   -Wno-unused-function)

# add_kernel(NAME OPTION...): the kernel as the modules umat_batch_begin_NAME, umat_batch_path_NAME, ...
set(kernel_parts begin path rate step)
function(add_kernel name)
  add_library(hypofab_batch_${name} OBJECT)
  foreach(part ${kernel_parts})
    target_sources(hypofab_batch_${name} PRIVATE batch_${part}.F90)
    string(TOUPPER ${part} macro)
    target_compile_definitions(hypofab_batch_${name} PRIVATE HYPOFAB_BATCH_${macro}=umat_batch_${part}_${name})
  endforeach()
  target_compile_options(hypofab_batch_${name} PRIVATE ${kernel_options} ${ARGN})
  target_link_libraries(hypofab_batch_${name} PRIVATE hypofab_flags)
  target_sources(hypofab PRIVATE $<TARGET_OBJECTS:hypofab_batch_${name}>)
endfunction()

add_library(hypofab_batch OBJECT batch.F90)
target_link_libraries(hypofab_batch PRIVATE hypofab_flags)
add_kernel(portable)
set(kernels hypofab_batch_portable)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$" AND CMAKE_Fortran_COMPILER_ID STREQUAL "GNU")
  add_kernel(avx2 -mavx2 -mfma)
  add_kernel(avx512 -mavx512f -mavx512dq -mavx512vl -mavx2 -mfma -mprefer-vector-width=512)
  list(APPEND kernels hypofab_batch_avx2 hypofab_batch_avx512)
  target_compile_definitions(hypofab_batch PRIVATE HYPOFAB_BATCH_X86)
  target_compile_definitions(hypofab PRIVATE HYPOFAB_BATCH_X86)
endif()

target_link_libraries(hypofab_batch_lanes PRIVATE hypofab_model)
foreach(kernel ${kernels})
  target_link_libraries(${kernel} PRIVATE hypofab_model hypofab_batch_lanes)
endforeach()
target_link_libraries(hypofab_batch PRIVATE hypofab_model hypofab_batch_lanes ${kernels})
# CMake does not see that a part uses modules of another target: rebuild it when their sources change.
set(used batch_lanes.f90 kinds.F90 status.f90 material.f90 tableau.f90)
list(TRANSFORM used PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
set(kernel_sources ${kernel_parts})
list(TRANSFORM kernel_sources REPLACE "(.+)" "${CMAKE_CURRENT_SOURCE_DIR}/batch_\\1.F90")
set_source_files_properties(${kernel_sources} PROPERTIES OBJECT_DEPENDS
                                                         "${used};${CMAKE_CURRENT_SOURCE_DIR}/batch_series.inc")
list(APPEND used ${kernel_sources} ${CMAKE_CURRENT_SOURCE_DIR}/rate.f90
     ${CMAKE_CURRENT_SOURCE_DIR}/update.f90)
set_source_files_properties(batch.F90 PROPERTIES OBJECT_DEPENDS "${used}")
foreach(part hypofab_batch_lanes ${kernels} hypofab_batch)
  set_target_properties(${part} PROPERTIES Fortran_MODULE_DIRECTORY ${CMAKE_BINARY_DIR}/modules)
endforeach()

target_sources(hypofab PRIVATE $<TARGET_OBJECTS:hypofab_batch_lanes> $<TARGET_OBJECTS:hypofab_batch> batch.c)
if(OpenMP_C_FOUND)
  target_link_libraries(hypofab PRIVATE OpenMP::OpenMP_C)
endif()
