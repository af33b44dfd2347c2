// SPDX-License-Identifier: Apache-2.0
#include "hunt/tick_bisect.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "recorder/recording_sink.hpp"
#include "replay/recorded_plan.hpp"
#include "run/composed_run.hpp"
#include "stages/all.hpp"
#include "tests/source_path.hpp"

namespace clew::hunt {
namespace {

/// A run of Krishna & Kalra's graph that leaves the U after its alarm.
class TickBisect : public testing::Test {
 protected:
  static runtime::ConfigPath configs() {
    return runtime::ConfigPath({tests::source_path("configs")});
  }

  void SetUp() override {
    const auto name = testing::UnitTest::GetInstance()->current_test_info()->name();
    path_ = (std::filesystem::temp_directory_path() / (std::string("clew-tick-bisect-") + name))
                .string();
    runtime::GraphOverrides overrides;
    overrides.max_ticks = 400;
    const auto plan = runtime::prepare_run("krishna_kalra", overrides, configs(), stages::all());
    ASSERT_TRUE(plan.ok()) << plan.error().text();
    auto sink = bridge::RecordingSink::create(*plan, path_, true);
    ASSERT_TRUE(sink.ok()) << sink.error().text();
    ASSERT_TRUE(bridge::run_composed(*plan, bridge::ComposedLayout{}, sink->get(), {}).ok());
    ASSERT_TRUE((*sink)->close({}).failure.empty());
  }
  void TearDown() override { std::filesystem::remove(path_); }

  core::Result<TickBisectEnd> bisected(const std::vector<std::string>& with,
                                       const std::vector<std::string>& set,
                                       const std::optional<Property>& property = {}) {
    const auto recording = bridge::RunRecording::open(path_);
    if (!recording.ok()) return recording.error();
    const auto recorded = bridge::recorded_plan(*recording, stages::all());
    if (!recorded.ok()) return recorded.error();
    runtime::GraphOverrides overrides;
    overrides.with = with;
    overrides.set = set;
    const auto changed = bridge::changed_plan(*recording, overrides, configs(), stages::all());
    if (!changed.ok()) return changed.error();
    return bisect_ticks(*recording, *recorded, *changed, property);
  }

  static const TickProbe* at(const TickBisectEnd& end, std::uint64_t tick) {
    const auto found = std::find_if(end.probes.begin(), end.probes.end(),
                                    [&](const TickProbe& probe) { return probe.tick == tick; });
    return found == end.probes.end() ? nullptr : &*found;
  }

 private:
  std::string path_;
};

TEST_F(TickBisect, FindsTheLastTickAtWhichAChangeMatters) {
  const auto end = bisected({"recover.detector=none"}, {});

  ASSERT_TRUE(end.ok()) << end.error().text();
  EXPECT_EQ(end->unchanged.outcome, "reached");
  ASSERT_TRUE(end->last_tick.has_value());
  // The alarm comes at tick 112, and the escape that it begins needs its detector until it is done.
  EXPECT_GT(*end->last_tick, 112u);
  ASSERT_NE(at(*end, *end->last_tick), nullptr);
  EXPECT_EQ(at(*end, *end->last_tick)->outcome, "timeout");
  ASSERT_NE(at(*end, *end->last_tick + 1), nullptr);
  EXPECT_EQ(at(*end, *end->last_tick + 1)->outcome, "reached");
  EXPECT_EQ(end->turns, 1u);
  EXPECT_TRUE(
      std::is_sorted(end->probes.begin(), end->probes.end(),
                     [](const TickProbe& a, const TickProbe& b) { return a.tick < b.tick; }));
}

TEST_F(TickBisect, AsksAPropertyInsteadOfTheOutcome) {
  const auto property = Property::parse("ticks < 250", "p");
  ASSERT_TRUE(property.ok());

  const auto end = bisected({}, {"control.guard_margin_m=0.4"}, *property);

  ASSERT_TRUE(end.ok()) << end.error().text();
  EXPECT_EQ(end->unchanged.verdict, "holds");
  ASSERT_TRUE(end->last_tick.has_value());
  EXPECT_EQ(at(*end, *end->last_tick)->verdict, "fails");
  EXPECT_EQ(at(*end, *end->last_tick)->outcome, "reached");
}

TEST_F(TickBisect, SaysThatAChangeWithoutEffectNeverMatters) {
  const auto end = bisected({}, {"classify.capacity=64"});

  ASSERT_TRUE(end.ok()) << end.error().text();
  EXPECT_FALSE(end->last_tick.has_value());
  EXPECT_EQ(end->turns, 0u);
  EXPECT_EQ(end->probes.size(), 17u);
}

TEST_F(TickBisect, RefusesAnotherDurationOfATick) {
  const auto end = bisected({}, {"tick_s=0.1"});

  EXPECT_FALSE(end.ok());
}

}  // namespace
}  // namespace clew::hunt
