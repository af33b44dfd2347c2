// SPDX-License-Identifier: Apache-2.0
#include "convert/codec.hpp"

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <fastcdr/exceptions/Exception.h>
#include <fastcdr/exceptions/NotEnoughMemoryException.h>
#include <fmt/format.h>

#include <cstring>
#include <string>
#include <vector>

#include "clew/idl_fingerprint.h"
#include "clew/idl_texts.hpp"
#include "convert/conversion.hpp"

namespace clew::bridge {
namespace {

using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;
using eprosima::fastcdr::exception::NotEnoughMemoryException;

constexpr std::size_t kHeaderSize = 4;
constexpr std::size_t kMaxPadding = 3;  // DDS rounds the size of a sample up to 4

/// Of the longest sample of a type, without padding at its end.
template <typename Idl>
std::size_t max_size() {
  static const std::size_t size = kHeaderSize + Idl::getMaxCdrSerializedSize();
  return size;
}

core::Error refusal(domain::Topic topic, std::string_view cdr, const std::string& what) {
  return {fmt::format("{}, {} bytes: {}", domain::type_name(topic), cdr.size(), what), {}};
}

/// Bytes 2 and 3 are options of the sender (Cyclone counts padding there) and may be anything.
bool is_little_endian_xcdr1(std::string_view cdr) { return cdr[0] == '\x00' && cdr[1] == '\x01'; }

/// What can be said of a sample from its header and its size.
core::Result<void> check_frame(domain::Topic topic, std::string_view cdr, std::size_t limit) {
  if (cdr.size() < kHeaderSize) return refusal(topic, cdr, "too short for an encapsulation header");
  if (!is_little_endian_xcdr1(cdr)) {
    return refusal(
        topic, cdr,
        fmt::format("encapsulation {:02x} {:02x}; allowed: 00 01, XCDR1 little-endian",
                    static_cast<unsigned char>(cdr[0]), static_cast<unsigned char>(cdr[1])));
  }
  if (cdr.size() > limit + kMaxPadding) {
    return refusal(topic, cdr, fmt::format("too long; allowed: at most {}", limit));
  }
  return {};
}

template <typename Idl>
core::Result<void> deserialize(domain::Topic topic, std::string_view cdr, Idl& idl) {
  // FastBuffer wants a char* for reading, too; deserialising does not write to it.
  FastBuffer bytes(const_cast<char*>(cdr.data()), cdr.size());
  Cdr reader(bytes, Cdr::LITTLE_ENDIANNESS, Cdr::DDS_CDR);
  try {
    reader.read_encapsulation();
    idl.deserialize(reader);
  } catch (const NotEnoughMemoryException&) {
    return refusal(topic, cdr, "too short for its content");
  } catch (const eprosima::fastcdr::exception::Exception&) {
    return refusal(topic, cdr, "a boolean is neither 0 nor 1");
  }
  // Generated code cuts a text at its bound and at a zero byte without a word; the text in memory
  // is then shorter than the one in the bytes.
  const std::size_t read = reader.getSerializedDataLength();
  if (read != kHeaderSize + Idl::getCdrSerializedSize(idl)) {
    return refusal(topic, cdr, "a text is longer than its bound, or has a zero byte or no end");
  }
  if (cdr.size() > read + kMaxPadding) {
    return refusal(topic, cdr, fmt::format("too long; its content ends after {}", read));
  }
  return {};
}

}  // namespace

template <typename Message>
struct Codec<Message>::Buffers {
  IdlOf<Message> idl;
  std::vector<char> bytes = std::vector<char>(max_size<IdlOf<Message>>());
  std::size_t used = 0;  ///< the rest of `bytes` is zero
};

template <typename Message>
Codec<Message>::Codec() : buffers_(std::make_unique<Buffers>()) {}
template <typename Message>
Codec<Message>::~Codec() = default;
template <typename Message>
Codec<Message>::Codec(Codec&&) noexcept = default;
template <typename Message>
Codec<Message>& Codec<Message>::operator=(Codec&&) noexcept = default;

template <typename Message>
std::string_view Codec<Message>::encode(const Message& message) {
  const core::Result<void> valid = domain::validate(message);
  CLEW_CHECK(valid.ok(), valid.error().text());
  Buffers& buffers = *buffers_;
  to_idl(message, buffers.idl);
  // Fast CDR skips padding, and would leave in it what an earlier message wrote there.
  std::memset(buffers.bytes.data(), 0, buffers.used);
  FastBuffer buffer(buffers.bytes.data(), buffers.bytes.size());
  Cdr writer(buffer, Cdr::LITTLE_ENDIANNESS, Cdr::DDS_CDR);
  writer.serialize_encapsulation();
  buffers.idl.serialize(writer);
  buffers.used = writer.getSerializedDataLength();
  return {buffers.bytes.data(), buffers.used};
}

template <typename Message>
core::Result<void> Codec<Message>::decode(std::string_view cdr, Message& message) {
  CLEW_RETURN_IF_ERROR(read(cdr));
  domain::FieldCheck check(domain::topic_of<Message>());
  from_idl(buffers_->idl, message, check);
  core::Result<void> result = check.result();
  if (result.ok()) result = domain::validate(message);
  if (!result.ok()) message = Message{};
  return result;
}

template <typename Message>
core::Result<void> Codec<Message>::decode_unvalidated(std::string_view cdr, Message& message) {
  using Idl = IdlOf<Message>;
  constexpr domain::Topic kTopic = domain::topic_of<Message>();
  CLEW_RETURN_IF_ERROR(read(cdr));
  domain::FieldCheck ignored(kTopic);
  from_idl(buffers_->idl, message, ignored);
  const std::size_t size = Idl::getCdrSerializedSize(buffers_->idl);
  to_idl(message, buffers_->idl);
  if (Idl::getCdrSerializedSize(buffers_->idl) == size) return {};
  message = Message{};
  return refusal(kTopic, cdr, "a list is longer than its bound");
}

template <typename Message>
core::Result<void> Codec<Message>::read(std::string_view cdr) {
  constexpr domain::Topic kTopic = domain::topic_of<Message>();
  CLEW_RETURN_IF_ERROR(check_frame(kTopic, cdr, max_size<IdlOf<Message>>()));
  return deserialize(kTopic, cdr, buffers_->idl);
}

template class Codec<domain::Command>;
template class Codec<domain::Event>;
template class Codec<domain::Guidance>;
template class Codec<domain::Landmark>;
template class Codec<domain::Odometry>;
template class Codec<domain::Scan>;
template class Codec<domain::State>;
template class Codec<domain::Target>;

std::string_view idl_fingerprint() { return CLEW_IDL_FINGERPRINT; }

std::string_view idl_text(domain::Topic topic) {
  switch (topic) {
    case domain::Topic::kCommand:
      return idl::kCommandText;
    case domain::Topic::kEvent:
      return idl::kEventText;
    case domain::Topic::kGuidance:
      return idl::kGuidanceText;
    case domain::Topic::kLandmark:
      return idl::kLandmarkText;
    case domain::Topic::kOdometry:
      return idl::kOdometryText;
    case domain::Topic::kScan:
      return idl::kScanText;
    case domain::Topic::kState:
      return idl::kStateText;
    case domain::Topic::kTarget:
      break;
  }
  return idl::kTargetText;
}

}  // namespace clew::bridge
