// SPDX-License-Identifier: Apache-2.0
#include "core/archive.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/geometry.hpp"

namespace clew::core {

enum class Mode : std::uint8_t { kSeek, kFollow };

struct Visit {
  Vec2 position = Vec2::Zero();
  std::uint32_t tick = 0;
};

bool operator==(const Visit& a, const Visit& b) {
  return a.position == b.position && a.tick == b.tick;
}

template <typename Visitor>
void visit_fields(Visitor& visit, Visit& v) {
  visit(v.position, v.tick);
}

/// One field of every kind that a state may have.
struct State {
  bool flag = false;
  std::uint8_t byte = 0;
  std::int64_t count = 0;
  double travel_m = 0.0;
  Mode mode = Mode::kSeek;
  std::string name;
  std::optional<double> last_m;
  std::optional<Visit> nothing;
  std::pair<int, std::string> pair;
  std::array<double, 3> classes{};
  std::vector<Visit> visits;
  std::vector<bool> flags;
  std::deque<std::uint16_t> queue;
  std::map<std::string, std::vector<int>> map;
  std::set<std::int32_t> set;
  BoundedVector<Mode, 4> modes;
  Pose2 pose;
};

template <typename Visitor>
void visit_fields(Visitor& visit, State& s) {
  visit(s.flag, s.byte, s.count, s.travel_m, s.mode, s.name, s.last_m, s.nothing, s.pair, s.classes,
        s.visits, s.flags, s.queue, s.map, s.set, s.modes, s.pose);
}

/// A state too large to copy for each checkpoint.
struct Uncopied {
  Uncopied() = default;
  Uncopied(const Uncopied&) = delete;
  Uncopied& operator=(const Uncopied&) = delete;

  std::vector<Visit> visits = std::vector<Visit>(2);
};

template <typename Visitor>
void visit_fields(Visitor& visit, Uncopied& u) {
  visit(u.visits);
}

namespace {

State filled_state() {
  State s;
  s.flag = true;
  s.byte = 200;
  s.count = -3;
  s.travel_m = 0.1;
  s.mode = Mode::kFollow;
  s.name = std::string("a\0b", 3);
  s.last_m = -0.0;
  s.pair = {-7, "pair"};
  s.classes = {1.0, 2.0, 3.0};
  s.visits = {{Vec2(1.0, 2.0), 3}, {Vec2(4.0, 5.0), 6}};
  s.flags = {true, false, true};
  s.queue = {1, 2, 3};
  s.map = {{"b", {2}}, {"a", {1, 1}}};
  s.set = {5, -5};
  s.modes.push_back(Mode::kFollow);
  s.pose = {1.0, 2.0, 3.0};
  return s;
}

std::string bytes_of(State s) {
  StateWriter writer;
  writer(s);
  return writer.take();
}

void expect_equal(const State& a, const State& b) {
  EXPECT_EQ(a.flag, b.flag);
  EXPECT_EQ(a.byte, b.byte);
  EXPECT_EQ(a.count, b.count);
  EXPECT_EQ(a.travel_m, b.travel_m);
  EXPECT_EQ(a.mode, b.mode);
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.last_m, b.last_m);
  EXPECT_EQ(a.nothing, b.nothing);
  EXPECT_EQ(a.pair, b.pair);
  EXPECT_EQ(a.classes, b.classes);
  EXPECT_EQ(a.visits, b.visits);
  EXPECT_EQ(a.flags, b.flags);
  EXPECT_EQ(a.queue, b.queue);
  EXPECT_EQ(a.map, b.map);
  EXPECT_EQ(a.set, b.set);
  EXPECT_EQ(a.modes, b.modes);
  EXPECT_EQ(a.pose, b.pose);
}

TEST(StateWriter, TakesAConstantStateWithoutACopyOfIt) {
  const Uncopied state;
  StateWriter writer;

  writer(state);

  // A count of 8 bytes, and two visits of two doubles and 4 bytes.
  EXPECT_EQ(writer.bytes().size(), 8u + 2u * 20u);
}

TEST(Archive, RestoresEveryKindOfField) {
  const std::string bytes = bytes_of(filled_state());
  State loaded;

  StateReader reader(bytes);
  reader(loaded);

  EXPECT_TRUE(reader.complete());
  expect_equal(loaded, filled_state());
  EXPECT_EQ(bytes_of(loaded), bytes);  // -0.0 included
}

TEST(Archive, ReplacesWhatAStateHeld) {
  const std::string bytes = bytes_of(State{});
  State loaded = filled_state();

  StateReader reader(bytes);
  reader(loaded);

  EXPECT_TRUE(reader.complete());
  expect_equal(loaded, State{});
}

TEST(Archive, LaysFieldsOutLittleEndianWithoutPadding) {
  StateWriter writer;
  std::uint8_t byte = 0xab;
  std::uint32_t word = 0x01020304;
  std::string text = "hi";
  Mode mode = Mode::kFollow;

  writer(byte, word, text, mode);

  const char expected[] =
      "\xab"                              // no padding after it
      "\x04\x03\x02\x01"                  // lowest byte first
      "\x02\x00\x00\x00\x00\x00\x00\x00"  // a size takes eight bytes
      "hi"
      "\x01";
  EXPECT_EQ(writer.bytes(), std::string(expected, sizeof expected - 1));
}

TEST(Archive, GivesTheSameBytesHoweverAStateWasFilled) {
  State forward;
  State backward;
  for (int i = 0; i < 20; ++i) {
    forward.set.insert(i);
    backward.set.insert(19 - i);
    forward.map[std::to_string(i)] = {i};
    backward.map[std::to_string(19 - i)] = {19 - i};
    forward.modes.clear();
    forward.modes.push_back(Mode::kFollow);
  }
  backward.modes.push_back(Mode::kFollow);

  EXPECT_EQ(bytes_of(forward), bytes_of(backward));
}

TEST(Archive, RefusesEveryTruncation) {
  const std::string bytes = bytes_of(filled_state());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    State loaded;
    StateReader reader(std::string_view(bytes).substr(0, size));

    reader(loaded);

    ASSERT_FALSE(reader.ok()) << size << " of " << bytes.size();
    ASSERT_FALSE(reader.complete());
  }
}

