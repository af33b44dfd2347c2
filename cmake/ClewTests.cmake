# SPDX-License-Identifier: Apache-2.0

# clew_test(<folder> SOURCES ... LINK ... [LABELS ...])
# One test executable a folder, clew_<folder>_test, every TEST a CTest of its own. Tests find the
# project's data through the definition CLEW_SOURCE_DIR. Label: unit, if none is given.
function(clew_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;LABELS" ${ARGN})
  add_executable(clew_${name}_test ${ARG_SOURCES})
  target_link_libraries(clew_${name}_test PRIVATE ${ARG_LINK} GTest::gtest_main clew_precompiled
    clew_warnings)
  target_precompile_headers(clew_${name}_test REUSE_FROM clew_precompiled)
  target_compile_definitions(clew_${name}_test PRIVATE CLEW_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  if(NOT ARG_LABELS)
    set(ARG_LABELS unit)
  endif()
  gtest_discover_tests(clew_${name}_test DISCOVERY_TIMEOUT 60 PROPERTIES
    TIMEOUT 300 LABELS "${ARG_LABELS}")
endfunction()
