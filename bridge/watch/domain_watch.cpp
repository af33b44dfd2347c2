// SPDX-License-Identifier: Apache-2.0
#include "watch/domain_watch.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "dds/rtps_ports.hpp"
#include "line/command_desk.hpp"
#include "line/user_data.hpp"
#include "run/limits.hpp"
#include "vendors/participant_factory.hpp"
#include "watch/run_watch.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {
namespace {

using std::chrono::nanoseconds;
using std::chrono::steady_clock;

/// Fast DDS may tell its endpoints with the next of its heartbeats only, a second later.
constexpr std::chrono::milliseconds kQuiet{1200};
/// Readers keep this many samples that the thread of delivery has not taken yet.
constexpr int kDepth = 64;
constexpr const char* kName = "clew topic";

}  // namespace

core::Result<int> domain_of_run(const std::string& run) {
  if (is_domain_number(run)) {
    const int domain = std::stoi(run);
    CLEW_RETURN_IF_ERROR(check_domain(domain));
    return domain;
  }
  const auto socket = connect_to_run(run);
  if (!socket.ok()) return socket.error();
  Link line(*socket);
  const auto what = ask_what_runs(line, steady_clock::now() + kAssignmentTimeout);
  if (what.ok()) return what->domain;
  return core::Error{"run '" + run + "' tells no domain: " + what.error().message +
                     " (a composed run has none)"};
}

core::Result<std::unique_ptr<DomainWatch>> DomainWatch::join(int domain) {
  std::unique_ptr<DomainWatch> self(new DomainWatch(domain));
  auto participant = create_participant(Vendor::kCycloneDds, {domain, kName, kLease_s}, *self);
  if (!participant.ok()) return participant.error();
  self->participant_ = std::move(participant).value();
  return self;
}

DomainWatch::~DomainWatch() = default;

void DomainWatch::settle(nanoseconds most) const {
  const Time deadline = steady_clock::now() + most;
  Time quiet_since = steady_clock::now();
  std::uint64_t known = 0;
  while (true) {
    std::uint64_t news = 0;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      news = news_;
    }
    const Time now = steady_clock::now();
    if (news != std::exchange(known, news)) quiet_since = now;
    // An empty domain is listened to until the end: who is there may be slow to say so.
    const Time until = news == 0 ? deadline : std::min(deadline, quiet_since + kQuiet);
    if (now >= until) return;
    changed_.wait_beside({}, until - now);
  }
}

std::vector<RemoteEndpoint> DomainWatch::endpoints() const {
  std::vector<RemoteEndpoint> all;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& [guid, remote] : endpoints_) all.push_back(remote);
  }
  const auto key = [](const RemoteEndpoint& e) { return std::tie(e.topic, e.type, e.guid); };
  std::sort(all.begin(), all.end(),
            [&](const RemoteEndpoint& a, const RemoteEndpoint& b) { return key(a) < key(b); });
  return all;
}

core::Result<void> DomainWatch::read(const std::string& topic, const std::string& type) {
  auto reader = std::make_unique<Reader>(*this, readers_.size());
  const std::string user_data = UserData{std::string(idl_fingerprint()), {}}.to_text();
  auto endpoint =
      participant_->create_reader({topic, type, user_data, kDepth, {false, false, true}}, *reader);
  if (!endpoint.ok()) return endpoint.error();
  reader->endpoint = std::move(endpoint).value();
  readers_.push_back(std::move(reader));
  return {};
}

void DomainWatch::keep(std::size_t reader, std::string_view cdr) {
  const Time now = steady_clock::now();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (bytes_ + cdr.size() > kMaxKeptBytes) {
      ++dropped_;
      return;
    }
    bytes_ += cdr.size();
    arrivals_.push_back({reader, now, std::string(cdr)});
  }
  changed_.ring();
}

void DomainWatch::wait(int descriptor, nanoseconds most) const {
  changed_.wait_beside({descriptor}, most);
}

std::vector<DomainWatch::Arrival> DomainWatch::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  bytes_ = 0;
  return std::exchange(arrivals_, {});
}

std::uint64_t DomainWatch::dropped() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return dropped_;
}

std::string DomainWatch::incompatible_policy() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return incompatible_policy_;
}

void DomainWatch::on_incompatible_qos(const std::string&, bool, const std::string& policy) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    incompatible_policy_ = policy;
  }
  changed_.ring();
}

void DomainWatch::on_discovered(const RemoteEndpoint& remote) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (endpoints_.insert_or_assign(remote.guid, remote).second) ++news_;
  }
  changed_.ring();
}

void DomainWatch::on_lost(const RemoteEndpoint& remote) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    endpoints_.erase(remote.guid);
    ++news_;
  }
  changed_.ring();
}

}  // namespace clew::bridge
