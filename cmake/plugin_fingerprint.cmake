# SPDX-License-Identifier: Apache-2.0
# Writes the fingerprint of the headers that plug-ins are built with. Names count as well as texts.
include(${CLEW_SOURCE}/cmake/public_headers.cmake)
clew_closure(headers ${CLEW_SOURCE} ${CLEW_BEHAVIOUR_HEADERS} plugin/plugin.hpp)
set(all)
foreach(header path IN ZIP_LISTS headers headers_PATHS)
  file(SHA256 ${path} digest)
  string(APPEND all "${header} ${digest}\n")
endforeach()
string(SHA256 fingerprint "${all}")
string(SUBSTRING ${fingerprint} 0 32 fingerprint)
file(WRITE ${OUTPUT} "// SPDX-License-Identifier: Apache-2.0
// Of Clew's headers as a plug-in is built with them; see plugin/descriptor.hpp.
#define CLEW_PLUGIN_FINGERPRINT \"${fingerprint}\"
#define CLEW_PLUGIN_CLEW_VERSION \"${VERSION}\"
")
