// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "core/result.hpp"

namespace clew::core {

/// A shared library that is loaded when it is needed. It stays until the process ends, since what
/// it made may live as long.
class SharedLibrary {
 public:
  /// Loads `name`: the name of a file along the program's run path, or a path. The error is what
  /// the dynamic linker says. Its symbols are seen by nobody else.
  static Result<SharedLibrary> load(const std::string& name);

  /// The function that the library exports as `name`, declared there as
  /// `extern "C" Function name;`.
  template <typename Function>
  Result<std::function<Function>> function(const std::string& name) const {
    const Result<void*> address = find(name);
    if (!address.ok()) return address.error();
    return std::function<Function>(reinterpret_cast<Function*>(*address));
  }

 private:
  SharedLibrary(void* handle, std::string name) : handle_(handle), name_(std::move(name)) {}
  Result<void*> find(const std::string& symbol) const;

  void* handle_;  // never closed
  std::string name_;
};

}  // namespace clew::core
