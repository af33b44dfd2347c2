// SPDX-License-Identifier: Apache-2.0
#include "classify/range_pattern.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace clew::classify {
namespace {

constexpr std::size_t kLeastBeams = 3;
// What returns from less than this before the end of the range may go on beyond it.
constexpr double kEndOfRange_m = 0.25;

/// The beams of a scan as points.
class Beams {
 public:
  Beams(const domain::Scan& scan, double robot_radius_m, double join_m)
      : scan_(scan), robot_radius_m_(robot_radius_m), join_m_(join_m) {}

  std::size_t count() const { return scan_.ranges_m.size(); }
  double range_m(std::size_t i) const { return scan_.ranges_m[i]; }
  bool returns(std::size_t i) const { return range_m(i) < scan_.range_max_m; }

  /// Whether two beams see the same thing.
  bool belong_together(std::size_t i, std::size_t k) const {
    if (!returns(i) || !returns(k)) return false;
    const double apart_m =
        std::max(distance_m(i), distance_m(k)) * std::fabs(scan_.bearing_step_rad);
    return core::length(point(i) - point(k)) <= join_m_ + 2.0 * apart_m;
  }
  /// The last beam of what begins with beam `first`.
  std::size_t last_of(std::size_t first) const {
    std::size_t last = first;
    while (true) {
      if (last + 1 < count() && belong_together(last, last + 1)) {
        last += 1;
      } else if (last + 2 < count() && belong_together(last, last + 2)) {
        last += 2;
      } else {
        return last;
      }
    }
  }
  bool is_whole(std::size_t first, std::size_t last) const {
    if (first == 0 || last + 1 >= count()) return false;
    const double most_m = scan_.range_max_m - kEndOfRange_m;
    if (range_m(first) >= most_m || range_m(last) >= most_m) return false;
    return range_m(first - 1) > range_m(first) && range_m(last + 1) > range_m(last);
  }
  SeenObject object(std::size_t first, std::size_t last) const {
    double nearest_m = distance_m(first);
    for (std::size_t i = first; i <= last; ++i) nearest_m = std::min(nearest_m, distance_m(i));
    SeenObject object;
    object.width_m = core::length(point(last) - point(first));
    const double middle_rad = 0.5 * (scan_.bearing_rad(first) + scan_.bearing_rad(last));
    object.centre_robot = (nearest_m + 0.5 * object.width_m) * core::direction(middle_rad);
    return object;
  }

 private:
  double distance_m(std::size_t i) const { return scan_.ranges_m[i] + robot_radius_m_; }
  core::Vec2 point(std::size_t i) const {
    return distance_m(i) * core::direction(scan_.bearing_rad(i));
  }

  const domain::Scan& scan_;
  double robot_radius_m_;
  double join_m_;
};

}  // namespace

void find_objects(const domain::Scan& scan, double robot_radius_m,
                  const RangePatternParameters& parameters, std::vector<SeenObject>& objects) {
  objects.clear();
  const Beams beams(scan, robot_radius_m, parameters.join_m);
  std::size_t first = 0;
  while (first < beams.count()) {
    if (!beams.returns(first)) {
      ++first;
      continue;
    }
    const std::size_t last = beams.last_of(first);
    if (last - first + 1 >= kLeastBeams && beams.is_whole(first, last)) {
      const SeenObject object = beams.object(first, last);
      if (object.width_m <= parameters.widest_m) objects.push_back(object);
    }
    first = last + 1;
  }
}

}  // namespace clew::classify
