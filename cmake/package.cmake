# `cmake --install` and find_package(boxwood).
include(CMakePackageConfigHelpers)
get_property(rooms GLOBAL PROPERTY BOXWOOD_ROOMS)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/boxwood)

install(TARGETS boxwood ${rooms} EXPORT boxwood_targets)
install(DIRECTORY include/boxwood DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT boxwood_targets NAMESPACE boxwood:: DESTINATION ${package_dir})
configure_package_config_file(cmake/boxwood-config.cmake.in ${PROJECT_BINARY_DIR}/boxwood-config.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/boxwood-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/boxwood-config.cmake ${PROJECT_BINARY_DIR}/boxwood-config-version.cmake
        DESTINATION ${package_dir})
