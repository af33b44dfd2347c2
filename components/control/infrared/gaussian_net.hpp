// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/math.hpp"

namespace clew::control {

/// One of the MISO neuro-fuzzy networks of Wang, Yang & Meng, section III: two inputs, kSets
/// Gaussian sets each (eq. 3), a rule for each pair of sets with Larson's product (eq. 4), and the
/// centre of area of all rules (eq. 5):
///
///     R_ki = exp(-(I_k - a_ki)^2 / (2 sigma_ki^2)),   u_ij = R_1i R_2j,
///     V = sum_ij u_ij w_ij / sum_ij u_ij.
///
/// The sums run over all sets (eq. 5 is printed up to 3). As sum_ij u_ij = (sum_i R_1i)(sum_j
/// R_2j), it works with memberships that add up to 1 for each input, p_i = R_1i / sum R_1 and q_j
/// alike: nothing underflows while (I - a) / sigma stays below 38.
template <std::size_t kSets>
struct GaussianNet {
  using PerInput = std::array<std::array<double, kSets>, 2>;
  using PerRule = std::array<std::array<double, kSets>, kSets>;

  PerInput centres{};  ///< a_1i, a_2j, in units of the readings
  PerInput widths{};   ///< sigma_1i, sigma_2j, the same; above 0
  PerRule outputs{};   ///< w_ij, row i of the first input

  /// dV/dz for every parameter z of the network (eq. 6), arranged as the parameters are.
  struct Gradient {
    PerInput centres{};
    PerInput widths{};
    PerRule outputs{};
  };

  /// The memberships of a reading in the sets of an input, scaled to a sum of 1.
  std::array<double, kSets> memberships(std::size_t input, double reading) const {
    std::array<double, kSets> degrees{};
    double sum = 0.0;
    for (std::size_t i = 0; i < kSets; ++i) {
      const double off = (reading - centres[input][i]) / widths[input][i];
      degrees[i] = core::exp(-0.5 * off * off);
      sum += degrees[i];
    }
    for (double& degree : degrees) degree /= sum;
    return degrees;
  }

  /// V for the readings of its two inputs.
  double infer(double first, double second) const {
    return weigh(memberships(0, first), memberships(1, second));
  }

  /// Eqs 9 to 16 without Delta V and the learning rates:
  ///
  ///     dV/da_1i     = p_i A_2 (I_1 - a_1i) / sigma_1i^2,     A_2 = sum_j (w_ij - V) q_j
  ///     dV/dsigma_1i = p_i A_2 (I_1 - a_1i)^2 / sigma_1i^3
  ///     dV/dw_ij     = p_i q_j
  ///
  /// and alike for the second input. *Deviation:* eqs 11 and 12 print sigma to the fourth, which is
  /// not the derivative.
  Gradient gradient(double first, double second) const {
    const auto p = memberships(0, first);
    const auto q = memberships(1, second);
    const double v = weigh(p, q);
    std::array<double, kSets> a_2{};
    std::array<double, kSets> a_1{};
    Gradient gradient;
    for (std::size_t i = 0; i < kSets; ++i) {
      for (std::size_t j = 0; j < kSets; ++j) {
        a_2[i] += (outputs[i][j] - v) * q[j];
        a_1[j] += (outputs[i][j] - v) * p[i];
        gradient.outputs[i][j] = p[i] * q[j];
      }
    }
    for (std::size_t i = 0; i < kSets; ++i) {
      add_sets(gradient, 0, i, first, p[i] * a_2[i]);
      add_sets(gradient, 1, i, second, q[i] * a_1[i]);
    }
    return gradient;
  }

  /// Whether no rule looks at the second input, as in Table I.
  bool ignores_second() const {
    return std::all_of(outputs.begin(), outputs.end(), [](const auto& row) {
      return std::all_of(row.begin(), row.end(), [&](double w) { return w == row[0]; });
    });
  }

 private:
  double weigh(const std::array<double, kSets>& p, const std::array<double, kSets>& q) const {
    double v = 0.0;
    for (std::size_t i = 0; i < kSets; ++i) {
      for (std::size_t j = 0; j < kSets; ++j) v += p[i] * q[j] * outputs[i][j];
    }
    return v;
  }

  void add_sets(Gradient& gradient, std::size_t input, std::size_t set, double reading,
                double weight) const {
    const double width = widths[input][set];
    const double off = reading - centres[input][set];
    gradient.centres[input][set] = weight * off / (width * width);
    gradient.widths[input][set] = weight * off * off / (width * width * width);
  }
};

}  // namespace clew::control
