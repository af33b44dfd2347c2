// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "wire/sample.hpp"

namespace clew::bridge {

struct SpooledState;

/// Adds a sample to a spool, as for_each_spooled reads it: tick and sequence (64 bits each), size
/// and number of the topic (32 bits each), little-endian, and the bytes.
void append_to_spool(const SampleView& sample, std::string& spool);
/// Adds a state.
void append_to_spool(const SpooledState& state, std::string& spool);

}  // namespace clew::bridge
