// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string_view>

namespace clew::bridge {

/// Takes what the components of a run wrote, as they spool it for a recorder; for a view of the
/// run. Must not wait.
using WatchSamples = std::function<void(std::string_view spool)>;

}  // namespace clew::bridge
