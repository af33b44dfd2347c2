// SPDX-License-Identifier: Apache-2.0
#include "replay/sample_comparison.hpp"

#include <algorithm>

namespace clew::bridge {
namespace {

std::optional<FieldValue> byte_at(std::string_view bytes, std::size_t place) {
  if (place >= bytes.size()) return std::nullopt;
  return FieldValue(std::uint64_t{static_cast<unsigned char>(bytes[place])});
}

/// The first byte in which two different byte strings differ.
FieldDifference first_byte(std::string_view a, std::string_view b) {
  const std::size_t common = std::min(a.size(), b.size());
  const auto at =
      std::mismatch(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(common), b.begin());
  const auto place = static_cast<std::size_t>(at.first - a.begin());
  return {"(byte " + std::to_string(place) + ')', byte_at(a, place), byte_at(b, place)};
}

}  // namespace

std::vector<FieldDifference> missing_sample(bool missing_in_a) {
  FieldDifference difference{"(sample)", std::nullopt, std::nullopt};
  (missing_in_a ? difference.b : difference.a) = FieldValue(std::string_view("present"));
  return {difference};
}

std::vector<FieldDifference> SampleComparison::explain(domain::Topic topic, std::string_view cdr_a,
                                                       std::string_view cdr_b) {
  return domain::visit_topic(topic, [&](auto constant) -> std::vector<FieldDifference> {
    auto& codec = std::get<constant.kIndex>(codecs_);
    auto& a = std::get<constant.kIndex>(a_);
    auto& b = std::get<constant.kIndex>(b_);
    // Bytes that are no message, or padding that differs, have no field to tell of.
    if (!codec.decode_unvalidated(cdr_a, a).ok() || !codec.decode_unvalidated(cdr_b, b).ok()) {
      return {first_byte(cdr_a, cdr_b)};
    }
    auto fields = differences(a, b);
    if (fields.empty()) return {first_byte(cdr_a, cdr_b)};
    return tolerance_ > 0.0 ? differences(a, b, tolerance_) : fields;
  });
}

}  // namespace clew::bridge
