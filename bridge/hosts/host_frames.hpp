// SPDX-License-Identifier: Apache-2.0
/// What a relay and a host say to each other, besides what they pass on of a component's line.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "line/frames.hpp"

namespace clew::bridge {

/// Frames of types below this one are a component's or its supervisor's, as they are.
enum class HostFrame : std::uint8_t {
  // from a relay
  kStart = 200,  ///< which component to start
  kAssigned,     ///< the supervisor's assignment, with the files that it names
  // from a host
  kStarted,
  kRefused,  ///< why it does not start it, and never will
  kEnded,    ///< the component has ended, and how
  // from both
  kBeat
};
constexpr FrameType frame_type(HostFrame frame) { return static_cast<FrameType>(frame); }
constexpr bool is_of_component(const Frame& frame) {
  return static_cast<std::uint8_t>(frame.type) < static_cast<std::uint8_t>(HostFrame::kStart);
}

/// Told apart are builds whose behaviours might differ.
struct StartComponent {
  std::string version;
  std::string idl_fingerprint;
  std::string run_id;  ///< no two runs have the same one, on whatever host
  std::string stage;   ///< or group
  std::int32_t domain = 0;
};

struct AssignedElsewhere {
  Assignment assignment;
  std::map<std::string, std::string> files;  ///< by the paths that the assignment has
};

struct ComponentEnd {
  std::int32_t signal = 0;  ///< that killed it, or 0
  std::int32_t status = 0;  ///< with which it exited
};

template <typename V>
void visit_fields(V& v, StartComponent& m) {
  v(m.version, m.idl_fingerprint, m.run_id, m.stage, m.domain);
}
template <typename V>
void visit_fields(V& v, AssignedElsewhere& m) {
  v(m.assignment, m.files);
}
template <typename V>
void visit_fields(V& v, ComponentEnd& m) {
  v(m.signal, m.status);
}

/// What may wait in one direction before nothing more is taken from the other.
inline constexpr std::size_t kMostRelayedBytes = std::size_t{4} << 20;

}  // namespace clew::bridge
