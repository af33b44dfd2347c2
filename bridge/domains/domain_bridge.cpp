// SPDX-License-Identifier: Apache-2.0
#include "domains/domain_bridge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "dds/origin.hpp"
#include "run/limits.hpp"

namespace clew::domains {

using bridge::Origin;
using bridge::RemoteEndpoint;
using core::Error;
using core::Result;

namespace {

/// Writers that a bridge knows, and makes, at most: more than any robot has, and less than a
/// stranger could ask for.
constexpr std::size_t kMostWriters = 1000;
/// Readers keep this many samples that the thread of delivery has not taken yet.
constexpr int kReaderDepth = 64;

/// Where samples come from after they have left a place: where they were written first, and the
/// places between.
Origin origin_beyond(const std::string& user_data, const std::string& place) {
  Origin origin = Origin::parse(user_data);
  if (origin.id.empty()) return {place, 1, {}};
  ++origin.hops;
  origin.via.push_back(place);
  return origin;
}

std::string manner_text(bool reliable, bool transient_local) {
  return fmt::format("{}, {}", reliable ? "reliable" : "best effort",
                     transient_local ? "transient local" : "volatile");
}

std::string place_text(const Place& place) {
  return fmt::format("{} (domain {})", place.name, place.domain);
}

}  // namespace

/// What discovery tells of one domain.
class DomainBridge::Ear : public bridge::DiscoveryListener {
 public:
  /// `hears_writers`: on the side that reads.
  Ear(Inbox& inbox, const Place& place, std::size_t index, bool hears_writers)
      : inbox_(inbox), place_(place), index_(index), hears_writers_(hears_writers) {}

  void on_participants(const std::set<std::string>&) override {}
  void on_matched(const RemoteEndpoint&) override {}
  void on_unmatched(const RemoteEndpoint&) override {}
  void on_incompatible_qos(const std::string& topic, bool local_is_writer,
                           const std::string& policy) override {
    inbox_.add(Notice{fmt::format("a {} of {} on {} does not match: {} differs",
                                  local_is_writer ? "reader" : "writer", topic, place_text(place_),
                                  policy)});
  }
  void on_inconsistent_type(const RemoteEndpoint& remote) override {
    inbox_.add(Notice{fmt::format("a {} of {} on {} has the type {}, another one than is passed on",
                                  remote.is_writer ? "writer" : "reader", remote.topic,
                                  place_text(place_), remote.type)});
  }
  void on_discovered(const RemoteEndpoint& remote) override {
    if (hears_writers_ && remote.is_writer) inbox_.add_writer(index_, remote);
  }
  void on_lost(const RemoteEndpoint& remote) override {
    if (hears_writers_ && remote.is_writer) inbox_.remove_writer(index_, remote.guid);
  }

 private:
  Inbox& inbox_;
  const Place& place_;
  const std::size_t index_;
  const bool hears_writers_;
};

/// A reader of the bridge.
class DomainBridge::Intake : public bridge::SampleListener {
 public:
  Intake(Inbox& inbox, std::size_t domain, Manner manner)
      : inbox_(inbox), domain_(domain), manner_(manner) {}

  void on_sample(std::string_view cdr, const RemoteEndpoint* writer) override {
    SampleCame sample{domain_,
                      {},
                      manner_.reliable,
                      manner_.transient_local,
                      std::chrono::steady_clock::now(),
                      std::string(cdr)};
    inbox_.add_sample(std::move(sample), writer);
  }

  std::unique_ptr<bridge::SampleReader> endpoint;

