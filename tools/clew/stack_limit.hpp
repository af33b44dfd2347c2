// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/result.hpp"

namespace clew::tools {

/// Gives the threads of this process, and the processes that it starts, stacks of the usual 8 MiB
/// where `ulimit -s` allows less: the C library takes that limit for every thread, and a thread of
/// a DDS vendor needs more than 128 KiB. The first thread gets as much as the hard limit allows,
/// and an error where that is too little to run at all.
core::Result<void> raise_small_stacks();

}  // namespace clew::tools
