// SPDX-License-Identifier: Apache-2.0
#include "domain/message_fields.hpp"

#include <gtest/gtest.h>

#include "domain/reset.hpp"
#include "domain/topics.hpp"

namespace clew::domain {
namespace {

std::size_t rounded_up(std::size_t size, std::size_t alignment) {
  return (size + alignment - 1) / alignment * alignment;
}

/// Where the listed members of a struct leave no room for another, nor stand in another order, they
/// are the members it has. Structs within are looked at, too.
template <typename Struct>
void expect_members_listed(const std::string& where) {
  static const Struct kValue{};
  std::size_t end = 0;
  std::size_t alignment = 1;
  visit_named_fields(
      [&](const char* name, const auto& member) {
        using Member = std::decay_t<decltype(member)>;
        const auto offset = static_cast<std::size_t>(reinterpret_cast<const char*>(&member) -
                                                     reinterpret_cast<const char*>(&kValue));
        EXPECT_EQ(offset, rounded_up(end, alignof(Member))) << where << '.' << name;
        end = offset + sizeof(Member);
        alignment = std::max(alignment, alignof(Member));
        if constexpr (kIsStruct<Member>) {
          expect_members_listed<Member>(where + '.' + name);
        } else if constexpr (kIsSequence<Member> || kIsArray<Member>) {
          using Item = std::decay_t<decltype(member[0])>;
          if constexpr (kIsStruct<Item>) expect_members_listed<Item>(where + '.' + name);
        }
      },
      kValue);
  EXPECT_EQ(sizeof(Struct), rounded_up(end, alignment)) << where;
}

TEST(MessageFields, AreTheMembersOfTheStructsInTheirOrder) {
  for (const Topic topic : kAllTopics) {
    visit_topic(topic, [&](auto constant) {
      expect_members_listed<typename decltype(constant)::Message>(std::string(topic_name(topic)));
    });
  }
}

TEST(Reset, LeavesTheDefaultsOfEveryMember) {
  Landmark landmark;
  landmark.stamp = {3, 0.3, 3};
  landmark.spatial_class = 2;
  landmark.presented = true;
  landmark.classes = {1, 2, 3};
  landmark.recognitions.resize(2);
  Guidance guidance;
  guidance.override_motion.kind = CommandKind::kGiveUp;
  guidance.override_motion.step_m = 1.0;
  guidance.why = "because";

  reset(landmark);
  reset(guidance);

  EXPECT_EQ(landmark.stamp.tick, 0U);
  EXPECT_EQ(landmark.spatial_class, 8);  // nothing near, which is no zero
  EXPECT_FALSE(landmark.presented);
  EXPECT_EQ(landmark.classes, (std::array<std::uint8_t, 3>{}));
  EXPECT_TRUE(landmark.recognitions.empty());
  EXPECT_EQ(guidance.override_motion.kind, CommandKind::kStop);
  EXPECT_EQ(guidance.override_motion.step_m, 0.0);
  EXPECT_EQ(guidance.why, "");
}

TEST(Reset, KeepsTheMemoryOfLists) {
  Scan scan;
  scan.ranges_m.assign(100, 1.0);
  const double* memory = scan.ranges_m.data();

  reset(scan);

  EXPECT_TRUE(scan.ranges_m.empty());
  EXPECT_EQ(scan.ranges_m.data(), memory);
}

}  // namespace
}  // namespace clew::domain
