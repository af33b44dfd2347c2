// SPDX-License-Identifier: Apache-2.0
#include "runtime/input_buffer.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

#include "core/random.hpp"

namespace clew::runtime {
namespace {

using Offer = InputBuffer::Offer;
using domain::Command;
using domain::Odometry;
using domain::Scan;

constexpr std::size_t kDepth = 4;

/// Reads scan and odometry of the tick, and command of the tick before.
NodePorts three_inputs() {
  NodePorts ports;
  ports.inputs.set(index_of(Topic::kScan)).set(index_of(Topic::kOdometry));
  ports.delayed_inputs.set(index_of(Topic::kCommand));
  ports.declared_inputs = ports.inputs | ports.delayed_inputs;
  return ports;
}

template <typename Message>
Message sample(std::uint64_t tick, std::uint64_t sequence = 0) {
  Message message;
  message.stamp.tick = tick;
  message.stamp.sequence = sequence;
  return message;
}

template <typename Message>
Offer offer(InputBuffer& buffer, std::uint64_t tick, std::uint64_t sequence = 0) {
  Message message = sample<Message>(tick, sequence);
  return buffer.offer(message);
}

/// All that tick `tick` needs.
void offer_all(InputBuffer& buffer, std::uint64_t tick) {
  offer<Scan>(buffer, tick);
  offer<Odometry>(buffer, tick);
  if (tick > 0) offer<Command>(buffer, tick - 1);
}

TEST(InputBuffer, IsReadyWhenEveryInputIsThere) {
  InputBuffer buffer(three_inputs(), kDepth);
  EXPECT_FALSE(buffer.ready());

  EXPECT_EQ(offer<Scan>(buffer, 0), Offer::kTaken);
  EXPECT_FALSE(buffer.ready());
  EXPECT_EQ(offer<Odometry>(buffer, 0), Offer::kTaken);

  EXPECT_TRUE(buffer.ready());  // tick 0 has no tick before it
}

TEST(InputBuffer, LaterTicksNeedTheCommandOfTheTickBefore) {
  InputBuffer buffer(three_inputs(), kDepth);
  domain::Messages messages;
  offer_all(buffer, 0);
  buffer.take(messages);
  offer<Scan>(buffer, 1);
  offer<Odometry>(buffer, 1);
  EXPECT_FALSE(buffer.ready());

  offer<Command>(buffer, 0, 77);

  ASSERT_TRUE(buffer.ready());
  EXPECT_EQ(buffer.take(messages), three_inputs().all_inputs());
  EXPECT_EQ(std::get<Command>(messages).stamp.sequence, 77u);
}

TEST(InputBuffer, HandsOverTheSamplesOfTheTick) {
  InputBuffer buffer(three_inputs(), kDepth);
  offer<Scan>(buffer, 0, 10);
  offer<Odometry>(buffer, 0, 20);
  domain::Messages messages;

  const TopicSet present = buffer.take(messages);

  EXPECT_EQ(present, three_inputs().inputs);
  EXPECT_EQ(std::get<Scan>(messages).stamp.sequence, 10u);
  EXPECT_EQ(std::get<Odometry>(messages).stamp.sequence, 20u);
  EXPECT_EQ(buffer.next_tick(), 1u);
  EXPECT_FALSE(buffer.ready());
}

/// One sample of the three topics in the first four ticks, by a number: topic * kDepth + tick.
Offer offer_numbered(InputBuffer& buffer, std::size_t number) {
  const std::uint64_t tick = number % kDepth;
  switch (number / kDepth) {
    case 0:
      return offer<Scan>(buffer, tick, 100 + tick);
    case 1:
      return offer<Odometry>(buffer, tick, 200 + tick);
    default:
      return offer<Command>(buffer, tick, 300 + tick);
  }
}

TEST(InputBuffer, AnyOrderOfArrivalGivesTheSameInputs) {
  // Scans and odometry of ticks 0..3, and commands 0..2, which ticks 1..3 need.
  std::vector<std::size_t> order = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  const core::Random random({});
  std::uint32_t draws = 0;
  for (int shuffle = 0; shuffle < 2000; ++shuffle) {
    for (std::size_t i = order.size() - 1; i > 0; --i) {
      std::swap(order[i], order[random.bits(draws++) % (i + 1)]);
    }
    InputBuffer buffer(three_inputs(), kDepth);
    domain::Messages messages;
    std::uint64_t steps = 0;
    for (const std::size_t number : order) {
      ASSERT_EQ(offer_numbered(buffer, number), Offer::kTaken);
      while (buffer.ready()) {
        buffer.take(messages);
        ASSERT_EQ(std::get<Scan>(messages).stamp.sequence, 100 + steps);
        ASSERT_EQ(std::get<Odometry>(messages).stamp.sequence, 200 + steps);
        if (steps > 0) {
          ASSERT_EQ(std::get<Command>(messages).stamp.sequence, 300 + steps - 1);
        }
        ++steps;
      }
    }
    ASSERT_EQ(steps, kDepth);
  }
}

TEST(InputBuffer, KeepsTheFirstOfTwoSamplesOfATick) {
  InputBuffer buffer(three_inputs(), kDepth);
  offer<Scan>(buffer, 0, 1);

  EXPECT_EQ(offer<Scan>(buffer, 0, 2), Offer::kKnown);

  offer<Odometry>(buffer, 0);
  domain::Messages messages;
  buffer.take(messages);
  EXPECT_EQ(std::get<Scan>(messages).stamp.sequence, 1u);
}

TEST(InputBuffer, DropsWhatWasStepped) {
  InputBuffer buffer(three_inputs(), kDepth);
  domain::Messages messages;
  offer_all(buffer, 0);
  buffer.take(messages);

  EXPECT_EQ(offer<Scan>(buffer, 0), Offer::kKnown);
  EXPECT_EQ(offer<Command>(buffer, 0), Offer::kTaken);  // tick 1 reads it
}

TEST(InputBuffer, KnowsWhatCanNoLongerCome) {
  InputBuffer buffer(three_inputs(), kDepth);
  offer<Scan>(buffer, 0);

  EXPECT_FALSE(buffer.rest_is_lost());
  // A later scan says nothing of the odometry of tick 0, a later odometry does.
  offer<Scan>(buffer, 1);
  EXPECT_FALSE(buffer.rest_is_lost());
  offer<Odometry>(buffer, 2);
  EXPECT_TRUE(buffer.rest_is_lost());
}

TEST(InputBuffer, HoldsSoManyTicksAndNoMore) {
  InputBuffer buffer(three_inputs(), kDepth);

  EXPECT_EQ(offer<Scan>(buffer, kDepth - 1), Offer::kTaken);
  EXPECT_EQ(offer<Scan>(buffer, kDepth), Offer::kAhead);
  EXPECT_EQ(offer<Command>(buffer, kDepth - 1), Offer::kAhead);  // tick 4 would read it
}

TEST(InputBuffer, TakesNoHarmFromTicksAtTheEndOfNumbers) {
  constexpr std::uint64_t kLast = std::numeric_limits<std::uint64_t>::max();
  InputBuffer buffer(three_inputs(), kDepth);

  EXPECT_EQ(offer<Scan>(buffer, kLast), Offer::kAhead);
  EXPECT_EQ(offer<Command>(buffer, kLast), Offer::kAhead);

  offer_all(buffer, 0);
  EXPECT_TRUE(buffer.ready());
}

TEST(InputBuffer, ADroppedSampleStaysWithItsOwner) {
  InputBuffer buffer(three_inputs(), kDepth);
  Scan ahead = sample<Scan>(kDepth, 5);

  buffer.offer(ahead);

  EXPECT_EQ(ahead.stamp.sequence, 5u);
}

TEST(InputBuffer, GoesOnFromALaterTick) {
  InputBuffer buffer(three_inputs(), kDepth);
  offer_all(buffer, 1);
  offer_all(buffer, 2);

  buffer.restart_at(2);

  EXPECT_EQ(buffer.next_tick(), 2u);
  EXPECT_TRUE(buffer.ready());
  EXPECT_EQ(offer<Scan>(buffer, 1), Offer::kKnown);
  EXPECT_EQ(offer<Scan>(buffer, 5), Offer::kTaken);  // in the place of tick 1
}

TEST(InputBuffer, GoesOnFarAheadOfWhatItHolds) {
  InputBuffer buffer(three_inputs(), kDepth);
  for (std::uint64_t tick = 0; tick < kDepth; ++tick) offer_all(buffer, tick);

  buffer.restart_at(1000);

  EXPECT_FALSE(buffer.ready());
  offer_all(buffer, 1000);
  EXPECT_TRUE(buffer.ready());
}

TEST(InputBuffer, GoesBackToAnEarlierTick) {
  InputBuffer buffer(three_inputs(), kDepth);
  buffer.restart_at(10);
  for (std::uint64_t tick = 10; tick < 10 + kDepth; ++tick) offer_all(buffer, tick);

  buffer.restart_at(8);

  // Ticks 10 and 11 are still within reach; what was held for 12 and 13 must not pass for 8 and 9.
  EXPECT_FALSE(buffer.ready());
  domain::Messages messages;
  for (std::uint64_t tick : {8u, 9u}) {
    EXPECT_EQ(offer<Scan>(buffer, tick), Offer::kTaken);
    EXPECT_EQ(offer<Odometry>(buffer, tick), Offer::kTaken);
    EXPECT_EQ(offer<Command>(buffer, tick - 1), Offer::kTaken);
    buffer.take(messages);
    EXPECT_EQ(std::get<Scan>(messages).stamp.tick, tick);
  }
  EXPECT_TRUE(buffer.ready());
  EXPECT_EQ(offer<Scan>(buffer, 12), Offer::kTaken);
}

}  // namespace
}  // namespace clew::runtime
