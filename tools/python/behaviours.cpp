// SPDX-License-Identifier: Apache-2.0
/// Behaviours that are classes in Python. A step may come from a thread without the interpreter's
/// lock. An exception in one ends the run and reaches who called it.
#include <map>
#include <memory>
#include <utility>

#include "python/module.hpp"
#include "python/situation.hpp"
#include "stages/additions.hpp"
#include "world/world.hpp"

namespace clew::python {
namespace {

/// An object of a class of the user's. Its state is what `pickle` makes of its `__dict__`.
class Behaviour {
 public:
  explicit Behaviour(py::object object) : object_(std::move(object)) {}
  Behaviour(const Behaviour&) = delete;
  Behaviour& operator=(const Behaviour&) = delete;
  ~Behaviour() {
    const py::gil_scoped_acquire locked;
    object_ = py::object();
  }

  /// Calls a method and converts what it returns, under the lock.
  template <typename Result, typename... Arguments>
  Result call(const char* method, const Arguments&... arguments) const {
    const py::gil_scoped_acquire locked;
    return object_.attr(method)(arguments...).template cast<Result>();
  }
  template <typename... Arguments>
  void tell(const char* method, const Arguments&... arguments) const {
    const py::gil_scoped_acquire locked;
    object_.attr(method)(arguments...);
  }

  void save(core::StateWriter& writer) const {
    const py::gil_scoped_acquire locked;
    const py::object pickle = py::module_::import("pickle");
    writer(pickle.attr("dumps")(object_.attr("__dict__"), 4).cast<std::string>());
  }
  void load(core::StateReader& reader) {
    std::string bytes;
    reader(bytes);
    if (!reader.ok()) return;
    const py::gil_scoped_acquire locked;
    const py::object pickle = py::module_::import("pickle");
    object_.attr("__dict__").attr("update")(pickle.attr("loads")(py::bytes(bytes)));
  }

 private:
  py::object object_;
};

/// What each kind has in common: a stage's interface on top of an object.
template <typename Interface>
class Stateful : public Interface {
 public:
  explicit Stateful(py::object object) : behaviour_(std::move(object)) {}
  void save(core::StateWriter& writer) const override { behaviour_.save(writer); }
  void load(core::StateReader& reader) override { behaviour_.load(reader); }

 protected:
  Behaviour behaviour_;
};

class PyController final : public Stateful<control::Controller> {
 public:
  using Stateful::Stateful;
  domain::Motion step(const domain::Odometry& odometry, const domain::Scan& scan,
                      const core::Vec2& target_odom) override {
    return behaviour_.call<domain::Motion>("step", odometry, scan, place_of(target_odom));
  }
};

class PyClassifier final : public Stateful<classify::Classifier> {
 public:
  using Stateful::Stateful;
  void step(const domain::Odometry& odometry, const domain::Scan& scan,
            domain::Landmark& landmark) override {
    const auto [spatial_class, run_length] =
        behaviour_.call<std::pair<std::uint8_t, std::uint32_t>>("step", odometry, scan);
    landmark.spatial_class = spatial_class;
    landmark.run_length = run_length;
  }
};

class PyPlanner final : public Stateful<plan::Planner> {
 public:
  using Stateful::Stateful;
  plan::Subgoal step(const plan::Situation& situation) override {
    std::vector<Place> subgoals;
    for (const core::Vec2& subgoal : situation.subgoals) subgoals.push_back(place_of(subgoal));
    const auto [x_m, y_m, radius_m] = behaviour_.call<std::tuple<double, double, double>>(
        "step", situation.odometry, place_of(situation.target), situation.target_radius_m,
        subgoals);
    return {{x_m, y_m}, radius_m};
  }
};

class PyDetector final : public Stateful<recover::TrapDetector> {
 public:
  using Stateful::Stateful;
  std::optional<recover::TrapEvidence> observe(const recover::Situation& situation) override {
    const auto text = behaviour_.call<std::optional<std::string>>("observe", Situation(situation));
    if (!text) return std::nullopt;
    return recover::TrapEvidence{std::nullopt, text->substr(0, domain::kMaxTextLength)};
  }
  void start_afresh() override { behaviour_.tell("start_afresh"); }
};

class PyEscape final : public Stateful<recover::Escape> {
 public:
  using Stateful::Stateful;
  void begin(const recover::Situation& situation, const recover::TrapEvidence& evidence) override {
    behaviour_.tell("begin", Situation(situation), evidence.text);
  }
  recover::EscapeStatus step(const recover::Situation& situation,
                             domain::Guidance& guidance) override {
    const auto [word, request] =
        behaviour_.call<std::pair<std::string, Request>>("_step", Situation(situation));
    fill(request, guidance);
    static const std::map<std::string, recover::EscapeStatus> kWords = {
        {"active", recover::EscapeStatus::kActive},
        {"looks_again", recover::EscapeStatus::kLooksAgain},
        {"ended", recover::EscapeStatus::kEnded},
        {"failed", recover::EscapeStatus::kFailed},
        {"unreachable", recover::EscapeStatus::kUnreachable}};
    const auto found = kWords.find(word);
    if (found == kWords.end()) {
      throw InputError("an escape returned '" + word +
                       "'; allowed: active, looks_again, ended, failed, unreachable");
    }
    return found->second;
  }

