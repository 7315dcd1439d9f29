# DSDP 5.8 (Debian: libdsdp-dev) has neither a CMake nor a pkg-config file. The shared library brings its LAPACK along.
find_path(DSDP_INCLUDE_DIR dsdp5.h PATH_SUFFIXES dsdp)
find_library(DSDP_LIBRARY dsdp)
if(NOT DSDP_INCLUDE_DIR OR NOT DSDP_LIBRARY)
  message(FATAL_ERROR "DSDP is not installed: script/install brings it (Debian: libdsdp-dev)")
endif()
add_library(DSDP::DSDP UNKNOWN IMPORTED)
set_target_properties(DSDP::DSDP PROPERTIES IMPORTED_LOCATION ${DSDP_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${DSDP_INCLUDE_DIR})
