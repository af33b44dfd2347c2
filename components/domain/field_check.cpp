// SPDX-License-Identifier: Apache-2.0
#include "domain/field_check.hpp"

#include <fmt/format.h>

namespace clew::domain {

std::string FieldPath::text() const {
  std::string text = outer != nullptr ? outer->text() : "";
  if (!text.empty() && member != nullptr) text += '.';
  if (member != nullptr) text += member;
  if (index) text += fmt::format("[{}]", *index);
  return text;
}

template <typename Path>
void BasicFieldCheck<Path>::text(const Path& path, const std::string& value, std::size_t bound) {
  if (value.size() > bound) {
    refuse(path, fmt::format("{} bytes long", value.size()), fmt::format("at most {}", bound));
  } else if (value.find('\0') != std::string::npos) {
    refuse(path, "a text with a zero byte", "none, since that ends a string in CDR");
  }
}

template <typename Path>
std::string BasicFieldCheck<Path>::describe_range(double low, double high) {
  if (low == -kLargest && high == kLargest) return "finite numbers";
  if (high == kLargest) return fmt::format("finite numbers from {}", low);
  if (low == -kLargest) return fmt::format("finite numbers up to {}", high);
  return fmt::format("{} to {}", low, high);
}

template <typename Path>
void BasicFieldCheck<Path>::refuse_number(const Path& path, double found,
                                          const std::string& allowed) {
  refuse(path, fmt::format("{}", found), allowed);
}

template <typename Path>
void BasicFieldCheck<Path>::refuse(const Path& path, const std::string& found,
                                   const std::string& allowed) {
  if (error_) return;
  error_.emplace();
  if constexpr (std::is_same_v<Path, FieldPath>) {
    error_->message =
        fmt::format("{}: {} is {}; allowed: {}", topic_name(topic_), path.text(), found, allowed);
  }
}

template class BasicFieldCheck<FieldPath>;
template class BasicFieldCheck<NoPath>;

}  // namespace clew::domain
