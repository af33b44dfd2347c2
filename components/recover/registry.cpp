// SPDX-License-Identifier: Apache-2.0
#include "recover/registry.hpp"

#include "recover/landmark_revisit.hpp"
#include "recover/no_recovery.hpp"
#include "recover/obstacle_following.hpp"

namespace clew::recover {

const runtime::Registry<TrapDetector>& detectors() {
  static const runtime::TopicSet landmark =
      runtime::TopicSet().set(static_cast<std::size_t>(domain::Topic::kLandmark));
  static const runtime::Registry<TrapDetector> registry = {
      runtime::registration<TrapDetector, LandmarkRevisit>(
          "landmark_revisit",
          "the same landmark at the same place: distant memory (Krishna & Kalra 2000, section 4.3)",
          landmark),
      runtime::registration<TrapDetector, NoDetector>("none", "never says trap"),
  };
  return registry;
}

const runtime::Registry<Escape>& escapes() {
  static const runtime::Registry<Escape> registry = {
      runtime::registration<Escape, ObstacleFollowing>(
          "obstacle_following",
          "the four cases of the distant memory's action space (Krishna & Kalra 2000, section "
          "4.3)"),
      runtime::registration<Escape, NoEscape>("none", "lets the robot go on seeking"),
  };
  return registry;
}

}  // namespace clew::recover
