# Headers written by hand, of models that are files of equations: a second opinion for tests, and
# what other integrators step in benchmarks.
if(TARGET gearsweep_handwritten)
  return()
endif()
set(headers_bound "")
set(declarations "")
set(list "")
file(GLOB headers CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/headers/*.h)
foreach(header ${headers})
  get_filename_component(NAME ${header} NAME_WE)
  set(HEADER equations/headers/${NAME}.h)
  set(bound ${CMAKE_CURRENT_BINARY_DIR}/header_${NAME}.cpp)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/bind_model.cpp.in ${bound} @ONLY)
  list(APPEND headers_bound ${bound})
  string(APPEND declarations "namespace model_${NAME} {\nModel bind();\n}\n")
  string(APPEND list "model_${NAME}::bind(), ")
endforeach()
file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/headers.cpp CONTENT
"#include \"equations/headers.hpp\"

namespace gearsweep {
@declarations@
const std::vector<Model>& handwritten_models() {
  static const std::vector<Model> all = {@list@};
  return all;
}
}  // namespace gearsweep
" @ONLY)
add_library(gearsweep_handwritten STATIC ${headers_bound} ${CMAKE_CURRENT_BINARY_DIR}/headers.cpp)
target_include_directories(gearsweep_handwritten PUBLIC ${PROJECT_SOURCE_DIR}/tests)
target_link_libraries(gearsweep_handwritten PUBLIC gearsweep_study)
gearsweep_warnings(gearsweep_handwritten)
