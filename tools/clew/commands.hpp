// SPDX-License-Identifier: Apache-2.0
/// The commands of `clew`. Each adds its own line to the program's and, when it was called, leaves
/// its exit status in `status`. Results go to stdout, everything else to stderr.
#pragma once

#include <CLI/CLI.hpp>

namespace clew::tools {

void add_run(CLI::App& main, int& status);
void add_bench(CLI::App& main, int& status);
void add_check(CLI::App& main, int& status);
void add_list(CLI::App& main, int& status);
void add_bridge(CLI::App& main, int& status);
void add_component(CLI::App& main, int& status);
/// Started by runs only.
void add_recorder(CLI::App& main, int& status);
void add_plot(CLI::App& main, int& status);
void add_query(CLI::App& main, int& status);
void add_info(CLI::App& main, int& status);
void add_events(CLI::App& main, int& status);
void add_top(CLI::App& main, int& status);
/// topic list, info, find, echo, hz, bw, delay.
void add_topic(CLI::App& main, int& status);
void add_host(CLI::App& main, int& status);
void add_relay(CLI::App& main, int& status);
void add_doctor(CLI::App& main, int& status);
void add_explain(CLI::App& main, int& status);
void add_echo(CLI::App& main, int& status);
void add_import(CLI::App& main, int& status);
void add_rules(CLI::App& main, int& status);
void add_export(CLI::App& main, int& status);
void add_world(CLI::App& main, int& status);
/// To the command `world`.
void add_world_import(CLI::App& world, int& status);
/// Robots that meet.
void add_encounters(CLI::App& main, int& status);
void add_hunt(CLI::App& main, int& status);
void add_bisect(CLI::App& main, int& status);
void add_tune(CLI::App& main, int& status);
void add_shrink(CLI::App& main, int& status);
/// init, mint, check: the keys of secured runs.
void add_keys(CLI::App& main, int& status);
void add_sign(CLI::App& main, int& status);
void add_diff(CLI::App& main, int& status);
void add_replay(CLI::App& main, int& status);
/// swap, goal, pause, step, resume, pace, stop: what is done to a run that goes on.
void add_live(CLI::App& main, int& status);
void add_check_plugin(CLI::App& main, int& status);
void add_new(CLI::App& main, int& status);
void add_completion(CLI::App& main, int& status);
/// For those who build packages only.
void add_manual(CLI::App& main, int& status);
void add_view(CLI::App& main, int& status);
/// Started by runs only.
void add_gateway(CLI::App& main, int& status);
void add_report(CLI::App& main, int& status);

}  // namespace clew::tools
