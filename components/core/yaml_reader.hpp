// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/result.hpp"

namespace clew::core {

enum class YamlKind { kNull, kScalar, kList, kMap };

/// A value of a YAML file, which knows its place there. Reading is strict: what could be taken for
/// something else than its author meant is refused with file, line, column, what was found and what
/// is allowed. Duplicate keys, keys that are no plain text, anchors, aliases, tags and a second
/// document are refused when the file is parsed; wrong types and numbers that are not finite where
/// they are read. Copies are cheap and keep the file's content alive.
class YamlNode {
 public:
  /// The top value of a file; an empty file is an error. `file` is the name in errors.
  static Result<YamlNode> parse(std::string_view yaml, const std::string& file);

  YamlKind kind() const;
  const std::string& file() const;
  int line() const;    ///< from 1
  int column() const;  ///< from 1

  /// An error at this place.
  Error error(std::string message) const;
  /// What is here, for messages: `'abc'`, `a list of 3`, `a map`, `nothing`.
  std::string found() const;

  /// A finite number, decimal, as `1`, `-0.5` or `2e-3`; never quoted.
  Result<double> number() const;
  /// A whole number within 64 bits; never quoted.
  Result<std::int64_t> integer() const;
  /// `true` or `false`; never quoted.
  Result<bool> boolean() const;
  /// A text, quoted or not; what looks like a number is text as well.
  Result<std::string> string() const;

  /// The items of a list.
  Result<std::vector<YamlNode>> items() const;
  /// A list of exactly `count` finite numbers. `allowed` describes it: `[x, y]`.
  Result<std::vector<double>> numbers(std::size_t count, std::string_view allowed) const;

  struct Entry;
  /// Keys and values of a map, in the order of the file.
  Result<std::vector<Entry>> entries() const;
  /// Whether this is a map with no other keys than these. An unknown key is answered with the
  /// nearest one allowed.
  Result<void> check_keys(const std::vector<std::string>& allowed) const;
  /// The value of a key of a map; none if it is missing or this is no map.
  std::optional<YamlNode> find(std::string_view key) const;
  /// The value of a key that must be there.
  Result<YamlNode> at(std::string_view key) const;

 private:
  struct Value;
  struct Document;
  class Builder;
  YamlNode(std::shared_ptr<const Document> document, std::uint32_t index)
      : document_(std::move(document)), index_(index) {}
  Error expected(std::string_view what) const;

  std::shared_ptr<const Document> document_;
  std::uint32_t index_ = 0;
};

/// A key with its own place, and its value.
struct YamlNode::Entry {
  std::string key;
  YamlNode key_node;
  YamlNode value;
};

}  // namespace clew::core
