// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <fstream>
#include <mutex>

#include "doctor/doctor.hpp"
#include "line/domain_lock.hpp"
#include "vendors/participant_factory.hpp"

namespace clew::doctor {
namespace {

using bridge::Vendor;
using Clock = std::chrono::steady_clock;

constexpr Vendor kVendors[] = {Vendor::kCycloneDds, Vendor::kFastDds};
/// Discovery takes a second at the most; three were seen on a machine under full load.
constexpr auto kPatience = std::chrono::seconds(5);
constexpr double kLease_s = 10.0;
/// Little-endian CDR of one octet, as it is on the wire.
constexpr std::string_view kSample{"\0\1\0\0\x2a\0\0\0", 8};

class Nobody : public bridge::DiscoveryListener {
 public:
  void on_participants(const std::set<std::string>& /*names*/) override {}
  void on_matched(const bridge::RemoteEndpoint& /*remote*/) override {}
  void on_unmatched(const bridge::RemoteEndpoint& /*remote*/) override {}
  void on_incompatible_qos(const std::string& /*topic*/, bool /*local_is_writer*/,
                           const std::string& /*policy*/) override {}
  void on_inconsistent_type(const bridge::RemoteEndpoint& /*remote*/) override {}
};

/// Waits for a sample.
class Arrival : public bridge::SampleListener {
 public:
  void on_sample(std::string_view /*cdr*/, const bridge::RemoteEndpoint* /*writer*/) override {
    const std::lock_guard lock(mutex_);
    arrived_ = true;
    changed_.notify_all();
  }
  bool wait() {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kPatience, [&] { return arrived_; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool arrived_ = false;
};

/// Domains and names that runs hold: they listen on sockets of these names.
std::vector<std::string> runs(const Machine& machine) {
  std::ifstream file(machine.proc + "/net/unix");
  std::vector<std::string> found;
  for (std::string line; std::getline(file, line);) {
    for (const char* kind : {"domain", "run"}) {
      const std::string name = fmt::format("@clew.{}.", kind);
      const std::size_t at = line.find(name);
      // A connection to one bears the same name.
      const std::string run = at == std::string::npos
                                  ? std::string()
                                  : fmt::format("{} {}", kind, line.substr(at + name.size()));
      const bool is_new = std::find(found.begin(), found.end(), run) == found.end();
      if (!run.empty() && is_new) found.push_back(run);
    }
  }
  return found;
}

Finding tell_runs(const Machine& machine) {
  const auto found = runs(machine);
  return {"runs",
          true,
          found.empty() ? "none goes on" : fmt::format("going on: {}", fmt::join(found, ", ")),
          {}};
}

/// One sample from a writer of one vendor to a reader of the other.
Finding check_way(Vendor from, Vendor to, int domain) {
  Finding finding{fmt::format("{}_to_{}", vendor_name(from), vendor_name(to)), false, {}, {}};
  const auto begin = Clock::now();
  Nobody nobody;
  Arrival arrival;
  const bridge::EndpointSpec spec{"clew_doctor", "clew::msg::Doctor", "", 1, {}};
  const auto sender = create_unsettled_participant(from, {domain, "doctor", kLease_s}, nobody);
  const auto receiver = create_unsettled_participant(to, {domain, "doctor", kLease_s}, nobody);
  for (const auto* each : {&sender, &receiver}) {
    if (each->ok()) continue;
    finding.found = each->error().text();
    finding.fix = "install the package of the library that is named, or build with it";
    return finding;
  }
  const auto reader = (*receiver)->create_reader(spec, arrival);
  const auto writer = (*sender)->create_writer(spec);
  finding.ok = reader.ok() && writer.ok() &&
               (*writer)->write(kSample) == bridge::WriteStatus::kTaken && arrival.wait();
  const auto taken = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - begin);
  if (finding.ok) {
    finding.found = fmt::format("a sample arrived after {} ms, start included", taken.count());
  } else {
    finding.found = fmt::format("no sample arrived within {} ms", taken.count());
    finding.fix = "let UDP pass on the loopback interface (iptables -L, nft list ruleset)";
  }
  return finding;
}

}  // namespace

std::vector<Finding> check_dds(const Machine& machine) {
  std::vector<Finding> findings = {tell_runs(machine)};
  const auto domain = bridge::DomainLock::take(std::nullopt);
  if (!domain.ok()) {
    findings.push_back({"free_domain", false, domain.error().text(),
                        "end runs, or the programs that hold their ports: ss -lunp"});
    return findings;
  }
  findings.push_back({"free_domain", true, fmt::format("domain {} is free", domain->domain()), {}});
  for (const Vendor from : kVendors) {
    for (const Vendor to : kVendors) findings.push_back(check_way(from, to, domain->domain()));
  }
  return findings;
}

}  // namespace clew::doctor
