// SPDX-License-Identifier: Apache-2.0
#include "core/math.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/random.hpp"

namespace clew::core {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint32_t kSamples = 100000;

/// What math.hpp promises.
constexpr long double kAllowedUlps = 4.0L;

/// Distance of a result from the exact one, in units of the last place of the exact one.
long double error_ulps(double result, long double exact) {
  const double rounded = std::fabs(static_cast<double>(exact));
  const double unit = std::nextafter(rounded, kInfinity) - rounded;
  return std::fabs(static_cast<long double>(result) - exact) / static_cast<long double>(unit);
}

/// Values for a function: uniform in [low, high].
class Uniform {
 public:
  Uniform(double low, double high) : low_(low), high_(high) {}
  double operator()(std::uint32_t index) const {
    return low_ + (high_ - low_) * random_.uniform(index);
  }

 private:
  Random random_{RandomKey{}};
  double low_;
  double high_;
};

/// Values for a function: of either sign, their magnitude's exponent uniform in [low, high].
class Magnitudes {
 public:
  Magnitudes(double low, double high) : exponent_(low, high) {}
  double operator()(std::uint32_t index) const {
    const double magnitude = std::exp2(exponent_(index));
    return index % 2 == 0 ? magnitude : -magnitude;
  }

 private:
  Uniform exponent_;
};

template <typename Function, typename Exact, typename Values>
void expect_accurate(Function function, Exact exact, Values values) {
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    const double x = values(i);

    ASSERT_LE(error_ulps(function(x), exact(static_cast<long double>(x))), kAllowedUlps)
        << "at " << std::hexfloat << x;
  }
}

long double exact_sin(long double x) { return std::sin(x); }
long double exact_cos(long double x) { return std::cos(x); }
long double exact_exp(long double x) { return std::exp(x); }
long double exact_log(long double x) { return std::log(x); }
long double exact_tanh(long double x) { return std::tanh(x); }

TEST(Math, SineAndCosineAreAccurateOverTheirRange) {
  for (const double reach : {1.0, 10.0, 1e5}) {
    expect_accurate(sin, exact_sin, Uniform(-reach, reach));
    expect_accurate(cos, exact_cos, Uniform(-reach, reach));
  }
  expect_accurate(sin, exact_sin, Magnitudes(-1000.0, 0.0));
  expect_accurate(cos, exact_cos, Magnitudes(-1000.0, 0.0));
}

TEST(Math, SineAndCosineAreAccurateWhereTheyVanish) {
  // Near a multiple of pi/2 the reduced argument is what is left of two nearly equal numbers.
  const auto near_quarter_turn = [](std::uint32_t index) {
    const double multiple = (index % 60000) * (kPi / 2.0);
    return multiple + Uniform(-1e-9, 1e-9)(index);
  };

  expect_accurate(sin, exact_sin, near_quarter_turn);
  expect_accurate(cos, exact_cos, near_quarter_turn);
}

TEST(Math, ArcTangentIsAccurateInEveryDirection) {
  const Magnitudes magnitude(-60.0, 60.0);
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    // Signs ++, -+, +-, -- in turn.
    const double y = magnitude(2 * i) * (i % 2 == 0 ? 1.0 : -1.0);
    const double x = magnitude(2 * i + kSamples) * (i / 2 % 2 == 0 ? 1.0 : -1.0);

    const long double exact = std::atan2(static_cast<long double>(y), static_cast<long double>(x));

    ASSERT_LE(error_ulps(atan2(y, x), exact), kAllowedUlps)
        << "at " << std::hexfloat << y << ", " << x;
  }
}

TEST(Math, ArcSineAndArcCosineAreAccurate) {
  const auto exact_acos = [](long double x) { return std::acos(x); };
  const auto exact_asin = [](long double x) { return std::asin(x); };
  const auto near_one = [](std::uint32_t index) {
    return 1.0 - std::exp2(Uniform(-53.0, 0.0)(index));
  };

  expect_accurate(acos, exact_acos, Uniform(-1.0, 1.0));
  expect_accurate(asin, exact_asin, Uniform(-1.0, 1.0));
  expect_accurate(acos, exact_acos, near_one);
  expect_accurate(asin, exact_asin, near_one);
}

TEST(Math, ExponentialIsAccurateOverTheWholeRange) {
  expect_accurate(exp, exact_exp, Uniform(-1.0, 1.0));
  expect_accurate(exp, exact_exp, Uniform(-745.0, 709.78));
}

