// SPDX-License-Identifier: Apache-2.0
#include "bench/coverage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/quoted.hpp"
#include "replay/component_replay.hpp"
#include "rules/rule_base.hpp"

namespace clew::bench {
namespace {

using core::Result;
using insides::Case;
using insides::Choice;
using nlohmann::ordered_json;

/// So many names stand in a cell of the table; all are in the file.
constexpr std::size_t kMostNames = 6;

std::size_t count_cases(const std::vector<Choice>& choices) {
  std::size_t count = 0;
  for (const Choice& choice : choices) count += choice.is_closed ? choice.cases.size() : 0;
  return count;
}

/// Rules are told in the order of the rule base: where all of one are there, they get its words.
void name_rules(const rules::RuleBase& base, std::vector<Choice>& choices) {
  if (count_cases(choices) != base.rules.size()) return;
  auto sentence = base.rules.begin();
  for (Choice& choice : choices) {
    if (!choice.is_closed) continue;
    for (Case& rule : choice.cases) rule.name = *sentence++;
  }
}

/// Escapes that never came to work are cases, too.
void name_escapes(const runtime::GraphStage& stage, std::vector<Choice>& choices) {
  const auto parts = stage.config.parts.find("escape");
  if (parts == stage.config.parts.end()) return;
  const auto found = std::find_if(choices.begin(), choices.end(),
                                  [](const Choice& each) { return each.of == "escape.name"; });
  const bool is_told = found != choices.end();
  if (!is_told) choices.push_back({"escape.name", 0, true, {}});
  Choice& escapes = is_told ? *found : choices.back();
  for (const auto& part : parts->second) escapes.case_of(part.name);
  escapes.is_closed = true;
}

std::string names_of(const std::vector<const Case*>& cases) {
  std::string text;
  for (std::size_t i = 0; i < cases.size() && i < kMostNames; ++i) {
    text += (i == 0 ? "" : "; ") + cases[i]->name;
  }
  if (cases.size() > kMostNames) text += fmt::format("; and {} more", cases.size() - kMostNames);
  return text;
}

/// The choices of a variant, over its runs.
std::vector<CoveredChoice> total_of(const BenchResults& results, std::size_t variant) {
  std::vector<CoveredChoice> total;
  for (const RunResult* run : results.samples_of(variant)) {
    for (const CoveredChoice& each : run->coverage) {
      const auto same = [&](const CoveredChoice& known) {
        return known.stage == each.stage && known.choice.of == each.choice.of;
      };
      const auto found = std::find_if(total.begin(), total.end(), same);
      if (found == total.end()) {
        total.push_back(each);
      } else {
        found->choice.add(each.choice);
      }
    }
  }
  return total;
}

std::vector<std::string> coverage_row(const Variant& variant, const CoveredChoice& covered) {
  const Choice& choice = covered.choice;
  std::vector<const Case*> never;
  const Case* most = nullptr;
  std::size_t silent = 0;
  for (const Case& each : choice.cases) {
    if (each.decided == 0) never.push_back(&each);
    if (each.held == 0) ++silent;
    if (each.decided > 0 && (most == nullptr || each.decided > most->decided)) most = &each;
  }
  const auto share = [&](std::uint64_t ticks) {
    return 100.0 * static_cast<double>(ticks) / static_cast<double>(choice.ticks);
  };
  return {variant.label(),
          covered.stage,
          choice.of,
          std::to_string(choice.ticks),
          choice.is_closed
              ? fmt::format("{} of {}", choice.cases.size() - never.size(), choice.cases.size())
              : fmt::format("{}", choice.cases.size() - never.size()),
          most == nullptr ? "" : fmt::format("{} ({:.0f} %)", most->name, share(most->decided)),
          std::to_string(silent),
          names_of(never)};
}

}  // namespace

Result<std::vector<CoveredChoice>> coverage_of(const bridge::RunRecording& recording,
                                               const runtime::RunPlan& plan) {
  const auto bases = rules::rule_bases_of(plan);
  if (!bases.ok()) return bases.error();
  std::vector<CoveredChoice> coverage;
  for (const runtime::GraphStage& stage : plan.graph.stages) {
    if (!stage.deployment.is_ours()) continue;
    insides::Decisions decisions;
    CLEW_RETURN_IF_ERROR(bridge::for_each_inside(
        recording, plan, stage.info->name,
        [&](std::uint64_t, const domain::Inside& inside) { decisions.add(inside); }));
    std::vector<Choice> choices = decisions.choices();
    for (const rules::RuleBase& base : bases->fuzzy) {
      if (base.stage == stage.info->name) name_rules(base, choices);
    }
    name_escapes(stage, choices);
    for (Choice& choice : choices) coverage.push_back({stage.info->name, std::move(choice)});
  }
  return coverage;
}

ordered_json to_json(const std::vector<CoveredChoice>& coverage) {
  ordered_json json = ordered_json::array();
  for (const auto& [stage, choice] : coverage) {
    ordered_json cases = ordered_json::array();
    for (const Case& each : choice.cases) {
      cases.push_back({{"case", each.name}, {"decided", each.decided}, {"held", each.held}});
    }
    json.push_back({{"stage", stage},
                    {"of", choice.of},
                    {"ticks", choice.ticks},
                    {"closed", choice.is_closed},
                    {"cases", std::move(cases)}});
  }
  return json;
}

std::vector<CoveredChoice> read_coverage(const nlohmann::json& json) {
  std::vector<CoveredChoice> coverage;
  for (const auto& each : json) {
    Choice choice{each.at("of").get<std::string>(),
                  each.at("ticks").get<std::uint64_t>(),
                  each.at("closed").get<bool>(),
                  {}};
    for (const auto& one : each.at("cases")) {
      choice.cases.push_back({one.at("case").get<std::string>(),
                              one.at("decided").get<std::uint64_t>(),
                              one.at("held").get<std::uint64_t>()});
    }
    coverage.push_back({each.at("stage").get<std::string>(), std::move(choice)});
  }
  return coverage;
}

Table coverage_table(const BenchResults& results) {
  Table table;
  table.title = "What decided";
  table.note =
      "Of rules, cells of tables, neurons, categories and cases: at how many ticks there was "
      "something to decide, how many ever decided (as the strongest, or the winner), which did "
      "most, how many never had a say at all, and which never decided. coverage.csv has each.";
  table.columns = {"graph",        "stage",        "choice",      "ticks",
                   "ever decided", "decided most", "never a say", "never decided"};
  for (std::size_t i = 0; i < results.plan->variants.size(); ++i) {
    for (const CoveredChoice& covered : total_of(results, i)) {
      table.rows.push_back(coverage_row(results.plan->variants[i], covered));
      table.runs.push_back({{i, {}, {}}});
    }
  }
  return table;
}

std::string coverage_csv(const BenchResults& results) {
  std::string text = "graph,stage,choice,case,ticks,decided,held\n";
  for (std::size_t i = 0; i < results.plan->variants.size(); ++i) {
    const std::string graph = core::csv_field(results.plan->variants[i].label());
    for (const auto& [stage, choice] : total_of(results, i)) {
      for (const Case& each : choice.cases) {
        text += fmt::format("{},{},{},{},{},{},{}\n", graph, stage, core::csv_field(choice.of),
                            core::csv_field(each.name), choice.ticks, each.decided, each.held);
      }
    }
  }
  return text;
}

}  // namespace clew::bench
