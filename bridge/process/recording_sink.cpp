// SPDX-License-Identifier: Apache-2.0
#include "process/recording_sink.hpp"

#include <utility>

#include "convert/codec.hpp"

namespace clew::bridge {

core::Result<std::unique_ptr<RecordingSink>> RecordingSink::create(const runtime::RunPlan& plan,
                                                                   const std::string& path,
                                                                   bool overwrite) {
  RunDescription description;
  description.tick_s = plan.graph.tick_s;
  description.seed = plan.graph.seed;
  description.versions = {{"clew", CLEW_VERSION}};
  description.idl_fingerprint = std::string(idl_fingerprint());
  description.bundle = plan.bundle;
  for (domain::Topic topic : domain::kAllTopics) {
    if (plan.graph.writer_of(topic) != nullptr) description.schemas[topic] = idl_text(topic);
  }
  RecorderOptions options;
  options.overwrite = overwrite;
  auto recorder = RunRecorder::create(path, description, options);
  if (!recorder.ok()) return recorder.error();
  return std::unique_ptr<RecordingSink>(new RecordingSink(std::move(recorder).value()));
}

}  // namespace clew::bridge
