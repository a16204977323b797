# The entries of ctest for the Python package.
set(environment PYTHONPATH=${CMAKE_CURRENT_BINARY_DIR} PYTHONDONTWRITEBYTECODE=1
    GEARSWEEP=$<TARGET_FILE:gearsweep>
    NUMPY_2=${CMAKE_CURRENT_BINARY_DIR}/numpy-2
    COUNTING_OPENCL=$<TARGET_FILE:counting_opencl>)
set(pytest ${Python3_EXECUTABLE} -m pytest -q -p no:cacheprovider -c ${PROJECT_SOURCE_DIR}/pyproject.toml)

# With the examples of the docstrings.
add_test(NAME python COMMAND ${pytest} --doctest-modules --pyargs gearsweep
         ${CMAKE_CURRENT_SOURCE_DIR}/tests)
set_tests_properties(python PROPERTIES ENVIRONMENT "${environment}")

# The examples, on few points. Each draws its picture; the one that reads files has a test of its own.
file(GLOB examples CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/examples/*.py)
list(FILTER examples EXCLUDE REGEX import_ode)
foreach(example ${examples})
  get_filename_component(name ${example} NAME_WE)
  add_test(NAME python_example_${name}
           COMMAND ${Python3_EXECUTABLE} ${example} --small
                   --out ${CMAKE_CURRENT_BINARY_DIR}/${name}.png)
  set_tests_properties(python_example_${name} PROPERTIES ENVIRONMENT "${environment}")
endforeach()

# The package is right by its own types, and so is a program that uses it by its stubs.
add_test(NAME python_types
         COMMAND ${Python3_EXECUTABLE} -m mypy --config-file ${PROJECT_SOURCE_DIR}/pyproject.toml
                 --cache-dir ${CMAKE_CURRENT_BINARY_DIR}/mypy
                 ${CMAKE_CURRENT_SOURCE_DIR}/gearsweep ${CMAKE_CURRENT_SOURCE_DIR}/tests/typed_program.py)

# The module beside the runtime of clang's sanitizers, which has to be there before Python's own
# libraries. What Python has at its end is not freed, so leaks are looked for before: conftest.py.
# With malloc() for all objects, the sanitizer sees what they point to.
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND CMAKE_CXX_FLAGS MATCHES "-fsanitize=address")
  foreach(library libclang_rt.asan-x86_64.so libstdc++.so.6)
    execute_process(COMMAND ${CMAKE_CXX_COMPILER} -print-file-name=${library}
                    OUTPUT_VARIABLE path OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
    list(APPEND runtime ${path})
  endforeach()
  list(JOIN runtime ":" runtime)
  add_test(NAME python_binding COMMAND ${pytest} -m binding ${CMAKE_CURRENT_SOURCE_DIR}/tests)
  set_tests_properties(python_binding PROPERTIES LABELS sanitize_weekly ENVIRONMENT
    "${environment};PYTHONMALLOC=malloc;LD_PRELOAD=${runtime};ASAN_OPTIONS=leak_check_at_exit=0:use_sigaltstack=0")
endif()
