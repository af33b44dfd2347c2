// SPDX-License-Identifier: Apache-2.0
/// Whatever the bytes, behind one that chooses the topic: decode refuses them, or gives a message
/// that may enter a component and whose own bytes give the same message.
#include <cstdint>
#include <string>
#include <string_view>

#include "core/check.hpp"
#include "wire/codec.hpp"

namespace clew::fuzz {
namespace {

using namespace bridge;

template <typename Message>
void read(std::string_view cdr) {
  Codec<Message> codec;
  Message message;
  const bool holds_values = codec.decode_unvalidated(cdr, message).ok();
  const auto decoded = codec.decode(cdr, message);
  if (!decoded.ok()) {
    CLEW_CHECK(!decoded.error().message.empty(), "an error without a message");
    return;
  }
  CLEW_CHECK(holds_values, "only the valid message can be read");
  const std::string canonical(codec.encode(message));  // aborts if the message is not valid
  Message again;
  CLEW_CHECK(codec.decode(canonical, again).ok(), "our own bytes are refused");
  CLEW_CHECK(codec.encode(again) == canonical, "the same message has other bytes");
}

}  // namespace
}  // namespace clew::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace clew;
  if (size == 0) return 0;
  const std::string_view cdr(reinterpret_cast<const char*>(bytes) + 1, size - 1);
  domain::visit_topic(static_cast<domain::Topic>(bytes[0] % domain::kTopicCount),
                      [&](auto topic) { fuzz::read<typename decltype(topic)::Message>(cdr); });
  return 0;
}
