// SPDX-License-Identifier: Apache-2.0
#include "bench/bench.hpp"

#include <algorithm>
#include <filesystem>
#include <map>

#include "bench/coverage.hpp"
#include "bench/groups.hpp"
#include "bench/results_file.hpp"
#include "bench/run_order.hpp"
#include "bench/stopping.hpp"
#include "bench/timing.hpp"
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

constexpr std::uintmax_t kLargeBytes = 64 << 20;  // of results, which are then compressed
/// For a task of the same shard that a cluster has ended, or thinks so, and that is not gone yet.
constexpr double kPatience_s = 20.0;

/// Which runs have a result.
class Books {
 public:
  /// `keep` keeps the results themselves, for looks at them.
  Books(const BenchPlan& plan, bool keep) : order_(plan), is_done_(order_.size()), keep_(keep) {}

  Result<void> take(const std::string& line) {
    auto result = read_run_result(line);
    if (!result.ok()) return result.error();
    const auto index = order_.index_of(result->key);
    if (!index) return Error{run_text(result->key) + " is no run of this bench"};
    if (!is_done_[*index]) ++done_;
    is_done_[*index] = true;
    if (keep_) kept_.insert_or_assign(*index, std::move(result).value());
    return {};
  }
  bool has(const RunKey& key) const { return is_done_[*order_.index_of(key)]; }
  std::size_t done() const { return done_; }
  std::size_t total() const { return order_.size(); }

  /// The results of a part of the bench that is done.
  BenchResults results_of(const BenchPlan& part) const {
    BenchResults results{&part, {}};
    const RunOrder order(part);
    for (std::size_t i = 0; i < order.size(); ++i) {
      results.runs.push_back(kept_.at(*order_.index_of(order.key_of(i))));
    }
    return results;
  }

 private:
  RunOrder order_;
  std::vector<bool> is_done_;
  std::size_t done_ = 0;
  bool keep_;
  std::map<std::size_t, RunResult> kept_;
};

/// Calls `visit` with variant, seed and key of each run of a unit, as long as it gives true.
template <typename Visit>
void for_each_run(const BenchPlan& plan, const Unit& unit, const Visit& visit) {
  for (std::size_t run = unit.first; run < unit.end; ++run) {
    const Variant& variant = plan.variants[run / plan.seeds.size()];
    const std::uint64_t seed = plan.seeds[run % plan.seeds.size()];
    const RunKey key{variant.graph, variant.text(), plan.worlds[unit.world].name, seed};
    if (!visit(variant, seed, key)) return;
  }
}

/// The units in which something is left to run.
std::vector<std::size_t> open_units(const BenchPlan& plan, const std::vector<Unit>& units,
                                    const Books& books) {
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < units.size(); ++i) {
    bool is_open = false;
    for_each_run(plan, units[i], [&](const Variant&, std::uint64_t, const RunKey& key) {
      is_open = !books.has(key);
      return !is_open;
    });
    if (is_open) open.push_back(i);
  }
  return open;
}

Result<void> write_world(const WorldBench& bench, const BenchWorld& world,
                         const fs::path& directory) {
  if (bench.generated_text().empty()) return {};
  return write_file(directory / "worlds" / (world.name + ".yaml"), bench.generated_text());
}

/// What a worker does: all that is left to run of a unit.
Result<void> run_unit(const BenchPlan& plan, const Unit& unit, const Books& books,
                      const runtime::ConfigPath& configs,
                      const std::vector<runtime::StageInfo>& stages, const fs::path& directory,
                      const Emit& emit) {
  WorldBench bench(plan, unit.world, configs, stages);
  CLEW_RETURN_IF_ERROR(write_world(bench, plan.worlds[unit.world], directory));
  Result<void> end;
  for_each_run(plan, unit, [&](const Variant& variant, std::uint64_t seed, const RunKey& key) {
    if (books.has(key)) return true;
    const auto line = bench.run(variant, seed);
    if (!line.ok()) end = line.error();
    return line.ok() && *line && emit(**line);
  });
  return end;
}

/// The files of a bench that is under way.
struct Files {
  ResultsFile results;
  LineFile timing;

  Result<void> append(const TimedLine& line) {
    // The result comes last: it says that the run is done.
    CLEW_RETURN_IF_ERROR(timing.append(line.timing));
    return results.append(line.result);
  }
};

