// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "classify/classifier.hpp"
#include "control/controller.hpp"
#include "core/result.hpp"
#include "drive/drive_model.hpp"
#include "plan/planner.hpp"
#include "recover/detectors/trap_detector.hpp"
#include "recover/escapes/escape.hpp"
#include "runtime/plugin_list.hpp"
#include "runtime/registry.hpp"
#include "sense/range_sensor.hpp"

namespace clew::stages {

/// Behaviours from outside, for any stage.
struct Additions {
  std::vector<runtime::Registration<sense::RangeSensor>> sensors;
  std::vector<runtime::Registration<classify::Classifier>> classifiers;
  std::vector<runtime::Registration<plan::Planner>> planners;
  std::vector<runtime::Registration<recover::TrapDetector>> detectors;
  std::vector<runtime::Registration<recover::Escape>> escapes;
  std::vector<runtime::Registration<control::Controller>> controllers;
  std::vector<runtime::Registration<drive::DriveModel>> drives;
};

/// Puts them behind the behaviours that there are, for the rest of the process: all() has them
/// then, too. Returns where they stand. Refused: a name that is taken; those before it stay.
core::Result<std::vector<runtime::BehaviourName>> add(Additions additions);

}  // namespace clew::stages
