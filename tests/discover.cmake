# After a test program is built: writes what ctest shall run of it. A process costs more than most
# tests (it starts OpenCL and loads its kernels anew), so that one process runs a whole suite, unless
# each test wants one of its own. Where a label names only some tests of a suite, they get a process
# of their own.
# Variables: PROGRAM, FOLDER (before each name), OUTPUT, EACH (suite or test), LABELS (a list of
# "label=name,name..."; a name is "Suite", "Suite.Test", "Suite.Te*" or "*").
cmake_minimum_required(VERSION 3.25)

# All tests of the program, as "Suite.Test".
execute_process(COMMAND ${PROGRAM} --gtest_list_tests RESULT_VARIABLE status OUTPUT_VARIABLE listing)
if(status)
  message(FATAL_ERROR "${PROGRAM} --gtest_list_tests failed (${status})")
endif()
string(REGEX REPLACE " *#[^\n]*" "" listing "${listing}")  # values of parameters
string(REGEX MATCHALL "[^\n]+" lines "${listing}")
foreach(line IN LISTS lines)
  if(line MATCHES "^  (.+)")
    list(APPEND tests "${suite}${CMAKE_MATCH_1}")
  else()
    set(suite "${line}")  # with its dot
  endif()
endforeach()

foreach(entry IN LISTS LABELS)
  string(REGEX MATCH "^([^=]+)=(.+)$" entry "${entry}")
  set(label ${CMAKE_MATCH_1})
  string(REPLACE "," ";" names "${CMAKE_MATCH_2}")
  foreach(name IN LISTS names)
    set(pattern "${name}")
    if(NOT name MATCHES "[.*]")
      string(APPEND pattern ".*")
    endif()
    string(REPLACE "." "[.]" pattern "${pattern}")
    string(REPLACE "*" ".*" pattern "${pattern}")
    set(named ${tests})
    list(FILTER named INCLUDE REGEX "^${pattern}$")
    if(NOT named)
      message(FATAL_ERROR "${FOLDER} has no test ${name}, which shall have the label ${label}: name "
                          "others in tests/CMakeLists.txt")
    endif()
    foreach(test IN LISTS named)
      list(APPEND "labels_${test}" ${label})
    endforeach()
  endforeach()
endforeach()

# Tests of one suite with the same labels share an entry.
foreach(test IN LISTS tests)
  set(entry "${test}")
  if(EACH STREQUAL "suite")
    string(REGEX REPLACE "[.].*" "" entry "${test}")
  endif()
  string(REPLACE ";" "+" kind "${labels_${test}}")
  list(APPEND entries "${entry}+${kind}")
  list(APPEND "tests_${entry}+${kind}" "${test}")
  list(APPEND "all_${entry}" "${test}")
endforeach()
list(REMOVE_DUPLICATES entries)

set(script "")
foreach(key IN LISTS entries)
  string(REGEX MATCH "^([^+]+)[+](.*)$" key "${key}")
  set(entry "${CMAKE_MATCH_1}")
  set(kind "${CMAKE_MATCH_2}")
  set(name "${FOLDER}/${entry}")
  set(filter "${tests_${key}}")
  if("${filter}" STREQUAL "${all_${entry}}")
    if(EACH STREQUAL "suite")
      set(filter "${entry}.*")
    endif()
  elseif(kind)
    string(APPEND name "+${kind}")
  endif()
  string(REPLACE ";" ":" filter "${filter}")
  string(REPLACE "+" ";" labels "${kind}")
  string(APPEND script
         "add_test([==[${name}]==] [==[${PROGRAM}]==] [==[--gtest_filter=${filter}]==] --gtest_brief=1)\n"
         "set_tests_properties([==[${name}]==] PROPERTIES TIMEOUT 900 LABELS [==[${labels}]==])\n")
endforeach()
file(WRITE ${OUTPUT} "${script}")
