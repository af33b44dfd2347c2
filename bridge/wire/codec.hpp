// SPDX-License-Identifier: Apache-2.0
/// Domain values to CDR bytes and back.
#pragma once

#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "domain/topics.hpp"

namespace clew::bridge {

/// The bytes of `message`, in `buffer`. A message that domain::validate refuses is a mistake of the
/// caller.
std::string_view encode(domain::ConstMessagePointer message, std::vector<char>& buffer);

/// What is asked of the values in bytes from outside.
enum class Values {
  kValid,  ///< what domain::validate asks
  kAny     ///< nothing, for messages that are only compared or shown
};

/// Fills `message` from bytes that came from outside; after a refusal it is a default one. Refused:
/// another encapsulation, too short, more than 3 bytes left over, bounds exceeded, booleans other
/// than 0 and 1, and values that are not as `values` asks. With Values::kAny enumerators may be
/// unknown; those beyond 255 become 255.
core::Result<void> decode(std::string_view cdr, domain::MessagePointer message, Values values);

/// Serialises and deserialises one topic's messages, reusing its buffer: not for two threads at
/// once. Bytes are XCDR1 little-endian with encapsulation header `00 01 00 00`, padding zero,
/// and no padding at the end: identical values are identical bytes. After warm-up nothing is
/// allocated.
template <typename Message>
class Codec {
 public:
  /// The bytes of `message`, valid until the next call: see bridge::encode.
  std::string_view encode(const Message& message) { return bridge::encode(&message, buffer_); }

  /// Takes what may enter a component: see bridge::decode.
  core::Result<void> decode(std::string_view cdr, Message& message) {
    return bridge::decode(cdr, &message, Values::kValid);
  }

  /// The same for messages that are only compared or shown, with whatever values there are.
  core::Result<void> decode_unvalidated(std::string_view cdr, Message& message) {
    return bridge::decode(cdr, &message, Values::kAny);
  }

 private:
  std::vector<char> buffer_;  ///< as long as the longest message, once there was one
};

/// A codec of each topic, indexed by domain::Topic.
using Codecs = domain::PerTopic<Codec>;

/// 32 hexadecimal digits that change with any file in idl/; also in the generated C header
/// `clew/idl_fingerprint.h` for components that do not link clew.
std::string_view idl_fingerprint();

/// The preprocessed, self-contained IDL text of a topic's type: a recording's schema.
std::string_view idl_text(domain::Topic topic);

}  // namespace clew::bridge
