// SPDX-License-Identifier: Apache-2.0
#include "plot/run_picture.hpp"

#include <algorithm>
#include <set>

#include "plot/map_view.hpp"
#include "plot/page.hpp"
#include "plot/palette.hpp"
#include "plot/svg_writer.hpp"
#include "plot/symbols.hpp"
#include "plot/track_layer.hpp"
#include "plot/world_layer.hpp"

namespace clew::plot {
namespace {

constexpr double kLegendPx = 250.0;  ///< the legend's width
constexpr std::size_t kLongestName = 30;

std::string outcome_text(const RunTrack& track) {
  const domain::State& state = track.last_state;
  const std::string after = " after " + short_number(state.stamp.sim_time_s) + " s (tick " +
                            std::to_string(state.stamp.tick) + ")";
  switch (state.outcome) {
    case domain::Outcome::kReached:
      return "reached" + after;
    case domain::Outcome::kCollided:
      return "collided" + after;
    case domain::Outcome::kUnreachable:
      return "given up as unreachable" + after;
    case domain::Outcome::kTimeout:
      return "timed out" + after;
    case domain::Outcome::kRunning:
      break;
  }
  return (track.cut_off ? "recording cut off" : "ended without an outcome") + after;
}

std::string count_text(std::size_t count, const std::string& what) {
  return ", " + std::to_string(count) + ' ' + what + (count == 1 ? "" : "s");
}

std::string details_text(const world::World& world, const RunTrack& track) {
  std::string text = "path " + short_number(track.last_state.path_length_m) + " m";
  if (world.shortest_path_m()) {
    text += " (shortest " + short_number(*world.shortest_path_m()) + " m)";
  }
  const auto traps = static_cast<std::size_t>(std::count_if(
      track.traps.begin(), track.traps.end(), [](const TrapMark& trap) { return !trap.shadow; }));
  if (traps > 0) text += count_text(traps, "trap");
  if (track.last_state.safety_stops > 0) {
    text += count_text(track.last_state.safety_stops, "safety stop");
  }
  text += ", seed " + std::to_string(track.seed);
  return track.graph.empty() ? text : track.graph + "; " + text;
}

std::string shortened(const std::string& name) {
  if (name.size() <= kLongestName) return name;
  return name.substr(0, kLongestName - 3) + "...";
}

/// A list of names over several lines, none longer than a name may be, if no name is.
std::vector<std::string> broken(const std::string& list) {
  std::vector<std::string> lines;
  std::size_t begin = 0;
  while (begin < list.size()) {
    std::size_t end = list.size();
    if (end - begin > kLongestName) {
      const std::size_t last = list.find_last_of(",+", begin + kLongestName - 1);
      if (last != std::string::npos && last > begin) end = last + 1;
    }
    lines.push_back(shortened(list.substr(begin, end - begin)));
    begin = list.find_first_not_of(' ', end);
  }
  return lines;
}

/// Writes the legend's lines from top to bottom.
class Legend {
 public:
  Legend(SvgWriter& svg, const Point& upper_left) : svg_(svg), at_(upper_left) {}

  void path(const Paint& paint, std::string_view text) {
    svg_.line({at_.x, at_.y}, {at_.x + 26.0, at_.y}, paint);
    entry(text);
  }
  void band_under_path(const Paint& band, const Paint& path, std::string_view text) {
    svg_.line({at_.x + 3.0, at_.y}, {at_.x + 23.0, at_.y}, band);
    this->path(path, text);
  }
  void symbol(Symbol symbol) {
    draw_symbol(svg_, symbol, {at_.x + 13.0, at_.y}, kBlack);
    entry(symbol_name(symbol));
  }
  void disc(const Paint& paint, bool with_heading, std::string_view text) {
    svg_.circle({at_.x + 13.0, at_.y}, 7.0, paint);
    if (with_heading) {
      svg_.line({at_.x + 13.0, at_.y}, {at_.x + 20.0, at_.y}, {"none", paint.stroke, 1.6});
    }
    entry(text);
  }
  /// A line of text under the last entry.
  void note(std::string_view text) {
    svg_.text({at_.x + 36.0, at_.y + 1.0}, text, {10.5, Anchor::kStart, "#666666"});
    at_.y += kLegendLinePx - 3.0;
  }

