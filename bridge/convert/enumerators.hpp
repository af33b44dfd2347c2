// SPDX-License-Identifier: Apache-2.0
/// The enumerators of the domain and of idl/ have the same numbers, which this file proves.
#pragma once

#include <clew/msg/Event.h>
#include <clew/msg/Guidance.h>
#include <clew/msg/Landmark.h>
#include <clew/msg/Motion.h>
#include <clew/msg/State.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "domain/field_check.hpp"
#include "domain/messages.hpp"

namespace clew::bridge {

template <auto kIdl, auto kDomain>
inline constexpr bool kSame = static_cast<std::uint32_t>(kIdl) ==
                              static_cast<std::uint32_t>(kDomain);

using domain::CommandKind;
static_assert(kSame<msg::COMMAND_STOP, CommandKind::kStop>);
static_assert(kSame<msg::COMMAND_TURN_AND_STEP, CommandKind::kTurnAndStep>);
static_assert(kSame<msg::COMMAND_VELOCITIES, CommandKind::kVelocities>);
static_assert(kSame<msg::COMMAND_WHEEL_SPEEDS, CommandKind::kWheelSpeeds>);
static_assert(kSame<msg::COMMAND_GIVE_UP, CommandKind::kGiveUp>);

using domain::EventKind;
static_assert(kSame<msg::EVENT_LANDMARK, EventKind::kLandmark>);
static_assert(kSame<msg::EVENT_REFLEX, EventKind::kReflex>);
static_assert(kSame<msg::EVENT_TRAP, EventKind::kTrap>);
static_assert(kSame<msg::EVENT_ESCAPE_BEGUN, EventKind::kEscapeBegun>);
static_assert(kSame<msg::EVENT_ESCAPE_ENDED, EventKind::kEscapeEnded>);
static_assert(kSame<msg::EVENT_ESCAPE_FAILED, EventKind::kEscapeFailed>);
static_assert(kSame<msg::EVENT_VIRTUAL_TARGET, EventKind::kVirtualTarget>);
static_assert(kSame<msg::EVENT_UNREACHABLE, EventKind::kUnreachable>);

using domain::GuidanceMode;
static_assert(kSame<msg::GUIDANCE_SEEK, GuidanceMode::kSeek>);
static_assert(kSame<msg::GUIDANCE_RECOVER, GuidanceMode::kRecover>);
static_assert(kSame<msg::GUIDANCE_UNREACHABLE, GuidanceMode::kUnreachable>);

using domain::Network;
static_assert(kSame<msg::NETWORK_SOM, Network::kSom>);
static_assert(kSame<msg::NETWORK_FUZZY_ART, Network::kFuzzyArt>);

using domain::Outcome;
static_assert(kSame<msg::OUTCOME_RUNNING, Outcome::kRunning>);
static_assert(kSame<msg::OUTCOME_REACHED, Outcome::kReached>);
static_assert(kSame<msg::OUTCOME_COLLIDED, Outcome::kCollided>);
static_assert(kSame<msg::OUTCOME_UNREACHABLE, Outcome::kUnreachable>);
static_assert(kSame<msg::OUTCOME_TIMEOUT, Outcome::kTimeout>);

template <typename Idl, typename Domain>
Idl enum_to_idl(Domain value) {
  return static_cast<Idl>(value);
}

/// The domain's enumerator. If `value` is beyond `last`, a complaint, and an enumerator that has no
/// name, with the same number as far as it can hold that.
template <typename Domain, typename Idl>
Domain enum_from_idl(Idl value, Domain last, const domain::FieldPath& path,
                     domain::FieldCheck& check) {
  const auto number = static_cast<std::uint32_t>(value);
  check.at_most(path, number, static_cast<std::uint32_t>(last));
  constexpr std::uint32_t kLargest = std::numeric_limits<std::underlying_type_t<Domain>>::max();
  return static_cast<Domain>(std::min(number, kLargest));
}

}  // namespace clew::bridge
