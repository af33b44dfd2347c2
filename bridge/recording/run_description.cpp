// SPDX-License-Identifier: Apache-2.0
#include "recording/run_description.hpp"

#include <charconv>
#include <cmath>
#include <sstream>
#include <string_view>
#include <system_error>

#include "recording/piece_files.hpp"
#include "recording/recorded_intervention.hpp"

namespace clew::bridge {
namespace {

constexpr std::string_view kFormat = "clew-recording/1";
constexpr std::string_view kVersionPrefix = "version.";
constexpr std::string_view kPlannedPrefix = "planned.";
constexpr const char* kDigestKey = "digest";
constexpr const char* kLeftOutKey = "left_out";
constexpr const char* kSplitBytesKey = "split_bytes";
constexpr const char* kSplitSecondsKey = "split_s";
constexpr const char* kPieceKey = "piece";
constexpr const char* kHashBeforeKey = "hash_before";
constexpr const char* kRunHashKey = "run_hash";
constexpr const char* kContinuesKey = "continues";

/// The shortest digits that read back as the same number.
std::string text_of(double value) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value);
  return {digits, end.ptr};
}

template <typename Number>
std::optional<Number> number_from(std::string_view text, int base) {
  Number number = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), number, base);
  if (end.ec != std::errc() || end.ptr != text.data() + text.size()) return std::nullopt;
  return number;
}

/// A tick's length; within these bounds ticks and nanoseconds turn into each other.
std::optional<double> tick_s_from(std::string_view text) {
  constexpr double kShortest = 1e-6;
  constexpr double kLongest = 1e6;
  double number = 0.0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), number);
  if (end.ec != std::errc() || end.ptr != text.data() + text.size()) return std::nullopt;
  if (!(number >= kShortest && number <= kLongest)) return std::nullopt;
  return number;
}

std::optional<core::Hash128> hash_from(std::string_view hexadecimal) {
  if (hexadecimal.size() != 32) return std::nullopt;
  const auto high = number_from<std::uint64_t>(hexadecimal.substr(0, 16), 16);
  const auto low = number_from<std::uint64_t>(hexadecimal.substr(16), 16);
  if (!high || !low) return std::nullopt;
  return core::Hash128{*high, *low};
}

/// Over all entries but itself; lengths keep two different maps from one text.
std::string digest(const mcap::StringMap& entries) {
  std::string text;
  for (const auto& [key, value] : entries) {
    if (key == kDigestKey) continue;
    for (const std::string& part : {key, value}) text += std::to_string(part.size()) + ':' + part;
  }
  return core::hash128(text).hex();
}

core::Error refused(const mcap::Metadata& metadata, const std::string& why) {
  return {"its metadata record '" + metadata.name + "' " + why};
}

core::Result<void> check_digest(const mcap::Metadata& metadata) {
  const auto found = metadata.entries.find(kDigestKey);
  if (found == metadata.entries.end()) return refused(metadata, "has no digest");
  if (found->second != digest(metadata.entries)) {
    return refused(metadata, "does not match its digest: some of its bytes were changed");
  }
  return {};
}

/// An entry's text; empty if it is missing.
std::string_view entry(const mcap::Metadata& metadata, const std::string& key) {
  const auto found = metadata.entries.find(key);
  return found == metadata.entries.end() ? std::string_view() : found->second;
}

/// What is of the file, and not of the run: only of files that are not as they are by default.
void add_file_entries(const RunDescription& description, mcap::StringMap& entries) {
  std::string names;
  for (const domain::Topic topic : description.left_out) {
    names += (names.empty() ? "" : " ") + std::string(domain::topic_name(topic));
  }
  if (!names.empty()) entries[kLeftOutKey] = names;
  if (description.split.bytes > 0)
    entries[kSplitBytesKey] = std::to_string(description.split.bytes);
  if (description.split.seconds > 0) entries[kSplitSecondsKey] = text_of(description.split.seconds);
  if (!description.split.any()) return;
  entries[kPieceKey] = std::to_string(description.piece);
  entries[kHashBeforeKey] = description.hash_before.hex();
}

core::Result<void> read_split(const mcap::Metadata& metadata, RunDescription& description) {
  const bool by_bytes = metadata.entries.count(kSplitBytesKey) > 0;
  const bool by_seconds = metadata.entries.count(kSplitSecondsKey) > 0;
  if (!by_bytes && !by_seconds) return {};
  const auto bytes = number_from<std::uint64_t>(entry(metadata, kSplitBytesKey), 10);
  const auto seconds = tick_s_from(entry(metadata, kSplitSecondsKey));
  if (by_bytes && !bytes) return refused(metadata, "has no number 'split_bytes'");
  if (by_seconds && !seconds) return refused(metadata, "has no number 'split_s'");
  description.split = {bytes.value_or(0), seconds.value_or(0.0)};
  const auto piece = number_from<std::uint64_t>(entry(metadata, kPieceKey), 10);
  const auto before = hash_from(entry(metadata, kHashBeforeKey));
  if (!piece || *piece >= kMaxPieces) {
    return refused(metadata, "has no number 'piece' below " + std::to_string(kMaxPieces));
  }
  if (!before) return refused(metadata, "has no 'hash_before' of 32 hexadecimal digits");
  description.piece = *piece;
  description.hash_before = *before;
  return {};
}

core::Result<void> read_file_entries(const mcap::Metadata& metadata, RunDescription& description) {
  std::istringstream names{std::string(entry(metadata, kLeftOutKey))};
  for (std::string name; names >> name;) {
    const auto topic = domain::topic_from_name(name);
    if (!topic) return refused(metadata, "leaves out '" + name + "', which is no topic");
    description.left_out.insert(*topic);
  }
  return read_split(metadata, description);
}

}  // namespace

