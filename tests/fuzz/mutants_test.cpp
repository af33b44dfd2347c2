// SPDX-License-Identifier: Apache-2.0
/// Every reader of strangers' bytes, fed with its seeds and some hundred changed ones. It is worth
/// most under the sanitizers (preset asan); tools/fuzz looks for longer, and led by coverage.
#include "mutants.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <set>
#include <string>

// Of the sanitizers, where there are any.
extern "C" void __sanitizer_set_death_callback(void (*callback)()) __attribute__((weak));

namespace clew::fuzz {
namespace {

constexpr std::uint32_t kSeed = 20261129;

int mutants() {
  const char* wanted = std::getenv("CLEW_MUTANTS");
  return wanted != nullptr ? std::atoi(wanted) : 300;
}

const Target* target = nullptr;
std::string input;

/// What broke a reader stays as a file, which tools/fuzz can read.
void keep_input() {
  const std::string file = std::string("crash-") + target->name;
  std::ofstream(file, std::ios::binary) << input;
  std::fprintf(stderr, "%s is broken by the %zu bytes that are now in %s\n", target->name,
               input.size(), file.c_str());
}

void keep_input_and_abort(int) {
  keep_input();
  std::signal(SIGABRT, SIG_DFL);
  std::abort();
}

class Reader : public testing::TestWithParam<Target> {
 protected:
  void SetUp() override {
    target = &GetParam();
    std::signal(SIGABRT, keep_input_and_abort);
    if (__sanitizer_set_death_callback != nullptr) __sanitizer_set_death_callback(keep_input);
  }
  void TearDown() override { std::signal(SIGABRT, SIG_DFL); }
};

TEST_P(Reader, RefusesOrReadsWhateverComes) {
  const Seeds seeds = GetParam().seeds();
  ASSERT_FALSE(seeds.empty());
  for (const std::string& seed : seeds) {
    input = seed;
    GetParam().read(input);
  }

  Mutants mutant(seeds, kSeed);
  for (int left = mutants(); left > 0; --left) {
    input = mutant.next();
    GetParam().read(input);
  }
  input.clear();
  GetParam().read(input);
}

INSTANTIATE_TEST_SUITE_P(OfEveryTarget, Reader, testing::ValuesIn(all_targets()),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(Mutants, AreTheSameEveryTimeAndDiffer) {
  Mutants first({"resolution: 0.05\n", "origin: [1, 2, 0]\n"}, kSeed);
  Mutants second({"resolution: 0.05\n", "origin: [1, 2, 0]\n"}, kSeed);
  std::set<std::string> different;

  for (int i = 0; i < 200; ++i) {
    const std::string one = first.next();
    EXPECT_EQ(one, second.next());
    different.insert(one);
  }

  EXPECT_GT(different.size(), 150u);
}

}  // namespace
}  // namespace clew::fuzz
