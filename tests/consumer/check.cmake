# Installs the built project under a fresh prefix, builds the consumer against it and runs both the
# consumer and the installed tool. Variables: BUILD, SOURCE, WORK, CXX.
function(must)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status)
  if(status)
    message(FATAL_ERROR "failed (${status}): ${ARGN}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
must(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
must(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/build -G Ninja -DCMAKE_PREFIX_PATH=${WORK}/prefix
     -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_BUILD_TYPE=Release)
must(${CMAKE_COMMAND} --build ${WORK}/build)
must(${WORK}/build/consumer)
file(MAKE_DIRECTORY ${WORK}/elsewhere)
execute_process(COMMAND ${WORK}/prefix/bin/gearsweep studies WORKING_DIRECTORY ${WORK}/elsewhere
                RESULT_VARIABLE status)
if(status)
  message(FATAL_ERROR "the installed tool does not run from another directory")
endif()
