// SPDX-License-Identifier: Apache-2.0
#include "scan/scan_check.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <utility>
#include <vector>

#include "core/angle.hpp"

namespace clew::scan {
namespace {

using domain::Scan;
using domain::ScanLayout;

ScanLayout seven_cones() {
  return {"cones", 7, core::radians(45.0), core::radians(-15.0), core::radians(15.0), 1.5};
}

Scan scan_of(const ScanLayout& layout) {
  Scan scan;
  scan.bearing_first_rad = layout.bearing_first_rad;
  scan.bearing_step_rad = layout.bearing_step_rad;
  scan.beam_width_rad = layout.beam_width_rad;
  scan.range_max_m = layout.range_max_m;
  scan.ranges_m.assign(layout.beam_count, layout.range_max_m);
  return scan;
}

TEST(ScanCheck, AcceptsTheArrangementThatWasDeclared) {
  Scan scan = scan_of(seven_cones());
  scan.bearing_first_rad += core::radians(0.05);  // as from single precision, and more

  EXPECT_TRUE(check_arrangement(scan, seven_cones()).ok());
}

TEST(ScanCheck, RefusesAnotherWithWhatIsDeclared) {
  const std::vector<std::pair<std::string, std::function<void(Scan&)>>> faults = {
      {"scan: ranges_m is 6 values long; allowed: 7, as sense cones has",
       [](Scan& scan) { scan.ranges_m.pop_back(); }},
      {"scan: bearing_first_rad is ", [](Scan& scan) { scan.bearing_first_rad += 0.002; }},
      // 0.002 rad at each of six steps would be 0.7 degrees at the last beam.
      {"scan: bearing_step_rad is ", [](Scan& scan) { scan.bearing_step_rad += 0.002; }},
      {"scan: beam_width_rad is 0; allowed: ", [](Scan& scan) { scan.beam_width_rad = 0.0; }},
      {"scan: range_max_m is 1.6; allowed: 1.499 to 1.501, as sense cones has",
       [](Scan& scan) { scan.range_max_m = 1.6; }}};
  for (const auto& [message, spoil] : faults) {
    Scan scan = scan_of(seven_cones());
    spoil(scan);

    const auto checked = check_arrangement(scan, seven_cones());

    ASSERT_FALSE(checked.ok()) << message;
    EXPECT_EQ(checked.error().text().find(message), 0u) << checked.error().text();
  }
}

TEST(ScanCheck, ALayoutWithoutASensorDeclaresNothing) {
  EXPECT_TRUE(check_arrangement(scan_of(seven_cones()), ScanLayout{}).ok());
}

}  // namespace
}  // namespace clew::scan
