// SPDX-License-Identifier: Apache-2.0
/// The fuzzy rule bases of a graph as something that can be looked at: sets over their variables,
/// rules, and what the controller answers over two of its inputs.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "runtime/run_plan.hpp"

namespace clew::rules {

/// What is drawn along: `low` to `high`.
struct Axis {
  std::string name;
  std::string unit;  ///< as `deg`; empty for shares
  double low = 0.0;
  double high = 1.0;
};

/// A fuzzy set: its degrees at equal steps of its variable, both ends included.
struct FuzzySet {
  std::string name;
  std::vector<double> degrees;
};

/// A variable of rules, with the sets over it.
struct Variable {
  Axis axis;
  std::vector<FuzzySet> sets;
};

/// What is answered over two inputs, both ends of both included; all others are as `given` says.
struct Surface {
  std::string name;
  std::string unit;
  std::string given;
  Axis across;
  Axis up;
  std::size_t columns = 0;
  std::vector<double> values;  ///< row by row, the lowest value of `up` first
};

struct RuleBase {
  std::string stage;
  std::string parameter;  ///< of the stage, that names the file
  std::string name;       ///< of the file
  std::vector<Variable> variables;
  std::vector<std::string> rules;  ///< a sentence each
  std::vector<Surface> surfaces;
};

/// What a graph's rule files are. A file that several behaviours of a stage name is one.
struct RuleBases {
  std::vector<RuleBase> fuzzy;
  std::vector<std::string> others;  ///< files without fuzzy sets, as `krishna_kalra_som`
};

/// Refused: a file that its behaviour would refuse.
core::Result<RuleBases> rule_bases_of(const runtime::RunPlan& plan);

}  // namespace clew::rules
