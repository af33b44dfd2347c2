// SPDX-License-Identifier: Apache-2.0
/// What whole runs cost: composed, and as five processes on either vendor and mixed, with the clew
/// command itself.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

namespace {

struct Layout {
  const char* name;
  const char* options;
};

// Neighbours in the loop on different cores: with five processes on two cores each hop then wakes
// the other core.
std::string pinned() {
  std::string options;
  int core = 0;
  for (const char* stage : {"drive", "sense", "classify", "recover", "control"}) {
    options += std::string(" --prefix ") + stage + "='taskset -c " + std::to_string(core) + "'";
    core = 1 - core;
  }
  return options;
}

// Who is woken waits until the one that wakes it has sent all. Not everybody may ask for it.
constexpr char kRealtime[] = " --realtime-priority 1";

// In this world nobody arrives, and without a detector nobody gives up: every run has all ticks.
constexpr char kUnsolvable[] = " --world unsolvable-box";
constexpr char kEndless[] = " --world unsolvable-box --with recover.detector=none";

constexpr const char* kRecovering[] = {"default", "krishna_kalra", "lagoudakis_maida", "nakhaeinia",
                                       "pin_bender"};
constexpr const char* kOthers[] = {"neural_map", "reactive", "wang_yang_meng"};  // no recover

constexpr Layout kComposed = {"composed", " --layout composed"};
constexpr Layout kProcesses[] = {
    {"cyclonedds", " --middleware cyclonedds"},
    {"fastdds", " --middleware fastdds"},
    {"mixed",
     " --middleware sense=fastdds --middleware recover=fastdds --middleware drive=fastdds"}};

// Who acts, and who perceives and decides: two processes.
std::string two_processes() {
  std::string options;
  for (const char* stage : {"drive", "control"}) {
    options += std::string(" --set ") + stage + ".process.group=act";
  }
  for (const char* stage : {"sense", "classify", "recover"}) {
    options += std::string(" --set ") + stage + ".process.group=perceive";
  }
  return options;
}

constexpr char kACoreEach[] = " --prefix drive='taskset -c 0' --prefix sense='taskset -c 1'";

nlohmann::json run(const std::string& graph, const std::string& options) {
  const std::string command = "'" CLEW_COMMAND "' run " + graph + " --json" + options;
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  for (int c; pipe && (c = std::fgetc(pipe.get())) != EOF;) text += static_cast<char>(c);
  return nlohmann::json::parse(text, nullptr, false);
}

// Time is that between the first tick and the last, as the run reports it.
void ticks(benchmark::State& state, const std::string& graph, const std::string& options,
           int max_ticks) {
  for (auto _ : state) {
    const auto report = run(graph, options + " --max-ticks " + std::to_string(max_ticks));
    if (!report.is_object() || report["ticks_per_s"] <= 0.0) {
      state.SkipWithError("the run failed");
      break;
    }
    state.SetIterationTime(report["ticks"].get<double>() / report["ticks_per_s"].get<double>());
    state.SetItemsProcessed(state.items_processed() + report["ticks"].get<std::int64_t>());
  }
}

constexpr char kSecured[] = " --secure";

// What a user waits before the robot moves: until the first tick is done.
void start(benchmark::State& state, const std::string& options) {
  for (auto _ : state) {
    const auto report = run("krishna_kalra", options + " --max-ticks 1");
    if (!report.is_object() || !report["start_s"].is_number()) {
      state.SkipWithError("the run failed");
      break;
    }
    state.SetIterationTime(report["start_s"]);
  }
}

void register_ticks(const std::string& name, const std::string& options, int max_ticks,
                    const std::string& graph = "krishna_kalra") {
  benchmark::RegisterBenchmark(name.c_str(), ticks, graph, options, max_ticks)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

void register_start(const std::string& name, const std::string& options) {
  benchmark::RegisterBenchmark(("start/" + name).c_str(), start, options)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  const std::string endless = kEndless;
  register_ticks("ticks/composed/u-trap", std::string(kComposed.options) + " --world u-trap",
                 20000);
  register_ticks("ticks/composed/endless", kComposed.options + endless, 20000);
  for (const char* graph : kRecovering) {
    register_ticks(std::string("ticks/composed/endless/no-hash/") + graph,
                   kComposed.options + endless + " --no-hash", 20000, graph);
  }
  for (const char* graph : kOthers) {
    register_ticks(std::string("ticks/composed/endless/no-hash/") + graph,
                   std::string(kComposed.options) + kUnsolvable + " --no-hash", 20000, graph);
  }
  // The search for a way, over and over, until it is proved that there is none.
  register_ticks("ticks/composed/unreachable/no-hash/default",
                 std::string(kComposed.options) + kUnsolvable + " --no-hash", 20000, "default");
  for (const Layout& layout : kProcesses) {
    const std::string name = layout.name;
    register_ticks("ticks/" + name + "/pinned", layout.options + endless + pinned(), 10000);
    register_ticks("ticks/" + name + "/pinned/realtime",
                   layout.options + endless + pinned() + kRealtime, 10000);
    register_ticks("ticks/" + name, layout.options + endless, 10000);
    // The mix would divide both groups.
    if (name != "mixed") {
      register_ticks("ticks/" + name + "/two-processes/pinned",
                     layout.options + endless + two_processes() + kACoreEach, 10000);
      register_ticks("ticks/" + name + "/two-processes", layout.options + endless + two_processes(),
                     10000);
    }
    register_ticks("ticks/" + name + "/recorded",
                   layout.options + endless + " --record /tmp/clew-benchmark.mcap --force", 10000);
    register_ticks("ticks/" + name + "/secured", layout.options + endless + kSecured, 10000);
    register_start(name, layout.options);
    register_start(name + "/secured", std::string(layout.options) + kSecured);
  }
  benchmark::RunSpecifiedBenchmarks();
  std::remove("/tmp/clew-benchmark.mcap");
  return 0;
}
