// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "files/scratch_folder.hpp"
#include "files/whole_file.hpp"

namespace clew::files {
namespace {

namespace fs = std::filesystem;

/// The environment's TMPDIR, put back at the end.
class TemporaryFolders {
 public:
  explicit TemporaryFolders(const std::string& path) {
    if (const char* const before = std::getenv("TMPDIR")) before_ = before;
    ::setenv("TMPDIR", path.c_str(), 1);
  }
  ~TemporaryFolders() {
    if (before_.empty()) {
      ::unsetenv("TMPDIR");
    } else {
      ::setenv("TMPDIR", before_.c_str(), 1);
    }
  }
  TemporaryFolders(const TemporaryFolders&) = delete;
  TemporaryFolders& operator=(const TemporaryFolders&) = delete;

 private:
  std::string before_;
};

TEST(ScratchFolder, SaysThatThereIsNoPlaceForTemporaryFiles) {
  const TemporaryFolders none("/no/such/folder");

  const auto folder = ScratchFolder::make("clew-test");

  ASSERT_FALSE(folder.ok());
  EXPECT_EQ(folder.error().text(),
            "/no/such/folder: is no folder for temporary files: No such file or directory; set "
            "TMPDIR to one "
            "that can be written");
}

TEST(ScratchFolder, GoesWithItsFiles) {
  std::string path;
  {
    const auto folder = ScratchFolder::make("clew-test");
    ASSERT_TRUE(folder.ok()) << folder.error().text();
    path = folder->path();
    ASSERT_TRUE(write_file(path + "/a", "a").ok());
  }
  EXPECT_FALSE(fs::exists(path));
}

TEST(ScratchFolder, RemovesThoseOfProcessesThatAreGone) {
  const auto used = ScratchFolder::make("clew-test-left");
  ASSERT_TRUE(used.ok()) << used.error().text();
  const fs::path left = used->path().substr(0, used->path().rfind('.')) + ".aaaaaa";
  const fs::path other = left.string() + 'a';
  fs::create_directories(left / "folder");
  fs::create_directories(other);
  ASSERT_TRUE(write_file((left / "rules.yaml").string(), "format: rules").ok());

  const auto next = ScratchFolder::make("clew-test-left");

  ASSERT_TRUE(next.ok()) << next.error().text();
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(used->path()));
  EXPECT_TRUE(fs::exists(next->path()));
  EXPECT_TRUE(fs::remove(other)) << "a folder of another kind was removed";
}

TEST(WholeFile, FollowsNoLinkBesideIt) {
  const auto folder = ScratchFolder::make("clew-test");
  ASSERT_TRUE(folder.ok()) << folder.error().text();
  const std::string file = folder->path() + "/a";
  const std::string victim = folder->path() + "/victim";
  ASSERT_TRUE(write_file(victim, "untouched").ok());
  fs::create_symlink(victim, file + '~' + std::to_string(::getpid()) + "-0");

  ASSERT_TRUE(write_file(file, "new").ok());

  EXPECT_EQ(*read_file(victim), "untouched");
  EXPECT_EQ(*read_file(file), "new");
  EXPECT_FALSE(fs::is_symlink(file));
}

TEST(WholeFile, KeepsTheRightsOfAFileAndLeavesNothingBesideIt) {
  const auto folder = ScratchFolder::make("clew-test");
  ASSERT_TRUE(folder.ok()) << folder.error().text();
  const std::string file = folder->path() + "/a";
  ASSERT_TRUE(write_file(file, "old").ok());
  fs::permissions(file, fs::perms(0640));

  ASSERT_TRUE(write_file(file, "new").ok());

  EXPECT_EQ(*read_file(file), "new");
  EXPECT_EQ(fs::status(file).permissions(), fs::perms(0640));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder->path()), fs::directory_iterator()), 1);
}

}  // namespace
}  // namespace clew::files
