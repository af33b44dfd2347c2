// SPDX-License-Identifier: Apache-2.0
#include "core/shared_library.hpp"

#include <dlfcn.h>

namespace clew::core {
namespace {

/// The linker's own words begin with the name of the file.
Error linker_error() {
  const char* const why = ::dlerror();
  return {std::string("cannot be loaded: ") + (why == nullptr ? "unknown reason" : why)};
}

}  // namespace

Result<SharedLibrary> SharedLibrary::load(const std::string& name) {
  // Lazy, since most of what a large library could call is never called. Our own modules are linked
  // to be bound at once, so that one which lacks a symbol is refused here and not in a run.
  void* const handle = ::dlopen(name.c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (handle == nullptr) return linker_error();
  return SharedLibrary(handle, name);
}

Result<void*> SharedLibrary::find(const std::string& symbol) const {
  void* const address = ::dlsym(handle_, symbol.c_str());
  if (address == nullptr) return linker_error();
  return address;
}

}  // namespace clew::core
