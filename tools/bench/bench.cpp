// SPDX-License-Identifier: Apache-2.0
#include "bench/bench.hpp"

#include <filesystem>
#include <map>
#include <set>

#include "bench/results_file.hpp"
#include "bench/run_result.hpp"
#include "bench/worker_pool.hpp"
#include "bench/world_bench.hpp"
#include "bench/worst_runs.hpp"
#include "files/whole_file.hpp"
#include "plot/world_picture.hpp"

namespace clew::bench {
namespace {

using core::Error;
using core::Result;

using files::make_directory;
using files::write_file;

namespace fs = std::filesystem;

RunKey key_of(const BenchPlan& plan, std::size_t variant, std::size_t world, std::size_t seed) {
  return {plan.variants[variant].graph, plan.variants[variant].text(), plan.worlds[world].name,
          plan.seeds[seed]};
}

/// The results so far, by run.
class Bookkeeping {
 public:
  Result<void> take(const std::string& line) {
    auto result = read_run_result(line);
    if (!result.ok()) return result.error();
    lines_[result->key] = line;
    results_.insert_or_assign(result->key, *result);
    return {};
  }
  bool has(const RunKey& key) const { return lines_.count(key) > 0; }
  std::size_t size() const { return lines_.size(); }
  const std::string& line(const RunKey& key) const { return lines_.at(key); }
  const RunResult& result(const RunKey& key) const { return results_.at(key); }

 private:
  std::map<RunKey, std::string> lines_;
  std::map<RunKey, RunResult> results_;
};

template <typename Visit>
void for_each_run(const BenchPlan& plan, const Visit& visit) {
  for (std::size_t variant = 0; variant < plan.variants.size(); ++variant) {
    for (std::size_t world = 0; world < plan.worlds.size(); ++world) {
      for (std::size_t seed = 0; seed < plan.seeds.size(); ++seed) visit(variant, world, seed);
    }
  }
}

/// The worlds in which something is left to run.
std::vector<std::size_t> open_worlds(const BenchPlan& plan, const Bookkeeping& books) {
  std::set<std::size_t> open;
  for_each_run(plan, [&](std::size_t variant, std::size_t world, std::size_t seed) {
    if (!books.has(key_of(plan, variant, world, seed))) open.insert(world);
  });
  return {open.begin(), open.end()};
}

/// What a worker does: all that is left to run in a world.
Result<void> run_world(const BenchPlan& plan, std::size_t world, const Bookkeeping& books,
                       const runtime::ConfigPath& configs,
                       const std::vector<runtime::StageInfo>& stages, const fs::path& directory,
                       const Emit& emit) {
  WorldBench bench(plan, world, configs, stages);
  if (!bench.generated_text().empty()) {
    CLEW_RETURN_IF_ERROR(write_file(directory / "worlds" / (plan.worlds[world].name + ".yaml"),
                                    bench.generated_text()));
  }
  for (std::size_t variant = 0; variant < plan.variants.size(); ++variant) {
    for (std::size_t seed = 0; seed < plan.seeds.size(); ++seed) {
      if (books.has(key_of(plan, variant, world, seed))) continue;
      const auto line = bench.run(plan.variants[variant], plan.seeds[seed]);
      if (!line.ok()) return line.error();
      if (!*line || !emit(**line)) return {};
    }
  }
  return {};
}

BenchEnd gather(const BenchPlan& plan, const Bookkeeping& books, BenchResults& results) {
  BenchEnd end;
  results.plan = &plan;
  for_each_run(plan, [&](std::size_t variant, std::size_t world, std::size_t seed) {
    const RunKey key = key_of(plan, variant, world, seed);
    end.lines.push_back(books.line(key));
    results.runs.push_back(books.result(key));
  });
  return end;
}

Result<void> write_report(const BenchResults& results, const Report& report,
                          const fs::path& directory) {
  CLEW_RETURN_IF_ERROR(write_file(directory / "results.csv", to_csv(results)));
  CLEW_RETURN_IF_ERROR(write_file(directory / "report.md", to_markdown(report)));
  return write_file(directory / "report.html", to_html(report));
}

}  // namespace

Result<BenchEnd> run_bench(const BenchPlan& plan, const runtime::ConfigPath& configs,
                           const std::vector<runtime::StageInfo>& stages,
                           const BenchOptions& options) {
  const fs::path directory(options.directory);
  CLEW_RETURN_IF_ERROR(make_directory(directory / "worlds"));
  CLEW_RETURN_IF_ERROR(make_directory(directory / "pictures"));
  auto file = ResultsFile::open((directory / "results.jsonl").string(), plan.configuration,
                                options.restart);
  if (!file.ok()) return file.error();
  Bookkeeping books;
  for (const std::string& line : file->lines()) CLEW_RETURN_IF_ERROR(books.take(line));
  const std::size_t found = books.size();

  // Workers are forked now, with the books as they are.
  const Work work = [&](std::size_t world, const Emit& emit) {
    return run_world(plan, world, books, configs, stages, directory, emit);
  };
  PoolOptions pool;
  pool.workers = options.jobs;
  pool.on_line = [&](const std::string& line) -> Result<void> {
    CLEW_RETURN_IF_ERROR(file->append(line));
    CLEW_RETURN_IF_ERROR(books.take(line));
    if (options.progress) options.progress(found, books.size(), plan.runs());
    return {};
  };
  const auto pool_end = run_in_workers(open_worlds(plan, books), work, pool);
  if (!pool_end.ok()) return pool_end.error();
  if (pool_end->interrupted_by != 0) return BenchEnd{pool_end->interrupted_by, {}, {}};

  BenchResults results;
  BenchEnd end = gather(plan, books, results);
  auto pictures = draw_worst_runs(results, configs, stages, options.directory);
  if (!pictures.ok()) return pictures.error();
  end.report = make_report(results, std::move(pictures).value());
  CLEW_RETURN_IF_ERROR(write_report(results, end.report, directory));
  return end;
}

Result<std::size_t> write_worlds(const BenchPlan& plan, const std::string& directory) {
  CLEW_RETURN_IF_ERROR(make_directory(directory));
  std::size_t count = 0;
  for (const BenchWorld& entry : plan.worlds) {
    if (!entry.order) continue;
    const auto generated = trap_worlds::generate_world(*entry.order);
    const auto world = world::World::parse(generated.text, generated.name);
    if (!world.ok()) return world.error();
    const fs::path path = fs::path(directory) / generated.name;
    CLEW_RETURN_IF_ERROR(write_file(path.string() + ".yaml", generated.text));
    CLEW_RETURN_IF_ERROR(write_file(path.string() + ".svg",
                                    plot::draw_empty_world(*world, entry.order->robot_radius_m)));
    ++count;
  }
  return count;
}

}  // namespace clew::bench
