// SPDX-License-Identifier: Apache-2.0
#include "python/module.hpp"

#include <dlfcn.h>

#include "plugins/plugin_loader.hpp"
#include "runtime/plugin_list.hpp"

namespace clew::python {
namespace {

void load_plugin(const std::string& name) {
  const std::string path = value_or_raise(bridge::find_plugin_file(name, module_roots()));
  raise_if_error(bridge::load_plugin(path));
}

std::vector<std::string> names(const std::string& folder) {
  return runtime::ConfigPath(module_roots()).names(folder);
}

}  // namespace

std::vector<std::string> module_roots() {
  // The interpreter's own path says nothing; the module lies within the installation.
  Dl_info info{};
  ::dladdr(reinterpret_cast<const void*>(&module_roots), &info);
  return runtime::config_roots(info.dli_fname);
}

py::object to_python(const bridge::FieldValue& value) {
  return std::visit([](const auto& v) -> py::object { return py::cast(v); }, value);
}

}  // namespace clew::python

PYBIND11_MODULE(_clew, module) {
  using namespace clew::python;
  module.doc() = "Clew's graphs, runs and recordings. Use the package clew.";
  py::register_exception<InputError>(module, "InputError", PyExc_ValueError);
  module.def("load_plugin", &load_plugin, py::arg("name"));
  module.def("names", &names, py::arg("folder"));
  add_conversions(module);
  add_behaviours(module);
  add_runs(module);
  add_recordings(module);
}
