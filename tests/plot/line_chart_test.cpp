// SPDX-License-Identifier: Apache-2.0
#include "plot/line_chart.hpp"

#include <gtest/gtest.h>

namespace clew::plot {
namespace {

LineChart chart() {
  return {"Learning",
          "iteration",
          "error, m/s",
          {{"train", {{0, 0.08}, {30000, 0.01}}}},
          {{"untrained", 0.04}}};
}

TEST(LineChart, DrawsLinesAndLevelsToScale) {
  const std::string svg = draw(chart());

  // The plot is 530 px wide and 360 high, from (70, 420) up: 0.08 is the top, 0.01 an eighth.
  EXPECT_NE(svg.find("M70 60L600 375"), std::string::npos) << svg;
  EXPECT_NE(svg.find("M70 240L600 240\" fill=\"none\" stroke=\"#0072B2\""), std::string::npos)
      << svg;
  EXPECT_NE(svg.find("stroke-dasharray=\"6 4\""), std::string::npos);
}

TEST(LineChart, NamesAxesLinesAndTicks) {
  const std::string svg = draw(chart());

  for (const char* text : {">Learning<", ">iteration<", ">error, m/s<", ">train<", ">untrained<",
                           ">0.02<", ">10000<", ">30000<"}) {
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  }
}

TEST(LineChart, BeginsBelowZeroWhereValuesAreNegative) {
  const std::string svg = draw({"Turns", "s", "rad/s", {{"turn", {{0, -1}, {10, 3}}}}, {}});

  EXPECT_NE(svg.find("M70 420L600 60"), std::string::npos) << svg;
  EXPECT_NE(svg.find(">-1<"), std::string::npos);
}

TEST(LineChart, DrawsAChartWithoutValues) {
  const std::string svg = draw({"Nothing", "x", "y", {{"none", {{0, 0}}}}, {}});

  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

}  // namespace
}  // namespace clew::plot
