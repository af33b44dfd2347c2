// SPDX-License-Identifier: Apache-2.0
/// Runs in this process: to the end, or tick by tick.
#include <memory>
#include <optional>
#include <utility>

#include "contract/mission.hpp"
#include "python/module.hpp"
#include "python/run_result.hpp"
#include "recorder/recording_sink.hpp"
#include "stages/all.hpp"
#include "wire/codec.hpp"

namespace clew::python {
namespace {

/// Files, and one world that is none.
class WithWorld : public runtime::ConfigSource {
 public:
  WithWorld(runtime::ConfigPath files, std::string world)
      : files_(std::move(files)), world_(std::move(world)) {}
  core::Result<core::Resource> find(const std::string& folder,
                                    const std::string& name) const override {
    if (folder == "worlds" && !world_.empty()) return core::Resource{"world", world_};
    return files_.find(folder, name);
  }

 private:
  runtime::ConfigPath files_;
  std::string world_;
};

RunResult run(const RunRequest& request, const std::string& recording, bool force, bool hash) {
  runtime::RunPlan plan = plan_of(request);
  std::unique_ptr<bridge::RecordingSink> file;
  if (!recording.empty()) {
    file =
        value_or_raise(bridge::RecordingSink::create(bridge::describe_run(plan), recording, force));
  }
  return run_to_end(plan, std::nullopt, std::move(file), hash);
}

/// A run that Python steps.
class Simulation {
 public:
  explicit Simulation(const RunRequest& request)
      : mission_(value_or_raise(contract::Mission::create(plan_of(request)))) {}

  /// Steps until `ticks` more are done or the run is over; returns whether it goes on.
  bool step(std::uint64_t ticks) {
    const py::gil_scoped_release released;
    for (std::uint64_t i = 0; i < ticks && !mission_.over(); ++i) mission_.step();
    return !mission_.over();
  }

  bool over() const { return mission_.over(); }
  std::uint64_t ticks() const { return mission_.next_tick(); }

  /// The last sample of a topic: paths and values.
  py::list fields(const std::string& topic) const {
    const auto found = domain::topic_from_name(topic);
    if (!found || !mission_.topics()[domain::index_of(*found)]) {
      throw py::key_error("this run has no topic '" + topic + "'");
    }
    py::list list;
    domain::visit_topic(*found, [&](auto constant) {
      const auto& message = std::get<decltype(constant)::kIndex>(mission_.messages());
      for (const bridge::Field& field : bridge::fields_of(message)) {
        list.append(py::make_tuple(field.path, to_python(field.value)));
      }
    });
    return list;
  }

  std::vector<std::string> topics() const {
    std::vector<std::string> names;
    for (const domain::Topic topic : domain::kAllTopics) {
      if (mission_.topics()[domain::index_of(topic)]) names.emplace_back(domain::topic_name(topic));
    }
    return names;
  }

  py::bytes save() const {
    const auto saved = mission_.save();
    core::StateWriter writer;
    std::vector<std::string> messages;
    for (const domain::Topic topic : domain::kAllTopics) {
      std::vector<char> buffer;
      domain::visit_topic(topic, [&](auto constant) {
        const auto bytes =
            bridge::encode(&std::get<decltype(constant)::kIndex>(saved.messages), buffer);
        messages.emplace_back(bytes);
      });
    }
    writer(saved.nodes, messages, saved.next_tick);
    return py::bytes(writer.take());
  }

  void load(const std::string& bytes) {
    contract::Mission::Saved saved;
    std::vector<std::string> messages;
    core::StateReader reader(bytes);
    reader(saved.nodes, messages, saved.next_tick);
    if (!reader.complete() || messages.size() != domain::kTopicCount) {
      throw InputError("these are no saved states of a run");
    }
    for (const domain::Topic topic : domain::kAllTopics) {
      domain::visit_topic(topic, [&](auto constant) {
        constexpr auto kIndex = decltype(constant)::kIndex;
        raise_if_error(bridge::decode(messages[kIndex], &std::get<kIndex>(saved.messages),
                                      bridge::Values::kAny));
      });
    }
    raise_if_error(mission_.load(saved));
  }

 private:
  contract::Mission mission_;
};

}  // namespace

runtime::RunPlan plan_of(const RunRequest& request) {
  const WithWorld source(runtime::ConfigPath(module_roots()), request.world_text);
  return value_or_raise(
      runtime::prepare_run(request.graph, request.overrides, source, stages::all()));
}

void add_runs(py::module_& module) {
  py::class_<RunRequest>(module, "RunRequest")
      .def(py::init([](std::string graph, std::optional<std::string> world, std::string world_text,
                       std::optional<std::string> robot, std::vector<std::string> with,
                       std::vector<std::string> set, std::optional<std::uint64_t> seed,
                       std::optional<std::uint64_t> max_ticks) {
             RunRequest request{std::move(graph), {}, std::move(world_text)};
             request.overrides = {
                 std::move(world), std::move(robot), std::move(with), std::move(set), seed,
                 max_ticks};
             return request;
           }),
           py::arg("graph"), py::arg("world"), py::arg("world_text"), py::arg("robot"),
           py::arg("with_"), py::arg("set"), py::arg("seed"), py::arg("max_ticks"));
  py::class_<RunResult>(module, "RunResult")
      .def_readonly("outcome", &RunResult::outcome)
      .def_readonly("ticks", &RunResult::ticks)
      .def_readonly("sim_time_s", &RunResult::sim_time_s)
      .def_readonly("path_length_m", &RunResult::path_length_m)
      .def_readonly("shortest_path_m", &RunResult::shortest_path_m)
      .def_readonly("collisions", &RunResult::collisions)
      .def_readonly("ticks_per_s", &RunResult::ticks_per_s)
      .def_readonly("hash", &RunResult::hash)
      .def_property_readonly("trajectory", [](const RunResult& r) {
        return py::array_t<double>({r.poses.size() / 3, std::size_t{3}}, r.poses.data());
      });
  module.def("run", &run, py::arg("request"), py::arg("recording"), py::arg("force"),
             py::arg("hash"));
  py::class_<Simulation>(module, "Simulation")
      .def(py::init<const RunRequest&>())
      .def("step", &Simulation::step, py::arg("ticks"))
      .def("fields", &Simulation::fields, py::arg("topic"))
      .def("topics", &Simulation::topics)
      .def("save", &Simulation::save)
      .def("load", &Simulation::load, py::arg("state"))
      .def_property_readonly("over", &Simulation::over)
      .def_property_readonly("ticks", &Simulation::ticks);
}

}  // namespace clew::python
