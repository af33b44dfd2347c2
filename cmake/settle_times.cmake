# SPDX-License-Identifier: Apache-2.0
# Run by cpack before it packs: all files get the time SOURCE_DATE_EPOCH, so that the same sources
# give the same packages.
if(DEFINED ENV{SOURCE_DATE_EPOCH})
  execute_process(COMMAND find ${CPACK_TEMPORARY_DIRECTORY} -exec touch -h -d
    "@$ENV{SOURCE_DATE_EPOCH}" {} + COMMAND_ERROR_IS_FATAL ANY)
endif()
