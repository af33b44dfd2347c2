# SPDX-License-Identifier: Apache-2.0

# clew_add_plugin(<name> SOURCE...)
# A plug-in lib<name>.so. It exports nothing but what CLEW_PLUGIN says, so its copy of Clew's code
# does not meet the program's.
function(clew_add_plugin name)
  add_library(${name} MODULE ${ARGN})
  target_link_libraries(${name} PRIVATE clew::plugin)
  target_compile_features(${name} PRIVATE cxx_std_17)
  set_target_properties(${name} PROPERTIES CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON POSITION_INDEPENDENT_CODE ON)
endfunction()
