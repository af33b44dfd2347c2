// SPDX-License-Identifier: Apache-2.0
#include "wire/older_type.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <string>

#include "wire/codec.hpp"
#include "wire/idl_types.hpp"

namespace clew::bridge {
namespace {

using domain::Topic;

/// Numbers one after the other, aligned as CDR asks for.
class Bytes {
 public:
  template <typename Number>
  Bytes& add(Number number) {
    while ((bytes_.size() - 4) % sizeof number != 0) bytes_ += '\0';
    bytes_.append(reinterpret_cast<const char*>(&number), sizeof number);
    return *this;
  }
  Bytes& text(const std::string& text) {
    add(static_cast<std::uint32_t>(text.size() + 1));
    bytes_.append(text.c_str(), text.size() + 1);
    return *this;
  }
  const std::string& get() const { return bytes_; }

 private:
  std::string bytes_ = std::string("\0\1\0\0", 4);
};

const std::string kStamp =
    "module clew { module msg { @final struct TickStamp { uint64 tick; double sim_time_s; "
    "uint64 sequence_number; }; }; }; ";

std::string in_module(const std::string& text) {
  return "module clew { module msg { " + text + " }; };";
}

OlderType parsed(Topic topic, const std::string& idl) {
  auto type = OlderType::parse(topic, kStamp + in_module(idl));
  EXPECT_TRUE(type.ok()) << type.error().text();
  return std::move(type).value();
}

std::string refusal(Topic topic, const std::string& idl) {
  const auto type = OlderType::parse(topic, idl);
  return type.ok() ? "taken" : type.error().message;
}

TEST(OlderType, GivesFieldsByTheirNamesAndThoseThatHaveComeTheirDefaults) {
  // Of before the heading; a field that is gone, and another order.
  const OlderType type =
      parsed(Topic::kTarget,
             "@final struct Gone { uint8 a[3]; string<9> b; sequence<double, 4> c; };"
             "@final struct Target { TickStamp stamp; double radius_m; Gone gone; "
             "double x_m; double y_m; };");
  Bytes bytes;
  bytes.add(std::uint64_t{7}).add(2.1).add(std::uint64_t{6}).add(0.25);
  for (const std::uint8_t a : std::array<std::uint8_t, 3>{1, 2, 3}) bytes.add(a);
  bytes.text("b").add(std::uint32_t{2}).add(1.0).add(2.0).add(3.5).add(-4.5);
  std::vector<char> buffer;

  const auto cdr = type.to_current(bytes.get(), buffer);

  ASSERT_TRUE(cdr.ok()) << cdr.error().text();
  domain::Target target;
  ASSERT_TRUE(Codec<domain::Target>().decode(*cdr, target).ok());
  EXPECT_EQ(target.stamp.tick, 7u);
  EXPECT_EQ(target.stamp.sim_time_s, 2.1);
  EXPECT_EQ(target.stamp.sequence, 6u);
  EXPECT_EQ(target.x_m, 3.5);
  EXPECT_EQ(target.y_m, -4.5);
  EXPECT_EQ(target.radius_m, 0.25);
  EXPECT_FALSE(target.has_heading);
  EXPECT_TRUE(type.has_field("stamp.tick"));
  EXPECT_TRUE(type.has_field("radius_m"));
  EXPECT_FALSE(type.has_field("has_heading"));
  EXPECT_FALSE(type.has_field("stamp.hour"));
}

TEST(OlderType, KeepsEnumeratorsByTheirNamesAndListsOfStructs) {
  const OlderType type =
      parsed(Topic::kEvent,
             "enum EventKind { EVENT_UNREACHABLE, EVENT_GONE, EVENT_TRAP };"
             "@final struct EventEntry { EventKind kind; boolean shadow; string<48> rule; };"
             "@final struct Event { TickStamp stamp; sequence<EventEntry, 4> entries; };");
  Bytes bytes;
  bytes.add(std::uint64_t{0}).add(0.0).add(std::uint64_t{0}).add(std::uint32_t{3});
  for (const std::uint32_t kind : {2U, 0U, 1U}) {
    bytes.add(kind).add(std::uint8_t{1}).text("r" + std::to_string(kind));
  }
  std::vector<char> buffer;

  const auto cdr = type.to_current(bytes.get(), buffer);

  ASSERT_TRUE(cdr.ok()) << cdr.error().text();
  domain::Event event;
  ASSERT_TRUE(Codec<domain::Event>().decode_unvalidated(*cdr, event).ok());
  ASSERT_EQ(event.entries.size(), 3u);
  EXPECT_EQ(event.entries[0].kind, domain::EventKind::kTrap);
  EXPECT_EQ(event.entries[0].rule, "r2");
  EXPECT_TRUE(event.entries[0].shadow);
  EXPECT_EQ(event.entries[1].kind, domain::EventKind::kUnreachable);
  EXPECT_EQ(static_cast<int>(event.entries[2].kind), 255);  // it has no name any more
  EXPECT_TRUE(type.has_field("entries[2].rule"));
  EXPECT_TRUE(type.has_field("entries.length"));
  EXPECT_FALSE(type.has_field("entries[2].text"));
}

TEST(OlderType, FindsTypesAmongManyByTheirNamesTheFirstOfOneName) {
  std::string idl = "module m { enum Last { A };";
  for (int i = 0; i < 10000; ++i) idl += "enum E" + std::to_string(i) + "{A};";
  idl += "enum E9999{B,C};@final struct Many {";
  for (int i = 0; i < 20000; ++i) idl += "E9999 m" + std::to_string(i) + ';';
  idl += "}; };";

  const auto types = IdlTypes::parse(idl);

  ASSERT_TRUE(types.ok()) << types.error().text();
  EXPECT_EQ(types->structs().back().members.back().type.index, 10000U);
  EXPECT_EQ(types->enumerations()[10000].enumerators.size(), 1U);
}

TEST(OlderType, OfTodayGivesTheSameBytes) {
  const auto type = OlderType::parse(Topic::kGuidance, idl_text(Topic::kGuidance));
  ASSERT_TRUE(type.ok()) << type.error().text();
  domain::Guidance guidance;
  guidance.why = "because";
  guidance.virtual_obstacles.push_back({1, 2, 3, 4});
  guidance.override_motion.kind = domain::CommandKind::kVelocities;
  Codec<domain::Guidance> codec;
  const std::string bytes(codec.encode(guidance));
  std::vector<char> buffer;

  const auto cdr = type->to_current(bytes, buffer);

  ASSERT_TRUE(cdr.ok()) << cdr.error().text();
  EXPECT_EQ(*cdr, bytes);
}

TEST(OlderType, RefusesEveryTruncationAndBoundsThatAreTooSmallToday) {
  const OlderType type =
      parsed(Topic::kTarget, "@final struct Target { TickStamp stamp; double x_m; };");
  Bytes bytes;
  bytes.add(std::uint64_t{7}).add(2.1).add(std::uint64_t{6}).add(0.25);
  std::vector<char> buffer;
  for (std::size_t size = 0; size < bytes.get().size(); ++size) {
    EXPECT_FALSE(type.to_current(std::string_view(bytes.get()).substr(0, size), buffer).ok())
        << size;
  }
  const OlderType wide =
      parsed(Topic::kGuidance, "@final struct Guidance { TickStamp stamp; string<500> why; };");
  Bytes text;
  text.add(std::uint64_t{7}).add(2.1).add(std::uint64_t{6}).text(std::string(97, 'x'));

  const auto cdr = wide.to_current(text.get(), buffer);

  ASSERT_FALSE(cdr.ok());
  EXPECT_EQ(cdr.error().message, "why is 97 bytes long; allowed: 96");
}

TEST(OlderType, RefusesAFieldOfAnotherKind) {
  const OlderType type =
      parsed(Topic::kTarget, "@final struct Target { TickStamp stamp; uint32 x_m; };");
  Bytes bytes;
  bytes.add(std::uint64_t{7}).add(2.1).add(std::uint64_t{6}).add(std::uint32_t{1});
  std::vector<char> buffer;

  const auto cdr = type.to_current(bytes.get(), buffer);

  ASSERT_FALSE(cdr.ok());
  EXPECT_EQ(cdr.error().message, "x_m was no number");
}

TEST(OlderType, RefusesTextsThatAreNoIdlOfOurs) {
  EXPECT_EQ(refusal(Topic::kTarget, ""), "it declares no struct Target");
  EXPECT_EQ(refusal(Topic::kTarget, "struct Target {"), "found 'struct', expected '@'");
  EXPECT_EQ(refusal(Topic::kTarget, "module a {"), "a module of it does not end");
  EXPECT_EQ(refusal(Topic::kTarget, "@final struct Target { };"), "found '}', expected a type");
  EXPECT_EQ(refusal(Topic::kTarget, "@final struct Target { Target t; };"),
            "found 'Target', expected a type");
  EXPECT_EQ(refusal(Topic::kTarget, "@final struct Target { sequence<double> t; };"),
            "found '>', expected ','");
  EXPECT_EQ(refusal(Topic::kTarget, "@final struct Target { double t[99999999999]; };"),
            "found '99999999999', expected a number");
  EXPECT_EQ(refusal(Topic::kTarget, std::string(2 * 1024 * 1024, ' ')),
            "it is longer than any of ours");
  // Each twice the one before: reading one would never end.
  std::string deep = "@final struct S0 { uint8 a; };";
  for (int i = 1; i < 40; ++i) {
    const std::string before = "S" + std::to_string(i - 1);
    deep += "@final struct S" + std::to_string(i) + " { " + before + " a; " + before + " b; };";
  }
  EXPECT_EQ(refusal(Topic::kTarget, deep), "its structs lie too deep within each other");
}

}  // namespace
}  // namespace clew::bridge
