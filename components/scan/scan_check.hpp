// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/result.hpp"
#include "domain/messages.hpp"
#include "domain/setup.hpp"

namespace clew::scan {

/// Whether a scan has the arrangement of beams that behaviours were told of before the run: as many
/// beams, bearings and widths within 0.1 degrees, the range within a millimetre. A layout that
/// names no sensor declares nothing.
core::Result<void> check_arrangement(const domain::Scan& scan, const domain::ScanLayout& declared);

}  // namespace clew::scan