 private:
  Inbox& inbox_;
  const std::size_t domain_;
  const Manner manner_;
};

DomainBridge::DomainBridge(BridgeFile file, std::vector<Place> places, Surroundings surroundings)
    : file_(std::move(file)),
      places_(std::move(places)),
      surroundings_(std::move(surroundings)),
      inbox_(bridge::kMaxKeptBytes) {}

DomainBridge::~DomainBridge() = default;

Result<std::unique_ptr<DomainBridge>> DomainBridge::create(BridgeFile file,
                                                           std::vector<Place> places,
                                                           Surroundings surroundings) {
  std::unique_ptr<DomainBridge> self(
      new DomainBridge(std::move(file), std::move(places), std::move(surroundings)));
  const auto opened = self->open();
  if (!opened.ok()) return opened.error();
  return self;
}

Result<void> DomainBridge::open() {
  readers_side_.resize(places_.size());
  writers_side_.resize(places_.size());
  const auto join = [&](std::size_t index, bool reads,
                        std::unique_ptr<bridge::Participant>& side) -> Result<void> {
    if (side != nullptr) return {};
    ears_.push_back(std::make_unique<Ear>(inbox_, places_[index], index, reads));
    bridge::ParticipantConfig config{places_[index].domain, "clew bridge", bridge::kLease_s};
    config.user_data = "enclave=/;";  // what nodes of ROS 2 look for
    config.on_network = places_[index].on_network;
    auto joined = surroundings_.join(index, config, *ears_.back());
    if (!joined.ok()) return joined.error();
    side = std::move(joined).value();
    return {};
  };
  // Who writes comes first, so that it is there when something is found.
  for (const TopicRule& rule : file_.rules) {
    for (const std::size_t to : rule.to) {
      CLEW_RETURN_IF_ERROR(join(to, false, writers_side_[to]));
    }
  }
  for (const TopicRule& rule : file_.rules) {
    CLEW_RETURN_IF_ERROR(join(rule.from, true, readers_side_[rule.from]));
  }
  return {};
}

void DomainBridge::step() {
  for (const News& news : inbox_.take()) {
    std::visit([this](const auto& one) { take(one); }, news);
  }
  for (auto it = outlets_.begin(); it != outlets_.end();) {
    it->second.flush();
    it = it->second.is_done() ? outlets_.erase(it) : std::next(it);
  }
}

bool DomainBridge::waits() const {
  return std::any_of(outlets_.begin(), outlets_.end(),
                     [](const auto& entry) { return entry.second.waits(); });
}

void DomainBridge::take(const WriterFound& found) {
  const RemoteEndpoint& writer = found.writer;
  std::vector<const TopicRule*> rules;
  for (const TopicRule& rule : file_.rules) {
    const bool is_of_type = rule.type.empty() || rule.type == writer.type;
    if (rule.from == found.domain && is_of_type && rule.renamed(writer.topic)) {
      rules.push_back(&rule);
    }
  }
  if (rules.empty()) return;
  if (std::max({sources_.size(), passages_.size(), intakes_.size()}) >= kMostWriters) {
    surroundings_.tell(fmt::format("{} on {} is left out: {} writers are the most", writer.topic,
                                   place_text(places_[found.domain]), kMostWriters));
    return;
  }
  Source source{writer.type, {writer.reliable, writer.transient_local}, {}};
  // A writer has one reader here, for all rules.
  if (std::any_of(rules.begin(), rules.end(), [](auto* rule) { return rule->best_effort; })) {
    source.manner = {false, false};
  }
  for (const TopicRule* rule : rules) {
    const std::string as = *rule->renamed(writer.topic);
    for (const std::size_t to : rule->to) add_route(*rule, as, to, found, source);
  }
  listen(found, source);
  sources_.insert_or_assign({found.domain, writer.guid}, std::move(source));
}

void DomainBridge::add_route(const TopicRule& rule, const std::string& as, std::size_t to,
                             const WriterFound& found, Source& source) {
  const RemoteEndpoint& writer = found.writer;
  Route route{&rule, &passage_of(rule, writer.topic, as, to), nullptr};
  const std::string why = refusal(rule, to, found);
  if (why.empty()) route.outlet = outlet_of(route, found, source);
  const std::string what =
      fmt::format("{} [{}] of {}", writer.topic, writer.type, place_text(places_[found.domain]));
  if (route.outlet != nullptr) {
    route.outlet->add_source();
    surroundings_.tell(
        fmt::format("{} goes to {} as {}, {}", what, place_text(places_[to]), as,
                    manner_text(source.manner.reliable, source.manner.transient_local)));
  } else if (!why.empty()) {
    surroundings_.tell(fmt::format("{} does not go to {}: {}", what, place_text(places_[to]), why));
  }
  source.routes.push_back(route);
}

std::string DomainBridge::refusal(const TopicRule& rule, std::size_t to,
                                  const WriterFound& found) const {
  const Origin origin = Origin::parse(found.writer.user_data);
  if (origin.has_been_on(places_[to].id)) return "it has been there";
  if (origin.has_been_on(places_[found.domain].id)) return "it has been here before";
  if (!origin.id.empty() && origin.hops >= Origin::kMostHops) {
    return fmt::format("it has come through {} bridges", origin.hops);
  }
  for (const Condition& condition : rule.where) {
    const auto good = condition.check(found.writer.type);
    if (!good.ok()) return good.error().message;
  }
  if (outlets_.size() >= kMostWriters) {
    return fmt::format("this bridge has {} writers, which are the most", kMostWriters);
  }
  return {};
}

Passage& DomainBridge::passage_of(const TopicRule& rule, const std::string& topic,
                                  const std::string& as, std::size_t to) {
  for (Passage& passage : passages_) {
    if (passage.topic == topic && passage.as == as && passage.from == rule.from &&
        passage.to == to) {
      return passage;
    }
  }
  Passage passage;
  passage.topic = topic;
  passage.as = as;
  passage.from = rule.from;
  passage.to = to;
  return passages_.emplace_back(std::move(passage));
}

Outlet* DomainBridge::outlet_of(const Route& route, const WriterFound& found,
                                const Source& source) {
  const std::string& id = places_[found.domain].id;
  // Stage and seal are those of the run that the writer belongs to.
  const std::string user_data =
      bridge::without_origin(found.writer.user_data, {"clew_stage", "clew_seal"}) +
      origin_beyond(found.writer.user_data, id).to_text();
  const OutletKey key{route.passage, source.type, source.manner, user_data};
  const auto known = outlets_.find(key);
  if (known != outlets_.end()) return &known->second;
  bridge::EndpointSpec spec;
  spec.topic = route.passage->as;
  spec.type = source.type;
  spec.user_data = user_data;
  spec.history_depth = route.rule->depth;
  // A full history refuses what a reliable reader has not got; without one the oldest goes.
  spec.qos = {source.manner.reliable, source.manner.transient_local, !source.manner.reliable};
  auto writer = writers_side_[route.passage->to]->create_writer(spec);
  if (!writer.ok()) {
    surroundings_.tell(fmt::format("no writer of {} on {}: {}", spec.topic,
                                   place_text(places_[route.passage->to]), writer.error().message));
    return nullptr;
  }
  return &outlets_.try_emplace(key, std::move(writer).value(), *route.passage).first->second;
}

void DomainBridge::listen(const WriterFound& found, const Source& source) {
  const IntakeKey key{found.domain, found.writer.topic, source.type, source.manner};
  std::unique_ptr<Intake>& intake = intakes_[key];
  if (intake != nullptr) return;
  intake = std::make_unique<Intake>(inbox_, found.domain, source.manner);
  bridge::EndpointSpec spec;
  spec.topic = found.writer.topic;
  spec.type = source.type;
  spec.user_data = Origin{places_[found.domain].id}.to_text();
  spec.history_depth = kReaderDepth;
  spec.qos = {source.manner.reliable, source.manner.transient_local, !source.manner.reliable};
  auto reader = readers_side_[found.domain]->create_reader(spec, *intake);
  if (reader.ok()) {
    intake->endpoint = std::move(reader).value();
  } else {
    surroundings_.tell(fmt::format("no reader of {} on {}: {}", spec.topic,
                                   place_text(places_[found.domain]), reader.error().message));
    intakes_.erase(key);  // the next writer tries again
  }
}

void DomainBridge::take(const WriterLost& lost) {
  const auto source = sources_.find({lost.domain, lost.guid});
  if (source == sources_.end()) return;
  for (const Route& route : source->second.routes) {
    if (route.outlet != nullptr) route.outlet->remove_source();
  }
  sources_.erase(source);
}

void DomainBridge::take(const SampleCame& sample) {
  const auto source = sources_.find({sample.domain, sample.writer});
  if (source == sources_.end()) {
    ++unknown_;
    return;
  }
  // A reader that asks for less gets it, too; the other one has passed it on.
  const Manner& manner = source->second.manner;
  if (manner.reliable != sample.reliable || manner.transient_local != sample.transient_local) {
    return;
  }
  for (Route& route : source->second.routes) pass(sample, source->second, route);
}

void DomainBridge::pass(const SampleCame& sample, const Source& source, Route& route) {
  Passage& passage = *route.passage;
  if (route.outlet == nullptr) {
    ++passage.refused;
    return;
  }
  for (const Condition& condition : route.rule->where) {
    const auto holds = condition.holds(source.type, sample.cdr);
    if (!holds.ok()) ++passage.unreadable;
    if (holds.ok() && !*holds) ++passage.filtered;
    if (!holds.ok() || !*holds) return;
  }
  if (route.rule->rate_hz > 0.0) {
    if (route.due && sample.at < *route.due) {
      ++passage.thinned;
      return;
    }
    using std::chrono::duration;
    const auto period = std::chrono::duration_cast<std::chrono::steady_clock::duration>(
        duration<double>(1.0 / route.rule->rate_hz));
    // Counted from when it was due, so that a rate that does not divide the writer's is kept, too.
    const bool is_late = !route.due || sample.at - *route.due > period;
    route.due = (is_late ? sample.at : *route.due) + period;
  }
  route.outlet->pass(sample.cdr);
}

}  // namespace clew::domains
