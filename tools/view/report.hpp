// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"

namespace clew::view {

/// A recording on its way into a report.
struct ReportedRecording {
  std::string name;                ///< for people
  std::vector<std::string> bytes;  ///< of each of its files
};

/// `page` with recordings inside: one file that needs neither server nor network. Names and bytes
/// stand in it in base64, so that no text of a recording is ever HTML.
core::Result<std::string> report(std::string_view page,
                                 const std::vector<ReportedRecording>& recordings);

}  // namespace clew::view
