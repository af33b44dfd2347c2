// SPDX-License-Identifier: Apache-2.0
#include "replay/recording_diff.hpp"

#include <fmt/format.h>

#include <set>
#include <sstream>
#include <tuple>
#include <utility>

#include "replay/recorded_plan.hpp"

namespace clew::bridge {
namespace {

using Place = std::pair<std::uint64_t, domain::Topic>;

/// The samples of a recording with their places, which must rise.
class OrderedSamples {
 public:
  explicit OrderedSamples(const RunRecording& recording)
      : path_(recording.path()), stream_(recording.samples()) {}

  core::Result<void> advance() {
    auto sample = stream_.next();
    if (!sample.ok()) return sample.error();
    const std::optional<Place> before = place();
    sample_ = std::move(sample).value();
    if (!before || !sample_ || *place() > *before) return {};
    return core::Error{fmt::format("its samples are not in the order of tick and topic at tick {} "
                                   "of {}",
                                   sample_->tick, domain::topic_name(sample_->topic)),
                       path_};
  }
  const std::optional<SampleView>& sample() const { return sample_; }

 private:
  std::optional<Place> place() const {
    if (!sample_) return std::nullopt;
    return Place(sample_->tick, sample_->topic);
  }

  std::string path_;
  SampleStream stream_;
  std::optional<SampleView> sample_;
};

/// Whether the sample stands before the other, or the other is none.
bool comes_first(const std::optional<SampleView>& sample, const std::optional<SampleView>& other) {
  if (!sample) return false;
  if (!other) return true;
  return std::tie(sample->tick, sample->topic) < std::tie(other->tick, other->topic);
}

/// Counts samples and keeps the first difference.
class DiffBuilder {
 public:
  DiffBuilder(RecordingDiff& diff, double tolerance) : diff_(diff), comparison_(tolerance) {}

  void add_one_side(const SampleView& sample, bool is_a) {
    TopicDiff& topic = diff_.topics[sample.topic];
    ++(is_a ? topic.samples_a : topic.samples_b);
    ++(is_a ? topic.only_a : topic.only_b);
    const bool is_shared = diff_.topics_of_one.count(sample.topic) == 0;
    auto& first = is_shared ? diff_.first : first_of_one_;
    if (!first) first = {sample.topic, sample.tick, missing_sample(!is_a)};
  }

  /// Where topics that both have do not differ, those that only one has do.
  void close() {
    if (!diff_.first) diff_.first = std::move(first_of_one_);
  }

  void add_pair(const SampleView& a, const SampleView& b) {
    TopicDiff& topic = diff_.topics[a.topic];
    ++topic.samples_a;
    ++topic.samples_b;
    std::vector<FieldDifference> fields = comparison_.compare(a.topic, a.cdr, b.cdr);
    if (fields.empty() && a.sequence != b.sequence) {
      fields = {{"(sequence)", FieldValue(a.sequence), FieldValue(b.sequence)}};
    }
    ++(fields.empty() ? topic.equal : topic.different);
    if (!fields.empty() && !diff_.first) diff_.first = {a.topic, a.tick, std::move(fields)};
  }

 private:
  RecordingDiff& diff_;
  std::optional<SampleDifference> first_of_one_;
  SampleComparison comparison_;
};

core::Result<void> diff_samples(const RunRecording& a, const RunRecording& b, double tolerance,
                                RecordingDiff& diff) {
  OrderedSamples samples_a(a);
  OrderedSamples samples_b(b);
  DiffBuilder builder(diff, tolerance);
  CLEW_RETURN_IF_ERROR(samples_a.advance());
  CLEW_RETURN_IF_ERROR(samples_b.advance());
  while (samples_a.sample() || samples_b.sample()) {
    const bool only_a = comes_first(samples_a.sample(), samples_b.sample());
    const bool only_b = comes_first(samples_b.sample(), samples_a.sample());
    if (only_a || only_b) {
      OrderedSamples& side = only_a ? samples_a : samples_b;
      builder.add_one_side(*side.sample(), only_a);
      CLEW_RETURN_IF_ERROR(side.advance());
    } else {
      builder.add_pair(*samples_a.sample(), *samples_b.sample());
      CLEW_RETURN_IF_ERROR(samples_a.advance());
      CLEW_RETURN_IF_ERROR(samples_b.advance());
    }
  }
  builder.close();
  return {};
}

/// The first line in which two texts differ, as `line 7: radius_m: 0.2`.
std::pair<std::string, std::string> first_line(const std::string& a, const std::string& b) {
  std::istringstream lines_a(a);
  std::istringstream lines_b(b);
  for (int number = 1;; ++number) {
    std::string line_a;
    std::string line_b;
    const bool has_a = static_cast<bool>(std::getline(lines_a, line_a));
    const bool has_b = static_cast<bool>(std::getline(lines_b, line_b));
    if (!has_a && !has_b) return {"another end of line", "another end of line"};
    if (has_a == has_b && line_a == line_b) continue;
    const auto text = [&](bool has, const std::string& line) {
      return has ? fmt::format("line {}: {}", number, line) : fmt::format("no line {}", number);
    };
    return {text(has_a, line_a), text(has_b, line_b)};
  }
}

using Texts = std::map<std::string, std::string>;

std::set<std::string> names_of(const Texts& a, const Texts& b) {
  std::set<std::string> names;
  for (const Texts* texts : {&a, &b}) {
    for (const auto& [name, text] : *texts) names.insert(name);
  }
  return names;
}

void diff_files(const Texts& a, const Texts& b, std::vector<ConfigurationDifference>& found) {
  for (const std::string& name : names_of(a, b)) {
    const auto in_a = a.find(name);
    const auto in_b = b.find(name);
    if (in_a == a.end() || in_b == b.end()) {
      found.push_back({name, in_a == a.end() ? "" : "present", in_b == b.end() ? "" : "present"});
    } else if (in_a->second != in_b->second) {
      const auto [line_a, line_b] = first_line(in_a->second, in_b->second);
      found.push_back({name, line_a, line_b});
    }
  }
}

/// What is no file, as texts by name.
Texts values_of(const RunDescription& description) {
  Texts values = {{"seed", std::to_string(description.seed)},
                  {"tick_s", field_text(description.tick_s)}};
  for (const auto& [program, version] : description.versions) {
    values["version " + program] = version;
  }
  return values;
}

void diff_values(const Texts& a, const Texts& b, std::vector<ConfigurationDifference>& found) {
  for (const std::string& name : names_of(a, b)) {
    const auto in_a = a.find(name);
    const auto in_b = b.find(name);
    const std::string value_a = in_a == a.end() ? "" : in_a->second;
    const std::string value_b = in_b == b.end() ? "" : in_b->second;
    if (value_a != value_b) found.push_back({name, value_a, value_b});
  }
}

}  // namespace

core::Result<RecordingDiff> diff_recordings(const RunRecording& a, const RunRecording& b,
                                            double tolerance) {
  CLEW_RETURN_IF_ERROR(check_message_types(a));
  CLEW_RETURN_IF_ERROR(check_message_types(b));
  RecordingDiff diff;
  diff_values(values_of(a.description()), values_of(b.description()), diff.configuration);
  diff_files(a.description().bundle, b.description().bundle, diff.configuration);
  for (const domain::Topic topic : domain::kAllTopics) {
    const bool in_a = a.description().schemas.count(topic) > 0;
    if (in_a != (b.description().schemas.count(topic) > 0)) diff.topics_of_one[topic] = in_a;
  }
  CLEW_RETURN_IF_ERROR(diff_samples(a, b, tolerance, diff));
  return diff;
}

}  // namespace clew::bridge
