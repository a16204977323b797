# Installs the built project under a fresh prefix, builds the consumer against it and runs both the
# consumer and the installed tool. Variables: BUILD, SOURCE, WORK, CXX, EACH_HEADER (whether each header
# is compiled alone, too, which takes a minute).
function(must)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status)
  if(status)
    message(FATAL_ERROR "failed (${status}): ${ARGN}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
must(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
must(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/build -G Ninja -DCMAKE_PREFIX_PATH=${WORK}/prefix
     -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_BUILD_TYPE=Release
     -DEACH_HEADER=${EACH_HEADER})
must(${CMAKE_COMMAND} --build ${WORK}/build)

# What a header includes is there, too.
file(GLOB_RECURSE headers RELATIVE ${WORK}/prefix/include/gearsweep
     ${WORK}/prefix/include/gearsweep/*.hpp)
foreach(header ${headers})
  file(STRINGS ${WORK}/prefix/include/gearsweep/${header} lines REGEX "^#include \"")
  foreach(line ${lines})
    string(REGEX REPLACE "^#include \"(.*)\".*" "\\1" included "${line}")
    if(NOT EXISTS ${WORK}/prefix/include/gearsweep/${included})
      message(FATAL_ERROR "${header} includes ${included}, which is not installed")
    endif()
  endforeach()
endforeach()
must(${WORK}/build/consumer)
file(MAKE_DIRECTORY ${WORK}/elsewhere)
execute_process(COMMAND ${WORK}/prefix/bin/gearsweep studies WORKING_DIRECTORY ${WORK}/elsewhere
                RESULT_VARIABLE status)
if(status)
  message(FATAL_ERROR "the installed tool does not run from another directory")
endif()
