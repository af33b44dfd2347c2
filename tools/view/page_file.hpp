// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace clew::view {

/// The page of `clew view`: one HTML file. Empty in a build without npm.
std::string_view page();

/// The page of `clew bench`, likewise.
std::string_view bench_page();

/// What to say where it is empty.
inline constexpr char kNoPage[] =
    "this build has no page: node, npm or npm's registry were missing; install nodejs and npm and "
    "build again";

}  // namespace clew::view