mcap::Metadata to_metadata(const RunDescription& description) {
  mcap::Metadata metadata;
  metadata.name = kDescriptionName;
  metadata.entries["format"] = kFormat;
  metadata.entries["tick_s"] = text_of(description.tick_s);
  metadata.entries["seed"] = std::to_string(description.seed);
  metadata.entries["idl_fingerprint"] = description.idl_fingerprint;
  if (description.compression != mcap::Compression::kNone) {
    metadata.entries["compression"] = mcap::compression_name(description.compression);
  }
  add_file_entries(description, metadata.entries);
  if (const auto& box = description.black_box) {
    metadata.entries["black_box_tick"] = std::to_string(box->tick);
    metadata.entries["black_box_why"] = box->why;
  }
  for (std::size_t i = 0; i < description.planned.size(); ++i) {
    // Five digits, so that the order of the keys is theirs.
    const std::string number = std::to_string(100000 + i).substr(1);
    metadata.entries[std::string(kPlannedPrefix) + number] =
        to_planned_json(description.planned[i]);
  }
  for (const auto& [name, version] : description.versions) {
    metadata.entries[std::string(kVersionPrefix) + name] = version;
  }
  metadata.entries[kDigestKey] = digest(metadata.entries);
  return metadata;
}

mcap::Metadata to_metadata(const RunEnd& end) {
  mcap::Metadata metadata;
  metadata.name = kEndName;
  metadata.entries["ticks"] = std::to_string(end.ticks);
  metadata.entries["hash"] = end.hash.hex();
  if (end.lost_samples > 0) metadata.entries["lost_samples"] = std::to_string(end.lost_samples);
  if (!end.aborted.empty()) metadata.entries["aborted"] = end.aborted;
  if (end.run_hash) metadata.entries[kRunHashKey] = end.run_hash->hex();
  if (end.continues) metadata.entries[kContinuesKey] = "true";
  metadata.entries[kDigestKey] = digest(metadata.entries);
  return metadata;
}

core::Result<RunDescription> description_from_metadata(const mcap::Metadata& metadata) {
  CLEW_RETURN_IF_ERROR(check_digest(metadata));
  const std::string_view format = entry(metadata, "format");
  if (format != kFormat) {
    return refused(metadata, "is of format '" + std::string(format) + "'; this version reads '" +
                                 std::string(kFormat) + "'");
  }
  const auto tick_s = tick_s_from(entry(metadata, "tick_s"));
  const auto seed = number_from<std::uint64_t>(entry(metadata, "seed"), 10);
  if (!tick_s) return refused(metadata, "has no 'tick_s' between 1e-6 and 1e6");
  if (!seed) return refused(metadata, "has no number 'seed'");
  const auto compression = mcap::compression_from_name(entry(metadata, "compression"));
  if (!compression) return refused(metadata, "has an unknown 'compression'");
  RunDescription description;
  description.tick_s = *tick_s;
  description.seed = *seed;
  description.compression = *compression;
  description.idl_fingerprint = entry(metadata, "idl_fingerprint");
  CLEW_RETURN_IF_ERROR(read_file_entries(metadata, description));
  if (metadata.entries.count("black_box_tick") > 0) {
    const auto tick = number_from<std::uint64_t>(entry(metadata, "black_box_tick"), 10);
    if (!tick) return refused(metadata, "has no number 'black_box_tick'");
    description.black_box = {*tick, std::string(entry(metadata, "black_box_why")), {}};
  }
  for (const auto& [key, value] : metadata.entries) {
    if (key.compare(0, kVersionPrefix.size(), kVersionPrefix) == 0) {
      description.versions[key.substr(kVersionPrefix.size())] = value;
    }
    if (key.compare(0, kPlannedPrefix.size(), kPlannedPrefix) == 0) {
      auto planned = planned_from_json(value);
      if (!planned) return refused(metadata, "has no intervention '" + key + "'");
      description.planned.push_back(*std::move(planned));
    }
  }
  return description;
}

core::Result<RunEnd> end_from_metadata(const mcap::Metadata& metadata) {
  CLEW_RETURN_IF_ERROR(check_digest(metadata));
  const auto ticks = number_from<std::uint64_t>(entry(metadata, "ticks"), 10);
  const auto hash = hash_from(entry(metadata, "hash"));
  if (!ticks) return refused(metadata, "has no number 'ticks'");
  if (!hash) return refused(metadata, "has no 'hash' of 32 hexadecimal digits");
  const std::string_view lost = entry(metadata, "lost_samples");
  const auto lost_samples = number_from<std::uint64_t>(lost.empty() ? "0" : lost, 10);
  if (!lost_samples) return refused(metadata, "has no number 'lost_samples'");
  const auto run_hash = hash_from(entry(metadata, kRunHashKey));
  if (!run_hash && metadata.entries.count(kRunHashKey) > 0) {
    return refused(metadata, "has no 'run_hash' of 32 hexadecimal digits");
  }
  return RunEnd{*ticks,        *hash,
                *lost_samples, std::string(entry(metadata, "aborted")),
                run_hash,      metadata.entries.count(kContinuesKey) > 0};
}

std::uint64_t tick_to_ns(std::uint64_t tick, double tick_s) {
  return static_cast<std::uint64_t>(std::llround(static_cast<double>(tick) * tick_s * 1e9));
}

std::uint64_t ns_to_tick(std::uint64_t time_ns, double tick_s) {
  return static_cast<std::uint64_t>(std::llround(static_cast<double>(time_ns) * 1e-9 / tick_s));
}

}  // namespace clew::bridge
