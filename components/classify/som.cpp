// SPDX-License-Identifier: Apache-2.0
#include "classify/som.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/yaml_fields.hpp"
#include "domain/landmark_classes.hpp"

namespace clew::classify {
namespace {

using core::Result;
using core::YamlNode;

Result<Som::Neuron> read_neuron(const YamlNode& node) {
  CLEW_RETURN_IF_ERROR(node.check_keys({"weights", "lower_bounds"}));
  Som::Neuron neuron;
  CLEW_RETURN_IF_ERROR(core::read_numbers(node, "weights", "three classes",
                                          {0.0, domain::kLastClass}, neuron.weights));
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
  std::array<double, 3> wanted{};
  std::copy(classes.begin(), classes.end(), wanted.begin());
  Recall best;
  double best_squared = -1.0;
  for (std::uint32_t i = 0; i < kNeurons; ++i) {
    const double squared = domain::squared_class_distance(lattice_[i].weights, wanted);
    if (best_squared < 0.0 || squared < best_squared) {
      best_squared = squared;
      best.neuron = i;
    }
  }
  best.distance = std::sqrt(best_squared);
  return best;
}

}  // namespace clew::classify
