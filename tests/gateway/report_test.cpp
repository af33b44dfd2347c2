// SPDX-License-Identifier: Apache-2.0
#include "view/report.hpp"

#include <gtest/gtest.h>

#include "core/base64.hpp"

namespace clew::view {
namespace {

TEST(Report, NoTextOfARecordingIsHtml) {
  const std::string evil = "</script><img src=x onerror=alert(1)>\" '<!--";

  const auto text = report("<body><!-- recordings --></body>", {{evil, {evil}}});

  ASSERT_TRUE(text.ok());
  EXPECT_EQ(text->find("<img"), std::string::npos);
  EXPECT_EQ(text->find("onerror"), std::string::npos);
  EXPECT_NE(text->find("data-name=\"" + core::base64(evil) + '"'), std::string::npos);
}

TEST(Report, NeedsAPageWithAPlaceForRecordings) { EXPECT_FALSE(report("<body></body>", {}).ok()); }

}  // namespace
}  // namespace clew::view
