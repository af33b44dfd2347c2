// SPDX-License-Identifier: Apache-2.0
/// Any detector goes with any escape: every pair of the registries runs in a trap.
#include <gtest/gtest.h>

#include <fstream>
#include <tuple>

#include "core/random.hpp"
#include "mission.hpp"
#include "recover/registry.hpp"
#include "stages/all.hpp"
#include "tests/source_path.hpp"

namespace clew::stages {
namespace {

constexpr int kTicks = 600;

template <typename Behaviour>
std::vector<std::string> names(const runtime::Registry<Behaviour>& registry) {
  std::vector<std::string> all;
  for (const auto& registration : registry.all()) all.push_back(registration.info.name);
  return all;
}

using Pair = std::tuple<std::string, std::string>;

class EveryPair : public ::testing::TestWithParam<Pair> {
 protected:
  /// A world whose trap all detectors notice, with a short clock so that the slow ones do, too.
  static Mission mission(const std::vector<std::string>& more = {}) {
    const auto& [detector, escape] = GetParam();
    std::vector<std::string> with = {"recover.detector=" + detector, "recover.escape=" + escape};
    with.insert(with.end(), more.begin(), more.end());
    std::vector<std::string> set;
    if (detector == "no_progress") set = {"recover.detector.allowance_s=2"};
    return Mission("krishna_kalra", "g-trap", with, set);
  }
};

TEST_P(EveryPair, RunsInATrapWithoutACollision) {
  Mission run = mission();
  bool noticed = false;
  for (int tick = 0; tick < kTicks && !run.over(); ++tick) {
    run.step();
    for (const auto& entry : std::get<domain::Event>(run.messages()).entries) {
      noticed |= entry.kind == domain::EventKind::kTrap;
    }
    const auto mode = std::get<domain::Guidance>(run.messages()).mode;
    ASSERT_NE(mode, domain::GuidanceMode::kUnreachable) << "tick " << tick;
  }

  EXPECT_EQ(run.state().collisions, 0u);
  EXPECT_EQ(noticed, std::get<0>(GetParam()) != "none");
}

TEST_P(EveryPair, GoesOnAsBeforeFromRandomTicks) {
  const core::Random random(core::RandomKey{11, 0, 0, 0});
  Mission uninterrupted = mission();
  std::vector<std::string> digests;
  std::vector<Mission::Saved> breaks;
  for (int tick = 0; tick < kTicks && !uninterrupted.over(); ++tick) {
    if (random.uniform(static_cast<std::uint32_t>(tick)) < 0.03) {
      breaks.push_back(uninterrupted.save());
    }
    uninterrupted.step();
    digests.push_back(uninterrupted.digest());
  }

  ASSERT_FALSE(breaks.empty());
  // From one break to the next, where the same must be saved as without the break before it.
  for (std::size_t i = 0; i < breaks.size(); ++i) {
    const bool is_last = i + 1 == breaks.size();
    const std::uint64_t end = is_last ? digests.size() : breaks[i + 1].next_tick;
    Mission restored = mission();
    restored.load(breaks[i]);
    for (std::uint64_t tick = breaks[i].next_tick; tick < end; ++tick) {
      restored.step();
      ASSERT_EQ(restored.digest(), digests[tick])
          << "saved at " << breaks[i].next_tick << ", " << tick;
    }
    if (is_last) break;
    ASSERT_EQ(restored.save().nodes, breaks[i + 1].nodes) << "at tick " << end;
  }
}

TEST_P(EveryPair, IsGuidedTheSameWithShadows) {
  Mission alone = mission();
  std::string shadows;
  for (const std::string& name : names(recover::detectors())) {
    shadows += (shadows.empty() ? "recover.shadow=" : ",") + name;
  }
  Mission watched = mission({shadows});
  bool logged = false;
  for (int tick = 0; tick < kTicks && !alone.over(); ++tick) {
    alone.step();
    watched.step();
    ASSERT_EQ(alone.digest_of(domain::Topic::kGuidance),
              watched.digest_of(domain::Topic::kGuidance))
        << "tick " << tick;
    for (const auto& entry : std::get<domain::Event>(watched.messages()).entries) {
      logged |= entry.shadow;
    }
  }

  EXPECT_TRUE(logged);
}

std::string pair_name(const ::testing::TestParamInfo<Pair>& info) {
  return std::get<0>(info.param) + "_with_" + std::get<1>(info.param);
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryPair,
                         ::testing::Combine(::testing::ValuesIn(names(recover::detectors())),
                                            ::testing::ValuesIn(names(recover::escapes()))),
                         pair_name);

TEST(Pairs, FallBackInTheOrderOfTheList) {
  Mission run("krishna_kalra", "u-trap", {"recover.escape=fixed_sequence,obstacle_following"},
              {"recover.escape.fixed_sequence.retries=1"});
  std::vector<std::string> begun;
  for (int tick = 0; tick < 6000 && !run.over(); ++tick) {
    run.step();
    for (const auto& entry : std::get<domain::Event>(run.messages()).entries) {
      if (entry.kind == domain::EventKind::kEscapeBegun) begun.push_back(entry.rule);
    }
  }

  // The first trap is cleared away; at the second no retries are left, and the wall is followed.
  EXPECT_EQ(run.state().outcome, domain::Outcome::kReached);
  EXPECT_EQ(begun,
            (std::vector<std::string>{"fixed_sequence", "fixed_sequence", "obstacle_following"}));
}

TEST(Pairs, AreRefusedWhereNobodyWritesLandmarks) {
  const std::string path = ::testing::TempDir() + "no-classifier.yaml";
  std::ofstream(path) << "world: u-trap\nrobot: disc-015\nsense: {behaviour: cones}\n"
                         "recover: {detector: landmark_revisit, escape: [none]}\n"
                         "control: {behaviour: krishna_kalra_fuzzy}\n"
                         "drive: {behaviour: turn_then_step}\n";
  const runtime::ConfigPath configs({tests::source_path("configs")});

  const auto plan = runtime::prepare_run(path, {}, configs, all());

  ASSERT_FALSE(plan.ok());
  EXPECT_NE(plan.error().message.find("recover.detector 'landmark_revisit' needs 'landmark', and "
                                      "no stage of this graph writes it"),
            std::string::npos)
      << plan.error().text();
}

}  // namespace
}  // namespace clew::stages
