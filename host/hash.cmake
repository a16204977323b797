# Writes OUTPUT, a C++ file with version() and source_hash() over FILES.
set(all "")
foreach(file ${FILES})
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
