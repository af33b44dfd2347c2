// SPDX-License-Identifier: Apache-2.0
#include "hunt/candidate.hpp"

#include <algorithm>
#include <cmath>

#include "core/random.hpp"
#include "hunt/world_edit.hpp"

namespace clew::hunt {
namespace {

using core::Result;

constexpr std::uint32_t kDrawStream = 0x68756e74;  // tells these numbers from all others of a seed
constexpr double kSpread = 0.1;                    // of a mutation, as a share

/// Numbers by chance, one after the other.
class Draw {
 public:
  Draw(std::uint64_t seed, std::uint64_t index) : random_({seed, 0, kDrawStream, index}) {}

  double share() { return random_.uniform(next_++); }
  bool with(double probability) { return share() < probability; }
  std::size_t below(std::size_t count) {
    return std::min(static_cast<std::size_t>(share() * static_cast<double>(count)), count - 1);
  }
  /// Small enough for every reader of seeds.
  std::uint64_t seed() { return 1 + random_.bits(next_++) % 999999; }
  /// Near a share; what leaves [0, 1] is reflected.
  double near(double share) {
    const double moved = std::fabs(share + kSpread * random_.normal(next_++));
    return moved <= 1.0 ? moved : std::max(0.0, 2.0 - moved);
  }
  /// The same on a circle.
  double turned(double share) {
    const double moved = share + kSpread * random_.normal(next_++);
    return moved - std::floor(moved);
  }

 private:
  core::Random random_;
  std::uint32_t next_ = 0;
};

bool is_of_family(const Candidate& candidate, const HuntSpace& space) {
  return candidate.source >= space.worlds.size();
}

trap_worlds::WorldOrder order_of(const Candidate& candidate, const HuntSpace& space) {
  trap_worlds::WorldOrder order;
  order.family = space.families[candidate.source - space.worlds.size()];
  order.seed = candidate.world_seed;
  order.number = candidate.number;
  order.count = kDepths;
  return order;
}

void move_start(Candidate& candidate, Draw& draw) {
  if (candidate.place) {
    candidate.place = {draw.near((*candidate.place)[0]), draw.near((*candidate.place)[1])};
  } else {
    candidate.place = {draw.share(), draw.share()};
  }
  if (!candidate.heading) candidate.heading = draw.share();
}

void change_world(Candidate& candidate, const HuntSpace& space, Draw& draw) {
  if (!is_of_family(candidate, space)) return;
  if (draw.with(0.3)) {
    candidate.world_seed = draw.seed();
  } else {
    const int step = draw.with(0.5) ? 1 : -1;
    candidate.number = std::min(std::max(candidate.number + step, 0), kDepths - 1);
  }
}

void mutate_once(Candidate& candidate, const HuntSpace& space, Draw& draw) {
  const double which = draw.share();
  if (!candidate.parameters.empty() && which < 0.4) {
    double& share = candidate.parameters[draw.below(candidate.parameters.size())];
    share = draw.near(share);
  } else if (space.moves_start && which < 0.65) {
    move_start(candidate, draw);
  } else if (space.moves_start && which < 0.8) {
    candidate.heading = candidate.heading ? draw.turned(*candidate.heading) : draw.share();
  } else if (which < 0.9) {
    change_world(candidate, space, draw);
  } else {
    candidate.seed = draw.seed();
  }
}

Result<std::string> text_of_world(const Candidate& candidate, const HuntSpace& space,
                                  const runtime::ConfigSource& configs) {
  const auto& orders = space.worlds;
  if (is_of_family(candidate, space)) {
    return trap_worlds::generate_world(order_of(candidate, space)).text;
  }
  const bench::BenchWorld& world = orders[candidate.source];
  if (world.order) return trap_worlds::generate_world(*world.order).text;
  const auto file = configs.find("worlds", world.name);
  if (!file.ok()) return file.error();
  return file->text;
}

/// The world with the candidate's start, and what is true of it from there.
Result<std::string> with_start(const std::string& text, const std::string& name,
                               const Candidate& candidate, const HuntSpace& space) {
  auto world = world::read_world_file(text, name);
  if (!world.ok()) return world.error();
  if (candidate.place) {
    const auto parsed = world::World::parse(text, name);
    if (!parsed.ok()) return parsed.error();
    const auto& place = *candidate.place;
    const auto start = start_at(*parsed, space.robot_radius_m,
                                {place[0], place[1], candidate.heading.value_or(0.0)});
    if (!start) return text;  // nowhere else to begin
    world->start = *start;
    CLEW_RETURN_IF_ERROR(settle_claims(*world, space.robot_radius_m));
  } else {
    world->start.heading_rad = core::wrap_angle_rad(2.0 * core::kPi * *candidate.heading);
  }
  return world_text(*world);
}

}  // namespace

Candidate draw_candidate(const HuntSpace& space, std::uint64_t seed, std::uint64_t index) {
  Draw draw(seed, index);
  Candidate candidate;
  candidate.source = draw.below(space.sources());
  if (is_of_family(candidate, space)) {
    candidate.world_seed = draw.seed();
    candidate.number = static_cast<int>(draw.below(kDepths));
  }
  candidate.seed = draw.seed();
  for (std::size_t i = 0; i < space.ranges.size(); ++i)
    candidate.parameters.push_back(draw.share());
  if (!space.moves_start || draw.with(0.5)) return candidate;
  candidate.heading = draw.share();
  if (draw.with(0.5)) candidate.place = {draw.share(), draw.share()};
  return candidate;
}

Candidate mutate_candidate(const Candidate& parent, const HuntSpace& space, std::uint64_t seed,
                           std::uint64_t index) {
  Draw draw(seed, index);
  Candidate child = parent;
  const std::size_t changes = 1 + draw.below(3);
  for (std::size_t i = 0; i < changes; ++i) mutate_once(child, space, draw);
  return child;
}

Result<RunCase> realise(const Candidate& candidate, const HuntSpace& space,
                        const runtime::ConfigSource& configs) {
  auto text = text_of_world(candidate, space, configs);
  if (!text.ok()) return text.error();
  RunCase run;
  run.graph = space.graph;
  for (std::size_t i = 0; i < space.ranges.size(); ++i) {
    run.graph.set.push_back(space.ranges[i].setting(candidate.parameters[i]));
  }
  run.world_file = is_of_family(candidate, space)
                       ? trap_worlds::world_name(order_of(candidate, space))
                       : space.worlds[candidate.source].name;
  run.seed = candidate.seed;
  if (candidate.heading || candidate.place) {
    text = with_start(*text, run.world_file, candidate, space);
    if (!text.ok()) return text.error();
  }
  run.world_text = std::move(text).value();
  return run;
}

}  // namespace clew::hunt
