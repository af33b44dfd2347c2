// SPDX-License-Identifier: Apache-2.0
#include "classify/classify_component.hpp"

#include <utility>

namespace clew::classify {

using domain::Topic;

std::vector<runtime::PortInfo> ClassifyComponent::ports() {
  return {runtime::required_input(Topic::kScan, "what is around"),
          runtime::required_input(Topic::kOdometry, "where the robot believes it is"),
          runtime::output(Topic::kLandmark, "the spatial class, and landmarks recognised")};
}

ClassifyComponent::ClassifyComponent(std::unique_ptr<Classifier> classifier)
    : classifier_(std::move(classifier)) {}

void ClassifyComponent::step(const runtime::TickInputs& inputs, runtime::TickOutputs& outputs) {
  classifier_->step(inputs.get<domain::Odometry>(), inputs.get<domain::Scan>(),
                    outputs.get<domain::Landmark>());
}

}  // namespace clew::classify
