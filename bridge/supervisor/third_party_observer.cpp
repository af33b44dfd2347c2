// SPDX-License-Identifier: Apache-2.0
#include "supervisor/third_party_observer.hpp"

#include <utility>

#include "component/sealed_participant.hpp"
#include "supervisor/member.hpp"
#include "vendors/network_addresses.hpp"
#include "vendors/participant_factory.hpp"

namespace clew::bridge {
namespace {

/// In messages, to users who know of no observer: the component is missed by the run itself.
constexpr char kName[] = "the run";

}  // namespace

core::Result<std::unique_ptr<ThirdPartyObserver>> ThirdPartyObserver::create(
    const runtime::RunPlan& plan, Assignment assignment) {
  runtime::TopicSet topics;
  std::string stages;
  for (const runtime::GraphStage& stage : plan.graph.stages) {
    if (!is_third_party(stage)) continue;
    stages += (stages.empty() ? "" : ", ") + stage.info->name;
    topics |= stage.ports.outputs;
    for (runtime::Topic topic : stage.ports.output_order) {
      assignment.expected.push_back(
          {std::string(domain::topic_name(topic)), true, stage.info->name, true});
    }
  }
  if (topics.none()) return std::unique_ptr<ThirdPartyObserver>();

  const auto vendor = vendor_from_name(assignment.middleware);
  CLEW_CHECK(vendor.has_value(), assignment.middleware);
  std::unique_ptr<ThirdPartyObserver> self(new ThirdPartyObserver);
  self->stages_ = std::move(stages);
  ThirdPartyObserver* raw = self.get();
  const auto on_refused = [raw](std::string text) {
    const std::lock_guard<std::mutex> lock(raw->mutex_);
    raw->notices_.push_back(std::move(text));
  };
  const auto on_fatal = [raw](std::string text) {
    const std::lock_guard<std::mutex> lock(raw->mutex_);
    raw->fatal_ = std::move(text);
  };
  self->barrier_ = std::make_unique<StartBarrier>(
      kName, assignment.expected, StartBarrier::Handlers{[] {}, on_refused, on_fatal});
  self->barrier_->demand_seals(RunKey(assignment.run_key));
  const auto hosts = network_of(assignment.hosts);
  if (!hosts.ok()) return hosts.error();
  auto participant = create_participant(
      *vendor,
      {assignment.domain, kName, assignment.lease_s, {}, false, assignment.security, *hosts},
      *self->barrier_);
  if (!participant.ok()) return participant.error();
  self->participant_ = std::make_unique<SealedParticipant>(std::move(participant).value(),
                                                           RunKey(assignment.run_key));
  self->account_ =
      std::make_unique<InputAccount>(kName, topics, assignment, plan.setup.behaviour.scan);
  if (assignment.checkpoint) {
    CLEW_RETURN_IF_ERROR(self->account_->restore(*assignment.checkpoint));
  }
  CLEW_RETURN_IF_ERROR(self->account_->open(*self->participant_, *self->barrier_));
  CLEW_RETURN_IF_ERROR(self->watch_scans(plan, std::move(assignment)));
  return self;
}

core::Result<void> ThirdPartyObserver::watch_scans(const runtime::RunPlan& plan,
                                                   Assignment assignment) {
  const runtime::GraphStage* steering = plan.graph.writer_of(domain::Topic::kCommand);
  if (steering == nullptr || !is_third_party(*steering)) return {};
  scan_watch_.emplace(plan);
  realtime_ = assignment.pace == Pace::kRealtime;
  if (!realtime_ && !scan_watch_->watches_readings()) return {};
  runtime::TopicSet topics;
  for (const domain::Topic topic : {domain::Topic::kScan, domain::Topic::kOdometry}) {
    const runtime::GraphStage* writer = plan.graph.writer_of(topic);
    if (writer == nullptr) return {};
    topics.set(index_of(topic));
    barrier_->expect({{std::string(domain::topic_name(topic)), true, writer->info->name,
                       is_third_party(*writer)}});
  }
  assignment.hash = false;
  assignment.spooling = Spooling::kNothing;
  scans_ = std::make_unique<InputAccount>(kName, topics, assignment, plan.setup.behaviour.scan);
  if (assignment.checkpoint) scans_->begin_at(ticks());
  scans_->on_tick([this](std::uint64_t tick, const runtime::TopicSet& present,
                         const domain::Messages& messages) {
    const std::lock_guard<std::mutex> lock(mutex_);
    auto news = scan_watch_->see(tick, present, messages);
    const bool certain = news && news->kind == ScanWatch::kFrozen;
    if (news && (realtime_ || certain)) sensor_news_.push_back(*std::move(news));
  });
  return scans_->open(*participant_, *barrier_);
}

std::vector<ScanWatch::News> ThirdPartyObserver::look_at_sensor(ScanWatch::Time now) {
  if (!scans_) return {};
  const auto ticks_of = [this](domain::Topic topic) {
    return scans_->ticks_of(runtime::TopicSet().set(index_of(topic)));
  };
  // In this order: a scan is of an odometry that is older than it.
  const std::uint64_t odometry = ticks_of(domain::Topic::kOdometry);
  const std::uint64_t scans = ticks_of(domain::Topic::kScan);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (realtime_) {
    const bool newer = scans > std::exchange(scans_seen_, scans);
    auto news = newer ? scan_watch_->scan_arrives(scans - 1, now) : std::nullopt;
    if (news) sensor_news_.push_back(*std::move(news));
    if (odometry > 0) scan_watch_->odometry_arrives(odometry - 1, now);
    if ((news = scan_watch_->look(now))) sensor_news_.push_back(*std::move(news));
  }
  return std::exchange(sensor_news_, {});
}

void ThirdPartyObserver::poll() {
  spooled_ += account_->take_spooled();
  progress_ = account_->progress();
  // What is wrong with a scan is told by those who take part.
  if (scans_) scans_->take_notices();
}

std::map<std::string, core::Hash128> ThirdPartyObserver::chains() const {
  const auto finished = account_->finished(0);
  return finished ? finished->chains : std::map<std::string, core::Hash128>{};
}

std::vector<std::string> ThirdPartyObserver::take_notices() {
  std::vector<std::string> notices = account_->take_notices();
  const std::lock_guard<std::mutex> lock(mutex_);
  for (std::string& notice : notices_) notices.push_back(std::move(notice));
  notices_.clear();
  return notices;
}

std::optional<std::string> ThirdPartyObserver::fatal() const {
  if (const auto fatal = account_->fatal()) return fatal;
  const std::lock_guard<std::mutex> lock(mutex_);
  return fatal_;
}

}  // namespace clew::bridge
