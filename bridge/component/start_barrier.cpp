// SPDX-License-Identifier: Apache-2.0
#include "component/start_barrier.hpp"

#include <algorithm>
#include <utility>

#include "line/user_data.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {
namespace {

std::string describe(const RemoteEndpoint& remote) {
  std::string text =
      std::string(remote.is_writer ? "writer" : "reader") + " of '" + remote.topic + "'";
  const UserData user_data = UserData::parse(remote.user_data);
  if (!user_data.stage.empty()) text += " in " + user_data.stage;
  if (remote.process_id > 0) text += " (process " + std::to_string(remote.process_id) + ")";
  return text;
}

bool is_expected(const ExpectedEndpoint& expected, const RemoteEndpoint& remote) {
  if (expected.topic != remote.topic || expected.is_writer != remote.is_writer) return false;
  if (expected.stage.empty()) return true;
  const UserData user_data = UserData::parse(remote.user_data);
  return expected.third_party ? user_data.stage.empty() : user_data.stage == expected.stage;
}

}  // namespace

StartBarrier::StartBarrier(std::string own_name, std::vector<ExpectedEndpoint> expected,
                           Handlers handlers)
    : own_name_(std::move(own_name)),
      handlers_(std::move(handlers)),
      expected_(std::move(expected)) {}

void StartBarrier::expect(const std::vector<ExpectedEndpoint>& more) {
  const std::lock_guard<std::mutex> lock(mutex_);
  expected_.insert(expected_.end(), more.begin(), more.end());
}

std::vector<std::string> StartBarrier::missing() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<std::string> missing;
  for (const ExpectedEndpoint& expected : expected_) {
    const bool here = std::any_of(matched_.begin(), matched_.end(), [&](const auto& entry) {
      return is_expected(expected, entry.second);
    });
    if (here) continue;
    const std::string what =
        std::string(expected.is_writer ? "writer" : "reader") + " of '" + expected.topic + "'";
    missing.push_back(own_name_ + (expected.stage.empty()
                                       ? " has not found a " + what
                                       : " has not found the " + what + " in " + expected.stage));
  }
  return missing;
}

bool StartBarrier::wait_for_participants(const std::vector<std::string>& names,
                                         std::chrono::steady_clock::time_point deadline) const {
  std::unique_lock<std::mutex> lock(mutex_);
  return participants_changed_.wait_until(lock, deadline, [&] {
    return std::all_of(names.begin(), names.end(),
                       [this](const std::string& name) { return participants_.count(name) > 0; });
  });
}

bool StartBarrier::misses_third_party(const std::string& topic, bool is_writer) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::any_of(expected_.begin(), expected_.end(), [&](const ExpectedEndpoint& expected) {
    const bool asked = expected.third_party || expected.stage.empty();
    if (!asked || expected.topic != topic || expected.is_writer != is_writer) return false;
    return std::none_of(matched_.begin(), matched_.end(),
                        [&](const auto& entry) { return is_expected(expected, entry.second); });
  });
}

std::string StartBarrier::objection(const RemoteEndpoint& remote) const {
  const UserData user_data = UserData::parse(remote.user_data);
  const std::string own(idl_fingerprint());
  if (user_data.idl_fingerprint.empty()) {
    return "its USER_DATA has no clew_idl=<fingerprint>;, expected " + own;
  }
  if (user_data.idl_fingerprint != own) {
    return "it was built from other IDL files: its fingerprint is " + user_data.idl_fingerprint +
           ", that of " + own_name_ + " is " + own;
  }
  if (!user_data.stage.empty() && !key_.fits(user_data, remote.guid)) {
    return "it says that it is of " + user_data.stage + ", but has not the seal of this run";
  }
  if (!remote.is_writer) return {};
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto expected =
      std::find_if(expected_.begin(), expected_.end(),
                   [&](const ExpectedEndpoint& one) { return is_expected(one, remote); });
  if (expected == expected_.end()) return "the graph has no such writer";
  if (!expected->third_party) return {};
  // A component that is not clew's has no name to tell it by: the first one that comes is it.
  for (const auto& [guid, other] : matched_) {
    if (guid != remote.guid && is_expected(*expected, other)) return "there is one already";
  }
  return {};
}

bool StartBarrier::accepts(const RemoteEndpoint* writer) const {
  if (writer == nullptr) return false;
  const std::lock_guard<std::mutex> lock(mutex_);
  return matched_.count(writer->guid) != 0;
}

void StartBarrier::on_participants(const std::set<std::string>& names) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    participants_ = names;
  }
  participants_changed_.notify_all();
}

// Of a component that is not clew's, the first reader that comes is its own.
bool StartBarrier::is_expected_reader(const RemoteEndpoint& remote) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::any_of(expected_.begin(), expected_.end(), [&](const ExpectedEndpoint& expected) {
    if (!is_expected(expected, remote)) return false;
    return !expected.third_party ||
           std::none_of(matched_.begin(), matched_.end(), [&](const auto& entry) {
             return entry.first != remote.guid && is_expected(expected, entry.second);
           });
  });
}

void StartBarrier::on_matched(const RemoteEndpoint& remote) {
  const bool is_nobodys = UserData::parse(remote.user_data).stage.empty();
  if (handlers_.on_reader && !remote.is_writer && is_nobodys && !is_expected_reader(remote)) {
    return handlers_.on_reader("somebody else listens: a " + describe(remote) +
                               "; nothing waits for it");
  }
  const std::string why_not = objection(remote);
  if (!why_not.empty()) {
    handlers_.on_refused(own_name_ + " refuses the " + describe(remote) + ": " + why_not);
    return;
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    matched_[remote.guid] = remote;
    version_.fetch_add(1);
  }
  handlers_.on_change();
}

void StartBarrier::on_unmatched(const RemoteEndpoint& remote) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (matched_.erase(remote.guid) == 0) return;
    version_.fetch_add(1);
  }
  handlers_.on_change();
}

void StartBarrier::on_incompatible_qos(const std::string& topic, bool local_is_writer,
                                       const std::string& policy) {
  const std::string what = "a " + std::string(local_is_writer ? "reader" : "writer") + " of '" +
                           topic + "' does not match the " +
                           (local_is_writer ? "writer" : "reader") + " in " + own_name_ +
                           ": incompatible QoS policy " + policy +
                           "; expected RELIABLE, TRANSIENT_LOCAL, XCDR1; the history may be any";
  // Neither vendor tells whose it is: it may be anybody's. Only one of somebody else's components
  // can be expected and not match, and only while it is missed.
  if (misses_third_party(topic, !local_is_writer)) return handlers_.on_fatal(what);
  handlers_.on_refused(what);
}

void StartBarrier::on_inconsistent_type(const RemoteEndpoint& remote) {
  handlers_.on_refused(own_name_ + " refuses the " + describe(remote) + ": it uses type " +
                       remote.type);
}

}  // namespace clew::bridge
