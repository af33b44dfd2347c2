// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.hpp"

namespace clew::bridge {

/// The name of the interface that has 127.0.0.1 and is up; empty if there is none.
std::string loopback_interface();

/// Components of a run talk over it.
core::Result<void> check_loopback();

}  // namespace clew::bridge
