// SPDX-License-Identifier: Apache-2.0
/// Domain values to CDR bytes and back: the one place that knows both the domain's structs and the
/// types generated from idl/.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "core/result.hpp"
#include "domain/topics.hpp"

namespace clew::bridge {

/// Serialises and deserialises one topic's messages, reusing its buffers: not for two threads at
/// once. Bytes are XCDR1 little-endian with encapsulation header `00 01 00 00`, padding zero,
/// and no padding at the end: identical values are identical bytes.
template <typename Message>
class Codec {
 public:
  Codec();
  ~Codec();
  Codec(Codec&&) noexcept;
  Codec& operator=(Codec&&) noexcept;

  /// The bytes of `message`, valid until the next call. A message that domain::validate refuses is
  /// a mistake of the caller.
  std::string_view encode(const Message& message);

  /// Fills `message` from bytes that came from outside. Refused: another encapsulation, too short,
  /// more than 3 bytes left over, bounds exceeded, unknown enumerators, and what domain::validate
  /// refuses. `message` then has valid, unspecified content.
  core::Result<void> decode(std::string_view cdr, Message& message);

  /// The same for messages that are only compared or shown, with whatever values the bytes hold: no
  /// validation, and enumerators may be unknown (those beyond 255 become 255). Refused is only what
  /// has no place in `message`.
  core::Result<void> decode_unvalidated(std::string_view cdr, Message& message);

 private:
  struct Buffers;
  core::Result<void> read(std::string_view cdr);
  std::unique_ptr<Buffers> buffers_;
};

extern template class Codec<domain::Command>;
extern template class Codec<domain::Event>;
extern template class Codec<domain::Guidance>;
extern template class Codec<domain::Landmark>;
extern template class Codec<domain::Odometry>;
extern template class Codec<domain::Scan>;
extern template class Codec<domain::State>;
extern template class Codec<domain::Target>;

/// 32 hexadecimal digits that change with any file in idl/; also in the generated C header
/// `clew/idl_fingerprint.h` for components that do not link clew.
std::string_view idl_fingerprint();

/// The preprocessed, self-contained IDL text of a topic's type: a recording's schema.
std::string_view idl_text(domain::Topic topic);

}  // namespace clew::bridge
