// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "domain/topics.hpp"
#include "run/sample_account.hpp"
#include "wire/field_list.hpp"

namespace clew::bridge {

/// Two samples of the same topic and tick that are not the same.
struct SampleDifference {
  domain::Topic topic = domain::Topic::kCommand;
  std::uint64_t tick = 0;
  /// In the order of idl/, one at least. Besides the message's fields there are `(sample)`, of
  /// which one side has none, and `(byte N)`, for bytes that no field tells of.
  std::vector<FieldDifference> fields;
};

/// The difference between a sample and none: `(sample)`, `present` on one side.
std::vector<FieldDifference> missing_sample(bool missing_in_a);

/// Compares serialised samples, decoding only those whose bytes differ.
class SampleComparison {
 public:
  /// Numbers at most `tolerance` apart count as equal; with 0 bytes must be.
  explicit SampleComparison(double tolerance = 0.0) : tolerance_(tolerance) {}

  /// In what two samples differ; nothing if they are equal.
  std::vector<FieldDifference> compare(domain::Topic topic, std::string_view cdr_a,
                                       std::string_view cdr_b) {
    if (cdr_a == cdr_b) return {};
    return explain(topic, cdr_a, cdr_b);
  }

 private:
  std::vector<FieldDifference> explain(domain::Topic topic, std::string_view cdr_a,
                                       std::string_view cdr_b);

  double tolerance_;
  Codecs codecs_;
  domain::Messages a_;
  domain::Messages b_;
};

}  // namespace clew::bridge
