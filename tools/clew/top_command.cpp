// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/json_line.hpp"
#include "clew/process_usage.hpp"
#include "clew/terminal.hpp"
#include "line/command_desk.hpp"
#include "line/wake_up.hpp"
#include "log/log.hpp"
#include "run/end_signals.hpp"

namespace clew::tools {
namespace {

using bridge::CommandAnswer;
using bridge::ComponentStatus;
using core::Result;
using nlohmann::ordered_json;
using std::chrono::steady_clock;

constexpr std::chrono::seconds kPeriod{1};
/// Between the two looks of --once: rates are of this time.
constexpr std::chrono::milliseconds kGlance{500};

struct TopOptions {
  std::string run;
  bool once = false;
  bool json = false;
};

/// A run at a moment.
struct Look {
  CommandAnswer answer;
  std::map<std::int64_t, ProcessUsage> usage;  ///< by process
  steady_clock::time_point at;
};

/// A component between two looks.
struct Row {
  ComponentStatus status;
  double rate_hz = 0.0;
  std::optional<ProcessUsage> usage;
  std::optional<double> cpu_percent;  ///< of its process, of one core
};

Result<Look> look_at(const std::string& run) {
  auto answer = bridge::command_run(run, {bridge::RunCommand::Kind::kStatus});
  if (!answer.ok()) return answer.error();
  Look look{std::move(answer).value(), {}, steady_clock::now()};
  for (const ComponentStatus& status : look.answer.components) {
    if (const auto usage = usage_of(status.process_id)) look.usage[status.process_id] = *usage;
  }
  return look;
}

std::optional<ProcessUsage> usage_in(const Look& look, std::int64_t process_id) {
  const auto found = look.usage.find(process_id);
  return found == look.usage.end() ? std::nullopt : std::optional(found->second);
}

std::vector<Row> rows_between(const Look& before, const Look& now) {
  const double seconds = std::chrono::duration<double>(now.at - before.at).count();
  std::map<std::string, std::uint64_t> ticks_before;
  for (const ComponentStatus& status : before.answer.components) {
    ticks_before[status.stage] = status.ticks;
  }
  std::vector<Row> rows;
  for (const ComponentStatus& status : now.answer.components) {
    Row row{status, 0.0, usage_in(now, status.process_id), {}};
    // One that was set back since has no rate yet.
    if (const auto ticks = ticks_before.find(status.stage);
        ticks != ticks_before.end() && status.ticks > ticks->second) {
      row.rate_hz = static_cast<double>(status.ticks - ticks->second) / seconds;
    }
    if (const auto earlier = usage_in(before, status.process_id); earlier && row.usage) {
      row.cpu_percent = 100.0 * (row.usage->cpu_s - earlier->cpu_s) / seconds;
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

template <typename Value>
ordered_json or_null(bool known, Value value) {
  return known ? ordered_json(value) : ordered_json(nullptr);
}

std::string to_json(const Row& row) {
  const ComponentStatus& status = row.status;
  const bool stepped = status.steps.count > 0;
  return json_line(
      {{"stage", status.stage},
       {"process", status.process},
       {"pid", or_null(status.process_id != 0, status.process_id)},
       {"ticks", status.ticks},
       {"rate_hz", row.rate_hz},
       {"step_us",
        {{"p50", or_null(stepped, status.steps.p50_us)},
         {"p99", or_null(stepped, status.steps.p99_us)}}},
       {"rss_bytes",
        or_null(row.usage.has_value(), row.usage.value_or(ProcessUsage{}).resident_bytes)},
       {"cpu_percent", or_null(row.cpu_percent.has_value(), row.cpu_percent.value_or(0.0))},
       {"restarts", status.restarts},
       {"refused_samples", status.refused_samples},
       {"silent_s", status.silent_s}});
}

std::string to_text(const Row& row) {
  const ComponentStatus& status = row.status;
  const auto number = [](bool known, double value, int digits) {
    return known ? fmt::format("{:.{}f}", value, digits) : std::string("-");
  };
  const bool stepped = status.steps.count > 0;
  const double mib = row.usage ? static_cast<double>(row.usage->resident_bytes) / 1048576.0 : 0.0;
  return fmt::format(
      "{:<10} {:<10} {:>8} {:>10} {:>9.1f} {:>9} {:>9} {:>6} {:>8} {:>6.1f} {:>8} {:>7}",
      status.stage, status.process == status.stage ? "" : status.process,
      status.process_id == 0 ? "-" : std::to_string(status.process_id), status.ticks, row.rate_hz,
      number(stepped, status.steps.p50_us, 1), number(stepped, status.steps.p99_us, 1),
      number(row.cpu_percent.has_value(), row.cpu_percent.value_or(0.0), 0),
      number(row.usage.has_value(), mib, 1), status.silent_s, status.restarts,
      status.refused_samples);
}

void print_rows(const Look& look, const std::vector<Row>& rows, const TopOptions& options,
                bool clears) {
  if (options.json) {
    for (const Row& row : rows) fmt::print("{}\n", to_json(row));
    return;
  }
  // One write, so that a terminal shows it at once.
  std::string text = clears ? "\033[H\033[J" : "";
  text += fmt::format("run {}, tick {}{}\n", options.run, look.answer.tick,
                      look.answer.held ? ", paused" : "");
  text +=
      fmt::format("{:<10} {:<10} {:>8} {:>10} {:>9} {:>9} {:>9} {:>6} {:>8} {:>6} {:>8} {:>7}\n",
                  "stage", "group", "pid", "ticks", "ticks/s", "p50 us", "p99 us", "cpu %", "MiB",
                  "age s", "restarts", "refused");
  for (const Row& row : rows) text += to_text(row) + '\n';
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

int top_command(const TopOptions& options) {
  bridge::EndSignals signals;
  const bridge::WakeUp clock;
  auto before = look_at(options.run);
  if (!before.ok()) return complain(before.error());
  const bool clears = !options.once && !options.json && is_terminal(STDOUT_FILENO);
  auto period = std::chrono::nanoseconds(kGlance);
  while (true) {
    clock.wait_beside({signals.descriptor()}, period);
    if (signals.take() != 0) return kExitGood;
    auto now = look_at(options.run);
    if (!now.ok() && options.once) return complain(now.error());
    if (!now.ok()) {
      logs::info("run {} is over", options.run);
      return kExitGood;
    }
    print_rows(*now, rows_between(*before, *now), options, clears);
    if (options.once) return kExitGood;
    if (std::ferror(stdout) != 0) return kExitFailed;  // whoever read it has gone
    before = std::move(now);
    period = kPeriod;
  }
}

}  // namespace

void add_top(CLI::App& main, int& status) {
  const auto options = std::make_shared<TopOptions>();
  CLI::App* app = main.add_subcommand("top", "Watch how busy the components of a run are");
  app->add_option("run", options->run, "the number of its domain, or its name (run --name)")
      ->required();
  app->add_flag("--once", options->once, "print once and end");
  app->add_flag("--json", options->json, "print one JSON object a component");
  app->callback([options, &status] { status = top_command(*options); });
}

}  // namespace clew::tools
