// SPDX-License-Identifier: Apache-2.0
/// A plug-in is a shared library that adds behaviours to the stages of clew:
///
///     #include "plugin/plugin.hpp"
///
///     class Stagnation final : public clew::recover::TrapDetector { ... };
///
///     CLEW_PLUGIN("stagnation", "1.0") {
///       plugin.detector<Stagnation>("stagnation", "the robot has not come nearer for a while");
///     }
///
/// A behaviour is a class as ours are: it implements its stage's interface, has a struct
/// `Parameters` with visit_parameters, and
///
///     static core::Result<std::unique_ptr<Class>> create(const Parameters&,
///                                                        const domain::BehaviourSetup&);
///
/// `clew new` writes such a project, `clew check-plugin` tells whether it keeps the rules that ours
/// keep. A plug-in links what it uses of Clew statically (clew_add_plugin of find_package(clew)
/// sees to that) and shares only plain values and the interfaces with the program that loads it.
#pragma once

#include <string>
#include <utility>

#include "plugin/descriptor.hpp"
#include "stages/additions.hpp"

namespace clew::plugin {

/// Takes the behaviours of a plug-in.
class Plugin {
 public:
  explicit Plugin(stages::Additions& additions) : additions_(additions) {}

  template <typename Class>
  void sensor(std::string name, std::string summary) {
    put<Class>(additions_.sensors, std::move(name), std::move(summary), {});
  }
  template <typename Class>
  void classifier(std::string name, std::string summary) {
    put<Class>(additions_.classifiers, std::move(name), std::move(summary), {});
  }
  template <typename Class>
  void planner(std::string name, std::string summary) {
    put<Class>(additions_.planners, std::move(name), std::move(summary), {});
  }
  /// `needs`: optional inputs of *recover* that it cannot do without.
  template <typename Class>
  void detector(std::string name, std::string summary, runtime::TopicSet needs = {}) {
    put<Class>(additions_.detectors, std::move(name), std::move(summary), needs);
  }
  template <typename Class>
  void escape(std::string name, std::string summary, runtime::TopicSet needs = {}) {
    put<Class>(additions_.escapes, std::move(name), std::move(summary), needs);
  }
  template <typename Class>
  void controller(std::string name, std::string summary) {
    put<Class>(additions_.controllers, std::move(name), std::move(summary), {});
  }
  template <typename Class>
  void drive(std::string name, std::string summary) {
    put<Class>(additions_.drives, std::move(name), std::move(summary), {});
  }

 private:
  template <typename Class, typename Behaviour>
  static void put(std::vector<runtime::Registration<Behaviour>>& list, std::string name,
                  std::string summary, runtime::TopicSet needs) {
    list.push_back(
        runtime::registration<Behaviour, Class>(std::move(name), std::move(summary), needs));
  }

  stages::Additions& additions_;
};

}  // namespace clew::plugin

/// Begins the one function of a plug-in: what follows is its body, in which `plugin` takes the
/// behaviours. `name` and `version` are literals of a-z, 0-9, `_`, `-` and `.`.
#define CLEW_PLUGIN(name, version)                                                    \
  __attribute__((section(".note.clew"), used,                                         \
                 aligned(4))) static constexpr ::clew::plugin::Note kClewPluginNote = \
      ::clew::plugin::make_note(name, version);                                       \
  static void clew_plugin_behaviours(::clew::plugin::Plugin& plugin);                 \
  extern "C" __attribute__((visibility("default"))) void clew_plugin_add(             \
      ::clew::stages::Additions* additions) {                                         \
    ::clew::plugin::Plugin plugin(*additions);                                        \
    clew_plugin_behaviours(plugin);                                                   \
  }                                                                                   \
  static void clew_plugin_behaviours([[maybe_unused]] ::clew::plugin::Plugin& plugin)
