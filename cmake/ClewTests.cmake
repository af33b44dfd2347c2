# SPDX-License-Identifier: Apache-2.0

option(CLEW_TESTS_ONE_BY_ONE "Every TEST is a CTest of its own, not every executable" ON)

# All test executables, and nothing else.
add_custom_target(clew_tests)

# What nearly every test includes, parsed once: half of a test's time to compile is GoogleTest.
add_library(clew_precompiled_tests STATIC ${CMAKE_CURRENT_LIST_DIR}/precompiled.cpp)
target_precompile_headers(clew_precompiled_tests PRIVATE ${CLEW_PRECOMPILED} <fstream> <gtest/gtest.h>)
target_link_libraries(clew_precompiled_tests PUBLIC GTest::gtest clew_precompiled
  PRIVATE clew_warnings)

# clew_test(<folder> [EVERY_TEST] SOURCES ... LINK ... [LABELS ...])
# One test executable a folder, clew_<folder>_test. Every TEST of it is a CTest; or the executable is
# one, unit.<folder>, which saves two thousand starts where a start is slow. EVERY_TEST takes all files
# *_test.cpp from the folder and those below it besides SOURCES: a test that nobody listed would never
# run. Tests find the project's data through tests/source_path.hpp, and each other's headers by their
# path from the project's root. Label: unit, if none is given.
function(clew_test name)
  cmake_parse_arguments(ARG "EVERY_TEST" "" "SOURCES;LINK;LABELS" ${ARGN})
  if(ARG_EVERY_TEST)
    file(GLOB_RECURSE tests CONFIGURE_DEPENDS "*_test.cpp")
    list(APPEND ARG_SOURCES ${tests})
  endif()
  add_executable(clew_${name}_test ${ARG_SOURCES})
  target_link_libraries(clew_${name}_test PRIVATE ${ARG_LINK} GTest::gtest_main clew_source_path
    clew_precompiled_tests clew_warnings)
  target_precompile_headers(clew_${name}_test REUSE_FROM clew_precompiled_tests)
  target_include_directories(clew_${name}_test PRIVATE ${PROJECT_SOURCE_DIR})
  if(NOT ARG_LABELS)
    set(ARG_LABELS unit)
  endif()
  add_dependencies(clew_tests clew_${name}_test)
  if(CLEW_TESTS_ONE_BY_ONE)
    gtest_discover_tests(clew_${name}_test DISCOVERY_TIMEOUT 60 PROPERTIES
      TIMEOUT 300 LABELS "${ARG_LABELS}")
  else()
    # ThreadSanitizer's shadow memory fits no layout with as much randomness as new kernels give. A
    # container may forbid to have less; many give little.
    set(start)
    if(CLEW_SANITIZE STREQUAL "thread")
      execute_process(COMMAND setarch -R true RESULT_VARIABLE forbidden ERROR_QUIET)
      if(NOT forbidden)
        set(start setarch -R)
      endif()
    endif()
    add_test(NAME unit.${name} COMMAND ${start} $<TARGET_FILE:clew_${name}_test> --gtest_brief=1)
    # Fast DDS 2.9 deletes the statistics of each writer as an object of another size.
    set_tests_properties(unit.${name} PROPERTIES TIMEOUT 1800 LABELS "${ARG_LABELS}" ENVIRONMENT
      "LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/leaks_of_libraries.txt;ASAN_OPTIONS=new_delete_type_mismatch=0:malloc_context_size=8")
  endif()
endfunction()
