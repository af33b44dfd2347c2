// SPDX-License-Identifier: Apache-2.0
/// What the module of a vendor, `libclew-<vendor>.so`, exports. It alone links the vendor's
/// libraries, so that a process maps those of the vendor that carries it and no other's.
#pragma once

#include <memory>

#include "core/result.hpp"
#include "dds/participant.hpp"

namespace clew::bridge {

/// Creates a participant of the vendor into `created`. `discovery` must outlive it.
using CreateParticipant = void(const ParticipantConfig& config, DiscoveryListener& discovery,
                               core::Result<std::unique_ptr<Participant>>& created);

inline constexpr const char* kCreateParticipant = "clew_create_participant";

}  // namespace clew::bridge

extern "C" __attribute__((visibility("default")))
clew::bridge::CreateParticipant clew_create_participant;