Result<Files> open_files(const BenchPlan& plan, const BenchOrder& order,
                         const BenchOptions& options, Books& books) {
  const fs::path directory(options.directory);
  CLEW_RETURN_IF_ERROR(make_directory(directory / "worlds"));
  CLEW_RETURN_IF_ERROR(expand_results(options.directory, options.restart));
  ResultsHeader header{order, plan.configuration};
  if (options.shard.count > 1) header.configuration[kShardKey] = options.shard.text();
  const std::string path = (directory / kResultsFile).string();
  auto results = ResultsFile::open(
      path, header, options.restart,
      [&](const std::string& line, int number) -> Result<void> {
        const auto taken = books.take(line);
        return taken.ok() ? taken : Error{taken.error().message, path, number, 0};
      },
      options.shard.count > 1 ? kPatience_s : 0.0);
  if (!results.ok()) return results.error();
  auto timing = LineFile::open((directory / kTimingFile).string());
  if (!timing.ok()) return timing.error();
  if (options.restart) CLEW_RETURN_IF_ERROR(timing->clear());
  return Files{std::move(results).value(), std::move(timing).value()};
}

Result<BenchResults> read_results(const BenchPlan& plan, const std::string& path) {
  auto reader = LineReader::open(path);
  if (!reader.ok()) return reader.error();
  BenchResults results{&plan, {}};
  results.runs.reserve(plan.runs());
  reader->next();  // what they depend on
  while (const std::string* line = reader->next()) {
    auto run = read_run_result(*line);
    if (!run.ok()) return Error{run.error().message, path, reader->number(), 0};
    results.runs.push_back(std::move(run).value());
  }
  CLEW_RETURN_IF_ERROR(reader->is_whole());
  return results;
}

Result<void> write_groups(const BenchResults& results, const fs::path& directory) {
  std::vector<Grouping> by = results.plan->by;
  if (by.empty()) by = {Grouping::kSeverity};
  std::string text;
  for (const Grouping grouping : by) {
    for (const std::string& line : group_lines(results, grouping)) text += line + '\n';
  }
  return write_file(directory / kGroupsFile, text);
}

Result<void> write_report(const BenchResults& results, const Report& report,
                          const std::vector<KeptRun>& kept, const fs::path& directory,
                          std::string_view page) {
  auto table = NewFile::open((directory / "results.csv").string());
  if (!table.ok()) return table.error();
  CLEW_RETURN_IF_ERROR(table->write(csv_header()));
  for (const RunResult& run : results.runs) CLEW_RETURN_IF_ERROR(table->write(csv_row(run)));
  CLEW_RETURN_IF_ERROR(table->finish());
  if (results.plan->coverage) {
    CLEW_RETURN_IF_ERROR(write_file(directory / "coverage.csv", coverage_csv(results)));
  }
  CLEW_RETURN_IF_ERROR(write_groups(results, directory));
  CLEW_RETURN_IF_ERROR(write_file(directory / "report.md", to_markdown(report)));
  if (page.empty()) return write_file(directory / "report.html", to_html(report));
  const auto html = bench_page(page, results, report, kept, directory.string());
  if (!html.ok()) return html.error();
  return write_file(directory / "report.html", *html);
}

/// What a bench has at hand while its parts are run.
struct Parts {
  Books& books;
  Files& files;
  const runtime::ConfigPath& configs;
  const std::vector<runtime::StageInfo>& stages;
  const BenchOptions& options;
  std::size_t found;  ///< runs that were there before
};

/// Runs what is left of a part; the signal that interrupted it, or 0.
Result<int> run_part(const BenchPlan& part, Parts& parts) {
  const BenchOptions& options = parts.options;
  const std::vector<Unit> units =
      Shards(part, options.shard.count).units_of(options.shard.number, options.jobs);
  std::size_t total = parts.books.total();
  if (options.shard.count > 1) {
    total = 0;
    for (const Unit& unit : units) total += unit.end - unit.first;
  }
  // Workers are forked now, with the books as they are.
  const Work work = [&](std::size_t unit, const Emit& emit) {
    return run_unit(part, units[unit], parts.books, parts.configs, parts.stages, options.directory,
                    emit);
  };
  PoolOptions pool;
  pool.workers = options.jobs;
  pool.on_line = [&](const std::string& line) -> Result<void> {
    const auto timed = take_timing(line);
    if (!timed.ok()) return timed.error();
    CLEW_RETURN_IF_ERROR(parts.files.append(*timed));
    CLEW_RETURN_IF_ERROR(parts.books.take(timed->result));
    if (options.progress) options.progress(parts.found, parts.books.done(), total);
    return {};
  };
  const auto end = run_in_workers(open_units(part, units, parts.books), work, pool);
  if (!end.ok()) return end.error();
  return end->interrupted_by;
}

