# Headers that most files include are compiled once for all files that are compiled alike. Files
# include what they need all the same: the preset `tidy` is without this, and clang-tidy stops where
# one does not.
option(GEARSWEEP_PRECOMPILE "Precompile the headers that most files include, and join files" ON)

# gearsweep_precompile(TARGET header...): an object library whose headers others take, beside those of
# the language and fmt.
function(gearsweep_precompile target)
  target_precompile_headers(${target} PRIVATE <fmt/format.h> <fmt/ranges.h> <algorithm> <cmath>
                            <filesystem> <fstream> <functional> <map> <memory> <optional> <set>
                            <sstream> <string> <vector> ${ARGN})
endfunction()

# Several files are compiled as one: what they include takes longer than they do themselves. So names
# that are local to a file differ within a folder.
function(gearsweep_join target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 16)
endfunction()
