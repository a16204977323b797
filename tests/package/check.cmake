# Packs the built project for Debian and looks into the package: what it asks for, what it holds, and
# that the tool in it runs. Variables: BUILD, WORK.
function(must out)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE text
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(status)
    message(FATAL_ERROR "failed (${status}): ${ARGN}\n${text}")
  endif()
  set(${out} "${text}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
get_filename_component(tools ${CMAKE_COMMAND} DIRECTORY)
must(log ${tools}/cpack --config ${BUILD}/CPackConfig.cmake -G DEB -B ${WORK}/pack)
file(GLOB package ${WORK}/pack/gearsweep_*.deb)

must(needs dpkg-deb -f ${package} Depends)
foreach(name "pocl-opencl-icd | opencl-icd" ocl-icd-libopencl1 libnetcdf libsqlite3 libfftw3 libstdc++6)
  string(FIND "${needs}" "${name}" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "the package does not depend on ${name}: ${needs}")
  endif()
endforeach()
must(wants dpkg-deb -f ${package} Recommends)
if(NOT wants MATCHES "gnuplot-nox")
  message(FATAL_ERROR "the package does not recommend gnuplot: ${wants}")
endif()

must(log dpkg-deb -x ${package} ${WORK}/root)
foreach(file share/man/man1/gearsweep.1 share/man/man5/gearsweep-study.5
        share/bash-completion/completions/gearsweep share/fish/vendor_completions.d/gearsweep.fish share/doc/gearsweep/copyright
        share/doc/gearsweep/studies/coarse-map.toml share/doc/gearsweep/README.md
        share/doc/gearsweep/doc/studies.md share/doc/gearsweep/.readme/map.png)
  file(SIZE ${WORK}/root/usr/${file} size)
  if(size EQUAL 0)
    message(FATAL_ERROR "${file} is empty")
  endif()
endforeach()
if(EXISTS ${WORK}/root/usr/include)
  message(FATAL_ERROR "the tool's package holds the library's headers")
endif()
must(version ${WORK}/root/usr/bin/gearsweep --version)
must(expected dpkg-deb -f ${package} Version)
if(NOT version STREQUAL "gearsweep ${expected}")
  message(FATAL_ERROR "the package of ${expected} holds ${version}")
endif()
