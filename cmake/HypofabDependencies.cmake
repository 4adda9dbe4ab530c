# Everything libhypofab links, in one interface library. libhypofab_umat links none of it.
find_package(PkgConfig REQUIRED)
find_package(SUNDIALS 6 REQUIRED CONFIG COMPONENTS arkode cvode ida nvecserial sunlinsoldense) # element tests
find_package(LAPACK REQUIRED) # principal values of fabric tensors
find_package(GSL REQUIRED) # mixed control, roots of events
find_package(ZLIB REQUIRED) # contact lists compressed by gzip
pkg_check_modules(CYAML REQUIRED IMPORTED_TARGET libcyaml) # decks
pkg_check_modules(ZSTD REQUIRED IMPORTED_TARGET libzstd) # contact files compressed by zstd
find_package(Threads REQUIRED) # contact files are parsed by several threads
pkg_check_modules(JANSSON REQUIRED IMPORTED_TARGET jansson) # JSON results

add_library(hypofab_dependencies INTERFACE)
target_link_libraries(
  # GSL before LAPACK: its plain BLAS serves 6x6 systems better than a threaded one that LAPACK may bring along.
  hypofab_dependencies INTERFACE SUNDIALS::arkode SUNDIALS::cvode SUNDIALS::ida SUNDIALS::sunlinsoldense SUNDIALS::nvecserial
                                 GSL::gsl LAPACK::LAPACK ZLIB::ZLIB PkgConfig::ZSTD Threads::Threads PkgConfig::CYAML PkgConfig::JANSSON m)
