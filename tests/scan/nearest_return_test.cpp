// SPDX-License-Identifier: Apache-2.0
#include "scan/nearest_return.hpp"

#include <gtest/gtest.h>

#include "core/angle.hpp"

namespace clew::scan {
namespace {

domain::Scan scan_of(std::initializer_list<double> ranges_m) {
  domain::Scan scan;
  scan.bearing_first_rad = core::radians(45.0);
  scan.bearing_step_rad = core::radians(-45.0);
  scan.range_max_m = 2.0;
  scan.ranges_m = ranges_m;
  return scan;
}

TEST(NearestReturn, IsTheShortestReadingAndItsBearing) {
  const Return nearest = nearest_return(scan_of({1.5, 0.7, 0.4}));

  EXPECT_EQ(nearest.range_m, 0.4);
  EXPECT_DOUBLE_EQ(nearest.bearing_rad, core::radians(-45.0));
}

TEST(NearestReturn, IsTheFirstOfEqualOnes) {
  EXPECT_DOUBLE_EQ(nearest_return(scan_of({0.9, 0.4, 0.4})).bearing_rad, 0.0);
}

TEST(NearestReturn, IsAsFarAsTheScanSeesWhereNothingReturned) {
  EXPECT_EQ(nearest_return(scan_of({2.0, 2.0, 2.0})).range_m, 2.0);
}

}  // namespace
}  // namespace clew::scan
