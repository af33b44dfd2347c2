// SPDX-License-Identifier: Apache-2.0
/// What binds every behaviour of every stage, ours and those of plug-ins.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "contract/mission.hpp"
#include "core/result.hpp"
#include "runtime/config_source.hpp"
#include "runtime/plugin_list.hpp"

namespace clew::contract {

/// A behaviour under trial, in a graph in which it fits.
struct Subject {
  runtime::BehaviourName behaviour;
  std::string graph;
  const runtime::ConfigPath* configs = nullptr;

  /// `recover.detector=none`, as --with takes it.
  std::string choice() const {
    return behaviour.stage + '.' + behaviour.part + '=' + behaviour.name;
  }
};

/// The first of the shipped graphs, the fullest one before all others, in which the behaviour fits.
/// The error is that of the fullest.
core::Result<Subject> find_graph(const runtime::BehaviourName& behaviour,
                                 const runtime::ConfigPath& configs);

/// A run of the subject in a world with a trap, with errors of sensor and odometry.
core::Result<Mission> mission(const Subject& subject);

/// A rule, and what is wrong with a behaviour that breaks it.
struct Rule {
  std::string name;
  std::string about;
  std::function<core::Result<void>(const Subject&)> check;
};

/// Summary, documents, units, defaults within their ranges.
core::Result<void> check_declarations(const Subject& subject);
/// Two runs of the same inputs give the same samples.
core::Result<void> check_determinism(const Subject& subject);
/// A run that is saved and loaded at any tick goes on as if it had not been.
core::Result<void> check_save_and_load(const Subject& subject);
/// All samples keep the rules of their fields, with noise and drift.
core::Result<void> check_bounds(const Subject& subject);
/// The same with scans that a broken sensor gives: nothing, everything at once, only the surface.
core::Result<void> check_bad_scans(const Subject& subject);
/// At both ends of the range of each number it works, or is refused.
core::Result<void> check_parameter_ranges(const Subject& subject);

/// What it tells of its inside at any tick is finite, with each name once, is the same after save
/// and load, and asking for it changes nothing.
core::Result<void> check_insides(const Subject& subject);
/// It tells something of its own at each tick at which it was at work, and was at work at some; a
/// detector tells how near it is to an alarm. That binds our own behaviours; those of plug-ins may
/// keep silent.
core::Result<void> check_tells(const Subject& subject);

/// All that bind behaviours of plug-ins, too.
const std::vector<Rule>& rules();

}  // namespace clew::contract
