# Install rules: libraries, program, headers, pkg-config files and the CMake package `hypofab`.
# Nothing installed holds an absolute path: the tree may be moved after installation.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/hypofab)
set(pkgconfig_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

install(TARGETS hypofab_umat EXPORT hypofab LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
if(HYPOFAB_UMAT_STATIC)
  install(TARGETS hypofab_umat_static EXPORT hypofab ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
endif()
if(NOT HYPOFAB_UMAT_ONLY)
  # The program finds libhypofab beside itself, in the build folder too: CMake's own RUNPATH for that place would have an
  # empty element, by which the system's loader understands the working folder.
  file(RELATIVE_PATH lib_from_bin /${CMAKE_INSTALL_BINDIR} /${CMAKE_INSTALL_LIBDIR})
  set_target_properties(hypofab_cli PROPERTIES INSTALL_RPATH "$ORIGIN/${lib_from_bin}" BUILD_WITH_INSTALL_RPATH ON)
  install(TARGETS hypofab EXPORT hypofab LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(TARGETS hypofab_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  install(
    FILES cli/completion/hypofab.bash
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
    RENAME hypofab)
  install(FILES cli/completion/_hypofab DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
  install(FILES cli/completion/hypofab.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
  install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
endif()

# CMake: find_package(hypofab) gives hypofab::hypofab (C interface) and hypofab::umat (FE hosts; hypofab::umat_static).
install(EXPORT hypofab FILE hypofab-config.cmake NAMESPACE hypofab:: DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/hypofab-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/hypofab-config-version.cmake DESTINATION ${package_dir})

# pkg-config: hypofab and hypofab_umat. The prefix is found from the folder of the .pc file.
file(RELATIVE_PATH prefix_from_pkgconfig /${pkgconfig_dir} /)
string(REGEX REPLACE "/$" "" prefix_from_pkgconfig ${prefix_from_pkgconfig})
function(hypofab_install_pkgconfig name description)
  set(PKGCONFIG_NAME ${name})
  set(PKGCONFIG_DESCRIPTION ${description})
  configure_file(${PROJECT_SOURCE_DIR}/cmake/pkgconfig.pc.in ${PROJECT_BINARY_DIR}/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${pkgconfig_dir})
endfunction()
if(NOT HYPOFAB_UMAT_ONLY)
  hypofab_install_pkgconfig(hypofab ${PROJECT_DESCRIPTION})
endif()
hypofab_install_pkgconfig(hypofab_umat "UMAT of hypofab for finite element hosts")
