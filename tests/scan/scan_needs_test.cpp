// SPDX-License-Identifier: Apache-2.0
#include "scan/scan_needs.hpp"

#include <gtest/gtest.h>

#include "core/angle.hpp"

namespace clew::scan {
namespace {

using core::radians;

/// Beams of `width_deg` from `first_deg` on, counter-clockwise.
domain::ScanLayout eyes(std::size_t count, double first_deg, double step_deg, double width_deg) {
  return {"eyes", count, radians(first_deg), radians(step_deg), radians(width_deg), 2.0};
}

bool fit(const ScanNeeds& needs, const domain::ScanLayout& layout) {
  return check_needs(needs, layout, "me").ok();
}

TEST(ScanNeeds, OfNothingFitEverySensor) { EXPECT_TRUE(fit({}, eyes(1, 0.0, 0.0, 0.0))); }

TEST(ScanNeeds, CountBeams) {
  ScanNeeds needs;
  needs.least_beams = 2;

  EXPECT_FALSE(fit(needs, eyes(1, 0.0, 10.0, 0.0)));
  EXPECT_TRUE(fit(needs, eyes(2, 0.0, 10.0, 0.0)));
}

TEST(ScanNeeds, TellBeamsThatAreFarApartFromWhatLiesUnseenBetweenThem) {
  ScanNeeds apart;
  apart.most_apart_rad = radians(15.0);
  ScanNeeds unseen;
  unseen.most_unseen_rad = radians(15.0);
  const auto broad = eyes(7, -90.0, 30.0, 15.0);

  EXPECT_FALSE(fit(apart, broad));
  EXPECT_TRUE(fit(unseen, broad));
  EXPECT_FALSE(fit(unseen, eyes(7, -90.0, 30.0, 14.0)));
  EXPECT_TRUE(fit(apart, eyes(7, 45.0, -15.0, 0.0)));  // clockwise is as good
}

TEST(ScanNeeds, TellHowFarAxesReachFromHowFarIsSeen) {
  ScanNeeds axis;
  axis.least_axis_rad = radians(45.0);
  ScanNeeds seen;
  seen.least_seen_rad = radians(45.0);
  const auto narrow = eyes(7, -37.5, 12.5, 15.0);  // axes to 37.5, seen to 45

  EXPECT_FALSE(fit(axis, narrow));
  EXPECT_TRUE(fit(seen, narrow));
  EXPECT_FALSE(fit(axis, eyes(7, -45.0, 10.0, 15.0)));  // to 45 on the right, 15 on the left
  EXPECT_TRUE(fit(axis, eyes(7, -45.0, 15.0, 15.0)));
}

TEST(ScanNeeds, TakeAFieldForAsManyStepsAsBeams) {
  ScanNeeds needs;
  needs.least_field_rad = radians(90.0);

  EXPECT_FALSE(fit(needs, eyes(5, 0.0, 15.0, 15.0)));
  EXPECT_TRUE(fit(needs, eyes(6, 0.0, 15.0, 15.0)));
}

TEST(ScanNeeds, SayWhatIsNeededAndWhatIsGiven) {
  ScanNeeds needs;
  needs.least_beams = 3;
  needs.most_apart_rad = radians(30.0);
  needs.most_unseen_rad = radians(15.0);
  needs.least_axis_rad = radians(45.0);
  needs.least_seen_rad = radians(50.0);
  needs.least_field_rad = radians(100.0);
  needs.field_reason = "since I look there";

  EXPECT_EQ(check_needs(needs, eyes(4, 90.0, -60.0, 10.0), "me").error().message,
            "me needs 3 beams or more, at most 30 degrees from beam to beam, at most 15 degrees "
            "unseen between beams, beams out to 45 degrees on each side, a view out to 50 degrees "
            "on each side, a field of view of 100 degrees (since I look there); 'eyes' gives 4 "
            "beams of 10 degrees, 60 degrees apart from 90 on");
}

}  // namespace
}  // namespace clew::scan
