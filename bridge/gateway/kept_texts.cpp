// SPDX-License-Identifier: Apache-2.0
#include "gateway/kept_texts.hpp"

namespace clew::bridge {

KeptTexts::Texts KeptTexts::operator()(const RunDescription& description,
                                       const std::vector<domain::Intervention>& changes) {
  std::vector<std::uint64_t> ticks;
  for (const domain::Intervention& each : changes) ticks.push_back(each.tick);
  const auto known = kept_.find(ticks);
  if (known != kept_.end()) return known->second;
  Texts texts = make_(description, changes);
  if (kept_.size() == kMostKept) kept_.clear();
  kept_.emplace(std::move(ticks), texts);
  return texts;
}

}  // namespace clew::bridge
