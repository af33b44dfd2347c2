// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace clew::tune {

/// Minimises a function of real numbers from its values alone: CMA-ES, a search distribution that
/// learns the scales and correlations of the parameters (Hansen 2016, "The CMA evolution strategy:
/// a tutorial", arXiv:1604.00772; names and defaults are those of its table 1 and figure 6, with
/// the weights of the best half only).
///
/// The unit cube is searched: points outside are evaluated at the nearest one inside, and the
/// caller adds penalty(). Random numbers are a function of (seed, generation, number), so a search
/// that is done again takes the same way.
class CmaEs {
 public:
  /// Begins in the middle of the cube, with a standard deviation of `sigma` in each parameter.
  CmaEs(std::size_t dimensions, double sigma, std::uint64_t seed);

  /// lambda = 4 + floor(3 ln n).
  std::size_t population() const { return population_; }
  std::size_t generation() const { return generation_; }

  /// The points of this generation; not yet within the cube.
  std::vector<Eigen::VectorXd> ask() const;
  /// Takes their values, in the same order, and goes to the next generation.
  void tell(const std::vector<Eigen::VectorXd>& points, const std::vector<double>& values);

  const Eigen::VectorXd& mean() const { return mean_; }
  double sigma() const { return sigma_; }

  static Eigen::VectorXd within_cube(const Eigen::VectorXd& point);
  /// The squared distance to the cube, which leads the search back.
  static double penalty(const Eigen::VectorXd& point);

 private:
  void update_paths(const Eigen::VectorXd& step);
  void update_covariance(const Eigen::MatrixXd& steps);
  void decompose();

  // Table 1.
  std::size_t dimensions_;
  std::size_t population_;
  std::size_t parents_;      // mu
  Eigen::VectorXd weights_;  // w, of the parents, sum 1
  double effective_ = 0.0;   // mu_eff
  double c_sigma_ = 0.0;
  double d_sigma_ = 0.0;
  double c_c_ = 0.0;
  double c_1_ = 0.0;
  double c_mu_ = 0.0;
  double chi_ = 0.0;  // E ||N(0, I)||

  std::uint64_t seed_;
  std::size_t generation_ = 0;
  Eigen::VectorXd mean_;  // m
  double sigma_;
  Eigen::VectorXd path_sigma_;  // p_sigma
  Eigen::VectorXd path_c_;      // p_c
  Eigen::MatrixXd covariance_;  // C = B D^2 B'
  Eigen::MatrixXd basis_;       // B
  Eigen::VectorXd scales_;      // the diagonal of D
};

}  // namespace clew::tune
