// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "runtime/graph.hpp"

namespace clew::runtime {

/// Stages in the shape of the real ones, with every kind of port, part and parameter, and
/// components that only count: what the mechanics of graphs is tested with, whatever the real ones
/// become.
///
///     drive     parts: behaviour (slow: tick 0.3 s; quick: tick 0.1 s)
///     sense     parts: behaviour (cones, ray)
///     classify  parts: behaviour (table)
///     recover   parts: detector (by_place needs landmark, by_time), escape: list (follow, wait),
///               shadow: list of detectors
///     control   parts: behaviour (straight, curved); a parameter of the stage itself
const std::vector<StageInfo>& fake_stages();

/// A graph of all fake stages.
extern const char kFullGraph[];
/// A graph of drive, sense and control.
extern const char kSmallGraph[];

/// Loads a graph text of the fake stages; its file is called `graph.yaml`.
core::Result<Graph> load_fake(const std::string& text, const GraphOverrides& overrides = {});

/// Loads what must be acceptable.
Graph load_good(const std::string& text, const GraphOverrides& overrides = {});

/// The error of what must not be acceptable, with its place.
std::string refusal(const std::string& text, const GraphOverrides& overrides = {});

/// A value as it would stand in an expanded graph; `absent` if there is none.
std::string text_of(const core::ParameterValues& values, const std::string& name);

}  // namespace clew::runtime
