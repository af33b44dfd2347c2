// SPDX-License-Identifier: Apache-2.0
#include "supervisor/third_party_observer.hpp"

#include <utility>

#include "vendors/participant_factory.hpp"

namespace clew::bridge {
namespace {

/// In messages, to users who know of no observer: the component is missed by the run itself.
constexpr char kName[] = "the run";

/// Has no outputs; its host keeps account of what comes in.
class Onlooker : public runtime::Component {
 public:
  void step(const runtime::TickInputs&, runtime::TickOutputs&) override {}
  void save(core::StateWriter&) const override {}
  void load(core::StateReader&) override {}
};

}  // namespace

core::Result<std::unique_ptr<ThirdPartyObserver>> ThirdPartyObserver::create(
    const runtime::RunPlan& plan, Assignment assignment) {
  runtime::NodePorts ports;
  std::string stages;
  for (const runtime::GraphStage& stage : plan.graph.stages) {
    if (stage.deployment.exec.empty()) continue;
    stages += (stages.empty() ? "" : ", ") + stage.info->name;
    ports.inputs |= stage.ports.outputs;
    for (runtime::Topic topic : stage.ports.output_order) {
      assignment.expected.push_back(
          {std::string(domain::topic_name(topic)), true, stage.info->name, true});
    }
  }
  if (ports.inputs.none()) return std::unique_ptr<ThirdPartyObserver>();
  ports.declared_inputs = ports.inputs;

  const auto vendor = vendor_from_name(assignment.middleware);
  CLEW_CHECK(vendor.has_value(), assignment.middleware);
  std::unique_ptr<ThirdPartyObserver> self(new ThirdPartyObserver);
  self->stages_ = std::move(stages);
  ThirdPartyObserver* raw = self.get();
  const auto on_notice = [raw](std::string text) {
    const std::lock_guard<std::mutex> lock(raw->mutex_);
    raw->notices_.push_back(std::move(text));
  };
  const auto on_fatal = [raw](std::string text) {
    const std::lock_guard<std::mutex> lock(raw->mutex_);
    raw->fatal_ = std::move(text);
  };
  self->barrier_ = std::make_unique<StartBarrier>(
      kName, assignment.expected, StartBarrier::Handlers{[] {}, on_notice, on_fatal});
  auto participant =
      create_participant(*vendor, {assignment.domain, kName, assignment.lease_s}, *self->barrier_);
  if (!participant.ok()) return participant.error();
  self->participant_ = std::move(participant).value();
  runtime::Node node(kName, std::move(ports), std::make_unique<Onlooker>(), plan.graph.tick_s);
  self->host_ = std::make_unique<NodeHost>(
      std::move(node), assignment, plan,
      NodeHost::Handlers{on_notice, on_fatal,
                         [raw](const Progress& progress) {
                           const std::lock_guard<std::mutex> lock(raw->mutex_);
                           raw->progress_ = progress;
                         },
                         [](const Checkpoint&) {},
                         [raw](const std::string& spool) {
                           const std::lock_guard<std::mutex> lock(raw->mutex_);
                           raw->spooled_ += spool;
                         }},
      true);
  CLEW_RETURN_IF_ERROR(self->host_->open(*self->participant_, *self->barrier_));
  return self;
}

void ThirdPartyObserver::poll() { host_->flush(); }

std::uint64_t ThirdPartyObserver::ticks() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return progress_.ticks;
}

std::string ThirdPartyObserver::ticks_text() const {
  return ' ' + stages_ + ' ' + std::to_string(ticks());
}

bool ThirdPartyObserver::finished(std::uint64_t last_tick) const {
  return host_->finished(last_tick).has_value();
}

RunStatistics ThirdPartyObserver::statistics() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return progress_.statistics;
}

std::uint64_t ThirdPartyObserver::refused_samples() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return progress_.refused_samples;
}

std::map<std::string, core::Hash128> ThirdPartyObserver::chains() const {
  const auto finished = host_->finished(0);
  return finished ? finished->chains : std::map<std::string, core::Hash128>{};
}

std::string ThirdPartyObserver::take_spooled() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(spooled_, {});
}

std::vector<std::string> ThirdPartyObserver::take_notices() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(notices_, {});
}

std::optional<std::string> ThirdPartyObserver::fatal() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return fatal_;
}

}  // namespace clew::bridge
