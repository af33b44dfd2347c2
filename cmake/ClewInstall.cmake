# SPDX-License-Identifier: Apache-2.0
# What `cmake --install` installs, and what the packages of the same names hold:
#   clew         the command, the modules that it loads, its manual pages and completions, configs/, idl/
#   python3-clew the Python module
#   libclew-dev  libraries and public headers, found with find_package(clew CONFIG)
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# The program finds configs/ in the nearest share/clew above it. Here that is the source tree's.
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/share)
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/configs ${PROJECT_BINARY_DIR}/share/clew SYMBOLIC)

# Manual pages and completions are made by the command itself, from the tables that it parses with.
set(manual ${PROJECT_BINARY_DIR}/manual)
find_program(CLEW_GZIP gzip REQUIRED)
add_custom_command(
  OUTPUT ${manual}/done
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${manual}
  COMMAND ${CMAKE_COMMAND} -E make_directory ${manual}/man
  COMMAND clew manual ${manual}/man
  COMMAND sh -c "'${CLEW_GZIP}' -9n '${manual}'/man/*.1"
  COMMAND sh -c "'$<TARGET_FILE:clew>' completion bash > '${manual}/clew.bash'"
  COMMAND sh -c "'$<TARGET_FILE:clew>' completion zsh > '${manual}/_clew'"
  COMMAND ${CMAKE_COMMAND} -E touch ${manual}/done
  DEPENDS clew
  COMMENT "Manual pages and completions"
  VERBATIM)
add_custom_target(clew_manual ALL DEPENDS ${manual}/done)

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME clew)
install(TARGETS clew)
install(TARGETS clew_fastdds_module clew_cyclonedds_module clew_pictures_module clew_query_module
  LIBRARY DESTINATION ${CLEW_MODULE_DIRECTORY})
install(DIRECTORY configs/ DESTINATION ${CMAKE_INSTALL_DATADIR}/clew)
install(DIRECTORY idl/ DESTINATION ${CMAKE_INSTALL_DATADIR}/clew/idl
  FILES_MATCHING PATTERN "*.idl" PATTERN README.md PATTERN "*fingerprint*")
install(DIRECTORY ${manual}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${manual}/clew.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
  RENAME clew)
install(FILES ${manual}/_clew DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME libclew-dev)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libclew-dev USE_SOURCE_PERMISSIONS)
set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/clew)
set(libraries)
foreach(name core yaml domain world scan map runtime sense classify recover plan control drive stages
        behaviours plugin log wire recording plugins dds fastdds fastdds_profiles
        cyclonedds cyclonedds_configuration vendors security run line component recorder supervisor
        replay)
  set_target_properties(clew_${name} PROPERTIES EXPORT_NAME ${name})
  list(APPEND libraries clew_${name})
endforeach()
install(TARGETS ${libraries} EXPORT clew
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/clew
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/clew)
install(EXPORT clew FILE clewTargets.cmake NAMESPACE clew:: DESTINATION ${config_dir})
install(CODE "set(CLEW_SOURCE [[${PROJECT_SOURCE_DIR}]])
  set(CLEW_INCLUDE_DESTINATION \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}/clew\")
  include([[${PROJECT_SOURCE_DIR}/cmake/install_headers.cmake]])")
# The fingerprint of the message types, for components of someone else's.
install(FILES ${PROJECT_BINARY_DIR}/idl/include/clew/idl_fingerprint.h
  ${PROJECT_BINARY_DIR}/components/plugin/include/clew/plugin_fingerprint.h
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/clew/clew)
configure_package_config_file(cmake/clewConfig.cmake.in ${PROJECT_BINARY_DIR}/clewConfig.cmake
  INSTALL_DESTINATION ${config_dir} PATH_VARS CMAKE_INSTALL_FULL_BINDIR)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/clewConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES cmake/ClewPlugin.cmake ${PROJECT_BINARY_DIR}/clewConfig.cmake ${PROJECT_BINARY_DIR}/clewConfigVersion.cmake
  DESTINATION ${config_dir})

if(CLEW_PYTHON)
  set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME python3-clew)
  set(python_dir lib/python3/dist-packages/clew)
  install(TARGETS clew_python LIBRARY DESTINATION ${python_dir})
  install(DIRECTORY tools/python/clew/ DESTINATION ${python_dir}
    FILES_MATCHING PATTERN "*.py" PATTERN "*.pyi" PATTERN py.typed PATTERN __pycache__ EXCLUDE)
endif()

include(ClewPackages)
