// SPDX-License-Identifier: Apache-2.0
#include "control/infrared/neuro_fuzzy_nets.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "core/nearest_name.hpp"
#include "core/yaml_fields.hpp"

namespace clew::control {
namespace {

using core::Range;
using core::Result;
using core::YamlNode;
using Net = NeuroFuzzyNets::Net;
using Words = std::vector<std::string>;
using Four = std::array<double, NeuroFuzzyNets::kSets>;

constexpr char kRulesFormat[] = "clew-neuro-fuzzy-rules/1";
constexpr char kTrainedFormat[] = "clew-neuro-fuzzy-trained/1";
const Words kSetWords = {"TC", "C", "F", "TF"};
const Words kWheelSpeedWords = {"Z", "S", "M", "F", "FF"};
const Words kNetWords = {"V_L1", "V_R1", "V_L2", "V_R2"};
constexpr double kFileUnit = 1e-5;  // of every trained number

/// A map from each of these words to a number within the range.
Result<std::vector<double>> read_levels(const YamlNode& root, const char* key, const Words& words,
                                        Range range) {
  const auto map = root.at(key);
  if (!map.ok()) return map.error();
  CLEW_RETURN_IF_ERROR(map->check_keys(words));
  std::vector<double> levels(words.size());
  for (std::size_t i = 0; i < words.size(); ++i) {
    CLEW_RETURN_IF_ERROR(read_number(*map, words[i].c_str(), range, levels[i]));
  }
  return levels;
}

Result<double> read_speed(const YamlNode& cell, const std::string& word,
                          const std::vector<double>& speeds_mps) {
  for (std::size_t i = 0; i < kWheelSpeedWords.size(); ++i) {
    if (kWheelSpeedWords[i] == word) return speeds_mps[i];
  }
  return cell.error(core::unknown_name("speed", word, kWheelSpeedWords));
}

/// A cell as the paper prints it: `S/FF`, left wheel and right.
Result<WheelSpeeds> read_cell(const YamlNode& cell, const std::vector<double>& speeds_mps) {
  const auto text = cell.string();
  if (!text.ok()) return text.error();
  const std::size_t slash = text->find('/');
  if (slash == std::string::npos) {
    return cell.error("found " + cell.found() + ", expected LEFT/RIGHT, as S/FF");
  }
  const auto left = read_speed(cell, text->substr(0, slash), speeds_mps);
  if (!left.ok()) return left.error();
  const auto right = read_speed(cell, text->substr(slash + 1), speeds_mps);
  if (!right.ok()) return right.error();
  return WheelSpeeds{*left, *right};
}

/// A rule table: a row a set of the first sensor, a column a set of the second.
Result<void> read_table(const YamlNode& root, const char* key,
                        const std::vector<double>& speeds_mps, Net& left, Net& right) {
  const auto table = root.at(key);
  if (!table.ok()) return table.error();
  CLEW_RETURN_IF_ERROR(table->check_keys(kSetWords));
  for (std::size_t i = 0; i < kSetWords.size(); ++i) {
    const auto row = table->at(kSetWords[i]);
    if (!row.ok()) return row.error();
    const auto cells = row->items();
    if (!cells.ok()) return cells.error();
    if (cells->size() != kSetWords.size()) {
      return row->error("found " + row->found() + ", expected a cell for each of TC, C, F, TF");
    }
    for (std::size_t j = 0; j < kSetWords.size(); ++j) {
      const auto cell = read_cell((*cells)[j], speeds_mps);
      if (!cell.ok()) return cell.error();
      left.outputs[i][j] = cell->left_mps;
      right.outputs[i][j] = cell->right_mps;
    }
  }
  return {};
}

Result<NeuroFuzzyNets> read_rules(const YamlNode& root) {
  CLEW_RETURN_IF_ERROR(
      root.check_keys({"format", "centres", "width", "speeds_mps", "table_1", "table_2"}));
  const auto centres = read_levels(root, "centres", kSetWords, NeuroFuzzyNets::kCentres);
  if (!centres.ok()) return centres.error();
  double width = 0.0;
  CLEW_RETURN_IF_ERROR(read_number(root, "width", NeuroFuzzyNets::kWidths, width));
  const auto speeds =
      read_levels(root, "speeds_mps", kWheelSpeedWords, NeuroFuzzyNets::kOutputs_mps);
  if (!speeds.ok()) return speeds.error();
  NeuroFuzzyNets result;
  for (Net& net : result.nets) {
    for (auto& of_input : net.centres) {
      std::copy(centres->begin(), centres->end(), of_input.begin());
    }
    for (auto& of_input : net.widths) of_input.fill(width);
  }
  auto& nets = result.nets;
  CLEW_RETURN_IF_ERROR(read_table(root, "table_1", *speeds, nets[NeuroFuzzyNets::kLeft1],
                                  nets[NeuroFuzzyNets::kRight1]));
  CLEW_RETURN_IF_ERROR(read_table(root, "table_2", *speeds, nets[NeuroFuzzyNets::kLeft2],
                                  nets[NeuroFuzzyNets::kRight2]));
  return result;
}

/// As many lists of four numbers as there are rows, each number within the range.
template <std::size_t kRows>
Result<void> read_rows(const YamlNode& root, const char* key, Range range,
                       std::array<Four, kRows>& rows) {
  const auto node = root.at(key);
  if (!node.ok()) return node.error();
  const auto lists = node->items();
  if (!lists.ok()) return lists.error();
  if (lists->size() != kRows) {
    return node->error(fmt::format("found {}, expected {} rows", node->found(), kRows));
  }
  for (std::size_t i = 0; i < kRows; ++i) {
    const auto numbers = (*lists)[i].numbers(NeuroFuzzyNets::kSets, "four numbers");
    if (!numbers.ok()) return numbers.error();
    for (std::size_t j = 0; j < NeuroFuzzyNets::kSets; ++j) {
      rows[i][j] = (*numbers)[j];
      CLEW_RETURN_IF_ERROR(core::check_range((*lists)[i], rows[i][j], range));
    }
  }
  return {};
}

Result<NeuroFuzzyNets> read_trained(const YamlNode& root) {
  CLEW_RETURN_IF_ERROR(root.check_keys({"format", "trained_by", "nets"}));
  const auto nets = root.at("nets");
  if (!nets.ok()) return nets.error();
  CLEW_RETURN_IF_ERROR(nets->check_keys(kNetWords));
  NeuroFuzzyNets result;
  for (std::size_t k = 0; k < NeuroFuzzyNets::kCount; ++k) {
    const auto net = nets->at(kNetWords[k]);
    if (!net.ok()) return net.error();
    CLEW_RETURN_IF_ERROR(net->check_keys({"centres", "widths", "outputs_mps"}));
    Net& read = result.nets[k];
    CLEW_RETURN_IF_ERROR(read_rows(*net, "centres", NeuroFuzzyNets::kCentres, read.centres));
    CLEW_RETURN_IF_ERROR(read_rows(*net, "widths", NeuroFuzzyNets::kWidths, read.widths));
    CLEW_RETURN_IF_ERROR(
        read_rows(*net, "outputs_mps", NeuroFuzzyNets::kOutputs_mps, read.outputs));
  }
  return result;
}

template <std::size_t kRows>
std::string rows_yaml(const char* key, const std::array<Four, kRows>& rows) {
  std::string text = fmt::format("    {}:\n", key);
  for (const Four& row : rows) {
    text +=
        fmt::format("      - [{:.5f}, {:.5f}, {:.5f}, {:.5f}]\n", row[0], row[1], row[2], row[3]);
  }
  return text;
}

template <std::size_t kRows>
void round_rows(std::array<Four, kRows>& rows) {
  for (Four& row : rows) {
    for (double& value : row) value = std::round(value / kFileUnit) * kFileUnit;
  }
}

}  // namespace

Result<NeuroFuzzyNets> NeuroFuzzyNets::parse(const core::Resource& resource) {
  const auto root = YamlNode::parse(resource.text, resource.file);
  if (!root.ok()) return root.error();
  const auto format = root->at("format");
  if (!format.ok()) return format.error();
  const auto found = format->string();
  if (found.ok() && *found == kRulesFormat) return read_rules(*root);
  if (found.ok() && *found == kTrainedFormat) return read_trained(*root);
  return format->error(
      fmt::format("found {}, expected {} or {}", format->found(), kRulesFormat, kTrainedFormat));
}

std::string NeuroFuzzyNets::to_yaml() const {
  std::string text = "nets:\n";
  for (std::size_t k = 0; k < kCount; ++k) {
    text += fmt::format("  {}:\n", kNetWords[k]) + rows_yaml("centres", nets[k].centres) +
            rows_yaml("widths", nets[k].widths) + rows_yaml("outputs_mps", nets[k].outputs);
  }
  return text;
}

NeuroFuzzyNets NeuroFuzzyNets::rounded() const {
  NeuroFuzzyNets result = *this;
  for (Net& net : result.nets) {
    round_rows(net.centres);
    round_rows(net.widths);
    round_rows(net.outputs);
  }
  return result;
}

}  // namespace clew::control
