// SPDX-License-Identifier: Apache-2.0
#include "supervisor/run_participants.hpp"

#include <algorithm>

#include "core/check.hpp"
#include "line/frames.hpp"
#include "supervisor/launcher.hpp"
#include "supervisor/member.hpp"

namespace clew::bridge {
namespace {

using runtime::GraphStage;
using runtime::PortInfo;

const std::vector<Vendor> kBothVendors = {Vendor::kCycloneDds, Vendor::kFastDds};

void add_topics(const runtime::TopicSet& topics, std::set<std::string>& names) {
  for (const domain::Topic topic : domain::kAllTopics) {
    if (topics[index_of(topic)]) names.emplace(domain::topic_name(topic));
  }
}

/// Those who only read: whoever looks on, and the run's own.
void add_listeners(const std::vector<Vendor>& vendors, std::vector<SecuredParticipant>& all) {
  Rights reads_all;
  add_topics(runtime::TopicSet().set(), reads_all.reads);
  for (const char* name : {kWatcherName, kObserverIdentity}) {
    all.push_back({name, vendors, reads_all});
  }
}

Vendor vendor_of(const std::string& middleware) {
  const auto vendor = vendor_from_name(middleware);
  CLEW_CHECK(vendor.has_value(), middleware);
  return *vendor;
}

}  // namespace

std::vector<SecuredParticipant> run_participants(const runtime::Graph& graph,
                                                 const ProcessLayout& layout) {
  std::vector<SecuredParticipant> all;
  for (const GraphStage& stage : graph.stages) {
    const std::string name = process_of(stage);
    auto found = std::find_if(all.begin(), all.end(),
                              [&](const SecuredParticipant& one) { return one.name == name; });
    if (found == all.end()) {
      const std::vector<Vendor> own = {vendor_of(middleware_of(stage, layout))};
      all.push_back({name, is_third_party(stage) ? kBothVendors : own, {}});
      found = std::prev(all.end());
    }
    add_topics(stage.ports.outputs, found->rights.writes);
    add_topics(stage.ports.all_inputs(), found->rights.reads);
  }
  add_listeners({vendor_of(layout.middleware)}, all);
  return all;
}

std::vector<SecuredParticipant> all_participants(const std::vector<runtime::StageInfo>& stages) {
  std::vector<SecuredParticipant> all;
  for (const runtime::StageInfo& stage : stages) {
    Rights rights;
    for (const PortInfo& port : stage.ports) {
      const bool reads = port.direction == PortInfo::Direction::kInput;
      (reads ? rights.reads : rights.writes).emplace(domain::topic_name(port.topic));
    }
    all.push_back({stage.name, kBothVendors, std::move(rights)});
  }
  add_listeners(kBothVendors, all);
  return all;
}

}  // namespace clew::bridge
