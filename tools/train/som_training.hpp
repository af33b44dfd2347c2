// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "classify/class_sequence.hpp"
#include "classify/som.hpp"
#include "core/resources.hpp"
#include "core/result.hpp"

namespace clew::train {

using classify::RunLengths;

/// How the map is trained: a recipe file.
struct SomRecipe {
  std::uint64_t seed = 1;
  std::uint64_t iterations = 0;
  std::array<double, 2> learning_rate{};   ///< eta, first and last
  std::array<double, 2> radius_neurons{};  ///< sigma of the neighbourhood, first and last
  RunLengths least_runs{};                 ///< floor of the lower bounds, in ticks
  std::vector<double> scales;              ///< of the copies, largest first; the first is 1
  std::vector<std::string> worlds;         ///< landmark worlds

  /// Reads a recipe. Refused: another format, keys that are unknown or missing, fewer than 100
  /// iterations a neuron (Krishna & Kalra 2000, section 3.2.1), numbers out of range, scales that
  /// do not fall from 1.
  static core::Result<SomRecipe> parse(const core::Resource& resource);
};

/// One run of the reactive robot past a landmark: the spatial class of every tick.
struct LandmarkRun {
  std::string world;
  double scale = 1.0;
  std::vector<std::uint8_t> classes;
};

/// Trains the map and finds its lower bounds: Krishna & Kalra 2000, section 3.2.1 and appendix A.
/// Returns the trained file, which is the same bytes for the same recipe and runs. `runs` are one
/// of each world of the recipe at each of its scales; `command` is what a person types to get the
/// file.
///
/// The landmark vectors of the runs at full size and their mirror images are the inputs. A vector
/// must be at least as long as the recipe's floor, and may be free of obstacles (class 8) only at
/// its end: a landmark is something that is seen. For n = 0, 1, ... one of them is drawn at random,
/// and with iw the neuron nearest to it,
///
///     w_i += eta(n) h(i, iw) (u - w_i),   h = exp(-|r_i - r_iw|^2 / (2 sigma(n)^2))
///
/// where eta and sigma fall geometrically. (*Deviation:* printed without the square.)
///
/// Then the runs past all copies, from the largest to the smallest, are recalled: a neuron's lower
/// bounds are the shortest runs of its landmark in the smallest copy that it recalls, but not less
/// than the floor. The third run counts only until the vector is complete, so its bound is the
/// floor. A neuron that recalls nothing has no bounds.
///
/// An error if a landmark vector is farther than half a class from every neuron: the map did not
/// learn it.
core::Result<std::string> train_som(const SomRecipe& recipe, const std::vector<LandmarkRun>& runs,
                                    const std::string& command);

/// The class that the mirror image of a place has: left and right change places in Table I.
std::uint8_t mirrored(std::uint8_t spatial_class);

}  // namespace clew::train
