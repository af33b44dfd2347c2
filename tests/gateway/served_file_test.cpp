// SPDX-License-Identifier: Apache-2.0
#include "gateway/served_file.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/few_open_files.hpp"

namespace clew::bridge {
namespace {

std::string text_of(const std::optional<ByteRange>& range) {
  return range ? std::to_string(range->first) + '-' + std::to_string(range->last) : "none";
}

TEST(ByteRange, IsCutToTheFile) {
  EXPECT_EQ(text_of(read_range("bytes=0-9", 100)), "0-9");
  EXPECT_EQ(text_of(read_range("bytes=90-200", 100)), "90-99");
  EXPECT_EQ(text_of(read_range("bytes=90-", 100)), "90-99");
  EXPECT_EQ(text_of(read_range("bytes=-10", 100)), "90-99");
  EXPECT_EQ(text_of(read_range("bytes=-1000", 100)), "0-99");
}

TEST(ByteRange, RefusesWhatIsNoRangeOfTheFile) {
  for (const char* header : {"", "bytes", "bytes=", "bytes=-", "bytes=-0", "bytes=100-",
                             "bytes=9-3", "bytes=a-b", "bytes=0-9,20-29", "items=0-9",
                             "bytes=0x1-2", "bytes=18446744073709551616-", "bytes=--5"}) {
    EXPECT_EQ(text_of(read_range(header, 100)), "none") << header;
  }
  EXPECT_EQ(text_of(read_range("bytes=0-0", 0)), "none");
}

class AServedFile : public ::testing::Test {
 protected:
  // Tests run side by side: each has a file of its own.
  AServedFile()
      : path_(::testing::TempDir() + "clew_served_file_" +
              ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".bin") {
    std::ofstream(path_, std::ios::binary) << "0123456789";
  }
  ~AServedFile() override { std::remove(path_.c_str()); }

  std::string path_;
};

TEST_F(AServedFile, GivesTheRangeAndSaysWhichItIs) {
  const auto file = ServedFile::open(path_);
  ASSERT_TRUE(file.ok());

  const WebResponse response = file->answer("bytes=2-4");

  EXPECT_EQ(response.status, 206U);
  EXPECT_EQ(response.body, "234");
  const std::pair<std::string, std::string> told = {"Content-Range", "bytes 2-4/10"};
  EXPECT_EQ(response.headers.back(), told);
}

TEST_F(AServedFile, GivesAllWithoutARange) {
  const auto file = ServedFile::open(path_);
  ASSERT_TRUE(file.ok());

  EXPECT_EQ(file->answer("").body, "0123456789");
  EXPECT_EQ(file->answer("").status, 200U);
}

TEST_F(AServedFile, GrowsWithTheFile) {
  const auto file = ServedFile::open(path_);
  ASSERT_TRUE(file.ok());

  std::ofstream(path_, std::ios::binary | std::ios::app) << "ab";

  EXPECT_EQ(file->answer("bytes=8-").body, "89ab");
}

TEST_F(AServedFile, IsGoneWhenItWasRemoved) {
  const auto file = ServedFile::open(path_);
  ASSERT_TRUE(file.ok());

  std::remove(path_.c_str());

  EXPECT_EQ(file->answer("").status, 410U);
  EXPECT_EQ(file->answer("bytes=2-4").body,
            file->name() + " was removed since it was opened here\n");
}

TEST_F(AServedFile, IsGoneWhenAnotherHasItsName) {
  const auto file = ServedFile::open(path_);
  ASSERT_TRUE(file.ok());

  std::ofstream(path_ + "2", std::ios::binary) << "another";
  std::filesystem::rename(path_ + "2", path_);

  const WebResponse response = file->answer("bytes=2-4");
  EXPECT_EQ(response.status, 410U);
  EXPECT_EQ(response.body, file->name() + " is another file than when it was opened here\n");
}

TEST_F(AServedFile, IsServedOnWhenItsRecorderHasFinishedIt) {
  const std::string growing = path_ + ".tmp~";
  std::filesystem::rename(path_, growing);
  const auto file = ServedFile::open(growing);
  ASSERT_TRUE(file.ok());

  std::filesystem::rename(growing, path_);

  EXPECT_EQ(file->answer("bytes=2-4").body, "234");
}

TEST_F(AServedFile, NamesTheLimitOfOpenFiles) {
  const auto file = ServedFile::open(path_);
  ASSERT_TRUE(file.ok());
  const FewOpenFiles none(0);

  const WebResponse response = file->answer("");
  const auto other = ServedFile::open(path_);

  const std::string limit =
      "; this process may have " + std::to_string(none.limit()) + " (ulimit -n)";
  EXPECT_EQ(response.status, 500U);
  EXPECT_EQ(response.body,
            file->name() + " cannot be read again: Too many open files" + limit + '\n');
  ASSERT_FALSE(other.ok());
  EXPECT_EQ(other.error().text(), path_ + ": Too many open files" + limit);
}

TEST_F(AServedFile, TakesNoDescriptorBetweenAnswers) {
  const FewOpenFiles one(1);
  const auto recording = ServedRecording::open(std::vector<std::string>(100, path_));
  ASSERT_TRUE(recording.ok()) << recording.error().text();

  EXPECT_EQ(recording->files().size(), 100U);
  for (const ServedFile& file : recording->files()) EXPECT_EQ(file.answer("bytes=2-4").body, "234");
}

TEST_F(AServedFile, TellsTheSizeWhereTheRangeIsNone) {
  const auto file = ServedFile::open(path_);
  ASSERT_TRUE(file.ok());

  const WebResponse response = file->answer("bytes=10-");

  EXPECT_EQ(response.status, 416U);
  const std::pair<std::string, std::string> told = {"Content-Range", "bytes */10"};
  EXPECT_EQ(response.headers.back(), told);
}

TEST(ServedFile, SaysWhyAFileCannotBeOpened) {
  const auto file = ServedFile::open("/no/such/file");

  ASSERT_FALSE(file.ok());
  EXPECT_EQ(file.error().text(), "/no/such/file: No such file or directory");
}

TEST(ServedFile, RefusesWhatIsNoFile) {
  const auto file = ServedFile::open("/");

  ASSERT_FALSE(file.ok());
  EXPECT_EQ(file.error().text(), "/: is no regular file");
}

}  // namespace
}  // namespace clew::bridge