TEST(Math, LogarithmIsAccurateOverTheWholeRange) {
  const auto any = [](std::uint32_t index) {
    return std::fabs(Magnitudes(-1074.0, 1023.9)(index));
  };

  expect_accurate(log, exact_log, any);
  expect_accurate(log, exact_log, Uniform(0.5, 2.0));
}

TEST(Math, HyperbolicTangentIsAccurate) {
  expect_accurate(tanh, exact_tanh, Uniform(-25.0, 25.0));
  expect_accurate(tanh, exact_tanh, Uniform(-1.0, 1.0));
  expect_accurate(tanh, exact_tanh, Magnitudes(-1000.0, 0.0));
}

TEST(Math, HypotenuseIsAccurate) {
  const Magnitudes magnitude(-300.0, 300.0);
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    const double x = magnitude(2 * i);
    const double y = magnitude(2 * i + 1);

    const long double exact = std::hypot(static_cast<long double>(x), static_cast<long double>(y));

    ASSERT_LE(error_ulps(hypot(x, y), exact), kAllowedUlps);
  }
}

TEST(Math, IsExactWhereTheResultIs) {
  EXPECT_EQ(sin(0.0), 0.0);
  EXPECT_EQ(cos(0.0), 1.0);
  EXPECT_EQ(exp(0.0), 1.0);
  EXPECT_EQ(log(1.0), 0.0);
  EXPECT_EQ(tanh(0.0), 0.0);
  EXPECT_EQ(hypot(3.0, 4.0), 5.0);
  EXPECT_EQ(hypot(-3.0, 0.0), 3.0);
}

TEST(Math, ArcTangentKnowsTheAxes) {
  EXPECT_EQ(atan2(0.0, 1.0), 0.0);
  EXPECT_EQ(atan2(1.0, 0.0), kPi / 2.0);
  EXPECT_EQ(atan2(0.0, -1.0), kPi);
  EXPECT_EQ(atan2(-0.0, -1.0), kPi);  // one direction, one angle: never -pi
  EXPECT_EQ(atan2(-1.0, 0.0), -kPi / 2.0);
  EXPECT_EQ(atan2(0.0, 0.0), 0.0);
  EXPECT_EQ(atan2(1.0, -1.0), 3.0 * kPi / 4.0);
}

TEST(Math, InverseFunctionsClipTheirArgument) {
  EXPECT_EQ(acos(1.0), 0.0);
  EXPECT_EQ(acos(1.0 + 1e-15), 0.0);
  EXPECT_EQ(acos(-1.0), kPi);
  EXPECT_EQ(acos(-7.0), kPi);
  EXPECT_EQ(asin(1.0), kPi / 2.0);
  EXPECT_EQ(asin(7.0), kPi / 2.0);
  EXPECT_EQ(asin(-7.0), -kPi / 2.0);
}

TEST(Math, HasItsLimits) {
  EXPECT_EQ(exp(710.0), kInfinity);
  EXPECT_EQ(exp(kInfinity), kInfinity);
  EXPECT_EQ(exp(-746.0), 0.0);
  EXPECT_EQ(exp(-kInfinity), 0.0);
  EXPECT_EQ(log(0.0), -kInfinity);
  EXPECT_EQ(log(kInfinity), kInfinity);
  EXPECT_TRUE(std::isnan(log(-1.0)));
  EXPECT_EQ(tanh(kInfinity), 1.0);
  EXPECT_EQ(tanh(-23.0), -1.0);
}

TEST(Math, DoesNotHideNan) {
  EXPECT_TRUE(std::isnan(sin(kNan)));
  EXPECT_TRUE(std::isnan(cos(kNan)));
  EXPECT_TRUE(std::isnan(sin(kInfinity)));
  EXPECT_TRUE(std::isnan(cos(-kInfinity)));
  EXPECT_TRUE(std::isnan(atan2(kNan, 1.0)));
  EXPECT_TRUE(std::isnan(atan2(1.0, kNan)));
  EXPECT_TRUE(std::isnan(atan2(kInfinity, kInfinity)));
  EXPECT_TRUE(std::isnan(acos(kNan)));
  EXPECT_TRUE(std::isnan(asin(kNan)));
  EXPECT_TRUE(std::isnan(exp(kNan)));
  EXPECT_TRUE(std::isnan(log(kNan)));
  EXPECT_TRUE(std::isnan(tanh(kNan)));
  EXPECT_TRUE(std::isnan(hypot(kNan, 1.0)));
}

}  // namespace
}  // namespace clew::core