 private:
  static void fill(const Request& request, domain::Guidance& guidance) {
    if (request.target) {
      guidance.target_x_m = (*request.target)[0];
      guidance.target_y_m = (*request.target)[1];
      guidance.target_is_virtual = true;
    }
    guidance.has_override = request.motion.has_value();
    if (request.motion) guidance.override_motion = *request.motion;
    if (request.obstacles.size() > domain::kMaxVirtualObstacles) {
      throw InputError("an escape asked for more than 16 virtual obstacles");
    }
    for (const auto& box : request.obstacles) {
      guidance.virtual_obstacles.push_back({box[0], box[1], box[2], box[3]});
    }
    guidance.why = request.why.substr(0, domain::kMaxTextLength);
  }
};

class PySensor final : public sense::RangeSensor {
 public:
  PySensor(py::object object, std::string name)
      : behaviour_(std::move(object)), name_(std::move(name)) {}
  domain::ScanLayout layout() const override {
    const auto [beams, first_rad, step_rad, width_rad, range_max_m] =
        behaviour_.call<std::tuple<std::size_t, double, double, double, double>>("layout");
    return {name_, beams, first_rad, step_rad, width_rad, range_max_m};
  }
  void measure(const world::World& world, const core::Pose2& pose, double sim_time_s,
               const core::Random& random, domain::Scan& scan) const override {
    const domain::ScanLayout shape = layout();
    scan.bearing_first_rad = shape.bearing_first_rad;
    scan.bearing_step_rad = shape.bearing_step_rad;
    scan.beam_width_rad = shape.beam_width_rad;
    scan.range_max_m = shape.range_max_m;
    {
      const py::gil_scoped_acquire locked;
      // The world lives as long as the run; it is not copied.
      const py::object seen = py::cast(&world, py::return_value_policy::reference);
      scan.ranges_m = behaviour_.call<std::vector<double>>("measure", seen, pose, sim_time_s,
                                                           core::Random(random));
    }
    if (scan.ranges_m.size() != shape.beam_count) {
      throw InputError("the sensor " + name_ + " measured " + std::to_string(scan.ranges_m.size()) +
                       " ranges; its layout has " + std::to_string(shape.beam_count));
    }
  }

