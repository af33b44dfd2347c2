// SPDX-License-Identifier: Apache-2.0
#include "classify/som.hpp"

#include <cmath>
#include <string>

#include "core/yaml_reader.hpp"

namespace clew::classify {
namespace {

using core::Result;
using core::YamlNode;

constexpr char kFormat[] = "clew-krishna-kalra-som/1";
constexpr double kMaxRunLength = 1e6;

Result<void> read_weights(const YamlNode& map, Som::Neuron& neuron) {
  const auto node = map.at("weights");
  if (!node.ok()) return node.error();
  const auto weights = node->numbers(3, "three classes");
  if (!weights.ok()) return weights.error();
  for (std::size_t i = 0; i < 3; ++i) {
    const double weight = (*weights)[i];
    if (weight < 0.0 || weight > 8.0) return node->error("a weight is a class, 0 to 8");
    neuron.weights[i] = weight;
  }
  return {};
}

Result<void> read_lower_bounds(const YamlNode& map, Som::Neuron& neuron) {
  const auto node = map.find("lower_bounds");
  if (!node) return {};
  const auto bounds = node->numbers(3, "three numbers of ticks");
  if (!bounds.ok()) return bounds.error();
  RunLengths lengths{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double bound = (*bounds)[i];
    if (bound < 1.0 || bound > kMaxRunLength || bound != std::floor(bound)) {
      return node->error("a lower bound is a whole number of ticks, at least 1");
    }
    lengths[i] = static_cast<std::uint32_t>(bound);
  }
  neuron.lower_bounds = lengths;
  return {};
}

Result<void> check_format(const YamlNode& root) {
  const auto format = root.at("format");
  if (!format.ok()) return format.error();
  const auto name = format->string();
  if (name.ok() && *name == kFormat) return {};
  return format->error(std::string("expected ") + kFormat + ", found " + format->found());
}

}  // namespace

Result<Som> Som::parse(const core::Resource& resource) {
  const auto root = YamlNode::parse(resource.text, resource.file);
  if (!root.ok()) return root.error();
  CLEW_RETURN_IF_ERROR(root->check_keys({"format", "trained_by", "neurons"}));
  CLEW_RETURN_IF_ERROR(check_format(*root));
  const auto list = root->at("neurons");
  if (!list.ok()) return list.error();
  const auto items = list->items();
  if (!items.ok()) return items.error();
  if (items->size() != kNeurons) {
    return list->error("expected " + std::to_string(kNeurons) + " neurons, found " +
                       std::to_string(items->size()));
  }

  Lattice lattice;
  for (std::size_t i = 0; i < kNeurons; ++i) {
    const YamlNode& item = (*items)[i];
    CLEW_RETURN_IF_ERROR(item.check_keys({"weights", "lower_bounds"}));
    CLEW_RETURN_IF_ERROR(read_weights(item, lattice[i]));
    CLEW_RETURN_IF_ERROR(read_lower_bounds(item, lattice[i]));
  }
  return Som(lattice);
}

Som::Recall Som::recall(const Triple& classes) const {
  Recall best;
  double best_squared = -1.0;
  for (std::uint32_t i = 0; i < kNeurons; ++i) {
    double squared = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double difference = lattice_[i].weights[k] - static_cast<double>(classes[k]);
      squared += difference * difference;
    }
    if (best_squared < 0.0 || squared < best_squared) {
      best_squared = squared;
      best.neuron = i;
    }
  }
  best.distance = std::sqrt(best_squared);
  return best;
}

}  // namespace clew::classify
