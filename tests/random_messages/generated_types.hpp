// SPDX-License-Identifier: Apache-2.0
/// What both vendors' generators make of the topics' types in idl/.
#pragma once

#include <Command.h>
#include <Event.h>
#include <Guidance.h>
#include <Landmark.h>
#include <Odometry.h>
#include <Scan.h>
#include <State.h>
#include <Target.h>
#include <clew/msg/Command.h>
#include <clew/msg/Event.h>
#include <clew/msg/Guidance.h>
#include <clew/msg/Landmark.h>
#include <clew/msg/Odometry.h>
#include <clew/msg/Scan.h>
#include <clew/msg/State.h>
#include <clew/msg/Target.h>

#include <array>
#include <tuple>

#include "domain/topics.hpp"

namespace clew::bridge {

/// fastddsgen's C++ types, in the order of domain::Messages.
using FastMessages = std::tuple<msg::Command, msg::Event, msg::Guidance, msg::Landmark,
                                msg::Odometry, msg::Scan, msg::State, msg::Target>;
static_assert(std::tuple_size_v<FastMessages> == domain::kTopicCount);

template <typename Message>
using FastMessageOf =
    std::tuple_element_t<domain::index_of(domain::topic_of<Message>()), FastMessages>;

/// idlc's C types, indexed by Topic.
inline const dds_topic_descriptor_t& cyclone_type(domain::Topic topic) {
  static const std::array types = {&clew_msg_Command_desc,  &clew_msg_Event_desc,
                                   &clew_msg_Guidance_desc, &clew_msg_Landmark_desc,
                                   &clew_msg_Odometry_desc, &clew_msg_Scan_desc,
                                   &clew_msg_State_desc,    &clew_msg_Target_desc};
  static_assert(types.size() == domain::kTopicCount);
  return *types[domain::index_of(topic)];
}

}  // namespace clew::bridge
