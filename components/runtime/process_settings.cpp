// SPDX-License-Identifier: Apache-2.0
/// The settings of a stage's `process`.
#include <algorithm>
#include <cctype>

#include "core/nearest_name.hpp"
#include "runtime/middleware.hpp"
#include "runtime/raw_graph.hpp"

namespace clew::runtime {
namespace {

using core::Result;
using core::YamlNode;

constexpr std::int64_t kMaxRestarts = 1'000'000;
/// With a vendor and a number behind it, the common name of a certificate, which has 64 letters.
constexpr std::size_t kLongestGroupName = 48;

/// A group's name is a word of a command line, and that of a participant.
Result<void> read_group(const YamlNode& value, Deployment& deployment) {
  auto word = value.string();
  if (!word.ok()) return word.error();
  const bool plain = std::all_of(word->begin(), word->end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-';
  });
  if (!plain || word->empty() || word->size() > kLongestGroupName || word->front() == '-') {
    return value.error("group is " + value.found() + "; allowed: up to " +
                       std::to_string(kLongestGroupName) + " letters, digits, '_' and '-'");
  }
  deployment.group = *word;
  deployment.group_place = place_of(value);
  return {};
}

}  // namespace

const std::vector<std::string>& process_settings() {
  static const std::vector<std::string> names = {"middleware", "restart_limit", "restart_backoff_s",
                                                 "group", "host"};
  return names;
}

Result<void> read_process_setting(const std::string& key, const YamlNode& value,
                                  Deployment& deployment) {
  if (key == "restart_limit") {
    const auto limit = value.integer();
    if (!limit.ok()) return limit.error();
    if (*limit < 0 || *limit > kMaxRestarts) {
      return value.error("restart_limit is " + value.found() + "; allowed: 0 to " +
                         std::to_string(kMaxRestarts));
    }
    deployment.restart_limit = static_cast<std::uint32_t>(*limit);
    return {};
  }
  if (key == "restart_backoff_s") {
    const auto backoff = value.number();
    if (!backoff.ok()) return backoff.error();
    if (*backoff < 0.0 || *backoff > 60.0) {
      return value.error("restart_backoff_s is " + value.found() + "; allowed: 0 to 60 s");
    }
    deployment.restart_backoff_s = *backoff;
    return {};
  }
  if (key == "group") return read_group(value, deployment);
  if (key == "host") {
    auto host = value.string();
    if (!host.ok()) return host.error();
    if (!is_host_name(*host)) {
      return value.error("host is " + value.found() + "; allowed: " + kHostNameRule);
    }
    deployment.host = *host;
    return {};
  }
  if (key != "middleware") {
    return value.error(core::unknown_name("setting of process", key, process_settings()));
  }
  auto word = value.string();
  if (!word.ok()) return word.error();
  if (!is_middleware(*word)) return value.error(unknown_middleware(*word));
  deployment.middleware = *word;
  return {};
}

}  // namespace clew::runtime
