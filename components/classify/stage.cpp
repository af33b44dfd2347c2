// SPDX-License-Identifier: Apache-2.0
#include "classify/stage.hpp"

#include <utility>

#include "classify/classify_component.hpp"
#include "classify/registry.hpp"

namespace clew::classify {
namespace {

core::Result<std::unique_ptr<runtime::Component>> make(const runtime::StageConfig& config,
                                                       const runtime::RunSetup& setup) {
  auto classifier = classifiers().make(config.part("behaviour"), setup.behaviour);
  if (!classifier.ok()) return classifier.error();
  return std::unique_ptr<runtime::Component>(
      std::make_unique<ClassifyComponent>(std::move(classifier).value()));
}

}  // namespace

const runtime::StageInfo& stage() {
  static const runtime::StageInfo info = {"classify",
                                          "tells what kind of place this is, from the scans so far",
                                          ClassifyComponent::ports(),
                                          {},
                                          {{"behaviour", false, classifiers().variants()}},
                                          [](const runtime::StageConfig&) { return 0.0; },
                                          nullptr,
                                          make};
  return info;
}

}  // namespace clew::classify
