// SPDX-License-Identifier: Apache-2.0
#include "map/tile_log.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "map/tile_index.hpp"

namespace clew::map {
namespace {

bool holds(const std::vector<TileKey>& keys, const TileKey& key) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

TEST(TileLog, TellsAReaderAllThatChangedSinceItRead) {
  TileLog log;
  std::mt19937_64 random(3);
  std::map<TileKey, std::uint64_t> noted;
  TileLog::Position position;
  std::vector<TileKey> keys;
  EXPECT_FALSE(log.read(position, keys));
  std::set<TileKey> changed;
  for (int step = 0; step < 5000; ++step) {
    if (random() % 5 == 0) log.begin_round();
    const TileKey key(static_cast<std::int32_t>(random() % 4), 7);
    log.note(key, noted[key]);
    changed.insert(key);
    if (random() % 7 != 0) continue;
    ASSERT_TRUE(log.read(position, keys)) << step;
    for (const TileKey& each : changed) ASSERT_TRUE(holds(keys, each)) << step;
    changed.clear();
  }
}

TEST(TileLog, NotesATileOnceARound) {
  TileLog log;
  std::uint64_t noted = 0;
  TileLog::Position position;
  std::vector<TileKey> keys;
  log.read(position, keys);
  for (int i = 0; i < 10; ++i) log.note({1, 2}, noted);
  log.begin_round();
  log.note({1, 2}, noted);

  EXPECT_TRUE(log.read(position, keys));

  EXPECT_EQ(keys, (std::vector<TileKey>{{1, 2}, {1, 2}}));
}

TEST(TileLog, DoesNotKnowWhatItForgot) {
  TileLog log;
  TileLog::Position late;
  TileLog::Position early;
  std::vector<TileKey> keys;
  log.read(late, keys);
  log.read(early, keys);
  for (int i = 0; i < 20000; ++i) {
    log.begin_round();
    std::uint64_t noted = 0;
    log.note({i, 0}, noted);
    if (i % 100 == 99) {
      EXPECT_TRUE(log.read(early, keys));
      EXPECT_TRUE(holds(keys, {i, 0}) && holds(keys, {i - 99, 0}));
    }
  }

  EXPECT_FALSE(log.read(late, keys));
}

TEST(TileLog, IsAnotherOneWhereItIsCopied) {
  TileLog log;
  std::uint64_t noted = 0;
  TileLog::Position position;
  std::vector<TileKey> keys;
  log.read(position, keys);
  log.note({1, 2}, noted);
  TileLog copy = log;

  EXPECT_FALSE(copy.read(position, keys));
  copy.note({1, 2}, noted);
  EXPECT_TRUE(copy.read(position, keys));
  EXPECT_EQ(keys, (std::vector<TileKey>{{1, 2}}));
}

TEST(TileIndex, FindsTheRowsThatATileByTileSearchFinds) {
  std::mt19937_64 random(9);
  const auto below = [&](int end) {
    return static_cast<std::int32_t>(random() % static_cast<std::uint64_t>(end));
  };
  TileIndex index;
  std::set<TileKey> tiles;
  int found = 0;
  for (int step = 0; step < 2000; ++step) {
    const TileKey key(below(5) - 2, below(401) - 200);
    if (step % 20 == 0) {
      index.add(key);
      tiles.insert(key);
    }
    const std::int32_t first = below(401) - 200;
    const std::int32_t last = first + below(40) - 2;
    const auto rows = index.rows_between(key.first, first, last);
    std::vector<std::int32_t> expected;
    for (std::int32_t row = first; row <= last; ++row) {
      if (tiles.count({key.first, row}) != 0) expected.push_back(row);
    }
    ASSERT_EQ(rows.has_value(), !expected.empty()) << step;
    if (!rows) continue;
    ++found;
    ASSERT_EQ(rows->least, expected.front()) << step;
    ASSERT_EQ(rows->most, expected.back()) << step;
  }
  EXPECT_GT(found, 200);
}

}  // namespace
}  // namespace clew::map
