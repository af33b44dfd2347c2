// SPDX-License-Identifier: Apache-2.0
/// Each message's counterpart among the types generated from idl/, member by member. Objects are
/// reused: nothing is allocated once their lists have been as long before.
#pragma once

#include <clew/msg/Command.h>
#include <clew/msg/Event.h>
#include <clew/msg/Guidance.h>
#include <clew/msg/Landmark.h>
#include <clew/msg/Odometry.h>
#include <clew/msg/Scan.h>
#include <clew/msg/State.h>
#include <clew/msg/Target.h>

#include <tuple>

#include "domain/field_check.hpp"
#include "domain/messages.hpp"

namespace clew::bridge {

/// The generated type of a domain message, in the order of domain::Messages.
using IdlMessages = std::tuple<msg::Command, msg::Event, msg::Guidance, msg::Landmark,
                               msg::Odometry, msg::Scan, msg::State, msg::Target>;
template <typename Message>
using IdlOf =
    std::tuple_element_t<static_cast<std::size_t>(domain::topic_of<Message>()), IdlMessages>;

void to_idl(const domain::Command& from, msg::Command& to);
void to_idl(const domain::Event& from, msg::Event& to);
void to_idl(const domain::Guidance& from, msg::Guidance& to);
void to_idl(const domain::Landmark& from, msg::Landmark& to);
void to_idl(const domain::Odometry& from, msg::Odometry& to);
void to_idl(const domain::Scan& from, msg::Scan& to);
void to_idl(const domain::State& from, msg::State& to);
void to_idl(const domain::Target& from, msg::Target& to);

/// What a domain value cannot hold goes to `check`: unknown enumerators and lists beyond their
/// bound. Everything else is left to domain::validate.
void from_idl(const msg::Command& from, domain::Command& to, domain::FieldCheck& check);
void from_idl(const msg::Event& from, domain::Event& to, domain::FieldCheck& check);
void from_idl(const msg::Guidance& from, domain::Guidance& to, domain::FieldCheck& check);
void from_idl(const msg::Landmark& from, domain::Landmark& to, domain::FieldCheck& check);
void from_idl(const msg::Odometry& from, domain::Odometry& to, domain::FieldCheck& check);
void from_idl(const msg::Scan& from, domain::Scan& to, domain::FieldCheck& check);
void from_idl(const msg::State& from, domain::State& to, domain::FieldCheck& check);
void from_idl(const msg::Target& from, domain::Target& to, domain::FieldCheck& check);

}  // namespace clew::bridge
