// SPDX-License-Identifier: Apache-2.0
/// The commands of `clew`, without their command lines: each takes what was asked for and returns
/// the exit status. Results go to stdout, everything else to stderr.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/graph.hpp"

namespace clew::tools {

inline constexpr int kExitGood = 0;
inline constexpr int kExitFailed = 1;
inline constexpr int kExitBadInput = 2;
inline constexpr int kExitTimeout = 3;
inline constexpr int kExitCollided = 4;
inline constexpr int kExitUnreachable = 5;
inline constexpr int kExitInterrupted = 130;

struct RunOptions {
  std::string graph;
  runtime::GraphOverrides overrides;
  std::string layout = "processes";
  std::vector<std::string> middleware;  ///< `VENDOR` or `STAGE=VENDOR`
  std::string pace = "lockstep";
  std::optional<int> domain;
  std::optional<int> realtime_priority;
  std::string record;
  std::string resume;  ///< a recording to go on with, in the graph's place
  bool force = false;
  std::string record_on;                ///< `trap`: a black box
  std::optional<double> record_last_s;  ///< that a black box keeps; none: 30
  std::string compression;  ///< empty: as the recording that is gone on with has it, else none
  std::string on_record_error = "stop";
  std::vector<std::string> external;
  std::vector<std::string> prefix;  ///< `STAGE=COMMAND`
  bool json = false;
  bool no_hash = false;
};
int run_command(const RunOptions& options);

struct BenchCommandOptions {
  std::string suite;
  std::vector<std::string> graphs;  ///< in place of the suite's
  std::vector<std::string> with;
  std::vector<std::string> set;
  std::vector<std::string> vary;  ///< `PATH=VALUE,VALUE,...`
  std::size_t jobs = 0;           ///< worker processes; 0: one a core
  std::string out;                ///< empty: out/bench/SUITE
  bool force = false;
  bool json = false;
  std::string write_worlds;  ///< a directory for the generated worlds, instead of running
};
int bench_command(const BenchCommandOptions& options);

struct CheckOptions {
  std::string graph;
  runtime::GraphOverrides overrides;
  bool expand = false;
};
int check_command(const CheckOptions& options);

struct ListOptions {
  std::string what;  ///< `graphs`, `worlds`, a stage, or `STAGE.PART`; empty: what there is
  std::string name;
};
int list_command(const ListOptions& options);

struct ComponentOptions {
  std::string graph;  ///< `-`: as the run has it
  std::string stage;
  std::optional<int> domain;
};
int component_command(const ComponentOptions& options);

struct RecorderOptions {
  int domain = 0;
};
int recorder_command(const RecorderOptions& options);

struct PlotOptions {
  std::vector<std::string> recordings;
  std::string output;
  std::optional<std::uint64_t> tick;  ///< what components show of it, instead of the whole run
};
int plot_command(const PlotOptions& options);

struct InfoOptions {
  std::string recording;
  bool json = false;
};
int info_command(const InfoOptions& options);

struct DiffOptions {
  std::string a;
  std::string b;
  double tolerance = 0.0;
  bool json = false;
};
int diff_command(const DiffOptions& options);

struct ReplayOptions {
  std::string recording;
  std::string component;  ///< a stage; empty: all
  runtime::GraphOverrides overrides;
  std::optional<std::uint64_t> first_tick;
  std::optional<std::uint64_t> last_tick;
  std::optional<std::uint64_t> branch_tick;
  double rate = 0.0;   ///< simulated over wall-clock time; 0: as fast as possible
  std::string record;  ///< of the branch
  bool force = false;
  bool json = false;
  bool publishes = false;            ///< over DDS, instead of into a component in this process
  std::vector<std::string> publish;  ///< topics besides the component's inputs
  std::optional<int> domain;
  std::string middleware = "cyclonedds";
  bool start = false;                ///< the component's process
  std::string prefix;                ///< `STAGE=COMMAND`, which starts it too
  std::vector<std::string> readers;  ///< programs to start
  std::optional<double> wait_s;
  bool start_paused = false;
  bool commands = false;  ///< from stdin
};
int replay_command(const ReplayOptions& options);

inline constexpr char kDefaultSomRecipe[] = "krishna_kalra_som";
struct TrainSomOptions {
  std::string recipe = kDefaultSomRecipe;
  std::string output;
};
int train_som_command(const TrainSomOptions& options);

inline constexpr char kDefaultNeuroFuzzyRecipe[] = "wang_yang_meng";
struct TrainNeuroFuzzyOptions {
  std::string recipe = kDefaultNeuroFuzzyRecipe;
  std::string recording;  ///< empty: the expert's runs in the recipe's worlds
  std::string output;
  std::string curves;  ///< an SVG file; empty: none
};
int train_neuro_fuzzy_command(const TrainNeuroFuzzyOptions& options);

/// Prints an error as `clew: file:line: message` and returns `status`.
int complain(const core::Error& error, int status = kExitBadInput);

}  // namespace clew::tools
