// SPDX-License-Identifier: Apache-2.0
/// Parameters, declared once and used everywhere: by the behaviour, by the check of a graph, by
/// `clew list` and by the documents. A behaviour keeps its parameters in a struct whose initial
/// values are the defaults, with one free function beside it:
///
///     struct ConesParameters {
///       double range_m = 1.5;
///       double turn_rad = radians(15.0);
///     };
///     template <typename Visitor>
///     void visit_parameters(Visitor& visit, ConesParameters& p) {
///       visit.number("range_m", p.range_m, "m", {0.1, 20.0}, "how far a cone sees");
///       visit.angle("turn_deg", p.turn_rad, {0.0, 90.0}, "turn away from a contact");
///     }
#pragma once

#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/angle.hpp"
#include "core/check.hpp"

namespace clew::core {

/// As it stands in a graph file.
using ParameterValue =
    std::variant<bool, std::int64_t, double, std::string, std::vector<std::string>>;

/// Values by name, one for each declared parameter.
using ParameterValues = std::map<std::string, ParameterValue>;

/// What is allowed, both ends included.
struct Range {
  double min = 0.0;
  double max = 0.0;
};

/// One declared parameter.
struct ParameterInfo {
  std::string name;
  std::string unit;  ///< `m`, `s`, `deg`, `1` for a pure number, empty for what is no number
  std::string doc;   ///< one line
  ParameterValue default_value;
  std::optional<Range> range;        ///< of a number
  std::vector<std::string> choices;  ///< allowed words; empty: any, for a string
  std::string folder;                ///< the value names a data file in configs/<folder>
};

/// Visitor that collects the declarations.
class ParameterDescriber {
 public:
  void number(const char* name, double& field, const char* unit, Range range, const char* doc) {
    infos_.push_back({name, unit, doc, field, range, {}, {}});
  }
  void angle(const char* name, double& field_rad, Range range_deg, const char* doc) {
    // Rounded to a billionth of a degree, so that a default of 15 is printed as 15.
    const double rounded = std::round(degrees(field_rad) * 1e9) / 1e9;
    infos_.push_back({name, "deg", doc, rounded, range_deg, {}, {}});
  }
  void integer(const char* name, std::int64_t& field, const char* unit, Range range,
               const char* doc) {
    infos_.push_back({name, unit, doc, field, range, {}, {}});
  }
  void flag(const char* name, bool& field, const char* doc) {
    infos_.push_back({name, "", doc, field, {}, {}, {}});
  }
  template <typename Enum>
  void choice(const char* name, Enum& field,
              std::initializer_list<std::pair<const char*, Enum>> choices, const char* doc) {
    ParameterInfo info{name, "", doc, std::string(), {}, {}, {}};
    for (const auto& [word, value] : choices) {
      info.choices.emplace_back(word);
      if (value == field) info.default_value = std::string(word);
    }
    infos_.push_back(std::move(info));
  }
  void words(const char* name, std::vector<std::string>& field,
             std::initializer_list<const char*> choices, const char* doc) {
    infos_.push_back({name, "", doc, field, {}, {choices.begin(), choices.end()}, {}});
  }
  /// The name of a file in configs/<folder>; an empty name means none.
  void file(const char* name, std::string& field, const char* folder, const char* doc) {
    infos_.push_back({name, "", doc, field, {}, {}, folder});
  }

  std::vector<ParameterInfo> take() { return std::move(infos_); }

 private:
  std::vector<ParameterInfo> infos_;
};

/// Visitor that fills a struct from values that a graph's check has accepted: a missing or mistyped
/// one is a mistake of our own.
class ParameterReader {
 public:
  explicit ParameterReader(const ParameterValues& values) : values_(values) {}

  void number(const char* name, double& field, const char*, Range, const char*) {
    field = get<double>(name);
  }
  void angle(const char* name, double& field_rad, Range, const char*) {
    field_rad = radians(get<double>(name));
  }
  void integer(const char* name, std::int64_t& field, const char*, Range, const char*) {
    field = get<std::int64_t>(name);
  }
  void flag(const char* name, bool& field, const char*) { field = get<bool>(name); }
  template <typename Enum>
  void choice(const char* name, Enum& field,
              std::initializer_list<std::pair<const char*, Enum>> choices, const char*) {
    const auto& chosen = get<std::string>(name);
    for (const auto& [word, value] : choices) {
      if (chosen == word) field = value;
    }
  }
  void words(const char* name, std::vector<std::string>& field, std::initializer_list<const char*>,
             const char*) {
    field = get<std::vector<std::string>>(name);
  }
  void file(const char* name, std::string& field, const char*, const char*) {
    field = get<std::string>(name);
  }

 private:
  template <typename T>
  const T& get(const char* name) const {
    const auto found = values_.find(name);
    CLEW_CHECK(found != values_.end() && std::holds_alternative<T>(found->second),
               std::string("parameter ") + name + " was not checked");
    return std::get<T>(found->second);
  }

  const ParameterValues& values_;
};

/// Of what has none.
struct NoParameters {};

template <typename Visitor>
void visit_parameters(Visitor&, NoParameters&) {}

/// The declarations of a struct of parameters.
template <typename Parameters>
std::vector<ParameterInfo> describe_parameters() {
  Parameters defaults;
  ParameterDescriber describer;
  visit_parameters(describer, defaults);
  return describer.take();
}

/// A struct of parameters with these values.
template <typename Parameters>
Parameters read_parameters(const ParameterValues& values) {
  Parameters parameters;
  ParameterReader reader(values);
  visit_parameters(reader, parameters);
  return parameters;
}

/// The defaults as values, for tests and tools that build a behaviour without a graph.
inline ParameterValues default_values(const std::vector<ParameterInfo>& infos) {
  ParameterValues values;
  for (const ParameterInfo& info : infos) values[info.name] = info.default_value;
  return values;
}

}  // namespace clew::core
