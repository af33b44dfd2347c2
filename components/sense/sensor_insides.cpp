// SPDX-License-Identifier: Apache-2.0
/// What the sensors tell of a scan: what they would have read without noise and echoes.
#include <cmath>

#include "domain/words.hpp"
#include "sense/cones.hpp"
#include "sense/infrared.hpp"
#include "sense/laser.hpp"
#include "sense/sonar_ring.hpp"

namespace clew::sense {
namespace {

// A difference of less is one of rounding.
constexpr double kSame_m = 1e-9;

/// Compares a scan with that of the same sensor without what spoils readings.
void tell_errors(const RangeSensor& exact_sensor, const Sweep& sweep, domain::Inside& inside) {
  domain::Scan exact;
  exact_sensor.measure(sweep.world, sweep.pose_world_robot, sweep.sim_time_s, sweep.random, exact);
  std::size_t wrong = 0;
  double greatest_m = 0.0;
  for (std::size_t i = 0; i < exact.ranges_m.size(); ++i) {
    const double error_m = std::fabs(sweep.scan.ranges_m[i] - exact.ranges_m[i]);
    if (error_m > kSame_m) ++wrong;
    greatest_m = std::max(greatest_m, error_m);
  }
  inside.values.list("true_readings", exact.ranges_m, "m");
  inside.values.number("greatest_error", greatest_m, "m");
  inside.say(wrong == 0 ? "All readings are exact."
                        : "Errors of the sensor changed " + domain::say_count(wrong, "reading") +
                              ", by " + domain::say_metres(greatest_m) + " at most.");
}

}  // namespace

void Cones::tell(const Sweep& sweep, domain::Inside& inside) const {
  Parameters exact = parameters_;
  exact.corner_echo_ratio = 0.0;
  exact.noise = {};
  tell_errors(Cones(exact, radius_m_), sweep, inside);
}

void SonarRing::tell(const Sweep& sweep, domain::Inside& inside) const {
  Parameters exact = parameters_;
  exact.noise = {};
  tell_errors(SonarRing(exact, radius_m_), sweep, inside);
}

void Laser::tell(const Sweep& sweep, domain::Inside& inside) const {
  Parameters exact = parameters_;
  exact.noise = {};
  tell_errors(Laser(exact, radius_m_), sweep, inside);
}

/// Its errors are those of noise: the steps of its 8 bits are there without it, too.
void Infrared::tell(const Sweep& sweep, domain::Inside& inside) const {
  Parameters exact = parameters_;
  exact.noise = {};
  tell_errors(Infrared(exact, radius_m_), sweep, inside);
  std::vector<double> answers;
  for (const double range_m : sweep.scan.ranges_m) {
    answers.push_back(parameters_.curve.reading(range_m));
  }
  inside.values.list("answers_of_8_bits", std::move(answers));
}

}  // namespace clew::sense
