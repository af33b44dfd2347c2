# SPDX-License-Identifier: Apache-2.0
# Debian packages: `cpack -G DEB`, or tools/package, which builds them reproducibly.
set(packages clew libclew-dev)
if(CLEW_PYTHON)
  list(APPEND packages python3-clew)
endif()
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME clew)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "The Clew authors <clew@users.noreply.github.com>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL ${packages})
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/settle_times.cmake)

set(CPACK_COMPONENT_CLEW_DESCRIPTION "Sensor-based navigation of a mobile robot that gets trapped
Clew runs the behaviours of a mobile robot as a graph of DDS components,
in one process or in many, with the same bytes. A recording holds the
whole run and can be replayed, changed and continued.")
set(CPACK_DEBIAN_CLEW_PACKAGE_NAME clew)
set(CPACK_DEBIAN_CLEW_PACKAGE_SECTION science)
set(CPACK_DEBIAN_CLEW_PACKAGE_SHLIBDEPS ON)

set(CPACK_COMPONENT_LIBCLEW-DEV_DESCRIPTION "Sensor-based navigation of a mobile robot (development files)
Static libraries and headers of Clew's behaviours, runtime, recordings and
replay: for programs that use them, and for plug-ins of the clew command.")
set(CPACK_DEBIAN_LIBCLEW-DEV_PACKAGE_NAME libclew-dev)
set(CPACK_DEBIAN_LIBCLEW-DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBCLEW-DEV_PACKAGE_DEPENDS "clew (= ${PROJECT_VERSION}), libeigen3-dev (>= 3.4), libfmt-dev (>= 9), libspdlog-dev (>= 1.10), nlohmann-json3-dev, libssl-dev, libtinyxml2-dev, libyaml-cpp-dev, nettle-dev, libxxhash-dev, libzstd-dev, liblz4-dev, zlib1g-dev, pkg-config, libelf-dev, libfastrtps-dev, cyclonedds-dev")

set(CPACK_COMPONENT_PYTHON3-CLEW_DESCRIPTION "Sensor-based navigation of a mobile robot (Python module)
Runs Clew's graphs in Python, reads recordings as NumPy arrays, and takes
behaviours that are written in Python.")
set(CPACK_DEBIAN_PYTHON3-CLEW_PACKAGE_NAME python3-clew)
set(CPACK_DEBIAN_PYTHON3-CLEW_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON3-CLEW_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON3-CLEW_PACKAGE_DEPENDS
  "clew (= ${PROJECT_VERSION}), python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
set(CPACK_DEBIAN_PYTHON3-CLEW_PACKAGE_SUGGESTS python3-pandas)

# Each package has its licence and its change log.
file(WRITE ${PROJECT_BINARY_DIR}/packaging/copyright
"Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: clew

Files: *
Copyright: 2026 The Clew authors
License: Apache-2.0
 On Debian systems, the full text of the Apache License 2.0 is in
 /usr/share/common-licenses/Apache-2.0.
")
file(WRITE ${PROJECT_BINARY_DIR}/packaging/changelog
"clew (${PROJECT_VERSION}) bookworm; urgency=medium

  * Release ${PROJECT_VERSION}.

 -- The Clew authors <clew@users.noreply.github.com>  Sat, 28 Nov 2026 00:00:00 +0000
")
execute_process(COMMAND ${CLEW_GZIP} -9nf ${PROJECT_BINARY_DIR}/packaging/changelog)
foreach(package IN LISTS packages)
  install(FILES ${PROJECT_BINARY_DIR}/packaging/copyright
    ${PROJECT_BINARY_DIR}/packaging/changelog.gz
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${package})
endforeach()
include(CPack)
