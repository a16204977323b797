# Which sources decide the numbers of a sweep, and their hash. A journal or a shard is continued by
# any program that has the same ones, whatever else differs.
#
#   kernels/          what runs on the device
#   zoo/              the equations of the built-in models
#   model/            the formula on the host, and what is tabulated over the phase
#   expression/       values and derivatives of expressions
#   equations/        a model from its file
#   gear/             parameters and curves from a drawing
#   study/            axes, draws, defaults of keys
#   plan/             points, their starts, phase grids, tiles
#   engine/           windows, and what a tile's answers are
#   opencl/           programs, launches, how points lie in them
#   reference/        the other engine
#   tile/             orbits, longer windows
#   journal/journal.* how a tile's answers are stored
#   sweep/assembly.*  where the points of a chain go on
#
# Not so sweep/pilot.*, though it chooses the step: the step is a part of a journal's identity. Nor
# study/study_keys.*, which says what a study may have, with the texts of its manual page.
set(GEARSWEEP_DECIDING kernels zoo host/model host/expression host/equations host/gear
    host/study host/plan host/engine host/opencl host/reference host/tile host/journal/journal
    host/sweep/assembly)
set(GEARSWEEP_NOT_DECIDING host/study/study_keys)

# gearsweep_deciding_files(OUT BASE [CONFIGURE_DEPENDS])
function(gearsweep_deciding_files out base)
  set(files "")
  foreach(place ${GEARSWEEP_DECIDING})
    set(patterns ${base}/${place}.cpp ${base}/${place}.hpp)
    foreach(ending h cl toml cpp hpp in)
      list(APPEND patterns ${base}/${place}/*.${ending})
    endforeach()
    file(GLOB_RECURSE found ${ARGN} ${patterns})
    list(APPEND files ${found})
  endforeach()
  foreach(place ${GEARSWEEP_NOT_DECIDING})
    list(REMOVE_ITEM files ${base}/${place}.cpp ${base}/${place}.hpp)
  endforeach()
  set(${out} ${files} PARENT_SCOPE)
endfunction()

# As a script: writes OUTPUT, a C++ file with version() and source_hash() of the sources below BASE.
if(CMAKE_SCRIPT_MODE_FILE STREQUAL CMAKE_CURRENT_LIST_FILE)
  gearsweep_deciding_files(files ${BASE})
  set(all "")
  foreach(file ${files})
    file(SHA256 ${file} hash)
    file(RELATIVE_PATH path ${BASE} ${file})
    string(APPEND all "${path} ${hash}\n")
  endforeach()
  string(SHA256 hash "${all}")
  file(WRITE ${OUTPUT} "// Generated.
#include \"model/version.hpp\"

namespace gearsweep {

std::string version() { return \"${VERSION}\"; }
std::string source_hash() { return \"${hash}\"; }

}  // namespace gearsweep
")
endif()
