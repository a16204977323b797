# `cmake --install`: the tool with what belongs to it (component `tool`), and the library with its
# public headers and a find_package config (component `library`).
include(CMakePackageConfigHelpers)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME library)

# Manual and completion come from the tool's own options, by the tool itself.
set(pages ${CMAKE_CURRENT_BINARY_DIR}/pages)
file(MAKE_DIRECTORY ${pages})
add_custom_command(OUTPUT ${pages}/gearsweep.1 ${pages}/gearsweep-study.5 ${pages}/gearsweep.bash
                          ${pages}/gearsweep.fish
  COMMAND gearsweep manual > ${pages}/gearsweep.1
  COMMAND gearsweep manual study > ${pages}/gearsweep-study.5
  COMMAND gearsweep completion bash > ${pages}/gearsweep.bash
  COMMAND gearsweep completion fish > ${pages}/gearsweep.fish
  DEPENDS gearsweep VERBATIM)
add_custom_target(gearsweep_pages ALL DEPENDS ${pages}/gearsweep.1 ${pages}/gearsweep-study.5
                  ${pages}/gearsweep.bash ${pages}/gearsweep.fish)
install(TARGETS gearsweep COMPONENT tool)
install(FILES ${pages}/gearsweep.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT tool)
install(FILES ${pages}/gearsweep-study.5 DESTINATION ${CMAKE_INSTALL_MANDIR}/man5 COMPONENT tool)
install(FILES ${pages}/gearsweep.bash RENAME gearsweep
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT tool)
install(FILES ${pages}/gearsweep.fish
        DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT tool)
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md
              ${PROJECT_SOURCE_DIR}/CONTRIBUTING.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT tool)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/doc DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT tool
        PATTERN site EXCLUDE)
# What they lead to.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/zoo DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT tool)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/python/examples DESTINATION ${CMAKE_INSTALL_DOCDIR}/python
        COMPONENT tool FILES_MATCHING PATTERN *.py)
install(FILES ${PROJECT_SOURCE_DIR}/tests/consumer/main.cpp
        DESTINATION ${CMAKE_INSTALL_DOCDIR}/tests/consumer COMPONENT tool)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/.readme DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT tool
        FILES_MATCHING PATTERN *.png PATTERN *.svg)
# The name that Debian gives it.
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE RENAME copyright DESTINATION ${CMAKE_INSTALL_DOCDIR}
        COMPONENT tool)
install(DIRECTORY studies DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT tool)

# What a program that uses the library links: everything but the command line.
add_library(gearsweep_library INTERFACE)
add_library(gearsweep::gearsweep ALIAS gearsweep_library)
set_target_properties(gearsweep_library PROPERTIES EXPORT_NAME gearsweep)
set(library_folders model expression equations gear rexs study plan engine opencl reference tile journal orbits attractors scheduler
                    sweep point borders orders result plot report)
# A folder's detail/ is not for users of the library.
foreach(folder ${library_folders})
  list(APPEND library_targets gearsweep_${folder})
  file(GLOB headers CONFIGURE_DEPENDS ${folder}/*.hpp)
  install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gearsweep/${folder})
endforeach()
# Public headers show matrices.
target_link_libraries(gearsweep_library INTERFACE ${library_targets} Eigen3::Eigen)
install(FILES ${PROJECT_SOURCE_DIR}/kernels/sweep_types.h
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gearsweep)

install(TARGETS gearsweep_library ${library_targets} EXPORT gearsweep)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/gearsweep)
install(EXPORT gearsweep NAMESPACE gearsweep:: FILE gearsweep-targets.cmake DESTINATION ${package})
configure_package_config_file(gearsweep-config.cmake.in
                              ${CMAKE_CURRENT_BINARY_DIR}/gearsweep-config.cmake
                              INSTALL_DESTINATION ${package})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/gearsweep-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/gearsweep-config.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/gearsweep-config-version.cmake
        DESTINATION ${package})
