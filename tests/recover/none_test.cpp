// SPDX-License-Identifier: Apache-2.0
#include "recover/detectors/none.hpp"

#include <gtest/gtest.h>

#include "recover/escapes/none.hpp"
#include "tests/recover/scene.hpp"

namespace clew::recover {
namespace {

TEST(NoRecovery, NeverSaysTrapAndEndsAtOnce) {
  NoDetector detector;
  NoEscape escape;
  const Scene scene;
  domain::Guidance guidance;

  EXPECT_FALSE(detector.observe(scene.situation()).has_value());
  EXPECT_EQ(escape.step(scene.situation(), guidance), EscapeStatus::kEnded);
  EXPECT_FALSE(guidance.has_override);
}

}  // namespace
}  // namespace clew::recover
