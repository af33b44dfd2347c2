// SPDX-License-Identifier: Apache-2.0
#include "replay/recorded_plan.hpp"

#include <fmt/format.h>

#include <charconv>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/yaml_reader.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {
namespace {

using core::Result;

constexpr char kBranchFile[] = "branch.yaml";
constexpr char kBeforeBranch[] = "before_branch/";

std::vector<unsigned> bytes_of(const std::string& text) {
  std::vector<unsigned> bytes;
  for (const char c : text) bytes.push_back(static_cast<unsigned char>(c));
  return bytes;
}

/// The bytes of `x` and two hexadecimal digits for each; nothing if the text is not that.
std::optional<std::string> bytes_from(std::string_view text) {
  if (text.size() % 2 == 0 || text.front() != 'x') return std::nullopt;
  std::string bytes;
  for (std::size_t place = 1; place < text.size(); place += 2) {
    unsigned byte = 0;
    const char* end = text.data() + place + 2;
    const auto read = std::from_chars(text.data() + place, end, byte, 16);
    if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
    bytes += static_cast<char>(byte);
  }
  return bytes;
}

Result<HandOver> read_branch(const core::Resource& file) {
  const auto root = core::YamlNode::parse(file.text, file.file);
  if (!root.ok()) return root.error();
  const auto tick = root->at("tick");
  if (!tick.ok()) return tick.error();
  const auto number = tick->integer();
  if (!number.ok()) return number.error();
  if (*number < 0) return tick->error("tick is negative");
  const auto state = root->at("drive");
  if (!state.ok()) return state.error();
  const auto text = state->string();
  if (!text.ok()) return text.error();
  auto bytes = bytes_from(*text);
  if (!bytes) return state->error("no state of drive: 'x' and two hexadecimal digits a byte");
  return HandOver{static_cast<std::uint64_t>(*number), std::move(*bytes)};
}

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
                     recording.path()};
}

Result<runtime::RunPlan> recorded_plan(const RunRecording& recording,
                                       const std::vector<runtime::StageInfo>& stages) {
  CLEW_RETURN_IF_ERROR(check_message_types(recording));
  return described_plan(recording, stages);
}

Result<runtime::RunPlan> described_plan(const RunRecording& recording,
                                        const std::vector<runtime::StageInfo>& stages) {
  auto plan = runtime::prepare_run(recording.description().bundle, stages);
  if (!plan.ok()) return in_recording(recording, plan.error());
  return plan;
}

Result<RecordedChanges> recorded_changes(const RunRecording& recording,
                                         const runtime::RunPlan& plan,
                                         const std::vector<runtime::StageInfo>& stages,
                                         bool and_planned) {
  RecordedChanges changes;
  const auto& box = recording.description().black_box;
  for (const runtime::Intervention& found : recording.interventions()) {
    if (found.changes.empty()) continue;
    changes.interventions.push_back(found);
    if (!box || box->tick <= found.fed_from) continue;
    return in_recording(
        recording,
        {fmt::format("is a black box that begins at tick {}: what was changed at tick {} "
                     "was fed with ticks from {} on",
                     box->tick, found.tick, found.fed_from),
         {},
         0,
         0});
  }
  for (const runtime::Intervention& planned : recording.description().planned) {
    const bool is_later =
        changes.interventions.empty() || changes.interventions.back().tick < planned.tick;
    if (and_planned && is_later) changes.interventions.push_back(planned);
  }
  // A plan's own bundle holds what the plan needs; the recording's also what a change needs.
  runtime::RunPlan first = plan;
  const auto& bundle = recording.description().bundle;
  first.bundle.insert(bundle.begin(), bundle.end());
  auto plans = runtime::change_all(first, changes.interventions, stages);
  if (!plans.ok()) return in_recording(recording, plans.error());
  changes.plans = std::move(plans).value();
  return changes;
}

Result<runtime::RunPlan> changed_plan(const RunRecording& recording,
                                      const runtime::GraphOverrides& overrides,
                                      const runtime::ConfigSource& files,
                                      const std::vector<runtime::StageInfo>& stages) {
  CLEW_RETURN_IF_ERROR(check_message_types(recording));
  const runtime::BundleAndFiles source(recording.description().bundle, files);
  return runtime::prepare_run("graph", overrides, source, stages);
}

Result<std::optional<HandOver>> branch_of(const RunRecording& recording) {
  const auto& bundle = recording.description().bundle;
  const auto file = bundle.find(kBranchFile);
  if (file == bundle.end()) return std::optional<HandOver>();
  auto read = read_branch({kBranchFile, file->second});
  if (!read.ok()) return in_recording(recording, read.error());
  return std::optional<HandOver>(std::move(read).value());
}

void note_branch(const runtime::Bundle& before, const HandOver& robot, runtime::RunPlan& plan) {
  for (const auto& [name, text] : before) {
    const auto now = plan.bundle.find(name);
    if (now == plan.bundle.end() || now->second != text) plan.bundle[kBeforeBranch + name] = text;
  }
  plan.bundle[kBranchFile] = fmt::format(
      "# Samples of earlier ticks are those of the run in {}, from which this one branched off.\n"
      "tick: {}\n"
      "# The state of drive at that tick.\n"
      "drive: x{:02x}\n",
      kBeforeBranch, robot.tick, fmt::join(bytes_of(robot.state), ""));
}

}  // namespace clew::bridge
