# SPDX-License-Identifier: Apache-2.0
# Debian's cross compiler for aarch64, with libraries of tools/aarch64-sysroot in CLEW_SYSROOT, and
# qemu-aarch64 to run what it makes.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CLEW_SYSROOT "" CACHE PATH "Folder that tools/aarch64-sysroot has filled")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES CLEW_SYSROOT)
set(CMAKE_FIND_ROOT_PATH ${CLEW_SYSROOT})
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
foreach(what LIBRARY INCLUDE PACKAGE)
  set(CMAKE_FIND_ROOT_PATH_MODE_${what} ONLY)
endforeach()
set(ENV{PKG_CONFIG_LIBDIR} ${CLEW_SYSROOT}/usr/lib/aarch64-linux-gnu/pkgconfig)
set(ENV{PKG_CONFIG_SYSROOT_DIR} ${CLEW_SYSROOT})
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64 -L /usr/aarch64-linux-gnu)
