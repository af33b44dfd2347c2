// SPDX-License-Identifier: Apache-2.0
#include "core/math.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace clew::core {
namespace {

// pi/2 in three parts; the first two have 33 significant bits, so that n times each is exact for
// |n| < 2^20 (Cody and Waite 1980).
constexpr double kHalfPiHigh = 0x1.921fb544p+0;
constexpr double kHalfPiMiddle = 0x1.0b4611a6p-34;
constexpr double kHalfPiLow = 0x1.3198a2e037073p-69;

// ln 2 in two parts; the first has 32 significant bits.
constexpr double kLn2High = 0x1.62e42feep-1;
constexpr double kLn2Low = 0x1.a39ef35793c76p-33;

// Taylor series on [-pi/4, pi/4]; the first term left out is below 1e-19 of the result.
double sin_near_zero(double x, double low) {
  const double z = x * x;
  double p = -1.0 / 121645100408832000.0;
  p = p * z + 1.0 / 355687428096000.0;
  p = p * z - 1.0 / 1307674368000.0;
  p = p * z + 1.0 / 6227020800.0;
  p = p * z - 1.0 / 39916800.0;
  p = p * z + 1.0 / 362880.0;
  p = p * z - 1.0 / 5040.0;
  p = p * z + 1.0 / 120.0;
  p = p * z - 1.0 / 6.0;
  return x + (x * z * p + low * (1.0 - 0.5 * z));
}

double cos_near_zero(double x, double low) {
  const double z = x * x;
  double p = 1.0 / 2432902008176640000.0;
  p = p * z - 1.0 / 6402373705728000.0;
  p = p * z + 1.0 / 20922789888000.0;
  p = p * z - 1.0 / 87178291200.0;
  p = p * z + 1.0 / 479001600.0;
  p = p * z - 1.0 / 3628800.0;
  p = p * z + 1.0 / 40320.0;
  p = p * z - 1.0 / 720.0;
  p = p * z + 1.0 / 24.0;
  const double half_z = 0.5 * z;
  const double head = 1.0 - half_z;
  return head + (((1.0 - head) - half_z) + (z * z * p - x * low));
}

// std::floor, without the call that it is where the processor need not have an instruction for it.
double floor_of(double x) {
  if (!(std::fabs(x) < 0x1p52)) return x;  // whole already
  const auto whole = static_cast<double>(static_cast<std::int64_t>(x));
  return whole > x ? whole - 1.0 : whole;
}

struct Reduced {
  int quadrant;  // 0..3
  double x;      // in [-pi/4, pi/4]
  double low;    // what rounding took from x
};

Reduced reduce_to_quadrant(double x) {
  if (!(std::fabs(x) <= std::numeric_limits<double>::max())) {
    return {0, std::numeric_limits<double>::quiet_NaN(), 0.0};
  }
  const double n = floor_of(x * (2.0 / kPi) + 0.5);
  const double first = x - n * kHalfPiHigh;
  const double middle = n * kHalfPiMiddle;
  const double second = first - middle;
  const double rounded = (first - second) - middle;
  const double tail = n * kHalfPiLow - rounded;
  const double reduced = second - tail;
  const double quadrant = n - 4.0 * floor_of(n * 0.25);
  return {static_cast<int>(quadrant), reduced, (second - reduced) - tail};
}

double scale_by_power_of_two(double x, int exponent) {
  const auto power = [](int e) {
    const std::uint64_t bits = static_cast<std::uint64_t>(e + 1023) << 52;
    double value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  };
  if (exponent > 1023) return x * power(1023) * power(exponent - 1023);
  if (exponent < -1022) return x * power(-1000) * power(exponent + 1000);
  return x * power(exponent);
}

// e^x = 2^exponent (1 + rest), |rest| < 0.42.
struct ExpParts {
  int exponent;
  double rest;
};

ExpParts split_exp(double x) {
  const double n = std::floor(x * 1.44269504088896340736 + 0.5);
  const double r = (x - n * kLn2High) - n * kLn2Low;
  // Taylor series on [-ln2/2, ln2/2]; the first term left out is below 1e-18.
  double p = 1.0 / 6227020800.0;
  p = p * r + 1.0 / 479001600.0;
  p = p * r + 1.0 / 39916800.0;
  p = p * r + 1.0 / 3628800.0;
  p = p * r + 1.0 / 362880.0;
  p = p * r + 1.0 / 40320.0;
  p = p * r + 1.0 / 5040.0;
  p = p * r + 1.0 / 720.0;
  p = p * r + 1.0 / 120.0;
  p = p * r + 1.0 / 24.0;
  p = p * r + 1.0 / 6.0;
  p = p * r + 0.5;
  return {static_cast<int>(n), r + r * r * p};
}

// atan(k / 8) for k = 0..8.
constexpr double kAtanEighths[] = {0.0,
                                   0.12435499454676143503,
                                   0.24497866312686415417,
                                   0.35877067027057222039,
                                   0.46364760900080611621,
                                   0.55859931534356243597,
                                   0.64350110879328438680,
                                   0.71882999962162450542,
                                   0.78539816339744830962};

// atan(x), 0 <= x <= 1: atan(c) + atan((x - c) / (1 + c x)) with c the nearest eighth, whose
// argument is at most 1/16, so that nine terms of the series are enough.
double atan_unit(double x) {
  if (x != x) return x;
  const int k = static_cast<int>(std::floor(x * 8.0 + 0.5));
  const double c = k * 0.125;
  const double t = (x - c) / (1.0 + c * x);
  const double z = t * t;
  double p = 1.0 / 17.0;
  p = -p * z + 1.0 / 15.0;
  p = -p * z + 1.0 / 13.0;
  p = -p * z + 1.0 / 11.0;
  p = -p * z + 1.0 / 9.0;
  p = -p * z + 1.0 / 7.0;
  p = -p * z + 1.0 / 5.0;
  p = -p * z + 1.0 / 3.0;
  return kAtanEighths[k] + (t - t * z * p);
}

}  // namespace

