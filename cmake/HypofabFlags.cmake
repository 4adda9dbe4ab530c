# Compiler flags of every target of the project, as an interface library that is never exported.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo" FORCE)
endif()

set(CMAKE_C_STANDARD 11)
set(CMAKE_C_STANDARD_REQUIRED ON)

add_library(hypofab_flags INTERFACE)
target_compile_options(
  hypofab_flags
  INTERFACE $<$<COMPILE_LANG_AND_ID:C,GNU,Clang,AppleClang>:-Wall -Wextra>
            # -frecursive: every local variable on the stack, as Fortran 2018 has it; threads call the UMAT at once.
            $<$<COMPILE_LANG_AND_ID:Fortran,GNU>:-std=f2018 -frecursive -fimplicit-none -Wall -Wextra>
            # CMake before 3.28 asks flang for no optimisation; and flang takes temporary arrays from the heap unless told.
            $<$<AND:$<CONFIG:Release,RelWithDebInfo>,$<COMPILE_LANG_AND_ID:Fortran,LLVMFlang>>:-O3$<SEMICOLON>-fstack-arrays>
            # Traps for what the model must never do; the host of a UMAT may run with them.
            $<$<AND:$<CONFIG:Debug>,$<COMPILE_LANG_AND_ID:Fortran,GNU>>:-fcheck=all -ffpe-trap=invalid -fbacktrace>)

if(HYPOFAB_WERROR)
  target_compile_options(hypofab_flags INTERFACE -Werror)
endif()
if(HYPOFAB_NATIVE)
  target_compile_options(hypofab_flags INTERFACE -march=native)
endif()
if(HYPOFAB_SANITIZE)
  target_compile_options(hypofab_flags INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=undefined
                                                 -fno-omit-frame-pointer)
  target_link_options(hypofab_flags INTERFACE -fsanitize=address,undefined)
endif()
