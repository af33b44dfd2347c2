// SPDX-License-Identifier: Apache-2.0
#include "clew/stage_text.hpp"

namespace clew::tools {

std::string stage_text(const runtime::GraphStage& stage) {
  if (stage.deployment.ros2) return "a robot of ROS 2";
  if (!stage.deployment.exec.empty()) return "exec " + stage.deployment.exec.front();
  std::string text;
  for (const auto& [part, choices] : stage.config.parts) {
    text += (text.empty() ? "" : ", ") + part + ' ';
    if (choices.empty()) text += "none";
    for (std::size_t i = 0; i < choices.size(); ++i) {
      text += (i > 0 ? " then " : "") + choices[i].name;
    }
  }
  return text;
}

}  // namespace clew::tools
