// SPDX-License-Identifier: Apache-2.0
/// Recordings: as columns, replayed, compared, continued.
#include <csignal>
#include <map>
#include <utility>

#include "python/module.hpp"
#include "python/run_result.hpp"
#include "recording/run_recording.hpp"
#include "replay/branch.hpp"
#include "replay/component_replay.hpp"
#include "replay/recorded_plan.hpp"
#include "replay/recording_diff.hpp"
#include "stages/all.hpp"
#include "world/world.hpp"

namespace clew::python {
namespace {

using bridge::RunRecording;

constexpr const char* kOutcomes[] = {"running", "reached", "collided", "unreachable", "timeout"};

/// The values of one field over all samples of a topic; a sample that lacks it has None.
struct Column {
  std::vector<bridge::FieldValue> values;
  std::vector<std::size_t> samples;  ///< which sample each is of
};

py::object to_array(const Column& column, std::size_t samples) {
  const bool complete = column.values.size() == samples;
  const bool numbers = std::holds_alternative<double>(column.values.front());
  if (numbers) {
    py::array_t<double> array(static_cast<py::ssize_t>(samples));
    double* const data = array.mutable_data();
    std::fill(data, data + samples, std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < column.values.size(); ++i) {
      data[column.samples[i]] = std::get<double>(column.values[i]);
    }
    return array;
  }
  py::list list;
  std::size_t next = 0;
  for (std::size_t sample = 0; sample < samples; ++sample) {
    const bool has = next < column.samples.size() && column.samples[next] == sample;
    list.append(has ? to_python(column.values[next++]) : py::none());
  }
  const py::object numpy = py::module_::import("numpy");
  const bool texts = !std::holds_alternative<bool>(column.values.front()) &&
                     !std::holds_alternative<std::uint64_t>(column.values.front());
  if (complete && !texts) return numpy.attr("array")(list);
  return numpy.attr("array")(list, py::arg("dtype") = "object");
}

/// The columns of a topic, in the order of idl/.
py::list columns(const RunRecording& recording, const std::string& topic_name) {
  const auto topic = domain::topic_from_name(topic_name);
  if (!topic || recording.description().schemas.count(*topic) == 0) {
    throw py::key_error("this recording has no topic '" + topic_name + "'");
  }
  std::vector<std::string> order;
  std::map<std::string, Column> found;
  std::size_t samples = 0;
  domain::Messages messages;
  auto stream = recording.samples({{*topic}});
  while (const auto sample = value_or_raise(stream.next())) {
    domain::visit_topic(*topic, [&](auto constant) {
      auto& message = std::get<decltype(constant)::kIndex>(messages);
      raise_if_error(bridge::decode(sample->cdr, &message, bridge::Values::kAny));
      for (bridge::Field& field : bridge::fields_of(message)) {
        Column& column = found[field.path];
        if (column.values.empty()) order.push_back(field.path);
        column.values.push_back(std::move(field.value));
        column.samples.push_back(samples);
      }
    });
    ++samples;
  }
  py::list list;
  for (const std::string& path : order) {
    list.append(py::make_tuple(path, to_array(found.at(path), samples)));
  }
  return list;
}

std::vector<std::string> topics(const RunRecording& recording) {
  std::vector<std::string> names;
  for (const auto& [topic, schema] : recording.description().schemas) {
    names.emplace_back(domain::topic_name(topic));
  }
  return names;
}

runtime::RunPlan changed(const RunRecording& recording, const runtime::GraphOverrides& overrides) {
  return value_or_raise(bridge::changed_plan(recording, overrides,
                                             runtime::ConfigPath(module_roots()), stages::all()));
}

py::object difference(const std::optional<bridge::SampleDifference>& first) {
  if (!first) return py::none();
  const auto value = [](const std::optional<bridge::FieldValue>& v) {
    return v ? to_python(*v) : py::object(py::none());
  };
  py::dict found;
  found["topic"] = std::string(domain::topic_name(first->topic));
  found["tick"] = first->tick;
  found["field"] = first->fields.front().path;
  found["a"] = value(first->fields.front().a);
  found["b"] = value(first->fields.front().b);
  return found;
}

/// Feeds each stage, or one, what is recorded, and compares.
py::list replay(const RunRecording& recording, const std::string& component,
                std::vector<std::string> with, std::vector<std::string> set) {
  const auto recorded = value_or_raise(bridge::recorded_plan(recording, stages::all()));
  runtime::GraphOverrides overrides;
  overrides.with = std::move(with);
  overrides.set = std::move(set);
  runtime::RunPlan plan = changed(recording, overrides);
  // Scans have the arrangement that they had, whatever sense would make of them now.
  plan.setup.behaviour.scan = recorded.setup.behaviour.scan;
  py::list reports;
  for (const auto& stage : plan.graph.stages) {
    if (!component.empty() ? stage.info->name != component : !stage.deployment.is_ours()) {
      continue;
    }
    const auto report = [&] {
      const py::gil_scoped_release released;
      return bridge::replay_component(recording, plan, stage.info->name);
    }();
    const auto& good = value_or_raise(report);
    py::dict told;
    told["component"] = good.component;
    told["ticks"] = good.ticks;
    told["identical"] = good.identical();
    told["first_difference"] = difference(good.first);
    told["ticks_per_s"] = good.ticks_per_s;
    reports.append(told);
  }
  if (reports.empty()) throw InputError("the recording has no stage '" + component + "'");
  return reports;
}

py::dict diff(const RunRecording& a, const RunRecording& b, double tolerance) {
  const auto found = value_or_raise(bridge::diff_recordings(a, b, tolerance));
  py::dict told;
  told["identical"] = found.identical();
  told["first_difference"] = difference(found.first);
  return told;
}

RunResult branch(const RunRecording& recording, std::uint64_t tick, std::vector<std::string> with,
                 std::vector<std::string> set, std::optional<std::uint64_t> max_ticks) {
  const auto recorded = value_or_raise(bridge::recorded_plan(recording, stages::all()));
  runtime::GraphOverrides overrides;
  overrides.with = std::move(with);
  overrides.set = std::move(set);
  overrides.max_ticks = max_ticks;
  const runtime::RunPlan plan = changed(recording, overrides);
  const auto unfaithful = value_or_raise(bridge::find_unfaithful(recording, recorded, tick));
  if (unfaithful) {
    throw InputError(unfaithful->component + " does not do what is recorded, from tick " +
                     std::to_string(unfaithful->first->tick) + " on: there is no branch later");
  }
  auto start = value_or_raise(bridge::branch_off(recording, recorded, plan, tick));
  return run_to_end(plan, std::move(start), nullptr, true);
}

py::dict world(const std::string& text, const std::string& file) {
  const auto parsed = value_or_raise(world::World::parse(text, file));
  py::dict told;
  told["name"] = parsed.name();
  told["start"] =
      py::make_tuple(parsed.start().x_m, parsed.start().y_m, parsed.start().heading_rad);
  told["target"] = py::make_tuple(parsed.target().x(), parsed.target().y());
  told["target_radius_m"] = parsed.target_radius_m();
  told["bounds"] = py::make_tuple(parsed.bounds_min().x(), parsed.bounds_min().y(),
                                  parsed.bounds_max().x(), parsed.bounds_max().y());
  told["shortest_path_m"] = parsed.shortest_path_m();
  return told;
}

py::tuple find_file(const std::string& folder, const std::string& name) {
  const auto file = value_or_raise(runtime::ConfigPath(module_roots()).find(folder, name));
  return py::make_tuple(file.file, file.text);
}

}  // namespace

RunResult run_to_end(const runtime::RunPlan& plan, std::optional<bridge::ComposedStart> start,
                     std::unique_ptr<bridge::RecordingSink> file, bool hash) {
  RunResult result;
  PathSink sink(file.get(), result.poses);
  bridge::ComposedLayout layout;
  layout.hash = hash;
  const auto report = value_or_raise([&] {
    const py::gil_scoped_release released;
    return start ? bridge::run_composed(plan, std::move(*start), layout, &sink, nullptr)
                 : bridge::run_composed(plan, layout, &sink, nullptr);
  }());
  if (file) {
    const std::string what = bridge::complaint(file->close({report.aborted, false}));
    if (!what.empty()) throw InputError(what);
  }
  if (report.interrupted_by == SIGINT) {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
    throw py::error_already_set();
  }
  const bridge::RunTruth truth = report.statistics.truth.value_or(bridge::RunTruth{});
  result.outcome =
      report.aborted.empty() ? kOutcomes[static_cast<std::size_t>(truth.outcome)] : "aborted";
  result.ticks = truth.tick;
  result.sim_time_s = truth.sim_time_s;
  result.path_length_m = truth.path_length_m;
  result.shortest_path_m = plan.setup.world->shortest_path_m();
  result.collisions = truth.collisions;
  result.ticks_per_s = report.ticks_per_s;
  if (report.hash) result.hash = report.hash->hex();
  return result;
}

void add_recordings(py::module_& module) {
  py::class_<RunRecording>(module, "RunRecording")
      .def_static(
          "open", [](const std::string& path) { return value_or_raise(RunRecording::open(path)); },
          py::arg("path"))
      .def("columns", &columns, py::arg("topic"))
      .def("topics", &topics)
      .def("hash", [](const RunRecording& r) { return value_or_raise(r.survey()).hash.hex(); })
      .def_property_readonly("files", [](const RunRecording& r) { return r.description().bundle; })
      .def_property_readonly("tick_s", [](const RunRecording& r) { return r.description().tick_s; })
      .def_property_readonly("seed", [](const RunRecording& r) { return r.description().seed; })
      .def_property_readonly("complete", &RunRecording::complete);
  module.def("replay", &replay, py::arg("recording"), py::arg("component"), py::arg("with_"),
             py::arg("set"));
  module.def("diff", &diff, py::arg("a"), py::arg("b"), py::arg("tolerance"));
  module.def("branch", &branch, py::arg("recording"), py::arg("tick"), py::arg("with_"),
             py::arg("set"), py::arg("max_ticks"));
  module.def("world", &world, py::arg("text"), py::arg("file"));
  module.def("find_file", &find_file, py::arg("folder"), py::arg("name"));
}

}  // namespace clew::python
