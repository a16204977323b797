# The hash that a journal is continued by: the same after an edit of a help text, another one after
# an edit of anything that decides numbers. Of copies of the sources below SOURCE, in WORK.
file(REMOVE_RECURSE ${WORK})
file(COPY ${SOURCE}/kernels ${SOURCE}/zoo ${SOURCE}/host DESTINATION ${WORK})

function(hash out)
  execute_process(COMMAND ${CMAKE_COMMAND} -DOUTPUT=${WORK}/version.cpp -DVERSION=1 -DBASE=${WORK}
                          -P ${SOURCE}/host/hash.cmake COMMAND_ERROR_IS_FATAL ANY)
  file(SHA256 ${WORK}/version.cpp found)
  set(${out} ${found} PARENT_SCOPE)
endfunction()

function(replace path from to)
  file(READ ${WORK}/${path} text)
  string(REPLACE "${from}" "${to}" edited "${text}")
  if(edited STREQUAL text)
    message(FATAL_ERROR "${path} has no '${from}' any more")
  endif()
  file(WRITE ${WORK}/${path} "${edited}")
endfunction()

hash(first)
replace(host/cli/trace_command.cpp "The time history of points" "What happens at points")
replace(host/study/study_keys.cpp "How many values." "The number of values.")
file(APPEND ${WORK}/host/sweep/pilot.cpp "\n")
file(APPEND ${WORK}/host/main.cpp "\n")
hash(edited)
if(NOT edited STREQUAL first)
  message(FATAL_ERROR "an edit of a help text discards journals")
endif()

foreach(path kernels/sweep.cl kernels/rk4/rk4.h zoo/duffing.toml host/model/model.cpp
        host/expression/tape.cpp host/equations/make_model.cpp host/gear/conversion.cpp host/study/study_reader.cpp
        host/plan/phase_grid.cpp host/engine/window.cpp host/opencl/detail/launcher.cpp
        host/reference/detail/trajectory.cpp host/tile/tile_run.cpp host/journal/journal.cpp
        host/sweep/assembly.cpp)
  file(APPEND ${WORK}/${path} "\n")
  hash(next)
  if(next STREQUAL edited)
    message(FATAL_ERROR "a journal would go on after an edit of ${path}")
  endif()
  set(edited ${next})
endforeach()
file(REMOVE_RECURSE ${WORK})