double sin(double x) {
  const Reduced r = reduce_to_quadrant(x);
  switch (r.quadrant) {
    case 0:
      return sin_near_zero(r.x, r.low);
    case 1:
      return cos_near_zero(r.x, r.low);
    case 2:
      return -sin_near_zero(r.x, r.low);
    default:
      return -cos_near_zero(r.x, r.low);
  }
}

double cos(double x) {
  const Reduced r = reduce_to_quadrant(x);
  switch (r.quadrant) {
    case 0:
      return cos_near_zero(r.x, r.low);
    case 1:
      return -sin_near_zero(r.x, r.low);
    case 2:
      return -cos_near_zero(r.x, r.low);
    default:
      return sin_near_zero(r.x, r.low);
  }
}

double atan2(double y, double x) {
  const double ax = std::fabs(x);
  const double ay = std::fabs(y);
  if (ax == 0.0 && ay == 0.0) return 0.0;
  double angle = ay <= ax ? atan_unit(ay / ax) : kPi / 2.0 - atan_unit(ax / ay);
  if (x < 0.0) angle = kPi - angle;
  return y < 0.0 ? -angle : angle;
}

double acos(double x) {
  const double c = x < -1.0 ? -1.0 : (x > 1.0 ? 1.0 : x);
  return atan2(std::sqrt((1.0 - c) * (1.0 + c)), c);
}

double asin(double x) {
  const double s = x < -1.0 ? -1.0 : (x > 1.0 ? 1.0 : x);
  return atan2(s, std::sqrt((1.0 - s) * (1.0 + s)));
}

double exp(double x) {
  if (x != x) return x;
  if (x > 709.79) return std::numeric_limits<double>::infinity();
  if (x < -745.2) return 0.0;
  const ExpParts parts = split_exp(x);
  return scale_by_power_of_two(1.0 + parts.rest, parts.exponent);
}

double log(double x) {
  if (x != x || x < 0.0) return std::numeric_limits<double>::quiet_NaN();
  if (x == 0.0) return -std::numeric_limits<double>::infinity();
  if (x > std::numeric_limits<double>::max()) return x;
  int exponent = 0;
  double m = std::frexp(x, &exponent);  // exact: m in [0.5, 1)
  if (m < 0.70710678118654752440) {
    m *= 2.0;
    --exponent;
  }
  // log m = 2 atanh((m - 1) / (m + 1)), argument within 0.1716; with f = m - 1 and s = f / (2 + f)
  // it is f - s (f - r), which keeps the leading term exact.
  const double f = m - 1.0;
  const double s = f / (2.0 + f);
  const double z = s * s;
  double p = 2.0 / 23.0;
  p = p * z + 2.0 / 21.0;
  p = p * z + 2.0 / 19.0;
  p = p * z + 2.0 / 17.0;
  p = p * z + 2.0 / 15.0;
  p = p * z + 2.0 / 13.0;
  p = p * z + 2.0 / 11.0;
  p = p * z + 2.0 / 9.0;
  p = p * z + 2.0 / 7.0;
  p = p * z + 2.0 / 5.0;
  p = p * z + 2.0 / 3.0;
  const double tail = f - s * (f - z * p);
  return exponent * kLn2High + (exponent * kLn2Low + tail);
}

double tanh(double x) {
  const double a = std::fabs(x);
  double t;
  if (a < 0.125) {
    // Series to x^15: the next term is below 1e-17 of the result.
    const double z = x * x;
    double p = -929569.0 / 638512875.0;
    p = p * z + 21844.0 / 6081075.0;
    p = p * z - 1382.0 / 155925.0;
    p = p * z + 62.0 / 2835.0;
    p = p * z - 17.0 / 315.0;
    p = p * z + 2.0 / 15.0;
    p = p * z - 1.0 / 3.0;
    return x + x * z * p;
  }
  if (a > 22.0) {
    t = 1.0;
  } else if (a < 1.0) {
    // 1 - 2 / (exp + 1) would lose bits here: tanh a = (e^2a - 1) / ((e^2a - 1) + 2).
    const ExpParts parts = split_exp(2.0 * a);
    const double power = 1 << parts.exponent;
    const double exp_minus_one = power * parts.rest + (power - 1.0);
    t = exp_minus_one / (exp_minus_one + 2.0);
  } else {
    t = 1.0 - 2.0 / (exp(2.0 * a) + 1.0);
  }
  return x < 0.0 ? -t : t;
}

double hypot(double x, double y) { return std::sqrt(x * x + y * y); }

}  // namespace clew::core
