// SPDX-License-Identifier: Apache-2.0
#include "wire/codec.hpp"

#include <fmt/format.h>

#include <cstring>
#include <optional>
#include <string>

#include "clew/idl_fingerprint.h"
#include "clew/idl_texts.hpp"
#include "core/check.hpp"
#include "domain/reset.hpp"
#include "wire/cdr_reader.hpp"
#include "wire/cdr_writer.hpp"

namespace clew::bridge {
namespace {

constexpr std::size_t kMaxPadding = 3;  // DDS rounds the size of a sample up to 4

core::Error refusal(domain::Topic topic, std::string_view cdr, const std::string& what) {
  return {fmt::format("{}, {} bytes: {}", domain::type_name(topic), cdr.size(), what), {}};
}

/// What is wrong with the header; empty if nothing is. Its last two bytes are options of the sender
/// (Cyclone counts padding there) and may be anything.
std::string header_fault(std::string_view cdr) {
  if (cdr.size() < kCdrHeaderSize) return "too short for an encapsulation header";
  if (std::memcmp(cdr.data(), kCdrHeader, 2) == 0) return "";
  return fmt::format("encapsulation {:02x} {:02x}; allowed: 00 01, XCDR1 little-endian",
                     static_cast<unsigned char>(cdr[0]), static_cast<unsigned char>(cdr[1]));
}

/// Reads a message; what is wrong, if something is.
template <typename Path, typename Message>
std::optional<std::string> read(std::string_view cdr, Message& message, Values values) {
  BasicCdrReader<Path> reader(cdr.substr(kCdrHeaderSize), values == Values::kAny
                                                              ? Enumerators::kCutTo255
                                                              : Enumerators::kMustFit);
  reader.read_struct(message);
  const std::size_t end = kCdrHeaderSize + reader.position();
  if (reader.ok() && cdr.size() > end + kMaxPadding) {
    return fmt::format("too long; its content ends after {}", end);
  }
  return reader.fault();
}

/// Reads a message that is most often good, so without a look at the names of its fields, and once
/// more if it is not: what is wrong, if something is.
template <typename Message>
std::optional<std::string> read_message(std::string_view cdr, Message& message, Values values) {
  std::string fault = header_fault(cdr);
  if (!fault.empty()) return fault;
  constexpr std::size_t kLongest = max_cdr_size<Message>();
  if (cdr.size() > kLongest + kMaxPadding) {
    return fmt::format("too long; allowed: at most {}", kLongest);
  }
  if (!read<domain::NoPath>(cdr, message, values)) return std::nullopt;
  return read<domain::FieldPath>(cdr, message, values);
}

template <typename Message>
core::Result<void> decode_message(std::string_view cdr, Message& message, Values values) {
  const std::optional<std::string> fault = read_message(cdr, message, values);
  core::Result<void> result;
  if (fault) {
    result = refusal(domain::topic_of<Message>(), cdr, *fault);
  } else if (values == Values::kValid) {
    result = domain::validate(message);
  }
  if (!result.ok()) domain::reset(message);
  return result;
}

}  // namespace

std::string_view encode(domain::ConstMessagePointer message, std::vector<char>& buffer) {
  const core::Result<void> valid = domain::validate(message);
  CLEW_CHECK(valid.ok(), valid.error().text());
  return std::visit(
      [&](const auto* m) -> std::string_view {
        buffer.resize(max_cdr_size<std::decay_t<decltype(*m)>>());
        std::memcpy(buffer.data(), kCdrHeader, kCdrHeaderSize);
        CdrWriter writer(buffer.data() + kCdrHeaderSize, buffer.size() - kCdrHeaderSize);
        writer.write(*m);
        return {buffer.data(), kCdrHeaderSize + writer.size()};
      },
      message);
}

core::Result<void> decode(std::string_view cdr, domain::MessagePointer message, Values values) {
  return std::visit([&](auto* m) { return decode_message(cdr, *m, values); }, message);
}

std::string_view idl_fingerprint() { return CLEW_IDL_FINGERPRINT; }

std::string_view idl_text(domain::Topic topic) {
  const std::string_view type = domain::type_name(topic);
  const std::string_view name = type.substr(type.rfind(':') + 1);
  for (const idl::TypeText& known : idl::kTypeTexts) {
    if (known.name == name) return known.text;
  }
  CLEW_CHECK(false, fmt::format("no file in idl/ has the type {}", type));
  return {};
}

}  // namespace clew::bridge
