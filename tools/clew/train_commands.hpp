// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace clew::tools {

void add_train_som(CLI::App& train, int& status);
void add_train_neuro_fuzzy(CLI::App& train, int& status);

}  // namespace clew::tools
