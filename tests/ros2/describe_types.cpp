// SPDX-License-Identifier: Apache-2.0
/// Prints what Clew says of the types of ROS 2 that it uses, for oracles.mjs: a JSON object a line
/// with name, hash, canonical JSON and definition.
#include <cstdio>
#include <nlohmann/json.hpp>

#include "ros2/message_type.hpp"

namespace clew::ros2 {
namespace {

template <typename Message>
void print() {
  const TypeDescription description = describe_type<Message>();
  const MessageType& type = message_type<Message>();
  const nlohmann::json json = {{"name", type.name},
                               {"dds_name", type.dds_name},
                               {"hash", type.hash},
                               {"description", canonical_json(description)},
                               {"definition", type.definition}};
  std::printf("%s\n", json.dump().c_str());
}

}  // namespace
}  // namespace clew::ros2

int main() {
  using namespace clew::ros2;
  print<Time>();
  print<Header>();
  print<Clock>();
  print<LaserScan>();
  print<Odometry>();
  print<OccupancyGrid>();
  print<Path>();
  print<PoseStamped>();
  print<Twist>();
  print<TwistStamped>();
  print<TFMessage>();
  print<DiagnosticArray>();
  print<Log>();
  print<MarkerArray>();
  print<ParticipantEntitiesInfo<16>>();
  return 0;
}
