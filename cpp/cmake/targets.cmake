# urdd::urdd (shared), urdd::urdd_static, and, where nlohmann-json is found, urdd::types (urdd_types.hpp, without the
# library): of _urdd_include, _urdd_shared and _urdd_static.
find_package(Threads REQUIRED)
if(NOT TARGET urdd::urdd)
  add_library(urdd::urdd SHARED IMPORTED GLOBAL)
  set_target_properties(urdd::urdd PROPERTIES
    IMPORTED_LOCATION "${_urdd_shared}"
    IMPORTED_SONAME "liburdd.so.${URDD_ABI}"
    INTERFACE_COMPILE_FEATURES cxx_std_17
    INTERFACE_INCLUDE_DIRECTORIES "${_urdd_include}")
endif()
# The library may still be to be built, where another project adds this one.
if(NOT TARGET urdd::urdd_static AND (EXISTS "${_urdd_static}" OR TARGET urdd_library))
  add_library(urdd::urdd_static STATIC IMPORTED GLOBAL)
  set_target_properties(urdd::urdd_static PROPERTIES
    IMPORTED_LOCATION "${_urdd_static}"
    INTERFACE_COMPILE_FEATURES cxx_std_17
    INTERFACE_INCLUDE_DIRECTORIES "${_urdd_include}"
    INTERFACE_LINK_LIBRARIES "Threads::Threads;${CMAKE_DL_LIBS};m;gcc_s"
    # What a program does not use is left out of it: a quarter of the size.
    INTERFACE_LINK_OPTIONS "LINKER:--gc-sections")
endif()
find_package(nlohmann_json QUIET)
if(nlohmann_json_FOUND AND NOT TARGET urdd::types)
  add_library(urdd::types INTERFACE IMPORTED GLOBAL)
  set_target_properties(urdd::types PROPERTIES
    INTERFACE_COMPILE_FEATURES cxx_std_17
    INTERFACE_INCLUDE_DIRECTORIES "${_urdd_include}"
    INTERFACE_LINK_LIBRARIES nlohmann_json::nlohmann_json)
endif()
