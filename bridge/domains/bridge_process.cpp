// SPDX-License-Identifier: Apache-2.0
#include "domains/bridge_process.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/hash128.hpp"
#include "run/end_signals.hpp"
#include "watch/domain_watch.hpp"

namespace clew::domains {
namespace {

using core::Error;
using core::Result;
using std::chrono::steady_clock;

/// A slow reader's writer is asked again so often: nobody tells when there is room.
constexpr auto kRetryPeriod = std::chrono::milliseconds(5);
constexpr auto kLookPeriod = std::chrono::seconds(1);

/// What tells this host and its network from others: a domain on 127.0.0.1 is this one's only.
std::string host_id() {
  std::string boot;
  std::ifstream("/proc/sys/kernel/random/boot_id") >> boot;
  std::error_code ignored;
  const auto network = std::filesystem::read_symlink("/proc/self/ns/net", ignored);
  return core::hash128(boot + network.string()).hex().substr(0, 8);
}

Result<std::vector<Place>> find_places(const BridgeFile& file) {
  std::vector<Place> places;
  for (const JoinedDomain& joined : file.domains) {
    const auto domain = bridge::domain_of_run(joined.run);
    if (!domain.ok()) return Error{joined.name + ": " + domain.error().message};
    for (const Place& other : places) {
      if (other.domain != *domain || other.on_network != joined.on_network) continue;
      return Error{
          fmt::format("'{}' and '{}' are the same domain, {}", other.name, joined.name, *domain)};
    }
    const std::string where = joined.on_network ? "network" : host_id();
    places.push_back(
        {joined.name, *domain, joined.on_network, fmt::format("{}-{}", where, *domain)});
  }
  return places;
}

}  // namespace

Result<void> run_bridge_process(const BridgeFile& file, const BridgeProcess& process) {
  auto places = find_places(file);
  if (!places.ok()) return places.error();
  bridge::EndSignals signals;
  Surroundings surroundings;
  surroundings.tell = process.tell;
  surroundings.join = [&](std::size_t index, const bridge::ParticipantConfig& config,
                          bridge::DiscoveryListener& listener) {
    return bridge::create_participant(file.domains[index].vendor, config, listener);
  };
  auto bridge = DomainBridge::create(file, std::move(places).value(), surroundings);
  if (!bridge.ok()) return bridge.error();
  for (std::size_t i = 0; i < file.domains.size(); ++i) {
    const Place& place = (*bridge)->places()[i];
    process.tell(fmt::format("{} is domain {} on {}, by {}", place.name, place.domain,
                             place.on_network ? "the network" : "127.0.0.1",
                             bridge::vendor_name(file.domains[i].vendor)));
  }
  const auto status_period = std::chrono::duration_cast<steady_clock::duration>(
      std::chrono::duration<double>(process.status_s));
  auto next_status = steady_clock::now() + status_period;
  while (signals.take() == 0) {
    (*bridge)->step();
    if (process.status_s > 0.0 && steady_clock::now() >= next_status) {
      next_status += status_period;
      process.report(**bridge);
    }
    std::chrono::nanoseconds most = (*bridge)->waits() ? kRetryPeriod : kLookPeriod;
    if (process.status_s > 0.0) {
      most = std::clamp<std::chrono::nanoseconds>(next_status - steady_clock::now(),
                                                  std::chrono::nanoseconds(0), most);
    }
    (*bridge)->wait(signals.descriptor(), most);
  }
  (*bridge)->step();
  process.report(**bridge);
  return {};
}

std::string passages_text(const DomainBridge& bridge) {
  std::string text;
  const auto& places = bridge.places();
  for (const Passage& passage : bridge.passages()) {
    text += fmt::format(
        "{} of {} to {} as {}: {} passed, {} filtered, {} thinned, {} refused, {} unreadable, {} "
        "dropped, {} failed\n",
        passage.topic, places[passage.from].name, places[passage.to].name, passage.as,
        passage.passed, passage.filtered, passage.thinned, passage.refused, passage.unreadable,
        passage.dropped, passage.failed);
  }
  return text +
         fmt::format("of all: {} dropped before they were looked at, {} of unknown writers\n",
                     bridge.overrun(), bridge.unknown());
}

/// Names are of strangers, who may write no UTF-8.
std::string json_text(const nlohmann::ordered_json& line) {
  return line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
}

std::string passages_json(const DomainBridge& bridge) {
  std::string text;
  const auto& places = bridge.places();
  for (const Passage& passage : bridge.passages()) {
    const nlohmann::ordered_json line = {{"topic", passage.topic},
                                         {"as", passage.as},
                                         {"from", places[passage.from].name},
                                         {"to", places[passage.to].name},
                                         {"passed", passage.passed},
                                         {"filtered", passage.filtered},
                                         {"thinned", passage.thinned},
                                         {"refused", passage.refused},
                                         {"unreadable", passage.unreadable},
                                         {"dropped", passage.dropped},
                                         {"failed", passage.failed}};
    text += json_text(line);
  }
  const nlohmann::ordered_json rest = {{"overrun", bridge.overrun()},
                                       {"unknown", bridge.unknown()}};
  return text + json_text(rest);
}

}  // namespace clew::domains
