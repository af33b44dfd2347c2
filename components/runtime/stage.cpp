// SPDX-License-Identifier: Apache-2.0
#include "runtime/stage.hpp"

namespace clew::runtime {

const PartChoice& StageConfig::part(const std::string& name) const {
  const auto found = parts.find(name);
  CLEW_CHECK(found != parts.end() && found->second.size() == 1,
             stage + " has not exactly one " + name);
  return found->second.front();
}

}  // namespace clew::runtime
