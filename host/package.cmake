# `cpack`: the tool as a Debian package, or as an archive where Debian's tools are missing (packages
# dpkg-dev and file): without them the package would not know the libraries that it needs.
find_program(GEARSWEEP_SHLIBDEPS dpkg-shlibdeps)
find_program(GEARSWEEP_FILE file)
mark_as_advanced(GEARSWEEP_SHLIBDEPS GEARSWEEP_FILE)
if(GEARSWEEP_SHLIBDEPS AND GEARSWEEP_FILE)
  set(CPACK_GENERATOR DEB)
else()
  set(CPACK_GENERATOR TGZ)
endif()

set(CPACK_PACKAGE_NAME gearsweep)
set(CPACK_PACKAGE_VENDOR "The gearsweep authors")
set(CPACK_PACKAGE_CONTACT "The gearsweep authors")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_COMPONENTS_ALL tool)
set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_TOOL_PACKAGE_NAME gearsweep)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_COMPONENT_TOOL_DESCRIPTION
    "From a study file to bifurcation diagrams, Lyapunov, period, contact and force
maps and basins of a geared rotor-bearing pair with backlash, and of textbook
oscillators, on any OpenCL device; on CPUs through PoCL.")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "pocl-opencl-icd | opencl-icd")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "gnuplot-nox | gnuplot")
include(CPack)
