// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "component/node_host.hpp"

namespace clew::bridge {

/// A checkpoint of a process with several stages as one, and back: to whoever keeps it, it is
/// bytes.
Checkpoint pack_checkpoints(std::uint64_t tick, const std::map<std::string, Checkpoint>& by_stage);
core::Result<std::map<std::string, Checkpoint>> unpack_checkpoints(const Checkpoint& packed);

/// The stages of one process, a host each. To the supervisor they are one member: it is as far as
/// the last of them, it has a checkpoint where all of them have one, and it is finished when all
/// are.
class ProcessHost {
 public:
  using Time = NodeHost::Time;

  ProcessHost(std::vector<runtime::NodeSuccession> nodes, const Assignment& assignment,
              const runtime::RunPlan& plan, NodeHost::Handlers handlers);

  /// Lets each stage keep its inputs in its file, by stage, as far as that can be reached from
  /// here; before restore().
  void keep_inputs(const std::map<std::string, std::string>& files);
  core::Result<void> restore(const Checkpoint& checkpoint);
  core::Result<void> open(Participant& participant, const StartBarrier& barrier);
  core::Result<void> repeat_last_outputs(const Checkpoint& checkpoint);
  void go(Time now);
  /// NodeHost's, of the stage that starts ticks, if it is here.
  bool starts_ticks() const { return starter_ != nullptr; }
  std::uint64_t hold(std::uint64_t tick);
  void release(Time now);
  void set_pace(double factor, Time now);
  void rest();
  void slow(bool slowly);
  bool has_come_to_rest() const;
  void allow_until(std::uint64_t tick);
  void poll(Time now);
  std::optional<Time> next_due() const;
  bool is_stepping() const;
  /// BusyThread's, of all steps that are under way.
  std::uint64_t processor_ns() const;
  /// By stage.
  std::map<std::string, StepTimes> step_times() const;
  void flush();
  void spool();
  std::optional<Finished> finished(std::uint64_t last_tick) const;
  /// The stages of the process.
  std::vector<NodeHost*> stages() const;

 private:
  /// What becomes of the reports of the stage at `index`.
  NodeHost::Handlers handlers_of(std::size_t index);
  void take_progress(std::size_t index, const Progress& progress);
  void take_checkpoint(std::size_t index, const Checkpoint& checkpoint);
  /// What each stage finds of its own in a checkpoint of the process.
  core::Result<std::vector<Checkpoint>> unpack(const Checkpoint& checkpoint) const;

  const NodeHost::Handlers handlers_;
  std::vector<std::string> names_;
  std::mutex mutex_;                ///< of what follows; reports come from many threads
  std::vector<Progress> progress_;  ///< by stage
  /// By tick and stage: those that not all stages have passed yet, a few at the most.
  std::map<std::uint64_t, std::map<std::string, Checkpoint>> checkpoints_;
  NodeHost* starter_ = nullptr;  ///< the stage that starts ticks; null: of another process
  std::vector<std::unique_ptr<NodeHost>> hosts_;  ///< last, since they report while they end
};

}  // namespace clew::bridge
