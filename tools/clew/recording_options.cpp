// SPDX-License-Identifier: Apache-2.0
#include "clew/recording_options.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/nearest_name.hpp"
#include "recording/output_file.hpp"

namespace clew::tools {
namespace {

using core::Error;
using core::Result;

const std::vector<std::string> kCompressions = {"none", "zstd", "lz4"};
const std::vector<std::string> kRecordOn = {"trap"};
const std::vector<std::string> kOnRecordError = {"stop", "continue"};

bool known(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

Result<void> check_black_box(const RunOptions& options) {
  const bool wanted = !options.record_on.empty();
  if (wanted && !known(kRecordOn, options.record_on)) {
    return Error{core::unknown_name("occasion", options.record_on, kRecordOn), "--record-on"};
  }
  if (wanted && options.record.empty()) {
    return Error{"needs --record FILE", "--record-on"};
  }
  if (!options.resume.empty() && wanted) {
    return Error{"a resumed run is recorded as before", "--record-on"};
  }
  if (options.record_last_s && !wanted) {
    return Error{"needs --record-on trap", "--record-last"};
  }
  return {};
}

Result<void> check_choice(const RunOptions& options) {
  const std::pair<bool, const char*> choices[] = {
      {!options.record_topics.empty(), "--record-topics"},
      {options.split_bytes > 0, "--split-size"},
      {options.split_s > 0.0, "--split-s"}};
  for (const auto& [given, option] : choices) {
    if (!given) continue;
    if (!options.resume.empty()) return Error{"a resumed run is recorded as before", option};
    if (options.record.empty()) return Error{"needs --record FILE", option};
    if (options.record_on.empty()) continue;
    return Error{"a black box (--record-on) holds all topics, in one file", option};
  }
  const bool splits = options.split_bytes > 0 || options.split_s > 0.0;
  const bool is_device = bridge::mcap::OutputFile::temporary_name(options.record) == options.record;
  if (splits && is_device) {
    return Error{"a recording into a device or a pipe cannot be split", options.record};
  }
  return {};
}

}  // namespace

Result<void> check_recording_options(const RunOptions& options) {
  CLEW_RETURN_IF_ERROR(check_black_box(options));
  CLEW_RETURN_IF_ERROR(check_choice(options));
  if (!options.compression.empty() && !known(kCompressions, options.compression)) {
    return Error{core::unknown_name("compression", options.compression, kCompressions),
                 "--compression"};
  }
  if (!known(kOnRecordError, options.on_record_error)) {
    return Error{core::unknown_name("choice", options.on_record_error, kOnRecordError),
                 "--on-record-error"};
  }
  return {};
}

Result<void> choose_recording(const RunOptions& options, bridge::RunDescription& description) {
  const std::string compression = options.compression == "none" ? "" : options.compression;
  description.compression = *bridge::mcap::compression_from_name(compression);
  description.split = {options.split_bytes, options.split_s};
  if (options.record_topics.empty()) return {};
  std::set<domain::Topic> wanted;
  for (const std::string& pattern : options.record_topics) {
    const std::string plain = pattern.substr(pattern.find('/') == 0 ? 1 : 0);
    std::vector<std::string> names;
    bool found = false;
    for (const auto& [topic, schema] : description.schemas) {
      const std::string name(domain::topic_name(topic));
      names.push_back(name);
      if (::fnmatch(plain.c_str(), name.c_str(), 0) != 0) continue;
      wanted.insert(topic);
      found = true;
    }
    if (found) continue;
    return Error{core::unknown_name("topic of this run", plain, names), "--record-topics"};
  }
  for (auto topic = description.schemas.begin(); topic != description.schemas.end();) {
    const bool keep = wanted.count(topic->first) > 0;
    if (!keep) description.left_out.insert(topic->first);
    topic = keep ? std::next(topic) : description.schemas.erase(topic);
  }
  return {};
}

}  // namespace clew::tools
