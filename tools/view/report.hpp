// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"

namespace clew::view {

/// A recording on its way into a report.
struct ReportedFile {
  std::string name;   ///< for people
  std::string bytes;  ///< of the file
};

/// `page` with recordings inside: one file that needs neither server nor network. Names and bytes
/// stand in it in base64, so that no text of a recording is ever HTML.
core::Result<std::string> report(std::string_view page, const std::vector<ReportedFile>& files);

}  // namespace clew::view
