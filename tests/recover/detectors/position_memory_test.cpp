// SPDX-License-Identifier: Apache-2.0
#include "recover/detectors/position_memory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/random.hpp"

namespace clew::recover {
namespace {

PositionMemory::Visit visit(double x_m, double y_m, std::uint64_t tick = 0) {
  return {tick, {x_m, y_m, 0.0}, 0.0, {}};
}

/// The ticks of the visits kept around a position, in order.
std::vector<std::uint64_t> ticks_around(const PositionMemory& memory, double x_m, double y_m) {
  std::vector<std::uint64_t> ticks;
  memory.around({x_m, y_m}, 1, [&](const PositionMemory::Visit& v) { ticks.push_back(v.tick); });
  std::sort(ticks.begin(), ticks.end());
  return ticks;
}

TEST(PositionMemory, PairsIndicesAsCantorDoes) {
  const PositionMemory memory(1.0, 100);

  // (X, Y) = (2, 3): (5 * 6) / 2 + 3 = 18; times four, plus the quadrant.
  EXPECT_EQ(memory.key_at({2.5, 3.5}), 72u);
  EXPECT_EQ(memory.key_at({-2.5, 3.5}), 73u);
  EXPECT_EQ(memory.key_at({2.5, -3.5}), 74u);
  EXPECT_EQ(memory.key_at({-2.5, -3.5}), 75u);
  // Eq. 1 as printed: X^2 / 2 + X Y + Y^2 / 2 + X / 2 + 3 Y / 2 = 2 + 6 + 4.5 + 1 + 4.5.
}

TEST(PositionMemory, GivesEveryCellAKeyOfItsOwn) {
  const PositionMemory memory(0.5, 100);
  std::set<std::uint64_t> keys;
  for (int x = -50; x < 50; ++x) {
    for (int y = -50; y < 50; ++y) keys.insert(memory.key_at({0.5 * x + 0.25, 0.5 * y + 0.25}));
  }

  EXPECT_EQ(keys.size(), 10000u);
}

TEST(PositionMemory, FindsWhatIsAroundAcrossTheAxes) {
  PositionMemory memory(0.5, 100);
  memory.add(visit(0.1, 0.1, 1));
  memory.add(visit(-0.1, 0.1, 2));
  memory.add(visit(-0.1, -0.1, 3));
  memory.add(visit(5.0, 5.0, 4));

  EXPECT_EQ(ticks_around(memory, 0.1, -0.1), (std::vector<std::uint64_t>{1, 2, 3}));
  EXPECT_EQ(ticks_around(memory, -5.0, 5.0), std::vector<std::uint64_t>{});
}

TEST(PositionMemory, KeepsTheNewestVisitsOfACell) {
  PositionMemory memory(0.5, 100);
  for (std::uint64_t tick = 0; tick < 20; ++tick) memory.add(visit(0.1, 0.1, tick));

  EXPECT_EQ(ticks_around(memory, 0.1, 0.1),
            (std::vector<std::uint64_t>{12, 13, 14, 15, 16, 17, 18, 19}));
  EXPECT_EQ(memory.size(), 1u);
}

TEST(PositionMemory, ForgetsTheOlderHalfWhenItIsFull) {
  PositionMemory memory(1.0, 100);
  for (std::uint64_t i = 0; i < 1000; ++i) {
    memory.add(visit(static_cast<double>(i) + 0.5, 0.5, i));
    ASSERT_LE(memory.size(), 100u);
  }

  EXPECT_EQ(ticks_around(memory, 999.5, 0.5).size(), 2u);
  EXPECT_EQ(ticks_around(memory, 950.5, 0.5).size(), 3u);
  EXPECT_EQ(ticks_around(memory, 800.5, 0.5).size(), 0u);
}

TEST(PositionMemory, FindsWhatASearchFinds) {
  const core::Random random(core::RandomKey{3, 0, 0, 0});
  std::uint32_t next = 0;
  PositionMemory memory(0.5, 100000);
  std::vector<core::Vec2> all;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const double x_m = 200.0 * random.uniform(next++) - 100.0;
    const core::Vec2 p(x_m, 200.0 * random.uniform(next++) - 100.0);
    all.push_back(p);
    memory.add(visit(p.x(), p.y(), i));
  }
  for (int i = 0; i < 2000; ++i) {
    const auto found = ticks_around(memory, all[static_cast<std::size_t>(i)].x(),
                                    all[static_cast<std::size_t>(i)].y());

    // All that are within a cell's width are found, and nothing farther than two.
    for (std::uint64_t j = 0; j < all.size(); ++j) {
      const core::Vec2 apart = (all[j] - all[static_cast<std::size_t>(i)]).cwiseAbs();
      const bool is_found = std::binary_search(found.begin(), found.end(), j);
      if (apart.maxCoeff() <= 0.5) {
        ASSERT_TRUE(is_found);
      }
      if (apart.maxCoeff() >= 1.0) {
        ASSERT_FALSE(is_found);
      }
    }
  }
}

TEST(PositionMemory, IsTheSameAfterSaveAndLoad) {
  PositionMemory memory(0.5, 40);
  for (std::uint64_t i = 0; i < 100; ++i) memory.add(visit(0.3 * static_cast<double>(i), 0.1, i));
  core::StateWriter writer;
  memory.save(writer);
  PositionMemory restored(0.5, 40);

  core::StateReader reader(writer.bytes());
  restored.load(reader);
  memory.add(visit(-1.0, 0.0, 100));
  restored.add(visit(-1.0, 0.0, 100));

  EXPECT_TRUE(reader.complete());
  core::StateWriter a;
  core::StateWriter b;
  memory.save(a);
  restored.save(b);
  EXPECT_EQ(a.bytes(), b.bytes());
  EXPECT_EQ(ticks_around(restored, 29.0, 0.0), ticks_around(memory, 29.0, 0.0));
}

}  // namespace
}  // namespace clew::recover
