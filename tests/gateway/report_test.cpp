// SPDX-License-Identifier: Apache-2.0
#include "view/report.hpp"

#include <gtest/gtest.h>

namespace clew::view {
namespace {

// RFC 4648, section 10.
TEST(Base64, GivesTheVectorsOfTheStandard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64(std::string("\xff\xfe\x00", 3)), "//4A");
}

TEST(Report, NoTextOfARecordingIsHtml) {
  const std::string evil = "</script><img src=x onerror=alert(1)>\" '<!--";

  const auto text = report("<body><!-- recordings --></body>", {{evil, evil}});

  ASSERT_TRUE(text.ok());
  EXPECT_EQ(text->find("<img"), std::string::npos);
  EXPECT_EQ(text->find("onerror"), std::string::npos);
  EXPECT_NE(text->find("data-name=\"" + base64(evil) + '"'), std::string::npos);
}

TEST(Report, NeedsAPageWithAPlaceForRecordings) { EXPECT_FALSE(report("<body></body>", {}).ok()); }

}  // namespace
}  // namespace clew::view
