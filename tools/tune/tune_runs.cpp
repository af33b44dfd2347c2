// SPDX-License-Identifier: Apache-2.0
#include "tune/tune_runs.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "bench/results_file.hpp"
#include "bench/worker_pool.hpp"
#include "core/hash128.hpp"
#include "files/whole_file.hpp"
#include "hunt/property.hpp"

namespace clew::tune {
namespace {

using core::Error;
using core::Result;
using nlohmann::ordered_json;

constexpr char kFormat[] = "clew-tune/1";

std::string text_of(const Settings& settings) {
  std::string text;
  for (const std::string& setting : settings) text += (text.empty() ? "" : " ") + setting;
  return text;
}

/// What the results of a run depend on, besides its settings, world's name and seed.
bench::Configuration configuration_of(const TuneSpace& space, const TuneOptions& options) {
  bench::Configuration configuration = options.configuration;
  configuration["graph " + space.graph.graph] = space.graph_digest;
  configuration["max_ticks"] = std::to_string(space.graph.max_ticks.value_or(0));
  for (const TuneWorlds* worlds : {&space.tuning, &space.validation}) {
    for (const TuneWorld& world : worlds->worlds) {
      configuration["world " + world.name] = core::hash128(world.text).hex();
    }
  }
  return configuration;
}

/// Refused: the first line of results that were made with something else.
Result<void> check_header(const std::string& line, const bench::Configuration& now,
                          const std::string& path) {
  const auto json = ordered_json::parse(line, nullptr, false);
  const bool is_ours = json.is_object() && json.contains("format") && json["format"] == kFormat;
  if (!is_ours || !json.contains("configuration")) {
    return Error{std::string("is no file of results; expected format ") + kFormat, path, 1, 0};
  }
  bench::Configuration made_with;
  for (const auto& [key, value] : json["configuration"].items()) {
    made_with[key] = value.is_string() ? value.get<std::string>() : value.dump();
  }
  const std::string other = bench::difference(made_with, now);
  if (other.empty()) return {};
  return Error{other +
                   "; go on with what it was made with, choose another --out, or begin again "
                   "with --force",
               path, 1, 0};
}

}  // namespace

struct TuneRuns::Order {
  Settings settings;
  const TuneWorld* world = nullptr;
  std::uint64_t seed = 0;

  Key key() const { return {text_of(settings), world->name, seed}; }
};

Result<TuneRuns> TuneRuns::open(const TuneSpace& space, const hunt::Workshop& workshop,
                                const TuneOptions& options) {
  CLEW_RETURN_IF_ERROR(files::make_directory(options.directory));
  auto file =
      bench::LineFile::open((std::filesystem::path(options.directory) / "runs.jsonl").string());
  if (!file.ok()) return file.error();
  TuneRuns runs(space, workshop, options, std::move(file).value());
  if (options.restart) CLEW_RETURN_IF_ERROR(runs.file_.clear());
  CLEW_RETURN_IF_ERROR(runs.take_found());
  return runs;
}

Result<void> TuneRuns::take_found() {
  auto reader = bench::LineReader::open(file_.path());
  if (!reader.ok()) return reader.error();
  const bench::Configuration configuration = configuration_of(space_, options_);
  const std::string* line = reader->next();
  if (line == nullptr) {
    return file_.append(
        ordered_json({{"format", kFormat}, {"configuration", configuration}}).dump());
  }
  CLEW_RETURN_IF_ERROR(check_header(*line, configuration, file_.path()));
  while ((line = reader->next()) != nullptr) {
    CLEW_RETURN_IF_ERROR(take(*line, reader->number()));
  }
  return reader->is_whole();
}

Result<void> TuneRuns::take(const std::string& line, int number) {
  const auto json = ordered_json::parse(line, nullptr, false);
  try {
    ran_[{json.at("settings").get<std::string>(), json.at("world").get<std::string>(),
          json.at("seed").get<std::uint64_t>()}] = {json.at("success").get<bool>(),
                                                    json.at("cost").get<double>()};
  } catch (const nlohmann::json::exception&) {
    return Error{"is no line of a run", file_.path(), number, 0};
  }
  return {};
}

Result<std::string> TuneRuns::run(const Order& order) const {
  hunt::RunCase which{space_.graph, order.world->text, order.world->name, order.seed};
  which.graph.set.insert(which.graph.set.end(), order.settings.begin(), order.settings.end());
  const auto plan = hunt::plan_case(which, workshop_);
  if (!plan.ok()) return plan.error();
  const auto outcome = hunt::run_plan(*plan, nullptr, nullptr);
  if (!outcome.ok()) return outcome.error();
  if (!*outcome) return std::string();
  const hunt::FieldValues& values = (*outcome)->values;
  const std::string word = values.word(hunt::Field::kOutcome);
  const bool success = values[hunt::Field::kSuccess].value_or(0.0) != 0.0;
  std::optional<double> ratio;
  if (word == "reached") ratio = values[hunt::Field::kPathRatio];
  return ordered_json({{"settings", text_of(order.settings)},
                       {"world", order.world->name},
                       {"seed", order.seed},
                       {"outcome", word},
                       {"success", success},
                       {"cost", cost_of(success, ratio)},
                       {"hash", (*outcome)->hash}})
      .dump();
}

std::vector<TuneRuns::Order> TuneRuns::missing(const std::vector<Settings>& all,
                                               const TuneWorlds& worlds) const {
  std::vector<Order> orders;
  std::set<Key> ordered;
  for (const Settings& settings : all) {
    for (const TuneWorld& world : worlds.worlds) {
      for (const std::uint64_t seed : worlds.seeds) {
        Order order{settings, &world, seed};
        const bool is_new = ran_.count(order.key()) == 0 && ordered.insert(order.key()).second;
        if (is_new) orders.push_back(std::move(order));
      }
    }
  }
  return orders;
}

Result<bool> TuneRuns::make(const std::vector<Settings>& all, const TuneWorlds& worlds,
                            std::optional<double> best_cost) {
  const std::vector<Order> orders = missing(all, worlds);
  std::vector<std::size_t> units(orders.size());
  std::iota(units.begin(), units.end(), std::size_t{0});
  bench::PoolOptions pool;
  pool.workers = options_.jobs;
  pool.on_line = [&](const std::string& line) -> Result<void> {
    CLEW_RETURN_IF_ERROR(file_.append(line));
    CLEW_RETURN_IF_ERROR(take(line, 0));
    if (options_.progress) options_.progress(ran_.size(), best_cost);
    return {};
  };
  const auto end = bench::run_in_workers(
      units,
      [&](std::size_t unit, const bench::Emit& emit) -> Result<void> {
        const auto line = run(orders[unit]);
        if (!line.ok()) return line.error();
        if (!line->empty()) emit(*line);
        return {};
      },
      pool);
  if (!end.ok()) return end.error();
  interrupted_by_ = end->interrupted_by;
  return interrupted_by_ == 0;
}

Ran TuneRuns::at(const Settings& settings, const std::string& world, std::uint64_t seed) const {
  return ran_.at({text_of(settings), world, seed});
}

Score TuneRuns::score(const Settings& settings, const TuneWorlds& worlds) const {
  Score score;
  for (const TuneWorld& world : worlds.worlds) {
    for (const std::uint64_t seed : worlds.seeds) {
      const Ran ran = at(settings, world.name, seed);
      ++score.runs;
      if (ran.success) ++score.successes;
      score.cost += ran.cost;
    }
  }
  score.cost /= static_cast<double>(score.runs);
  return score;
}

}  // namespace clew::tune