 private:
  Behaviour behaviour_;
  std::string name_;
};

class PyDrive final : public drive::DriveModel {
 public:
  explicit PyDrive(py::object object) : behaviour_(std::move(object)) {}
  double tick_s() const override { return behaviour_.call<double>("tick_s"); }
  domain::MotionLimits limits() const override {
    domain::MotionLimits limits;
    std::tie(limits.speed_mps, limits.turn_rate_radps) =
        behaviour_.call<std::pair<double, double>>("limits");
    return limits;
  }
  drive::Legs legs(const domain::Motion& motion, const drive::Velocities& before) const override {
    drive::Legs legs;
    const auto asked = behaviour_.call<std::vector<std::array<double, 4>>>(
        "legs", motion, before.speed_mps, before.turn_rate_radps);
    if (asked.size() > 16) throw InputError("a drive gave more than 16 legs");
    for (const auto& leg : asked) legs.push_back({leg[0], leg[1], leg[2], leg[3]});
    return legs;
  }

 private:
  Behaviour behaviour_;
};

py::dict setup_of(const domain::BehaviourSetup& setup) {
  py::dict told;
  told["tick_s"] = setup.tick_s;
  told["robot_radius_m"] = setup.robot.radius_m;
  told["sensor"] = setup.scan.sensor;
  told["beam_count"] = setup.scan.beam_count;
  told["range_max_m"] = setup.scan.range_max_m;
  return told;
}

/// A class of the user's as a line of a registry. It is never freed, as the registry is not.
template <typename Interface, typename Class, typename... More>
runtime::Registration<Interface> registered(const runtime::VariantInfo& info, py::object type,
                                            More... more) {
  auto* const kept = new py::object(std::move(type));
  return {info,
          [kept, more...](const core::ParameterValues& values, const domain::BehaviourSetup& setup)
              -> core::Result<std::unique_ptr<Interface>> {
            const py::gil_scoped_acquire locked;
            py::dict parameters;
            for (const auto& [name, value] : values) parameters[py::str(name)] = py::cast(value);
            return std::unique_ptr<Interface>(
                std::make_unique<Class>((*kept)(setup_of(setup), **parameters), more...));
          }};
}

core::ParameterInfo parameter_of(const py::tuple& declared) {
  core::ParameterInfo info;
  info.name = declared[0].cast<std::string>();
  info.default_value = declared[1].cast<core::ParameterValue>();
  info.unit = declared[2].cast<std::string>();
  if (!declared[3].is_none()) {
    const auto [low, high] = declared[3].cast<std::pair<double, double>>();
    info.range = core::Range{low, high};
  }
  info.doc = declared[4].cast<std::string>();
  info.choices = declared[5].cast<std::vector<std::string>>();
  return info;
}

void add_behaviour(const std::string& kind, const std::string& name, const std::string& summary,
                   const py::object& type, const std::vector<py::tuple>& parameters) {
  runtime::VariantInfo info{name, summary, {}, {}};
  for (const py::tuple& declared : parameters) info.parameters.push_back(parameter_of(declared));
  stages::Additions a;
  if (kind == "sensor") {
    a.sensors.push_back(registered<sense::RangeSensor, PySensor>(info, type, name));
  } else if (kind == "classifier") {
    a.classifiers.push_back(registered<classify::Classifier, PyClassifier>(info, type));
  } else if (kind == "planner") {
    a.planners.push_back(registered<plan::Planner, PyPlanner>(info, type));
  } else if (kind == "detector") {
    a.detectors.push_back(registered<recover::TrapDetector, PyDetector>(info, type));
  } else if (kind == "escape") {
    a.escapes.push_back(registered<recover::Escape, PyEscape>(info, type));
  } else if (kind == "controller") {
    a.controllers.push_back(registered<control::Controller, PyController>(info, type));
  } else if (kind == "drive") {
    a.drives.push_back(registered<drive::DriveModel, PyDrive>(info, type));
  } else {
    throw InputError("no stage takes a " + kind);
  }
  value_or_raise(stages::add(std::move(a)));
}

}  // namespace

void add_behaviours(py::module_& module) {
  module.def("add_behaviour", &add_behaviour, py::arg("kind"), py::arg("name"), py::arg("summary"),
             py::arg("type"), py::arg("parameters"));
}

}  // namespace clew::python
