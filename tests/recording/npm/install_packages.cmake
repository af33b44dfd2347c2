# SPDX-License-Identifier: Apache-2.0
# Installs the packages of package-lock.json into DIRECTORY, once.
#   cmake -DNPM=... -DDIRECTORY=... -P install_packages.cmake
file(SHA256 ${DIRECTORY}/package-lock.json wanted)
set(stamp ${DIRECTORY}/node_modules/.installed)
if(EXISTS ${stamp})
  file(READ ${stamp} installed)
  if(installed STREQUAL wanted)
    return()
  endif()
endif()
execute_process(
  COMMAND ${NPM} ci --ignore-scripts --no-audit --no-fund
  WORKING_DIRECTORY ${DIRECTORY}
  COMMAND_ERROR_IS_FATAL ANY)
file(WRITE ${stamp} ${wanted})
