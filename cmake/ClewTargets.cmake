# SPDX-License-Identifier: Apache-2.0
# Language, warnings, sanitizers and the one way to declare a folder's target.

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_C_STANDARD 11)

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
find_program(CLEW_CCACHE ccache)
if(CLEW_CCACHE)
  # Another clone of the same sources, as CI makes one, finds what this one has compiled.
  set(launcher ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1
    CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${CLEW_CCACHE})
  set(CMAKE_C_COMPILER_LAUNCHER ${launcher})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${launcher})
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endif()

# Results are compared bit for bit between builds, layouts and machines: no fused multiply-add.
add_compile_options(-ffp-contract=off)
# Everywhere, so that every target may use the same precompiled header.
add_compile_options(-pthread)
# What is loaded at run time (a plug-in, a module) is linked from the same static libraries as the
# command. It exports what it says alone.
add_compile_options(-fPIC)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_C_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
# Two clones give the same bytes. A debugger needs the paths, so only Release leaves them out.
add_compile_options($<$<CONFIG:Release>:-ffile-prefix-map=${PROJECT_SOURCE_DIR}/=>
  $<$<CONFIG:Release>:-ffile-prefix-map=${PROJECT_BINARY_DIR}/=build/>)
set(CMAKE_CXX_FLAGS_RELEASE "-O2")
set(CMAKE_C_FLAGS_RELEASE "-O2")
# In a debugger every argument and local has its value, and macros are known. tools/soak asks for
# -Og -g1 instead, since it runs whole missions, which take forty times as long without optimisation.
set(CLEW_DEBUG_FLAGS "-O0 -g3" CACHE STRING "Compiler flags of Debug builds")
set(CMAKE_CXX_FLAGS_DEBUG "${CLEW_DEBUG_FLAGS}")
set(CMAKE_C_FLAGS_DEBUG "${CLEW_DEBUG_FLAGS}")
set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O2 -g")
set(CMAKE_C_FLAGS_RELWITHDEBINFO "-O2 -g")

set(CLEW_SANITIZE "" CACHE STRING "Sanitizers, as in -fsanitize=")
if(CLEW_SANITIZE)
  # A sanitizer's report needs lines only. Whole missions run with ASan, none with ThreadSanitizer.
  set(level -O1)
  if(CLEW_SANITIZE STREQUAL "thread")
    set(level -O0)
    # Without optimisation GCC does not see that CLEW_CHECK(false, ...) does not return.
    add_compile_options(-Wno-return-type)
  endif()
  set(CMAKE_CXX_FLAGS_DEBUG "${level} -g1")
  set(CMAKE_C_FLAGS_DEBUG "${level} -g1")
  add_compile_options(-fsanitize=${CLEW_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  # A null pointer traps by itself, and x86 reads what is not aligned; these checks take a third of the
  # time to compile.
  add_compile_options(-fno-sanitize=null,alignment,vptr,object-size)
  add_link_options(-fsanitize=${CLEW_SANITIZE})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Its analysis does not see through a sanitizer's checks, std::regex is enough to mislead it.
    add_compile_options(-Wno-maybe-uninitialized)
  endif()
endif()

# The presets for people switch it off, so that an attempt compiles; tools/test switches it on.
option(CLEW_WERROR "Warnings are errors" ON)
add_library(clew_warnings INTERFACE)
target_compile_options(clew_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
  $<$<BOOL:${CLEW_WERROR}>:-Werror> $<$<COMPILE_LANGUAGE:CXX>:-Wold-style-cast>)

# What nearly every file of ours includes, parsed once for all targets.
set(CLEW_PRECOMPILED <Eigen/Core> <algorithm> <array> <cmath> <cstdint> <functional> <map> <memory>
  <optional> <string> <string_view> <variant> <vector>)
function(clew_precompile name)
  add_library(${name} STATIC ${PROJECT_SOURCE_DIR}/cmake/precompiled.cpp)
  target_precompile_headers(${name} PRIVATE ${CLEW_PRECOMPILED})
  target_link_libraries(${name} PUBLIC Eigen3::Eigen PRIVATE clew_warnings)
  # A sum of products has one order, whatever vector unit a machine has.
  target_compile_definitions(${name} PUBLIC EIGEN_DONT_VECTORIZE)
endfunction()
clew_precompile(clew_precompiled)
set(CLEW_PRECOMPILED_BY clew_precompiled)

# clew_library(<folder name> [COMPUTES] SOURCES ... [LINK ...] [PRIVATE_LINK ...])
# One static library a folder, clew_<name>, alias clew::<name>. Headers are included by their path
# from the source root's include_root (components/ or the root itself): "core/angle.hpp". COMPUTES: it
# computes so much that a sanitizer's build optimises it, where others of its kind are not.
function(clew_library name)
  cmake_parse_arguments(ARG "COMPUTES" "" "SOURCES;LINK;PRIVATE_LINK" ${ARGN})
  add_library(clew_${name} STATIC ${ARG_SOURCES})
  add_library(clew::${name} ALIAS clew_${name})
  target_include_directories(clew_${name} PUBLIC "$<BUILD_INTERFACE:${CLEW_INCLUDE_ROOT}>")
  target_link_libraries(clew_${name} PUBLIC ${ARG_LINK}
    PRIVATE ${ARG_PRIVATE_LINK} $<BUILD_INTERFACE:clew_warnings>)
  if(ARG_COMPUTES AND NOT CLEW_PRECOMPILED_BY STREQUAL "clew_precompiled")
    target_compile_options(clew_${name} PRIVATE -O1)
    target_precompile_headers(clew_${name} REUSE_FROM clew_precompiled)
  else()
    target_precompile_headers(clew_${name} REUSE_FROM ${CLEW_PRECOMPILED_BY})
  endif()
endfunction()

# Where programs look for the modules that they load: in the build tree beside the command, as seen
# from the command itself and from the folders of tests and tools; once installed, in lib/clew. A run
# path of the older kind, since the newer one is that of whoever calls dlopen: with a sanitizer, not
# the program.
set(CLEW_MODULE_DIRECTORY lib/clew)
set(CMAKE_BUILD_RPATH "$ORIGIN" "$ORIGIN/../..")
set(CMAKE_INSTALL_RPATH "$ORIGIN/../${CLEW_MODULE_DIRECTORY}")
add_link_options(-Wl,--disable-new-dtags)

# clew_module(<name> SOURCES ... [LINK ...])
# A shared library libclew-<name>.so beside the command, which core::SharedLibrary loads when it is
# needed: what is large and not always wanted stays out of a process. It exports what it declares so,
# and has its own copy of what it links of ours, so that must have no state. It is bound when it is
# loaded: what it lacks shows then.
function(clew_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_library(clew_${name}_module MODULE ${ARG_SOURCES})
  target_include_directories(clew_${name}_module PRIVATE ${CLEW_INCLUDE_ROOT})
  target_link_libraries(clew_${name}_module PRIVATE ${ARG_LINK} clew_warnings)
  target_link_options(clew_${name}_module PRIVATE -Wl,-z,now)
  target_precompile_headers(clew_${name}_module REUSE_FROM ${CLEW_PRECOMPILED_BY})
  set_target_properties(clew_${name}_module PROPERTIES OUTPUT_NAME clew-${name}
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
endfunction()
