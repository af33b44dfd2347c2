// SPDX-License-Identifier: Apache-2.0
/// The bits of math.hpp's results, kept in math_golden.txt: the hash of a run holds on every
/// machine only as long as they do. After a deliberate change `CLEW_REWRITE_GOLDEN=1 clew_core_test
/// --gtest_filter=MathGolden.*` writes the file anew.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "core/math.hpp"
#include "tests/source_path.hpp"

namespace clew::core {
namespace {

const std::string kGoldenFile = tests::source_path("tests/core/math_golden.txt");

// Of every size and quadrant that a run meets, and the borders of the cases in math.cpp.
const std::vector<double> kAngles = {1e-300, 1e-9,
                                     0.1,    0.25,
                                     0.5,    0.7853981633974483,
                                     0.8,    1.0,
                                     1.5,    1.5707963267948966,
                                     2.0,    2.5,
                                     3.0,    3.1416,
                                     4.0,    5.5,
                                     -0.3,   -2.2,
                                     -6.0,   100.5,
                                     -777.7, 31416,
                                     99999.0};
const std::vector<double> kRatios = {-1.0, -0.999999, -0.9, -0.75,  -0.5,       -0.25, -0.1, -1e-5,
                                     0.0,  1e-300,    1e-9, 0.01,   0.0625,     0.3,   0.5,  0.6,
                                     0.7,  0.8,       0.99, 0.9999, 0.99999999, 1.0};
const std::vector<double> kExponents = {-745.0, -720.5, -708.0, -100.25, -10.0, -1.5,  -0.5,
                                        -1e-3,  -1e-17, 0.0,    1e-9,    0.1,   0.34,  0.35,
                                        0.7,    1.0,    2.5,    10.0,    33.3,  100.0, 709.7};
const std::vector<double> kPositives = {5e-324,
                                        1e-310,
                                        1e-100,
                                        1e-9,
                                        0.01,
                                        0.3,
                                        0.7071067811865475,
                                        0.70710678118654757,
                                        0.99,
                                        0.9999999999,
                                        1.0,
                                        1.0000001,
                                        1.1,
                                        1.41,
                                        1.42,
                                        2.0,
                                        2.718281828459045,
                                        10.0,
                                        1e5,
                                        1e100,
                                        1.7e308};
const std::vector<double> kTanhArguments = {
    -30.0, -22.0,  -5.5,  -1.0,  -0.5,  -0.125, -0.1,  -1e-9, 1e-300, 0.0,  1e-5,
    0.05,  0.1249, 0.126, 0.249, 0.251, 0.7,    0.999, 1.001, 3.0,    15.0, 21.9};
const std::vector<std::pair<double, double>> kVectors = {
    {1.0, 1.0},       {1.0, -1.0},    {-1.0, -1.0}, {-1.0, 1.0},  {0.3, 2.0},   {2.0, 0.3},
    {-0.3, 2.0},      {2.0, -0.3},    {1e-9, 1.0},  {1.0, 1e-9},  {1e-9, -1.0}, {-1e-9, -1.0},
    {0.0625, 1.0},    {0.19, 1.0},    {0.55, 0.56}, {7.25, -3.5}, {-12.0, 5.0}, {3.0, 4.0},
    {1e-160, 1e-155}, {1e150, 2e149}, {0.0, -2.0}};

std::string bits(double value) {
  std::uint64_t raw;
  std::memcpy(&raw, &value, sizeof raw);
  char text[20];
  std::snprintf(text, sizeof text, " %016llx", static_cast<unsigned long long>(raw));
  return text;
}

template <typename Function>
void add_lines(const char* name, Function function, const std::vector<double>& arguments,
               std::vector<std::string>& lines) {
  for (const double x : arguments) lines.push_back(name + bits(x) + bits(function(x)));
}

std::vector<std::string> current_lines() {
  std::vector<std::string> lines = {
      "# function, the bits of its arguments, the bits of its result"};
  add_lines("sin", sin, kAngles, lines);
  add_lines("cos", cos, kAngles, lines);
  add_lines("acos", acos, kRatios, lines);
  add_lines("asin", asin, kRatios, lines);
  add_lines("exp", exp, kExponents, lines);
  add_lines("log", log, kPositives, lines);
  add_lines("tanh", tanh, kTanhArguments, lines);
  for (const auto& [y, x] : kVectors) {
    lines.push_back("atan2" + bits(y) + bits(x) + bits(atan2(y, x)));
    lines.push_back("hypot" + bits(x) + bits(y) + bits(hypot(x, y)));
  }
  return lines;
}

std::vector<std::string> golden_lines() {
  std::ifstream file(kGoldenFile);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

TEST(MathGolden, GivesTheSameBitsOnEveryMachine) {
  const std::vector<std::string> lines = current_lines();
  if (std::getenv("CLEW_REWRITE_GOLDEN") != nullptr) {
    std::ofstream file(kGoldenFile);
    for (const std::string& line : lines) file << line << '\n';
  }

  const std::vector<std::string> golden = golden_lines();

  ASSERT_EQ(lines.size(), golden.size()) << kGoldenFile;
  for (std::size_t i = 0; i < lines.size(); ++i) EXPECT_EQ(lines[i], golden[i]) << "line " << i + 1;
}

}  // namespace
}  // namespace clew::core
