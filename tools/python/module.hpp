// SPDX-License-Identifier: Apache-2.0
/// The parts of the Python module `clew._clew`, and what they have in common.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "core/result.hpp"
#include "runtime/run_plan.hpp"
#include "wire/field_list.hpp"

namespace clew::python {

namespace py = pybind11;

/// Bad input, as Python raises it: `clew.InputError`, a ValueError.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The value, or the error as an exception.
template <typename T>
T value_or_raise(core::Result<T> result) {
  if (!result.ok()) throw InputError(result.error().text());
  return std::move(result).value();
}
inline void raise_if_error(const core::Result<void>& result) {
  if (!result.ok()) throw InputError(result.error().text());
}

/// Where the module finds what is installed with it, and CLEW_PATH.
std::vector<std::string> module_roots();

/// What a run is made of, as Python says it.
struct RunRequest {
  std::string graph;
  runtime::GraphOverrides overrides;
  std::string world_text;  ///< of a world that is no file; empty: overrides.world counts
};
runtime::RunPlan plan_of(const RunRequest& request);

/// A value of a message as a Python object.
py::object to_python(const bridge::FieldValue& value);

void add_conversions(py::module_& module);
void add_behaviours(py::module_& module);
void add_runs(py::module_& module);
void add_recordings(py::module_& module);

}  // namespace clew::python
