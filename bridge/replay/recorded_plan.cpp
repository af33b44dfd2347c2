// SPDX-License-Identifier: Apache-2.0
#include "replay/recorded_plan.hpp"

#include <fmt/format.h>

#include "convert/codec.hpp"
#include "core/yaml_reader.hpp"

namespace clew::bridge {
namespace {

using core::Result;

constexpr char kBranchFile[] = "branch.yaml";
constexpr char kBeforeBranch[] = "before_branch/";

/// The recording's own files, and others for what it does not have.
class RecordingSource : public runtime::ConfigSource {
 public:
  RecordingSource(const runtime::Bundle& bundle, const runtime::ConfigSource& files)
      : bundle_(bundle), files_(files) {}

  Result<core::Resource> find(const std::string& folder, const std::string& name) const override {
    const bool is_data = folder != "graphs" && folder != "worlds" && folder != "robots";
    auto recorded = bundle_.find(folder, name);
    if (recorded || !is_data) return recorded;
    return files_.find(folder, name);
  }

 private:
  runtime::BundleSource bundle_;
  const runtime::ConfigSource& files_;
};

core::Error in_recording(const RunRecording& recording, const core::Error& error) {
  return {error.text(), recording.path(), 0, 0};
}

}  // namespace

Result<void> check_message_types(const RunRecording& recording) {
  const std::string& recorded = recording.description().idl_fingerprint;
  if (recorded == idl_fingerprint()) return {};
  return core::Error{fmt::format("was recorded with other message types (IDL {}) than this version "
                                 "has (IDL {})",
                                 recorded.empty() ? "unknown" : recorded, idl_fingerprint()),
                     recording.path(), 0, 0};
}

Result<runtime::RunPlan> recorded_plan(const RunRecording& recording,
                                       const std::vector<runtime::StageInfo>& stages) {
  CLEW_RETURN_IF_ERROR(check_message_types(recording));
  auto plan = runtime::prepare_run(recording.description().bundle, stages);
  if (!plan) return in_recording(recording, plan.error());
  return plan;
}

Result<runtime::RunPlan> changed_plan(const RunRecording& recording,
                                      const runtime::GraphOverrides& overrides,
                                      const runtime::ConfigSource& files,
                                      const std::vector<runtime::StageInfo>& stages) {
  CLEW_RETURN_IF_ERROR(check_message_types(recording));
  const RecordingSource source(recording.description().bundle, files);
  return runtime::prepare_run("graph", overrides, source, stages);
}

Result<std::uint64_t> first_own_tick(const RunRecording& recording) {
  const auto& bundle = recording.description().bundle;
  const auto file = bundle.find(kBranchFile);
  if (file == bundle.end()) return std::uint64_t{0};
  const auto root = core::YamlNode::parse(file->second, kBranchFile);
  if (!root) return in_recording(recording, root.error());
  const auto tick = root->at("tick");
  if (!tick) return in_recording(recording, tick.error());
  const auto number = tick->integer();
  if (!number) return in_recording(recording, number.error());
  if (*number < 0) return in_recording(recording, tick->error("allowed: 0 and more"));
  return static_cast<std::uint64_t>(*number);
}

void note_branch(const runtime::Bundle& before, std::uint64_t tick, runtime::RunPlan& plan) {
  for (const auto& [name, text] : before) {
    const auto now = plan.bundle.find(name);
    if (now == plan.bundle.end() || now->second != text) plan.bundle[kBeforeBranch + name] = text;
  }
  plan.bundle[kBranchFile] = fmt::format(
      "# Samples of earlier ticks are those of the run in {}, from which this one branched off.\n"
      "tick: {}\n",
      kBeforeBranch, tick);
}

}  // namespace clew::bridge
