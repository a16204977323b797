# `cmake --install`: the tool, and the library with its public headers and a find_package config.
include(CMakePackageConfigHelpers)

# What a program that uses the library links: everything but the command line.
add_library(gearsweep_library INTERFACE)
add_library(gearsweep::gearsweep ALIAS gearsweep_library)
set_target_properties(gearsweep_library PROPERTIES EXPORT_NAME gearsweep)
target_link_libraries(gearsweep_library INTERFACE gearsweep_distribute gearsweep_io
                      gearsweep_opencl gearsweep_reference)

set(library_folders model study plan engine opencl reference journal distribute io)
foreach(folder ${library_folders})
  list(APPEND library_targets gearsweep_${folder})
  file(GLOB headers CONFIGURE_DEPENDS ${folder}/*.hpp)
  foreach(header ${headers})
    # A header says so in its first comment when it is not for users of the library.
    file(STRINGS ${header} private REGEX "Private to this")
    if(NOT private)
      install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gearsweep/${folder})
    endif()
  endforeach()
endforeach()
install(FILES ${PROJECT_SOURCE_DIR}/kernels/sweep_types.h
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gearsweep)

install(TARGETS gearsweep)
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
