// SPDX-License-Identifier: Apache-2.0
/// Transcendental functions with one implementation on every machine. The C library picks variants
/// by processor whose last bits differ; these use only +, -, *, /, sqrt and floor, which IEEE 754
/// fixes, so results are the same bits wherever clew runs. Accuracy: within 4 units in the last
/// place for |x| below 1e5 (trigonometric) and over the whole range of finite results (others). NaN
/// gives NaN, and so do the sine and cosine of infinities.
#pragma once

namespace clew::core {

inline constexpr double kPi = 3.14159265358979323846;

double sin(double x);
double cos(double x);
/// Angle of the vector (x, y) in (-pi, pi]; 0 for the null vector.
double atan2(double y, double x);
/// Arc cosine in [0, pi]; arguments beyond [-1, 1] are clipped.
double acos(double x);
/// Arc sine in [-pi/2, pi/2]; arguments beyond [-1, 1] are clipped.
double asin(double x);
double exp(double x);
/// Natural logarithm of x > 0; -infinity at 0, NaN below.
double log(double x);
double tanh(double x);
/// sqrt(x^2 + y^2), without care for overflow: lengths here are metres.
double hypot(double x, double y);

}  // namespace clew::core