/// Runs batch after batch until the shares are known well enough; leaves in `part` what was run.
Result<int> run_until_known(const BenchPlan& plan, Parts& parts, BenchPlan& part) {
  const Batches batches(plan);
  for (std::size_t done = 1;; done = std::min(Batches::next_look(done), batches.count())) {
    part = batches.first(done);
    part.stopping = Stopping{plan.stopping->width, done, batches.count()};
    const auto interrupted_by = run_part(part, parts);
    if (!interrupted_by.ok() || *interrupted_by != 0) return interrupted_by;
    const bool is_known = widest(parts.books.results_of(part)) <= plan.stopping->width;
    if (is_known || done == batches.count()) return 0;
  }
}

}  // namespace

Result<BenchEnd> run_bench(const BenchPlan& plan, const BenchOrder& order,
                           const runtime::ConfigPath& configs,
                           const std::vector<runtime::StageInfo>& stages,
                           const BenchOptions& options) {
  Books books(plan, plan.stopping.has_value());
  auto files = open_files(plan, order, options, books);
  if (!files.ok()) return files.error();
  Parts parts{books, *files, configs, stages, options, books.done()};
  BenchPlan part = plan;
  int interrupted_by = 0;
  if (plan.stopping) {
    const auto done = run_until_known(plan, parts, part);
    if (!done.ok()) return done.error();
    interrupted_by = *done;
  } else {
    const auto done = run_part(plan, parts);
    if (!done.ok()) return done.error();
    interrupted_by = *done;
  }
  if (interrupted_by != 0) return BenchEnd{interrupted_by, 0, {}};
  CLEW_RETURN_IF_ERROR(put_in_order(plan, options.directory));
  if (options.shard.count > 1) return BenchEnd{0, books.done(), {}};
  return finish_bench(part, configs, stages, options);
}

Result<void> put_in_order(const BenchPlan& plan, const std::string& directory) {
  const RunOrder order(plan);
  const PlaceOfLine place = [&](const std::string& line,
                                int) -> Result<std::optional<std::size_t>> {
    const auto key = read_run_key(line);
    return key.ok() ? order.index_of(*key) : std::nullopt;
  };
  CLEW_RETURN_IF_ERROR(sort_lines((fs::path(directory) / kResultsFile).string(), 1, place));
  return sort_lines((fs::path(directory) / kTimingFile).string(), 0, place);
}

Result<void> expand_results(const std::string& directory, bool restart) {
  for (const char* name : {kTimingFile, kResultsFile}) {
    const fs::path path = fs::path(directory) / name;
    const std::string compressed = path.string() + kCompressedEnding;
    std::error_code ignored;
    if (!fs::exists(compressed, ignored)) continue;
    if (restart || fs::exists(path, ignored)) {
      fs::remove(compressed, ignored);
    } else {
      CLEW_RETURN_IF_ERROR(expand_file(path.string()));
    }
  }
  return {};
}

Result<BenchEnd> finish_bench(const BenchPlan& plan, const runtime::ConfigPath& configs,
                              const std::vector<runtime::StageInfo>& stages,
                              const BenchOptions& options) {
  const fs::path folder(options.directory);
  CLEW_RETURN_IF_ERROR(make_directory(folder / "worlds"));
  CLEW_RETURN_IF_ERROR(make_directory(folder / "pictures"));
  for (const BenchWorld& world : plan.worlds) {
    const fs::path file = folder / "worlds" / (world.name + ".yaml");
    if (!world.order || fs::exists(file)) continue;
    CLEW_RETURN_IF_ERROR(write_file(file, trap_worlds::generate_world(*world.order).text));
  }
  const auto results = read_results(plan, (folder / kResultsFile).string());
  if (!results.ok()) return results.error();
  const auto kept = keep_failed_runs(*results, configs, stages, options.directory,
                                     {options.keep, options.jobs, options.pages.run});
  if (!kept.ok()) return kept.error();
  if (kept->interrupted_by != 0) return BenchEnd{kept->interrupted_by, 0, {}};
  auto pictures = draw_worst_runs(*results, configs, stages, options.directory, kept->runs);
  if (!pictures.ok()) return pictures.error();
  BenchEnd end;
  end.runs = results->runs.size();
  end.report = make_report(*results, std::move(pictures).value());
  CLEW_RETURN_IF_ERROR(write_report(*results, end.report, kept->runs, folder, options.pages.bench));
  if (options.compress || fs::file_size(folder / kResultsFile) >= kLargeBytes) {
    CLEW_RETURN_IF_ERROR(compress_file((folder / kTimingFile).string()));
    CLEW_RETURN_IF_ERROR(compress_file((folder / kResultsFile).string()));
  }
  return end;
}

Result<void> visit_runs(const std::string& directory,
                        const std::function<void(const std::string& line)>& visit) {
  const fs::path folder(directory);
  return visit_timed((folder / kResultsFile).string(), (folder / kTimingFile).string(), visit);
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
