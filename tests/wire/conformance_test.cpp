// SPDX-License-Identifier: Apache-2.0
/// Our bytes are those that Fast CDR makes with the types of fastddsgen. What Cyclone makes with
/// those of idlc is compared over DDS, in interop_test.cpp.
#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "all_messages.hpp"
#include "edge_messages.hpp"
#include "generated_types.hpp"
#include "message_equality.hpp"
#include "random_messages.hpp"
#include "wire/cdr_writer.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {
namespace {

using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;

/// The bytes after Fast CDR has read them into a generated type and written them again, to memory
/// that was zero, since it skips padding.
template <typename Message>
std::string through_fast_cdr(std::string cdr) {
  FastBuffer from(cdr.data(), cdr.size());
  Cdr reader(from, Cdr::LITTLE_ENDIANNESS, Cdr::DDS_CDR);
  reader.read_encapsulation();
  FastMessageOf<Message> theirs;
  theirs.deserialize(reader);
  EXPECT_EQ(reader.getSerializedDataLength(), cdr.size());
  std::string written(kCdrHeaderSize + FastMessageOf<Message>::getCdrSerializedSize(theirs), '\0');
  FastBuffer to(written.data(), written.size());
  Cdr writer(to, Cdr::LITTLE_ENDIANNESS, Cdr::DDS_CDR);
  writer.serialize_encapsulation();
  theirs.serialize(writer);
  EXPECT_EQ(writer.getSerializedDataLength(), written.size());
  return written;
}

template <typename Message>
class Conformance : public testing::Test {
 protected:
  void expect_same_bytes(const Message& message) {
    const std::string ours(codec_.encode(message));
    ASSERT_EQ(ours, through_fast_cdr<Message>(ours));
    Message received;
    ASSERT_TRUE(codec_.decode(ours, received).ok());
    EXPECT_TRUE(received == message);
  }

  Codec<Message> codec_;
};
TYPED_TEST_SUITE(Conformance, AllMessages);

TYPED_TEST(Conformance, OfMessagesAtRandom) {
  RandomMessages random(11);
  for (int i = 0; i < 1000; ++i) {
    TypeParam message;
    random.fill(message);

    this->expect_same_bytes(message);
    if (this->HasFatalFailure()) return;
  }
}

TYPED_TEST(Conformance, OfTheDefaultMessage) { this->expect_same_bytes(TypeParam{}); }

TYPED_TEST(Conformance, OfTheLeastValues) {
  TypeParam message;
  EdgeMessages(false).fill(message);

  this->expect_same_bytes(message);
}

TYPED_TEST(Conformance, OfTheGreatestValues) {
  TypeParam message;
  EdgeMessages(true).fill(message);

  this->expect_same_bytes(message);
}

/// Ours may be a few bytes more than the longest sample, where texts end anywhere.
TYPED_TEST(Conformance, NoMessageIsLongerThanWeReckon) {
  const std::size_t theirs = kCdrHeaderSize + FastMessageOf<TypeParam>::getMaxCdrSerializedSize();
  TypeParam longest;
  EdgeMessages(true).fill(longest);
  Codec<TypeParam> codec;

  EXPECT_GE(max_cdr_size<TypeParam>(), codec.encode(longest).size());
  EXPECT_LE(max_cdr_size<TypeParam>(), theirs + theirs / 10);
}

}  // namespace
}  // namespace clew::bridge
