// SPDX-License-Identifier: Apache-2.0
#include "recording/output_file.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "recording/mcap_reader.hpp"
#include "recording/mcap_writer.hpp"
#include "scratch_directory.hpp"

namespace clew::recording_test {
namespace {

using namespace bridge::mcap;

TEST(OutputFile, HasItsNameOnlyWhenItIsWhole) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("whole");
  auto file = OutputFile::create(path, false);
  ASSERT_TRUE(file.ok());

  ASSERT_TRUE(file->append("content").ok());
  EXPECT_FALSE(std::filesystem::exists(path));
  ASSERT_TRUE(file->publish().ok());

  EXPECT_EQ(read_bytes(path), "content");
  EXPECT_FALSE(std::filesystem::exists(path + ".tmp~"));
}

TEST(OutputFile, OverwritesOnlyWhenAsked) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("there");
  write_bytes(path, "old");

  const auto refused = OutputFile::create(path, false);
  auto forced = OutputFile::create(path, true);

  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().text(), path + ": exists; it is overwritten only with --force");
  ASSERT_TRUE(forced.ok() && forced->append("new").ok() && forced->publish().ok());
  EXPECT_EQ(read_bytes(path), "new");
}

TEST(OutputFile, WritesTheFileThatALinkLeadsToAndKeepsTheLink) {
  const ScratchDirectory scratch;
  const ScratchDirectory elsewhere;
  const std::string there = elsewhere.file("there");
  const std::string link = scratch.file("link");
  write_bytes(there, "old");
  std::filesystem::create_symlink(there, link);

  EXPECT_FALSE(OutputFile::create(link, false).ok());
  auto forced = OutputFile::create(link, true);
  ASSERT_TRUE(forced.ok() && forced->append("new").ok());
  EXPECT_EQ(read_bytes(there), "old") << "until it is whole";
  ASSERT_TRUE(forced->publish().ok());

  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(read_bytes(there), "new");
  EXPECT_FALSE(std::filesystem::exists(there + ".tmp~"));
}

TEST(OutputFile, RefusesALinkToNothing) {
  const ScratchDirectory scratch;
  const std::string link = scratch.file("link");
  std::filesystem::create_symlink(scratch.file("nothing"), link);

  for (const bool overwrite : {false, true}) {
    const auto refused = OutputFile::create(link, overwrite);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().text(),
              link + ": is a symbolic link to what is not there; a recording is written to a file");
  }
}

TEST(OutputFile, KeepsARecordingThatWasCutOffUnlessForced) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("cut");
  write_bytes(path + ".tmp~", "what a crash left");

  const auto refused = OutputFile::create(path, false);

  ASSERT_FALSE(refused.ok());
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

  ASSERT_FALSE(directory.ok());
  EXPECT_EQ(directory.error().message, "is a directory, a file is needed");
  ASSERT_FALSE(nowhere.ok());
  EXPECT_EQ(nowhere.error().text(),
            scratch.file("no/where.tmp~") + ": cannot be written: No such file or directory");
}

TEST(OutputFile, RefusesADirectoryThatIsReadOnly) {
  const ScratchDirectory scratch;
  std::filesystem::permissions(scratch.path(), std::filesystem::perms(0555));
  // Root may write anywhere; who else runs this may not become somebody else, and need not.
  constexpr uid_t kNobody = 65534;
  const uid_t self = ::geteuid();
  ASSERT_EQ(::seteuid(self == 0 ? kNobody : self), 0);

  const auto refused = OutputFile::create(scratch.file("a"), false);
  ASSERT_EQ(::seteuid(self), 0);
  std::filesystem::permissions(scratch.path(), std::filesystem::perms::owner_all);

  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().text(),
            scratch.file("a.tmp~") + ": cannot be written: Permission denied");
}

TEST(OutputFile, TakesBackWhatItReservedAndNoPipe) {
  const ScratchDirectory scratch;
  const std::string pipe = scratch.file("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  ASSERT_TRUE(OutputFile::reserve(scratch.file("a"), false).ok());
  const auto reserved = OutputFile::reserve(pipe, true);

  OutputFile::discard(scratch.file("a"));
  OutputFile::discard(pipe);

  ASSERT_FALSE(reserved.ok());
  EXPECT_EQ(reserved.error().text(),
            pipe + ": is a pipe, a socket or a disk; a recording is written to a file");
  EXPECT_FALSE(std::filesystem::exists(scratch.file("a.tmp~")));
  EXPECT_TRUE(std::filesystem::exists(pipe));
}

TEST(OutputFile, SaysThatTheDiskIsFullAndStaysSo) {
  // Every write to /dev/full fails as on a full disk.
  auto file = OutputFile::create("/dev/full", false);
  ASSERT_TRUE(file.ok());

  const auto first = file->append("x");
  const auto second = file->append("y");
  const auto published = file->publish();

  ASSERT_FALSE(first.ok());
  EXPECT_EQ(first.error().text(),
            "/dev/full: cannot be written on: No space left on device; the 0 bytes written before "
            "can still be read");
  ASSERT_FALSE(second.ok());
  EXPECT_EQ(second.error().text(), first.error().text());
  ASSERT_FALSE(published.ok());
}

TEST(OutputFile, SaysThatItsFileWasRemoved) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("gone");
  auto file = OutputFile::create(path, false);
  ASSERT_TRUE(file.ok() && file->append("content").ok());

  std::filesystem::remove(path + ".tmp~");
  const auto published = file->publish();

  ASSERT_FALSE(published.ok());
  EXPECT_EQ(published.error().text(), path + ".tmp~: was removed while it was written");
}

