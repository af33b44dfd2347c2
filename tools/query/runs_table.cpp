// SPDX-License-Identifier: Apache-2.0
#include "query/runs_table.hpp"

namespace clew::query {

const std::vector<Column>& runs_columns() {
  static const std::vector<Column> columns = {{"graph", "TEXT"},
                                              {"variant", "TEXT"},
                                              {"family", "TEXT"},
                                              {"world", "TEXT"},
                                              {"seed", "INTEGER"},
                                              {"outcome", "TEXT"},
                                              {"success", "INTEGER"},
                                              {"solvable", "INTEGER"},
                                              {"depth_ranges", "REAL"},
                                              {"severity_ranges", "REAL"},
                                              {"nested_pockets", "INTEGER"},
                                              {"necessary_backtrack_m", "REAL"},
                                              {"necessary_backtrack_ranges", "REAL"},
                                              {"bug1_bound_m", "REAL"},
                                              {"bug2_bound_m", "REAL"},
                                              {"ticks", "INTEGER"},
                                              {"sim_time_s", "REAL"},
                                              {"path_length_m", "REAL"},
                                              {"shortest_path_m", "REAL"},
                                              {"traps_detected", "INTEGER"},
                                              {"virtual_targets", "INTEGER"},
                                              {"collisions", "INTEGER"},
                                              {"hit_by", "INTEGER"},
                                              {"safety_stops", "INTEGER"},
                                              {"late_commands", "INTEGER"},
                                              {"captures", "INTEGER"},
                                              {"held_at_end", "INTEGER"},
                                              {"detectors", "JSON"},
                                              {"still_since", "JSON"},
                                              {"notes", "JSON"},
                                              {"coverage", "JSON"},
                                              {"restarts", "INTEGER"},
                                              {"refused_samples", "INTEGER"},
                                              {"lost_samples", "INTEGER"},
                                              {"why", "TEXT"},
                                              {"layout", "TEXT"},
                                              {"middleware", "TEXT"},
                                              {"secured", "INTEGER"},
                                              {"recording", "TEXT"},
                                              {"hash", "TEXT"},
                                              {"start_s", "REAL"},
                                              {"wall_s", "REAL"},
                                              {"ticks_per_s", "REAL"}};
  return columns;
}

std::string create_runs() {
  std::string text;
  for (const Column& column : runs_columns()) {
    const bool is_json = std::string(column.type) == "JSON";
    text += (text.empty() ? "" : ", ") + std::string(column.name) + ' ' +
            (is_json ? "TEXT" : column.type);
  }
  return "CREATE TABLE runs (" + text + ")";
}

}  // namespace clew::query
