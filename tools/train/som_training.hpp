// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
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
  double scale_step = 0.0;                 ///< each copy is smaller by this share of full size
  std::vector<std::string> worlds;         ///< landmark worlds

  /// Reads a recipe. Refused: another format, keys that are unknown or missing, fewer than 100
  /// iterations a neuron (Krishna & Kalra 2000, section 3.2.1), numbers out of range.
  static core::Result<SomRecipe> parse(const core::Resource& resource);
};

/// The spatial class of every tick of a run.
using ClassesSeen = std::vector<std::uint8_t>;
/// Runs the reactive robot past a copy of a landmark world, at `scale` of its size. Empty if the
/// robot has no room in a copy so small.
using RunPast = std::function<core::Result<ClassesSeen>(const std::string& world, double scale)>;

/// Trains the map and finds its lower bounds: Krishna & Kalra 2000, section 3.2.1 and appendix A.
/// Returns the trained file, which is the same bytes for the same recipe and runs; `command` is
/// what a person types to get the file.
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
/// Then the robot runs past smaller and smaller copies of each world, as long as it has room in
/// them. A neuron's lower bounds are the shortest runs, each of the three for itself, with which it
/// recalls a landmark in any copy; but not less than the floor. The third run counts only until the
/// vector is complete, so its bound is the floor. A neuron that recalls nothing has no bounds.
///
/// An error if a landmark vector is farther than half a class from every neuron: the map did not
/// learn it.
core::Result<std::string> train_som(const SomRecipe& recipe, const RunPast& run_past,
                                    const std::string& command);

/// The class that the mirror image of a place has: left and right change places in Table I.
std::uint8_t mirrored(std::uint8_t spatial_class);

}  // namespace clew::train