TEST(OutputFile, SaysThatItsFileWasRemovedWhenItIsWrittenOn) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("gone");
  auto file = OutputFile::create(path, false);
  ASSERT_TRUE(file.ok() && file->append("content").ok());

  std::filesystem::remove(path + ".tmp~");
  const auto appended = file->append("more");

  ASSERT_FALSE(appended.ok());
  EXPECT_EQ(appended.error().message, "was removed while it was written");
}

TEST(OutputFile, KeepsWhatStandsThereAndReplacesTheRest) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("again");
  write_bytes(path + ".tmp~", "one two thr");

  auto file = OutputFile::go_on(path);
  ASSERT_TRUE(file.ok());
  file->keep(true);
  ASSERT_TRUE(file->append("one ").ok() && file->append("two ").ok());
  file->keep(false);
  ASSERT_TRUE(file->append("3").ok());
  ASSERT_TRUE(file->publish().ok());

  EXPECT_EQ(read_bytes(path), "one two 3");
}

TEST(OutputFile, LeavesAFileAsItIsThatHoldsSomethingElse) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("other");
  write_bytes(path + ".tmp~", "one two");

  auto file = OutputFile::go_on(path);
  ASSERT_TRUE(file.ok());
  file->keep(true);
  const auto refused = file->append("one 2");

  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().message,
            "holds at byte 0 what this version does not write for this run");
  EXPECT_EQ(read_bytes(path + ".tmp~"), "one two");
}

TEST(OutputFile, WritesNothingWhileItHolds) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("held");
  auto file = OutputFile::create(path, false);
  ASSERT_TRUE(file.ok());

  file->hold();
  ASSERT_TRUE(file->append("what belongs ").ok() && file->append("together").ok());
  EXPECT_EQ(file->position(), 21U);
  EXPECT_EQ(read_bytes(path + ".tmp~"), "");
  ASSERT_TRUE(file->release().ok());

  EXPECT_EQ(read_bytes(path + ".tmp~"), "what belongs together");
  ASSERT_TRUE(file->append(", and more").ok());
  EXPECT_EQ(read_bytes(path + ".tmp~"), "what belongs together, and more");
  EXPECT_EQ(file->position(), 31U);
}

TEST(OutputFile, WritesOverWhatItWroteAhead) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("ahead");
  auto file = OutputFile::create(path, false);
  ASSERT_TRUE(file.ok() && file->append("one ").ok() && file->write_ahead("something long").ok());

  EXPECT_EQ(read_bytes(path + ".tmp~"), "one something long");
  ASSERT_TRUE(file->append("two").ok());
  EXPECT_EQ(read_bytes(path + ".tmp~"), "one two");
  ASSERT_TRUE(file->write_ahead(" three").ok() && file->publish().ok());

  EXPECT_EQ(read_bytes(path), "one two");
}

/// Lets files grow to a size and no further, as a full disk does, during its life.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : old_handler_(::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &old_limit_);
    const struct rlimit limit { bytes, old_limit_.rlim_max };
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &old_limit_);
    ::signal(SIGXFSZ, old_handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  struct rlimit old_limit_ {};
  void (*old_handler_)(int);
};

TEST(McapWriter, LeavesWhatItWroteReadableWhenTheDiskIsFull) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("full.mcap");
  WriterOptions options;
  options.chunk_bytes = 1000;
  auto writer = McapWriter::create(path, false, options);
  ASSERT_TRUE(writer.ok());
  const auto channel = writer->add_channel(0, "/t", "");
  core::Result<void> written;

  {
    // Each message fills a chunk of more than 900 bytes: ten fit at most.
    const FileSizeLimit limit(10'000);
    for (std::uint32_t i = 0; i < 20 && written.ok(); ++i) {
      written = writer->write(Message{channel, i, i, i, std::string(900, 'x')});
    }
  }
  const auto reader = McapReader::open(path + ".tmp~");

  ASSERT_FALSE(written.ok());
  // Of the chunk that did not fit nothing stays.
  const std::string whole = std::to_string(std::filesystem::file_size(path + ".tmp~"));
  EXPECT_NE(written.error().message.find("File too large; the " + whole + " bytes written before"),
            std::string::npos)
      << written.error().message;
  EXPECT_FALSE(writer->finish().ok());
  ASSERT_TRUE(reader.ok()) << reader.error().text();
  EXPECT_TRUE(reader->tear());
  auto messages = reader->messages(Order::kFile);
  std::uint32_t readable = 0;
  for (auto message = messages.next(); message.ok() && *message; message = messages.next()) {
    EXPECT_EQ((*message)->sequence, readable);
    ++readable;
  }
  EXPECT_GE(readable, 8U);
  EXPECT_LE(readable, 10U);
}

TEST(McapWriter, ReportsAFullDisk) {
  const auto writer = McapWriter::create("/dev/full", false, {});

  ASSERT_FALSE(writer.ok());
  EXPECT_NE(writer.error().text().find("No space left on device"), std::string::npos);
}

}  // namespace
}  // namespace clew::recording_test
