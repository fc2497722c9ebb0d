# Installation: find_package(geovor) gives geovor::geovor (every room of the library) and each room by its own name;
# the component occ_adapter gives geovor::occ_adapter, which needs OpenCASCADE.
include(CMakePackageConfigHelpers)

get_property(rooms GLOBAL PROPERTY GEOVOR_ROOMS)
list(REMOVE_ITEM rooms geovor_occ_adapter)

add_library(geovor_all INTERFACE)
add_library(geovor::geovor ALIAS geovor_all)
set_target_properties(geovor_all PROPERTIES EXPORT_NAME geovor)
target_link_libraries(geovor_all INTERFACE ${rooms})

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/geovor)
install(TARGETS ${rooms} geovor_all EXPORT geovorTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT geovorTargets NAMESPACE geovor:: DESTINATION ${package_dir})
install(DIRECTORY src/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/geovor FILES_MATCHING PATTERN "*.h")

if(WITH_OCC)
  install(TARGETS geovor_occ_adapter EXPORT geovorOccAdapterTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT geovorOccAdapterTargets NAMESPACE geovor:: DESTINATION ${package_dir})
  # Its other headers name OpenCASCADE's and are its own affair.
  install(FILES occ_adapter/read_cad.h occ_adapter/write_step.h
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/geovor/occ_adapter)
endif()

configure_package_config_file(cmake/geovorConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/geovorConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
# Below 1.0 every minor version may break its users.
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/geovorConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/geovorConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/geovorConfigVersion.cmake
        DESTINATION ${package_dir})
install(FILES LICENSE README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
