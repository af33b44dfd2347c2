# SPDX-License-Identifier: Apache-2.0
# Language, warnings, sanitizers and the one way to declare a folder's target.

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_C_STANDARD 11)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
find_program(CLEW_CCACHE ccache)
if(CLEW_CCACHE)
  set(CMAKE_C_COMPILER_LAUNCHER ${CLEW_CCACHE})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CLEW_CCACHE})
endif()

# Results are compared bit for bit between builds, layouts and machines: no fused multiply-add, and
# -Og in Debug, since the suite runs whole missions there.
add_compile_options(-ffp-contract=off)
set(CMAKE_CXX_FLAGS_RELEASE "-O2")
set(CMAKE_C_FLAGS_RELEASE "-O2")
set(CMAKE_CXX_FLAGS_DEBUG "-Og -g1")
set(CMAKE_C_FLAGS_DEBUG "-Og -g1")

set(CLEW_SANITIZE "" CACHE STRING "Sanitizers, as in -fsanitize=")
if(CLEW_SANITIZE)
  add_compile_options(-fsanitize=${CLEW_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${CLEW_SANITIZE})
endif()

add_library(clew_warnings INTERFACE)
target_compile_options(clew_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror
  $<$<COMPILE_LANGUAGE:CXX>:-Wold-style-cast>)

# clew_library(<folder name> SOURCES ... [LINK ...] [PRIVATE_LINK ...])
# One static library a folder, clew_<name>, alias clew::<name>. Headers are included by their path
# from the source root's include_root (components/ or the root itself): "core/angle.hpp".
function(clew_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;PRIVATE_LINK" ${ARGN})
  add_library(clew_${name} STATIC ${ARG_SOURCES})
  add_library(clew::${name} ALIAS clew_${name})
  target_include_directories(clew_${name} PUBLIC ${CLEW_INCLUDE_ROOT})
  target_link_libraries(clew_${name} PUBLIC ${ARG_LINK} PRIVATE ${ARG_PRIVATE_LINK} clew_warnings)
endfunction()
