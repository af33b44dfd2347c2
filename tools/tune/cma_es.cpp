// SPDX-License-Identifier: Apache-2.0
#include "tune/cma_es.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/check.hpp"
#include "core/math.hpp"
#include "core/random.hpp"

namespace clew::tune {
namespace {

constexpr std::uint32_t kStream = 0x636d61;
/// Of a scale, so that a direction that does not matter does not vanish.
constexpr double kLeastVariance = 1e-20;
constexpr double kMostSigma = 1.0;  // the side of the cube

double to_double(std::size_t count) { return static_cast<double>(count); }

}  // namespace

CmaEs::CmaEs(std::size_t dimensions, double sigma, std::uint64_t seed)
    : dimensions_(dimensions), seed_(seed), sigma_(sigma) {
  CLEW_CHECK(dimensions > 0, "nothing to search");
  const double n = to_double(dimensions);
  const auto size = static_cast<Eigen::Index>(dimensions);
  population_ = 4 + static_cast<std::size_t>(3.0 * core::log(n));
  parents_ = population_ / 2;
  weights_ = Eigen::VectorXd(static_cast<Eigen::Index>(parents_));
  for (std::size_t i = 0; i < parents_; ++i) {
    weights_[static_cast<Eigen::Index>(i)] =
        core::log((to_double(population_) + 1.0) / 2.0) - core::log(to_double(i + 1));
  }
  weights_ /= weights_.sum();
  effective_ = 1.0 / weights_.squaredNorm();
  c_sigma_ = (effective_ + 2.0) / (n + effective_ + 5.0);
  d_sigma_ = 1.0 + 2.0 * std::max(0.0, std::sqrt((effective_ - 1.0) / (n + 1.0)) - 1.0) + c_sigma_;
  c_c_ = (4.0 + effective_ / n) / (n + 4.0 + 2.0 * effective_ / n);
  c_1_ = 2.0 / ((n + 1.3) * (n + 1.3) + effective_);
  c_mu_ = std::min(1.0 - c_1_, 2.0 * (effective_ - 2.0 + 1.0 / effective_) /
                                   ((n + 2.0) * (n + 2.0) + effective_));
  chi_ = std::sqrt(n) * (1.0 - 1.0 / (4.0 * n) + 1.0 / (21.0 * n * n));
  mean_ = Eigen::VectorXd::Constant(size, 0.5);
  path_sigma_ = path_c_ = Eigen::VectorXd::Zero(size);
  covariance_ = basis_ = Eigen::MatrixXd::Identity(size, size);
  scales_ = Eigen::VectorXd::Ones(size);
}

std::vector<Eigen::VectorXd> CmaEs::ask() const {
  const core::Random random({seed_, 0, kStream, generation_});
  std::vector<Eigen::VectorXd> points;
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < population_; ++i) {
    Eigen::VectorXd z(mean_.size());
    for (double& value : z) value = random.normal(next++);
    points.emplace_back(mean_ + sigma_ * (basis_ * scales_.cwiseProduct(z)));
  }
  return points;
}

void CmaEs::tell(const std::vector<Eigen::VectorXd>& points, const std::vector<double>& values) {
  CLEW_CHECK(points.size() == population_ && values.size() == population_,
             "a generation that is not whole");
  std::vector<std::size_t> order(population_);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  Eigen::MatrixXd steps(mean_.size(), static_cast<Eigen::Index>(parents_));  // y, eq. 38
  for (std::size_t i = 0; i < parents_; ++i) {
    steps.col(static_cast<Eigen::Index>(i)) = (points[order[i]] - mean_) / sigma_;
  }
  const Eigen::VectorXd step = steps * weights_;  // <y>_w, eq. 41
  mean_ += sigma_ * step;                         // eq. 42
  update_paths(step);
  update_covariance(steps);
  ++generation_;
  decompose();
}

void CmaEs::update_paths(const Eigen::VectorXd& step) {
  // C^(-1/2) <y>_w = B D^-1 B' <y>_w; eq. 43.
  const Eigen::VectorXd whitened = basis_ * (basis_.transpose() * step).cwiseQuotient(scales_);
  path_sigma_ = (1.0 - c_sigma_) * path_sigma_ +
                std::sqrt(c_sigma_ * (2.0 - c_sigma_) * effective_) * whitened;
  const double length = path_sigma_.norm();
  sigma_ *= core::exp(c_sigma_ / d_sigma_ * (length / chi_ - 1.0));  // eq. 44
  sigma_ = std::min(sigma_, kMostSigma);
  // h_sigma stalls the other path while this one is long.
  double decay = 1.0;
  for (std::size_t i = 0; i < 2 * (generation_ + 1); ++i) decay *= 1.0 - c_sigma_;
  const double limit = (1.4 + 2.0 / (to_double(dimensions_) + 1.0)) * chi_;
  const bool moves = length / std::sqrt(1.0 - decay) < limit;
  path_c_ *= 1.0 - c_c_;  // eq. 45
  if (moves) path_c_ += std::sqrt(c_c_ * (2.0 - c_c_) * effective_) * step;
  const double lost = moves ? 0.0 : c_c_ * (2.0 - c_c_);
  covariance_ *= 1.0 + c_1_ * lost - c_1_ - c_mu_;  // the first term of eq. 47
}

void CmaEs::update_covariance(const Eigen::MatrixXd& steps) {
  covariance_ += c_1_ * (path_c_ * path_c_.transpose());
  covariance_ += c_mu_ * (steps * weights_.asDiagonal() * steps.transpose());  // eq. 47
}

void CmaEs::decompose() {
  const Eigen::MatrixXd symmetric = 0.5 * (covariance_ + covariance_.transpose());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(symmetric);
  basis_ = solver.eigenvectors();
  scales_ = solver.eigenvalues().cwiseMax(kLeastVariance).cwiseSqrt();
}

Eigen::VectorXd CmaEs::within_cube(const Eigen::VectorXd& point) {
  return point.cwiseMax(0.0).cwiseMin(1.0);
}

double CmaEs::penalty(const Eigen::VectorXd& point) {
  return (point - within_cube(point)).squaredNorm();
}

}  // namespace clew::tune
