# `cmake --install`: static libraries, headers, the program, and a package for find_package(Camber)
# with one target a module (camber::mesh, ...) and camber::camber for all of them.
include(CMakePackageConfigHelpers)

# The reference kernels are the tests' oracle; users get the real ones.
set(camber_installed ${camber_module_targets})
list(REMOVE_ITEM camber_installed camber_reference)

add_library(camber_camber INTERFACE)
add_library(camber::camber ALIAS camber_camber)
set_target_properties(camber_camber PROPERTIES EXPORT_NAME camber)
target_link_libraries(camber_camber INTERFACE ${camber_installed})

install(TARGETS ${camber_installed} EXPORT camber_targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(TARGETS camber_camber EXPORT camber_targets)
install(EXPORT camber_targets NAMESPACE camber:: FILE CamberTargets.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Camber)

configure_package_config_file(cmake/CamberConfig.cmake.in
  ${PROJECT_BINARY_DIR}/CamberConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Camber NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/CamberConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/CamberConfig.cmake ${PROJECT_BINARY_DIR}/CamberConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Camber)
install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR})
