# Packs the built project for Debian and looks into the packages: what they ask for, what they hold,
# and that the tool and the Python package in them run. Variables: BUILD, WORK, PYTHON (the
# interpreter that the Python package is built for; empty without it).
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

# A package's field, such as Depends.
function(must_name package field)
  must(named dpkg-deb -f ${package} ${field})
  foreach(name ${ARGN})
    string(FIND "${named}" "${name}" at)
    if(at EQUAL -1)
      message(FATAL_ERROR "${package} does not name ${name} in ${field}: ${named}")
    endif()
  endforeach()
endfunction()

set(libraries "pocl-opencl-icd | opencl-icd" ocl-icd-libopencl1 libnetcdf libsqlite3 libstdc++6)
must_name(${package} Depends ${libraries} libfftw3)
must_name(${package} Recommends gnuplot-nox)

must(log dpkg-deb -x ${package} ${WORK}/root)
foreach(file share/man/man1/gearsweep.1.gz share/man/man5/gearsweep-study.5.gz share/doc/gearsweep/changelog.gz
        share/bash-completion/completions/gearsweep share/fish/vendor_completions.d/gearsweep.fish
        share/doc/gearsweep/copyright
        share/doc/gearsweep/studies/coarse-map.toml share/doc/gearsweep/README.md
        share/doc/gearsweep/doc/studies.md share/doc/gearsweep/.readme/map.png)
  file(SIZE ${WORK}/root/usr/${file} size)
  if(size EQUAL 0)
    message(FATAL_ERROR "${file} is empty")
  endif()
endforeach()
# Links of the pages lead to files that are in the package, too.
file(GLOB_RECURSE pages ${WORK}/root/usr/share/doc/gearsweep/*.md)
foreach(page ${pages})
  get_filename_component(folder ${page} DIRECTORY)
  file(READ ${page} text)
  # Brackets and semicolons would be signs of a list of CMake's.
  string(REGEX REPLACE "[][;]" "|" text "${text}")
  string(REGEX MATCHALL "\\|\\([^) \n]+\\)" links "${text}")
  foreach(link ${links})
    string(REGEX REPLACE "^\\|\\(([^)#]*).*" "\\1" target "${link}")
    if(target AND NOT target MATCHES "^https?:" AND NOT EXISTS "${folder}/${target}")
      message(FATAL_ERROR "${page} leads to ${target}, which the package does not hold")
    endif()
    math(EXPR followed "${followed} + 1")
  endforeach()
endforeach()
if(NOT followed GREATER 200)
  message(FATAL_ERROR "the pages have ${followed} links")
endif()
if(EXISTS ${WORK}/root/usr/include)
  message(FATAL_ERROR "the tool's package holds the library's headers")
endif()
must(version ${WORK}/root/usr/bin/gearsweep --version)
must(expected dpkg-deb -f ${package} Version)
if(NOT version STREQUAL "gearsweep ${expected}")
  message(FATAL_ERROR "the package of ${expected} holds ${version}")
endif()

# Debian's own checker, where it is there: no error, and no warning of a place.
find_program(LINTIAN lintian)
if(LINTIAN)
  file(GLOB packages ${WORK}/pack/*.deb)
  execute_process(COMMAND ${LINTIAN} --allow-root --fail-on error,warning ${packages}
                  RESULT_VARIABLE status OUTPUT_VARIABLE text)
  if(status)
    message(FATAL_ERROR "lintian: ${text}")
  endif()
endif()

if(NOT PYTHON)
  return()
endif()
file(GLOB package ${WORK}/pack/python3-gearsweep_*.deb)
must_name(${package} Depends ${libraries} "python3 (>= 3." "python3 (<< 3." python3-numpy
          python3-xarray)
must_name(${package} Recommends python3-matplotlib python3-tqdm)
must(log dpkg-deb -x ${package} ${WORK}/python)
set(site ${WORK}/python/usr/lib/python3/dist-packages)
must(version ${CMAKE_COMMAND} -E env PYTHONPATH=${site} PYTHONDONTWRITEBYTECODE=1
     ${PYTHON} -c "print(__import__('gearsweep').__version__)")
if(NOT version STREQUAL expected OR NOT EXISTS ${site}/gearsweep/py.typed)
  message(FATAL_ERROR "the Python package of ${expected} holds ${version}")
endif()
