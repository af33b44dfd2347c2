// SPDX-License-Identifier: Apache-2.0
#include "runtime/stage.hpp"

#include <algorithm>

namespace clew::runtime {

const PartChoice& StageConfig::part(const std::string& name) const {
  const auto found = parts.find(name);
  CLEW_CHECK(found != parts.end() && found->second.size() == 1,
             stage + " has not exactly one " + name);
  return found->second.front();
}

std::string writer_of(Topic topic, const std::vector<StageInfo>& stages) {
  for (const StageInfo& stage : stages) {
    const bool writes = std::any_of(stage.ports.begin(), stage.ports.end(), [&](const auto& port) {
      return port.direction == PortInfo::Direction::kOutput && port.topic == topic;
    });
    if (writes) return stage.name;
  }
  return "stage that writes " + std::string(domain::topic_name(topic));
}

const VariantInfo* PartInfo::find(const std::string& wanted) const {
  for (const VariantInfo& variant : variants) {
    if (variant.name == wanted) return &variant;
  }
  return nullptr;
}

}  // namespace clew::runtime
