// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/json_line.hpp"
#include "clew/print_text.hpp"
#include "clew/recorded_fields.hpp"
#include "clew/waypoint_marks.hpp"
#include "log/log.hpp"
#include "replay/recorded_plan.hpp"
#include "stages/all.hpp"

namespace clew::tools {
namespace {

using core::Result;
using nlohmann::ordered_json;

struct EventsOptions {
  std::string recording;
  bool json = false;
};

/// The stage that writes a topic.
std::string writer_of(domain::Topic topic) {
  for (const runtime::StageInfo& stage : stages::all()) {
    for (const runtime::PortInfo& port : stage.ports) {
      const bool writes = port.direction == runtime::PortInfo::Direction::kOutput;
      if (writes && port.topic == topic) return stage.name;
    }
  }
  return {};
}

const char* kind_word(domain::EventKind kind) {
  switch (kind) {
    case domain::EventKind::kLandmark:
      return "landmark";
    case domain::EventKind::kReflex:
      return "reflex";
    case domain::EventKind::kTrap:
      return "trap";
    case domain::EventKind::kEscapeBegun:
      return "escape_begun";
    case domain::EventKind::kEscapeEnded:
      return "escape_ended";
    case domain::EventKind::kEscapeFailed:
      return "escape_failed";
    case domain::EventKind::kVirtualTarget:
      return "virtual_target";
    case domain::EventKind::kUnreachable:
      return "unreachable";
  }
  return "unknown";  // a later version's
}

ordered_json number_json(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

std::string to_json(const domain::TickStamp& stamp, const domain::EventEntry& entry,
                    const std::string& stage, const char* kind) {
  ordered_json json = {{"tick", stamp.tick},
                       {"time_s", number_json(stamp.sim_time_s)},
                       {"stage", stage},
                       {"kind", kind},
                       {"rule", entry.rule},
                       {"x_m", number_json(entry.x_m)},
                       {"y_m", number_json(entry.y_m)},
                       {"text", entry.text},
                       {"shadow", entry.shadow},
                       {"earlier", nullptr}};
  if (entry.has_earlier) {
    json["earlier"] = {{"tick", entry.earlier_tick},
                       {"x_m", number_json(entry.earlier_x_m)},
                       {"y_m", number_json(entry.earlier_y_m)}};
  }
  return json_line(json);
}

std::string to_text(const domain::TickStamp& stamp, const domain::EventEntry& entry,
                    const char* kind) {
  std::string text = fmt::format(
      "tick {:>6}  {:>8.1f} s  {:<14} {:<22} at ({:.2f}, {:.2f})", stamp.tick, stamp.sim_time_s,
      kind, entry.rule + (entry.shadow ? " (shadow)" : ""), entry.x_m, entry.y_m);
  if (entry.has_earlier) {
    text += fmt::format(", as at tick {} at ({:.2f}, {:.2f})", entry.earlier_tick,
                        entry.earlier_x_m, entry.earlier_y_m);
  }
  return entry.text.empty() ? text : text + "  " + entry.text;
}

std::string to_json(const domain::Incident& incident, double time_s) {
  return json_line(ordered_json{{"tick", incident.tick},
                                {"time_s", time_s},
                                {"stage", incident.stage},
                                {"kind", incident.kind},
                                {"rule", ""},
                                {"x_m", nullptr},
                                {"y_m", nullptr},
                                {"text", incident.text},
                                {"shadow", false},
                                {"earlier", nullptr}});
}

std::string to_text(const domain::Incident& incident, double time_s) {
  return fmt::format("tick {:>6}  {:>8.1f} s  {:<14} {}", incident.tick, time_s, incident.kind,
                     incident.text);
}

/// Prints what befell a run, between the events of its ticks.
class IncidentPrinter {
 public:
  IncidentPrinter(const bridge::RunRecording& recording, bool json)
      : incidents_(recording.incidents()), tick_s_(recording.description().tick_s), json_(json) {}

  /// Those that stand before the samples of `tick` and were not printed yet; how many.
  std::size_t print_until(std::uint64_t tick) {
    const std::size_t first = next_;
    for (; next_ < incidents_.size() && incidents_[next_].tick <= tick; ++next_) {
      const double time_s = static_cast<double>(incidents_[next_].tick) * tick_s_;
      print_text("{}\n",
                 json_ ? to_json(incidents_[next_], time_s) : to_text(incidents_[next_], time_s));
    }
    return next_ - first;
  }

 private:
  const std::vector<domain::Incident>& incidents_;
  const double tick_s_;
  const bool json_;
  std::size_t next_ = 0;
};

/// The referee's way-points as entries of its stage.
domain::EventEntry entry_of(const WaypointMark& mark) {
  domain::EventEntry entry;
  entry.rule = "referee";
  entry.x_m = mark.place.x();
  entry.y_m = mark.place.y();
  entry.text = fmt::format("{} of {}", mark.number, mark.of);
  return entry;
}

/// Prints all events of the ticks; counts them.
class EventPrinter {
 public:
  EventPrinter(WaypointMarks marks, bool json) : marks_(std::move(marks)), json_(json) {}

  std::size_t count() const { return count_; }
  bool has_waypoints() const { return marks_.any(); }

  Result<void> print(const bridge::SampleView& sample) {
    if (sample.topic != domain::Topic::kEvent) return print_waypoints(sample);
    domain::Event event;
    CLEW_RETURN_IF_ERROR(events_.decode_unvalidated(sample.cdr, event));
    for (const domain::EventEntry& entry : event.entries) {
      print(event.stamp, entry, stage_, kind_word(entry.kind));
    }
    return {};
  }

 private:
  Result<void> print_waypoints(const bridge::SampleView& sample) {
    if (sample.topic == domain::Topic::kOdometry) {
      domain::Odometry odometry;
      CLEW_RETURN_IF_ERROR(odometries_.decode_unvalidated(sample.cdr, odometry));
      marks_.hear(odometry);
      return {};
    }
    domain::State state;
    CLEW_RETURN_IF_ERROR(states_.decode_unvalidated(sample.cdr, state));
    for (const WaypointMark& mark : marks_.see(state)) {
      print(state.stamp, entry_of(mark), judge_, "waypoint");
    }
    return {};
  }

  void print(const domain::TickStamp& stamp, const domain::EventEntry& entry,
             const std::string& stage, const char* kind) {
    ++count_;
    print_text("{}\n", json_ ? to_json(stamp, entry, stage, kind) : to_text(stamp, entry, kind));
  }

  WaypointMarks marks_;
  const bool json_;
  const std::string stage_ = writer_of(domain::Topic::kEvent);
  const std::string judge_ = writer_of(domain::Topic::kState);
  bridge::Codec<domain::Event> events_;
  bridge::Codec<domain::State> states_;
  bridge::Codec<domain::Odometry> odometries_;
  std::size_t count_ = 0;
};

/// Prints all events and incidents; the number of them.
Result<std::size_t> print_events(const bridge::RunRecording& recording, bool json) {
  auto marks = WaypointMarks::create(recording);
  if (!marks.ok()) {
    logs::info("{}: its way-points cannot be told: {}", recording.path(), marks.error().text());
  }
  IncidentPrinter incidents(recording, json);
  std::size_t count = 0;
  EventPrinter printer(marks.ok() ? std::move(marks).value() : WaypointMarks(), json);
  std::set<domain::Topic> topics = {domain::Topic::kEvent};
  if (printer.has_waypoints()) {
    topics.insert({domain::Topic::kOdometry, domain::Topic::kState});
  }
  auto samples = recording.samples({topics});
  while (true) {
    const auto sample = samples.next();
    if (!sample.ok()) return sample.error();
    if (!*sample) {
      count += incidents.print_until(std::numeric_limits<std::uint64_t>::max());
      return count + printer.count();
    }
    count += incidents.print_until((*sample)->tick);
    const auto printed = printer.print(**sample);
    if (!printed.ok()) {
      return core::Error{fmt::format("tick {}: {}", (*sample)->tick, printed.error().message),
                         recording.path()};
    }
  }
}

int events_command(const EventsOptions& options) {
  const auto recording = bridge::RunRecording::open(options.recording);
  if (!recording.ok()) return complain(recording.error());
  const auto count = print_events(*recording, options.json);
  if (!count.ok()) return complain(count.error());
  if (const std::string why = recording->cut_off(); !why.empty()) {
    logs::warning("{}: {}; told is what is there", recording->path(), why);
  }
  if (recording->description().schemas.count(domain::Topic::kEvent) == 0) {
    logs::info("{}: its graph has no recover, which alone tells traps and escapes",
               recording->path());
  } else if (*count == 0 && !options.json) {
    print_text("no events\n");
  }
  return kExitGood;
}

}  // namespace

void add_events(CLI::App& main, int& status) {
  const auto options = std::make_shared<EventsOptions>();
  CLI::App* app = main.add_subcommand(
      "events",
      "Print what happened in a recording: traps, escapes, way-points, and what befell the run");
  app->add_option("recording", options->recording, "of a run")->required();
  app->add_flag("--json", options->json, "print one JSON object an event");
  app->callback([options, &status] { status = events_command(*options); });
}

}  // namespace clew::tools
