# SPDX-License-Identifier: Apache-2.0
# Makes PAGE and BENCH_PAGE from the FILES of SOURCE, in DIRECTORY. What cannot be made is left empty and old, so
# that the next build tries again.
function(give_up why)
  message("clew: ${why}; this build has no page for clew view, clew report and clew bench")
  file(WRITE ${PAGE} "")
  file(WRITE ${BENCH_PAGE} "")
  execute_process(COMMAND touch -d @0 ${PAGE} ${BENCH_PAGE})
endfunction()

foreach(file IN LISTS FILES)
  get_filename_component(folder ${DIRECTORY}/${file} DIRECTORY)
  file(COPY ${SOURCE}/${file} DESTINATION ${folder})
endforeach()
if(NOT NODE OR NOT NPM)
  give_up("node and npm are not installed")
  return()
endif()
file(SHA256 ${DIRECTORY}/package-lock.json wanted)
set(stamp ${DIRECTORY}/node_modules/.installed)
set(installed "")
if(EXISTS ${stamp})
  file(READ ${stamp} installed)
endif()
if(NOT installed STREQUAL wanted)
  execute_process(
    COMMAND ${NPM} ci --ignore-scripts --no-audit --no-fund --prefer-offline --fetch-retries=1
      --loglevel=error
    WORKING_DIRECTORY ${DIRECTORY} RESULT_VARIABLE failed OUTPUT_QUIET TIMEOUT 240)
  if(failed)
    give_up("npm could not install the page's packages")
    return()
  endif()
  file(WRITE ${stamp} ${wanted})
endif()
# A mistake in our own sources is no reason to go on without a page.
execute_process(
  COMMAND ${NODE} build.mjs ${PAGE} ${BENCH_PAGE}
  WORKING_DIRECTORY ${DIRECTORY} COMMAND_ERROR_IS_FATAL ANY)
