# SPDX-License-Identifier: Apache-2.0
# Installs the public headers. Run by `cmake --install`, so that it sees them as they are then.
include(${CLEW_SOURCE}/cmake/public_headers.cmake)
clew_closure(headers ${CLEW_SOURCE} ${CLEW_BEHAVIOUR_HEADERS} ${CLEW_PROGRAM_HEADERS})
foreach(header path IN ZIP_LISTS headers headers_PATHS)
  get_filename_component(folder ${header} DIRECTORY)
  file(INSTALL ${path} DESTINATION ${CLEW_INCLUDE_DESTINATION}/${folder})
endforeach()
