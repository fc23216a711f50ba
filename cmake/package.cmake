# `cpack` in the build folder makes camber_VERSION_ARCH.deb: program, library, headers, CMake package,
# Python package, documentation. Dependencies of the binaries are found by dpkg-shlibdeps.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME camber)
set(CPACK_PACKAGE_CONTACT "The Camber authors <camber@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
if(CAMBER_WITH_PYTHON)
  math(EXPR camber_next_minor "${Python_VERSION_MINOR} + 1")
  string(CONCAT CPACK_DEBIAN_PACKAGE_DEPENDS
    "python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), "
    "python3 (<< ${Python_VERSION_MAJOR}.${camber_next_minor}), python3-numpy")
endif()
# What find_package(Camber) asks for; the program and the Python package do without.
string(CONCAT CPACK_DEBIAN_PACKAGE_RECOMMENDS
  "g++, cmake, libeigen3-dev, libtbb-dev, libfmt-dev, libspdlog-dev, nlohmann-json3-dev, "
  "libnanoflann-dev, libpugixml-dev, libcgns-dev, libhdf5-dev, libocct-foundation-dev, libocct-modeling-data-dev, "
  "libocct-modeling-algorithms-dev, libocct-data-exchange-dev, libocct-visualization-dev, "
  "libocct-ocaf-dev")
include(CPack)
