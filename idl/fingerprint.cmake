# SPDX-License-Identifier: Apache-2.0
# clew_idl_fingerprint(<folder>): writes <folder>/clew/idl_fingerprint.h, which says what the IDL
# files beside this one are. For components outside this tree, too.
#
# The fingerprint is taken over the files as they are, comments included: what a preprocessor makes of
# them differs between compilers, and the same sources must give the same fingerprint on every host.
# In a shell: cat *.idl | sha256sum | cut -c1-32
function(clew_idl_fingerprint folder)
  file(GLOB files CONFIGURE_DEPENDS ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/*.idl)
  list(SORT files)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${files})
  set(all_texts)
  foreach(file IN LISTS files)
    file(READ ${file} text)
    string(APPEND all_texts "${text}")
  endforeach()
  string(SHA256 fingerprint "${all_texts}")
  string(SUBSTRING ${fingerprint} 0 32 CLEW_IDL_FINGERPRINT)
  configure_file(${CMAKE_CURRENT_FUNCTION_LIST_DIR}/idl_fingerprint.h.in
    ${folder}/clew/idl_fingerprint.h @ONLY)
endfunction()
