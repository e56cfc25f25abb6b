# `cmake --install` and `find_package(delmesh)`; tests/consumer tries both.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS delmesh EXPORT delmeshTargets)
if(TARGET delmesh_app)
  install(TARGETS delmesh_app)
endif()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/delmesh DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

set(DELMESH_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/delmesh)
install(EXPORT delmeshTargets NAMESPACE delmesh:: DESTINATION ${DELMESH_CMAKE_DIR})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/delmeshConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/delmeshConfig.cmake INSTALL_DESTINATION ${DELMESH_CMAKE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/delmeshConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/delmeshConfig.cmake ${PROJECT_BINARY_DIR}/delmeshConfigVersion.cmake
        DESTINATION ${DELMESH_CMAKE_DIR})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