TEST(Archive, NoticesWhatIsLeftOver) {
  State loaded;
  const std::string bytes = bytes_of(filled_state()) + '\0';
  StateReader reader(bytes);

  reader(loaded);

  EXPECT_TRUE(reader.ok());
  EXPECT_FALSE(reader.complete());
}

/// A container of `size` items, of which `present` bytes follow.
template <typename Container>
bool accepts(std::uint64_t size, std::size_t present) {
  StateWriter writer;
  writer(size);
  const std::string bytes = writer.take() + std::string(present, '\0');
  StateReader reader(bytes);
  Container container;
  reader(container);
  return reader.ok();
}

template <typename Container>
class ArchiveContainer : public ::testing::Test {};

using Containers = ::testing::Types<std::string, std::vector<std::uint8_t>, std::vector<bool>,
                                    std::vector<Visit>, std::deque<double>, std::map<int, double>,
                                    std::set<std::uint8_t>, BoundedVector<double, 4>>;
TYPED_TEST_SUITE(ArchiveContainer, Containers);

TYPED_TEST(ArchiveContainer, RefusesASizeBeyondTheBytesLeft) {
  // None of these may allocate what they claim to hold.
  EXPECT_FALSE((accepts<TypeParam>(std::numeric_limits<std::uint64_t>::max(), 16)));
  EXPECT_FALSE((accepts<TypeParam>(1ull << 62, 16)));
  EXPECT_FALSE((accepts<TypeParam>(1ull << 32, 16)));
  EXPECT_FALSE((accepts<TypeParam>(17, 16)));
}

TYPED_TEST(ArchiveContainer, AcceptsNothingAsZeroItems) { EXPECT_TRUE((accepts<TypeParam>(0, 0))); }

TEST(Archive, RefusesItemsOfSeveralBytesThatAreNotAllThere) {
  EXPECT_TRUE((accepts<std::vector<double>>(2, 16)));
  EXPECT_FALSE((accepts<std::vector<double>>(3, 16)));
  EXPECT_FALSE((accepts<std::map<int, double>>(2, 16)));
}

TEST(Archive, RefusesMoreThanABoundedVectorHolds) {
  EXPECT_TRUE((accepts<BoundedVector<std::uint8_t, 4>>(4, 4)));
  EXPECT_FALSE((accepts<BoundedVector<std::uint8_t, 4>>(5, 5)));
}

}  // namespace
}  // namespace clew::core
