# `cpack`: the tool as a Debian package, and the Python package as another where it is built; or as
# archives where Debian's tools are missing (packages dpkg-dev and file): without them a package would
# not know the libraries that it needs.
find_program(GEARSWEEP_SHLIBDEPS dpkg-shlibdeps)
find_program(GEARSWEEP_FILE file)
mark_as_advanced(GEARSWEEP_SHLIBDEPS GEARSWEEP_FILE)
if(GEARSWEEP_SHLIBDEPS AND GEARSWEEP_FILE)
  set(CPACK_GENERATOR DEB)
  set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/host/debian.cmake)
else()
  set(CPACK_GENERATOR TGZ)
endif()

set(CPACK_PACKAGE_NAME gearsweep)
set(CPACK_PACKAGE_VENDOR "The gearsweep authors")
# Debian wants an address; this one is nobody's (RFC 2606), so whoever distributes packages gives theirs.
set(GEARSWEEP_CONTACT "The gearsweep authors <authors@gearsweep.invalid>"
    CACHE STRING "Who answers for the packages: a name and <an address>")
set(CPACK_PACKAGE_CONTACT ${GEARSWEEP_CONTACT})
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_COMPONENTS_ALL tool)
set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(driver "pocl-opencl-icd | opencl-icd")

set(CPACK_DEBIAN_TOOL_PACKAGE_NAME gearsweep)
set(CPACK_DEBIAN_TOOL_PACKAGE_SECTION science)
set(CPACK_COMPONENT_TOOL_DESCRIPTION
    "From a study file to bifurcation diagrams, Lyapunov, period, contact and force
maps and basins of a geared rotor-bearing pair with backlash, and of textbook
oscillators, on any OpenCL device; on CPUs through PoCL.")
set(CPACK_DEBIAN_TOOL_PACKAGE_DEPENDS ${driver})
set(CPACK_DEBIAN_TOOL_PACKAGE_RECOMMENDS "gnuplot-nox | gnuplot")
set(CPACK_DEBIAN_TOOL_PACKAGE_SUGGESTS "chromium")

if(GEARSWEEP_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-gearsweep)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION
      "Runs the studies of gearsweep in Python, without the command and without a
file: bifurcation diagrams, Lyapunov, period, contact and force maps and basins
as xarray Datasets.")
  # The module is for the one version of Python that it was built with.
  math(EXPR next "${Python3_VERSION_MINOR} + 1")
  set(python "python3 (>= 3.${Python3_VERSION_MINOR}~), python3 (<< 3.${next})")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "${driver}, ${python}, python3-numpy, python3-xarray")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-matplotlib, python3-netcdf4, python3-tqdm")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/python/debian/postinst
      ${PROJECT_SOURCE_DIR}/python/debian/prerm)
endif()
include(CPack)
