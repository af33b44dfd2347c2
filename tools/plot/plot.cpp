// SPDX-License-Identifier: Apache-2.0
#include "plot/plot.hpp"

#include <algorithm>
#include <filesystem>

#include "core/check.hpp"
#include "files/whole_file.hpp"
#include "plot/png.hpp"
#include "plot/run_picture.hpp"
#include "plot/run_track.hpp"
#include "plot/tick_picture.hpp"
#include "plot/world_picture.hpp"
#include "world/world.hpp"

namespace clew::plot {
namespace {

core::Result<void> check_ending(const std::string& output) {
  const std::string ending = std::filesystem::path(output).extension().string();
  if (ending == ".svg" || ending == ".png" || ending == ".pdf") return {};
  return core::Error{"found ending '" + ending + "'; allowed: .svg, .png, .pdf", output};
}

core::Result<void> render_to(std::string picture, const std::string& output) {
  const std::filesystem::path ending = std::filesystem::path(output).extension();
  if (ending != ".svg") {
    auto rendered = ending == ".png" ? render_png(picture) : render_pdf(picture);
    if (!rendered.ok()) return rendered.error();
    picture = std::move(rendered).value();
  }
  return files::write_file(output, picture);
}

template <typename List, typename Same>
bool same_lists(const List& a, const List& b, const Same& same) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
}

/// Whether two worlds are those of two robots of one fleet: the room is the same, and others are
/// about in each.
bool of_one_fleet(const world::World& a, const world::World& b) {
  const auto has_others = [](const world::World& world) {
    return std::any_of(world.moving().begin(), world.moving().end(),
                       [](const auto& obstacle) { return obstacle.jumps; });
  };
  return has_others(a) && has_others(b) && a.bounds_min() == b.bounds_min() &&
         a.bounds_max() == b.bounds_max() && a.polygons() == b.polygons() &&
         same_lists(a.walls(), b.walls(),
                    [](const auto& x, const auto& y) { return x.a == y.a && x.b == y.b; }) &&
         same_lists(a.circles(), b.circles(), [](const auto& x, const auto& y) {
           return x.centre == y.centre && x.radius_m == y.radius_m;
         });
}

core::Result<world::World> world_of(const RunTrack& track) {
  return world::World::parse(track.world, track.path + ":world.yaml");
}

}  // namespace

core::Result<void> plot_recordings(const std::vector<std::string>& recordings,
                                   const std::string& output) {
  CLEW_CHECK(!recordings.empty(), "a picture of no recording");
  CLEW_RETURN_IF_ERROR(check_ending(output));
  std::vector<RunTrack> tracks;
  for (const std::string& recording : recordings) {
    auto track = read_run_track(recording);
    if (!track.ok()) return track.error();
    tracks.push_back(std::move(track).value());
  }
  const auto world = world_of(tracks.front());
  if (!world.ok()) return world.error();
  for (const RunTrack& track : tracks) {
    if (track.world == tracks.front().world) continue;
    const auto other = world_of(track);
    if (!other.ok()) return other.error();
    if (of_one_fleet(*world, *other)) continue;
    return core::Error{"was made in another world than " + tracks.front().path, track.path};
  }
  return render_to(draw_runs(*world, tracks), output);
}

core::Result<void> plot_tick(const std::string& recording, const InsideView& inside,
                             const std::string& output) {
  CLEW_RETURN_IF_ERROR(check_ending(output));
  const auto track = read_run_track(recording);
  if (!track.ok()) return track.error();
  if (track->frames.count(inside.tick) == 0) {
    return core::Error{"has no pose of tick " + std::to_string(inside.tick), recording};
  }
  const auto world = world_of(*track);
  if (!world.ok()) return world.error();
  return render_to(draw_tick(*world, *track, inside), output);
}

core::Result<void> plot_world(const world::World& world, double robot_radius_m,
                              const std::vector<core::Vec2>& traps, const std::string& output) {
  CLEW_RETURN_IF_ERROR(check_ending(output));
  return render_to(draw_empty_world(world, robot_radius_m, traps), output);
}

core::Result<void> write_picture(const std::string& svg, const std::string& output) {
  CLEW_RETURN_IF_ERROR(check_ending(output));
  return render_to(svg, output);
}

}  // namespace clew::plot
