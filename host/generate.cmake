# What is generated at configure time: bindings of each observable in kernels/, and the embedded
# kernels, models and studies. A new file in kernels/ or zoo/ is picked up by globbing; nothing lists it.

function(gearsweep_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wshadow
                         $<$<BOOL:${GEARSWEEP_WERROR}>:-Werror>)
endfunction()

set(GENERATED ${CMAKE_CURRENT_BINARY_DIR}/generated)
set(KERNELS ${PROJECT_SOURCE_DIR}/kernels)

set(DECLARATIONS "")
set(OBSERVABLES "")
file(GLOB headers CONFIGURE_DEPENDS ${KERNELS}/observables/*.h)
foreach(header ${headers})
  get_filename_component(NAME ${header} NAME_WE)
  string(TOUPPER ${NAME} UPPER)
  set(HEADER observables/${NAME}.h)
  configure_file(model/bind_observable.cpp.in ${GENERATED}/observable_${NAME}.cpp @ONLY)
  list(APPEND GEARSWEEP_MODEL_SOURCES ${GENERATED}/observable_${NAME}.cpp)
  string(APPEND DECLARATIONS "namespace observable_${NAME} {\nObservable bind();\n}\n")
  string(APPEND OBSERVABLES "observable_${NAME}::bind(), ")
endforeach()
configure_file(model/observables.cpp.in ${GENERATED}/observables.cpp @ONLY)
list(APPEND GEARSWEEP_MODEL_SOURCES ${GENERATED}/observables.cpp)

# gearsweep_embed(OUTPUT FUNCTION HEADER FILES...): a C++ file that defines
# FUNCTION() -> map from relative path to text, declared in HEADER.
function(gearsweep_embed output function header base)
  set(script ${PROJECT_SOURCE_DIR}/host/embed.cmake)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DFUNCTION=${function} -DHEADER=${header}
            -DBASE=${base} "-DFILES=${ARGN}" -P ${script}
    DEPENDS ${ARGN} ${script} VERBATIM)
endfunction()

file(GLOB_RECURSE kernel_files CONFIGURE_DEPENDS ${KERNELS}/*.h ${KERNELS}/*.cl)
gearsweep_embed(${GENERATED}/kernel_sources.cpp kernel_sources opencl/detail/kernel_sources.hpp ${KERNELS}
                ${kernel_files})
set(GEARSWEEP_KERNEL_SOURCES ${GENERATED}/kernel_sources.cpp)

set(ZOO ${PROJECT_SOURCE_DIR}/zoo)
file(GLOB model_files CONFIGURE_DEPENDS ${ZOO}/*.toml)
gearsweep_embed(${GENERATED}/model_texts.cpp model_texts study/builtin_models.hpp ${ZOO}
                ${model_files})

set(STUDIES ${PROJECT_SOURCE_DIR}/host/studies)
file(GLOB_RECURSE study_files CONFIGURE_DEPENDS ${STUDIES}/*.toml)
gearsweep_embed(${GENERATED}/builtin_studies.cpp builtin_studies study/builtin_studies.hpp
                ${STUDIES} ${study_files})
set(GEARSWEEP_STUDY_SOURCES ${GENERATED}/builtin_studies.cpp ${GENERATED}/model_texts.cpp)

set(EXPLORE ${PROJECT_SOURCE_DIR}/explore)
file(GLOB page_texts CONFIGURE_DEPENDS ${EXPLORE}/*.html ${EXPLORE}/*.css ${EXPLORE}/*.js)
gearsweep_embed(${GENERATED}/page_files.cpp page_files explore/page_files.hpp ${EXPLORE} ${page_texts})
set(GEARSWEEP_PAGE_SOURCES ${GENERATED}/page_files.cpp)

# The version and a hash of all sources that decide a result.
include(${PROJECT_SOURCE_DIR}/host/hash.cmake)
gearsweep_deciding_files(hashed_files ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS)
add_custom_command(OUTPUT ${GENERATED}/version.cpp
  COMMAND ${CMAKE_COMMAND} -DOUTPUT=${GENERATED}/version.cpp -DVERSION=${PROJECT_VERSION}
          -DBASE=${PROJECT_SOURCE_DIR} -P ${PROJECT_SOURCE_DIR}/host/hash.cmake
  DEPENDS ${hashed_files} ${PROJECT_SOURCE_DIR}/host/hash.cmake VERBATIM)
list(APPEND GEARSWEEP_MODEL_SOURCES ${GENERATED}/version.cpp)
# The lists of two observables have the same names, and clang-tidy has nothing to say of what is
# generated.
set_source_files_properties(${GEARSWEEP_MODEL_SOURCES} ${GEARSWEEP_KERNEL_SOURCES} ${GEARSWEEP_STUDY_SOURCES} ${GEARSWEEP_PAGE_SOURCES} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
