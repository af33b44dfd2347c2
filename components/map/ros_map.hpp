// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/resources.hpp"
#include "core/result.hpp"
#include "map/pgm.hpp"
#include "map/room_map.hpp"

namespace clew::map {

/// Reads a map of ROS's map_server: `image`, a PGM picture of kind P2 or P5, `resolution`,
/// `origin`, `negate`, `occupied_thresh`, `free_thresh` and, if given, `mode: trinary`. With p the
/// darkness of a pixel (its brightness if negate is 1), 0 to 1, it is occupied if p >
/// occupied_thresh, free if p < free_thresh, else unknown; what is not free is blocked. So it is in
/// map_server: grey 205, by which its saver means *unknown*, has a darkness of 0.1961, and is free
/// to a file that says `free_thresh: 0.25`.
///
/// Lines of a picture's head may end in CR and LF. A picture that goes on behind its last pixel is
/// refused: its head does not say what it holds.
///
/// *Deviation:* a map that is turned (third number of `origin`) and other modes are refused. The
/// error names file and line, or the picture, what was found and what is allowed.
core::Result<BlockedMap> read_ros_map(const core::Resource& file);

}  // namespace clew::map