 private:
  void entry(std::string_view text) {
    svg_.text({at_.x + 36.0, at_.y + 4.0}, text);
    at_.y += kLegendLinePx;
  }

  SvgWriter& svg_;
  Point at_;
};

/// What lies under a path, as the legend has it.
struct UnderEntry {
  Paint paint;
  bool is_line;
  std::string_view text;
};

std::vector<UnderEntry> under_entries(const std::vector<RunTrack>& tracks) {
  std::vector<UnderEntry> entries;
  const auto any = [&](const auto& list) {
    return std::any_of(tracks.begin(), tracks.end(),
                       [&](const RunTrack& track) { return !(track.*list).empty(); });
  };
  if (any(&RunTrack::virtual_obstacles)) {
    entries.push_back({kVirtualObstaclePaint, false, "virtual obstacle"});
  }
  if (any(&RunTrack::believed)) entries.push_back({kBelievedPaint, true, "believed path"});
  if (any(&RunTrack::subgoals)) entries.push_back({kSubgoalPaint, false, "subgoal of the plan"});
  return entries;
}

std::set<Symbol> symbols_of_all(const std::vector<RunTrack>& tracks) {
  std::set<Symbol> symbols;
  for (const RunTrack& track : tracks) symbols.merge(symbols_of(track));
  return symbols;
}

/// Of several robots in one world each has a world of its own, which the others move in.
bool are_robots(const std::vector<RunTrack>& tracks) {
  return std::any_of(tracks.begin(), tracks.end(),
                     [&](const RunTrack& track) { return track.world != tracks.front().world; });
}

TrackPaint paint_of(const std::vector<RunTrack>& tracks, std::size_t run) {
  return are_robots(tracks) ? TrackPaint::of_robot(run) : TrackPaint::of(run, tracks.size());
}

/// The number of a robot beside its start and the place where it goes.
void number_robot(SvgWriter& svg, const MapView& view, const RunTrack& track, std::size_t robot) {
  const auto write = [&](const core::Vec2& place, double radius_m) {
    const Point at = view.at(place);
    svg.text({at.x, at.y - view.px(radius_m) - 3.0}, std::to_string(robot + 1),
             {11.0, Anchor::kMiddle, run_colour(robot), true});
  };
  write(track.start.position(), track.robot_radius_m);
  if (track.missions.empty() || track.missions.back().waypoints.empty()) return;
  const world::Waypoint& target = track.missions.back().waypoints.back();
  write(target.place, target.radius_m);
}

bool shows_moving(const world::World& world, const std::vector<RunTrack>& tracks) {
  const bool robots = are_robots(tracks);
  return std::any_of(world.moving().begin(), world.moving().end(),
                     [&](const auto& obstacle) { return !(robots && obstacle.jumps); });
}

bool any_recovers(const std::vector<RunTrack>& tracks) {
  return std::any_of(tracks.begin(), tracks.end(), [](const RunTrack& track) {
    return std::find(track.recovering.begin(), track.recovering.end(), true) !=
           track.recovering.end();
  });
}

void draw_legend(SvgWriter& svg, const Point& upper_left, const world::World& world,
                 const std::vector<RunTrack>& tracks) {
  svg.begin_group("legend");
  Legend legend(svg, upper_left);
  for (std::size_t run = 0; run < tracks.size(); ++run) {
    const TrackPaint paint = paint_of(tracks, run);
    if (tracks.size() == 1) {
      legend.path(paint.seek, "path");
    } else {
      const std::string number = are_robots(tracks) ? std::to_string(run + 1) + " " : "";
      legend.path(paint.seek, number + shortened(tracks[run].name));
      for (const std::string& line : broken(tracks[run].graph)) legend.note(line);
      legend.note(outcome_text(tracks[run]));
      legend.note("path " + short_number(tracks[run].last_state.path_length_m) + " m");
    }
  }
  if (any_recovers(tracks)) {
    const TrackPaint paint = paint_of(tracks, 0);
    if (paint.recover_is_under) {
      legend.band_under_path(paint.recover, paint.seek, "under recovery");
    } else {
      legend.path(paint.recover, "path under recovery");
    }
  }
  for (const UnderEntry& entry : under_entries(tracks)) {
    if (entry.is_line) {
      legend.path(entry.paint, entry.text);
    } else {
      legend.disc(entry.paint, false, entry.text);
    }
  }
  legend.disc({kWhite, kBlack, 1.6}, true, "robot at the start");
  legend.disc({"#CDEBE1", kGreen, 2.0}, false, "target");
  if (shows_moving(world, tracks)) {
    legend.disc({"none", kMovingGrey, 1.2, "3 3"}, false, "moving obstacle at the start");
    legend.disc({kObstacleGrey, kMovingGrey, 1.5}, false, "moving obstacle at the end");
  }
  for (const Symbol symbol : symbols_of_all(tracks)) legend.symbol(symbol);
  svg.end_group();
}

double legend_height_px(const world::World& world, const std::vector<RunTrack>& tracks) {
  std::size_t runs = 3 * tracks.size();
  for (const RunTrack& track : tracks) runs += broken(track.graph).size();
  if (tracks.size() == 1) runs = 1;
  const std::size_t lines = runs + 3 + under_entries(tracks).size() +
                            (shows_moving(world, tracks) ? 2 : 0) + symbols_of_all(tracks).size();
  return static_cast<double>(lines) * kLegendLinePx;
}

void draw_title(SvgWriter& svg, const world::World& world, const std::vector<RunTrack>& tracks) {
  const bool alone = tracks.size() == 1;
  const std::string title =
      world.name() + ": " +
      (alone ? outcome_text(tracks[0])
             : std::to_string(tracks.size()) + (are_robots(tracks) ? " robots" : " runs"));
  std::string details = world.about();
  if (alone) details = details_text(world, tracks[0]);
  svg.text({kMarginPx, kMarginPx + 14.0}, title, {18.0, Anchor::kStart, kBlack, true});
  svg.text({kMarginPx, kMarginPx + 36.0}, details, {12.5, Anchor::kStart, "#555555"});
}

/// Those that were given, each once.
Ways ways_of(const std::vector<RunTrack>& tracks) {
  Ways ways;
  const auto same = [](const world::Waypoint& a, const world::Waypoint& b) {
    return a.place == b.place && a.radius_m == b.radius_m;
  };
  for (const RunTrack& track : tracks) {
    for (const bridge::GivenMission& mission : track.missions) {
      const bool known = std::any_of(ways.begin(), ways.end(), [&](const auto& way) {
        return std::equal(way.begin(), way.end(), mission.waypoints.begin(),
                          mission.waypoints.end(), same);
      });
      if (!known) ways.push_back(mission.waypoints);
    }
  }
  return ways;
}

double end_time_s(const std::vector<RunTrack>& tracks) {
  double end_s = 0.0;
  for (const RunTrack& track : tracks) end_s = std::max(end_s, track.last_state.stamp.sim_time_s);
  return end_s;
}

}  // namespace

std::string draw_runs(const world::World& world, const std::vector<RunTrack>& tracks) {
  const Point map_corner{kMarginPx, kMarginPx + kTitlePx};
  const MapView view(world.bounds_min(), world.bounds_max(), map_corner, kMapPx, kMapPx);
  const double map_height_px = view.height() + kFooterPx;
  const double legend_bottom_px = kMarginPx + legend_height_px(world, tracks);
  SvgWriter svg(view.right() + kMarginPx + kLegendPx,
                view.top() + std::max(map_height_px, legend_bottom_px));

  draw_title(svg, world, tracks);
  draw_world(svg, view, world, ways_of(tracks), end_time_s(tracks),
             are_robots(tracks) ? Moving::kNoRobots : Moving::kAll);
  for (const RunTrack& track : tracks) draw_under_track(svg, view, track);
  for (std::size_t run = 0; run < tracks.size(); ++run) {
    draw_track(svg, view, tracks[run], paint_of(tracks, run));
  }
  for (const RunTrack& track : tracks) {
    if (&track != &tracks.front() && track.start == tracks.front().start) continue;
    draw_start(svg, view, track.start, track.robot_radius_m);
  }
  for (std::size_t run = 0; run < tracks.size(); ++run) {
    draw_over_track(svg, view, tracks[run], paint_of(tracks, run));
  }
  for (std::size_t robot = 0; are_robots(tracks) && robot < tracks.size(); ++robot) {
    number_robot(svg, view, tracks[robot], robot);
  }
  draw_scale_bar(svg, view, world);
  draw_legend(svg, {view.right() + kMarginPx, view.top() + 10.0}, world, tracks);
  return std::move(svg).finish();
}

}  // namespace clew::plot
