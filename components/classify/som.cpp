// SPDX-License-Identifier: Apache-2.0
#include "classify/som.hpp"

#include <cmath>
#include <string>

#include "core/yaml_fields.hpp"

namespace clew::classify {
namespace {

using core::Result;
using core::YamlNode;

Result<Som::Neuron> read_neuron(const YamlNode& node) {
  CLEW_RETURN_IF_ERROR(node.check_keys({"weights", "lower_bounds"}));
  const auto list = node.at("weights");
  if (!list.ok()) return list.error();
  const auto weights = list->numbers(3, "three classes");
  if (!weights.ok()) return weights.error();
  Som::Neuron neuron;
  for (std::size_t i = 0; i < 3; ++i) {
    neuron.weights[i] = (*weights)[i];
    CLEW_RETURN_IF_ERROR(core::check_range(*list, neuron.weights[i], {0.0, 8.0}));
  }
  if (node.find("lower_bounds")) {
    CLEW_RETURN_IF_ERROR(core::read_counts(node, "lower_bounds", neuron.lower_bounds.emplace()));
  }
  return neuron;
}

}  // namespace

Result<Som> Som::parse(const core::Resource& resource) {
  const auto root = YamlNode::parse(resource.text, resource.file);
  if (!root.ok()) return root.error();
  CLEW_RETURN_IF_ERROR(root->check_keys({"format", "trained_by", "neurons"}));
  CLEW_RETURN_IF_ERROR(core::check_format(*root, "clew-krishna-kalra-som/1"));
  const auto list = root->at("neurons");
  if (!list.ok()) return list.error();
  const auto items = list->items();
  if (!items.ok()) return items.error();
  if (items->size() != kNeurons) {
    return list->error("found " + std::to_string(items->size()) + " neurons, expected " +
                       std::to_string(kNeurons));
  }

  Lattice lattice;
  for (std::size_t i = 0; i < kNeurons; ++i) {
    auto neuron = read_neuron((*items)[i]);
    if (!neuron.ok()) return neuron.error();
    lattice[i] = *neuron;
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
