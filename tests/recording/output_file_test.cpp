// SPDX-License-Identifier: Apache-2.0
#include "recording/output_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "recording/mcap_writer.hpp"
#include "scratch_directory.hpp"

namespace clew::recording_test {
namespace {

using namespace bridge::mcap;

TEST(OutputFile, HasItsNameOnlyWhenItIsWhole) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("whole");
  auto file = OutputFile::create(path, false);
  ASSERT_TRUE(file);

  ASSERT_TRUE(file->append("content"));
  EXPECT_FALSE(std::filesystem::exists(path));
  ASSERT_TRUE(file->publish());

  EXPECT_EQ(read_bytes(path), "content");
  EXPECT_FALSE(std::filesystem::exists(path + ".tmp~"));
}

TEST(OutputFile, OverwritesOnlyWhenAsked) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("there");
  write_bytes(path, "old");

  const auto refused = OutputFile::create(path, false);
  auto forced = OutputFile::create(path, true);

  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().text(), path + ": exists; it is overwritten only with --force");
  ASSERT_TRUE(forced && forced->append("new") && forced->publish());
  EXPECT_EQ(read_bytes(path), "new");
}

TEST(OutputFile, KeepsARecordingThatWasCutOffUnlessForced) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("cut");
  write_bytes(path + ".tmp~", "what a crash left");

  const auto refused = OutputFile::create(path, false);

  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().text(),
            path +
                ".tmp~: exists: a recording that is being written or was cut off; it is "
                "overwritten only with --force");
  EXPECT_EQ(read_bytes(path + ".tmp~"), "what a crash left");
}

TEST(OutputFile, RefusesADirectoryAndAPlaceThatIsNotThere) {
  const ScratchDirectory scratch;

  const auto directory = OutputFile::create(scratch.path().string(), true);
  const auto nowhere = OutputFile::create(scratch.file("no/where"), false);

  ASSERT_FALSE(directory);
  EXPECT_EQ(directory.error().message, "is a directory, a file is needed");
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(nowhere.error().text(),
            scratch.file("no/where.tmp~") + ": cannot be written: No such file or directory");
}

TEST(OutputFile, RefusesADirectoryThatIsReadOnly) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  const ScratchDirectory scratch;
  std::filesystem::permissions(
      scratch.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);

  const auto refused = OutputFile::create(scratch.file("a"), false);
  std::filesystem::permissions(scratch.path(), std::filesystem::perms::owner_all);

  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().text(),
            scratch.file("a.tmp~") + ": cannot be written: Permission denied");
}

TEST(OutputFile, SaysThatTheDiskIsFullAndStaysSo) {
  // Every write to /dev/full fails as on a full disk.
  auto file = OutputFile::create("/dev/full", false);
  ASSERT_TRUE(file);

  const auto first = file->append("x");
  const auto second = file->append("y");
  const auto published = file->publish();

  ASSERT_FALSE(first);
  EXPECT_EQ(first.error().text(),
            "/dev/full: cannot be written on: No space left on device; the 0 bytes written before "
            "can still be read");
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().text(), first.error().text());
  ASSERT_FALSE(published);
}

TEST(OutputFile, SaysThatItsFileWasRemoved) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("gone");
  auto file = OutputFile::create(path, false);
  ASSERT_TRUE(file && file->append("content"));

  std::filesystem::remove(path + ".tmp~");
  const auto published = file->publish();

  ASSERT_FALSE(published);
  EXPECT_EQ(published.error().message.substr(0, 20), "cannot be renamed to");
}

TEST(McapWriter, ReportsAFullDisk) {
  const auto writer = McapWriter::create("/dev/full", false, {});

  ASSERT_FALSE(writer);
  EXPECT_NE(writer.error().text().find("No space left on device"), std::string::npos);
}

}  // namespace
}  // namespace clew::recording_test
