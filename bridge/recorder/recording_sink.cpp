// SPDX-License-Identifier: Apache-2.0
#include "recorder/recording_sink.hpp"

#include <utility>

#include "wire/codec.hpp"

namespace clew::bridge {

RunDescription describe_run(const runtime::RunPlan& plan) {
  RunDescription description;
  description.tick_s = plan.graph.tick_s;
  description.seed = plan.graph.seed;
  description.versions = {{"clew", CLEW_VERSION}};
  description.idl_fingerprint = std::string(idl_fingerprint());
  description.bundle = plan.bundle;
  for (domain::Topic topic : domain::kAllTopics) {
    if (plan.graph.writer_of(topic) != nullptr) description.schemas[topic] = idl_text(topic);
  }
  return description;
}

Spooling spooling_for(const std::optional<RecordingOrder>& order, bool is_watched) {
  if (!order) return is_watched ? Spooling::kSamples : Spooling::kNothing;
  return order->keep_last_s > 0.0 ? Spooling::kSamplesAndStates : Spooling::kSamples;
}

core::Result<std::unique_ptr<RecordingSink>> RecordingSink::create(const runtime::RunPlan& plan,
                                                                   const std::string& path,
                                                                   bool overwrite) {
  return create(describe_run(plan), path, overwrite);
}

core::Result<std::unique_ptr<RecordingSink>> RecordingSink::create(
    const RunDescription& description, const std::string& path, bool overwrite) {
  auto recorder = RunRecorder::create(path, description, overwrite);
  if (!recorder.ok()) return recorder.error();
  return std::unique_ptr<RecordingSink>(new RecordingSink(std::move(recorder).value()));
}

core::Result<std::unique_ptr<RecordingSink>> RecordingSink::go_on(const RecordingOrder& order,
                                                                  std::uint64_t least_ticks) {
  auto recorder = RunRecorder::go_on(order.path, order.description, least_ticks, order.overwrite);
  if (!recorder.ok()) return recorder.error();
  return std::unique_ptr<RecordingSink>(new RecordingSink(std::move(recorder).value()));
}

RecordingAccount RecordingSink::close(const RunEnding& ending) {
  RecordingAccount account;
  const auto closed = ending.sealed ? recorder_.seal(ending.aborted, ending.run_hash)
                                    : recorder_.finish(ending.aborted, ending.run_hash);
  if (!closed.ok()) account.failure = closed.error().text();
  account.losses = recorder_.losses().texts();
  account.lost_samples = recorder_.losses().samples();
  return account;
}

}  // namespace clew::bridge
