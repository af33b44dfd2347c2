// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "runtime/config_source.hpp"

namespace clew::runtime {
namespace {

namespace fs = std::filesystem;

/// Two roots, `first` and `second`, in a directory that goes with the test.
class ConfigPathTest : public ::testing::Test {
 protected:
  ConfigPathTest() {
    std::string name = (fs::temp_directory_path() / "clew-config-XXXXXX").string();
    directory_ = mkdtemp(name.data());
  }
  ~ConfigPathTest() override { fs::remove_all(directory_); }

  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    fs::create_directories((directory_ / name).parent_path());
    std::ofstream(directory_ / name) << text;
    return path(name);
  }
  ConfigPath both() const { return ConfigPath({path("first"), path("second")}); }

  static std::string from_here() {
    return " (a path from the working directory, " + fs::current_path().string() + ')';
  }

  fs::path directory_;
};

TEST_F(ConfigPathTest, FindsANameInTheFirstRootThatHasIt) {
  write("first/worlds/a.yaml", "a of the first");
  write("second/worlds/a.yaml", "a of the second");
  const std::string b = write("second/worlds/b.yaml", "b");

  EXPECT_EQ(both().find("worlds", "a")->text, "a of the first");
  EXPECT_EQ(both().find("worlds", "b")->text, "b");
  EXPECT_EQ(both().find("worlds", "b")->file, b);
}

TEST_F(ConfigPathTest, TakesWhatHasASlashOrAnExtensionForAPath) {
  write("first/worlds/a.yaml", "by name");
  const std::string file = write("elsewhere/a.txt", "by path");

  EXPECT_EQ(both().find("worlds", file)->text, "by path");
  EXPECT_EQ(both().find("worlds", "no-such-a.yaml").error().text(),
            "no-such-a.yaml: cannot be read: No such file or directory" + from_here());
  EXPECT_EQ(both().find("worlds", "./no-such-a").error().text(),
            "./no-such-a: cannot be read: No such file or directory" + from_here());
}

TEST_F(ConfigPathTest, BringsAMapWithItsPicture) {
  const std::string map = write("first/maps/hall.yaml", "image: hall.pgm");
  write("first/maps/hall.pgm", "P5 bytes");
  write("first/maps/bare.yaml", "image: none.pgm");

  const auto file = both().find("maps", "hall");

  EXPECT_EQ(file->text, "image: hall.pgm");
  EXPECT_EQ(file->image, "P5 bytes");
  EXPECT_EQ(both().find("maps", map)->image, "P5 bytes");
  EXPECT_EQ(both().find("maps", "bare").error().text(),
            path("first/maps/bare.yaml") + ":1:8: image " + path("first/maps/none.pgm") +
                ": cannot be read: No such file or directory");
}

TEST_F(ConfigPathTest, FindsThePictureOfAMapInABundle) {
  Bundle bundle;
  add_to_bundle("maps", "hall", {"hall.yaml", "image: hall.pgm", "P5 bytes"}, bundle);

  const auto file = BundleSource(bundle).find("maps", "hall");

  EXPECT_EQ(bundle.size(), 2u);
  EXPECT_EQ(file->text, "image: hall.pgm");
  EXPECT_EQ(file->image, "P5 bytes");
}

TEST_F(ConfigPathTest, AnswersAnUnknownNameWithTheKnownOnes) {
  write("first/worlds/u-trap.yaml", "");
  write("second/worlds/u-trap.yaml", "");
  write("second/worlds/comb.yaml", "");
  write("second/worlds/readme.txt", "");

  EXPECT_EQ(both().find("worlds", "u-tarp").error().text(),
            "unknown world 'u-tarp' (did you mean 'u-trap'?); allowed: comb, u-trap (in " +
                path("first/worlds") + ", " + path("second/worlds") +
                "; CLEW_PATH adds directories)");
}

TEST_F(ConfigPathTest, ListsEachNameOnce) {
  write("first/worlds/u-trap.yaml", "");
  write("second/worlds/u-trap.yaml", "");
  write("second/worlds/comb.yaml", "");

  EXPECT_EQ(both().names("worlds"), (std::vector<std::string>{"comb", "u-trap"}));
  EXPECT_TRUE(both().names("robots").empty());
}

TEST_F(ConfigPathTest, RefusesWhatIsNoFile) {
  fs::create_directories(path("directory"));

  EXPECT_EQ(both().find("worlds", path("directory")).error().text(),
            path("directory") + ": cannot be read: it is no regular file");
  EXPECT_EQ(both().find("worlds", "/dev/zero").error().text(),
            "/dev/zero: cannot be read: it is no regular file");
}

TEST_F(ConfigPathTest, RefusesAFileOfUnreasonableSize) {
  const std::string file = write("large.yaml", "");
  fs::resize_file(file, (256u << 20) + 1);  // sparse: takes no room

  EXPECT_EQ(both().find("worlds", file).error().text(),
            file + ": cannot be read: it is larger than 256 MiB");
}

/// Sets CLEW_PATH for one test.
class ConfigPathFromEnvironment : public ConfigPathTest {
 protected:
  ConfigPathFromEnvironment() {
    if (const char* value = std::getenv("CLEW_PATH")) before_ = value;
  }
  ~ConfigPathFromEnvironment() override { setenv("CLEW_PATH", before_.c_str(), 1); }

  std::string before_;
};

TEST_F(ConfigPathFromEnvironment, LooksInTheSourceTreeThenInEachDirectoryOfClewPath) {
  write("first/worlds/mine.yaml", "mine");
  write("second/worlds/yours.yaml", "yours");
  write("second/worlds/u-trap.yaml", "not the one that ships");
  setenv("CLEW_PATH", (path("first") + "::" + path("second")).c_str(), 1);

  const ConfigPath source = ConfigPath::from_environment();

  EXPECT_EQ(source.find("worlds", "mine")->text, "mine");
  EXPECT_EQ(source.find("worlds", "yours")->text, "yours");
  EXPECT_NE(source.find("worlds", "u-trap")->text, "not the one that ships");
}

TEST_F(ConfigPathFromEnvironment, NeedsNoClewPath) {
  unsetenv("CLEW_PATH");

  EXPECT_TRUE(ConfigPath::from_environment().find("worlds", "u-trap").ok());
}

TEST(BundleSource, HoldsOneGraphOneWorldAndOneRobot) {
  const Bundle bundle = {
      {"graph.yaml", "g"}, {"world.yaml", "w"}, {"robot.yaml", "r"}, {"rulebases/som.yaml", "s"}};
  const Bundle nothing;
  const BundleSource source(bundle);

  EXPECT_EQ(source.find("graphs", "whatever")->text, "g");
  EXPECT_EQ(source.find("worlds", "./any where.yaml")->text, "w");
  EXPECT_EQ(source.find("robots", "disc-015")->text, "r");
  EXPECT_EQ(source.find("rulebases", "som")->text, "s");
  EXPECT_EQ(source.find("rulebases", "art").error().text(), "the bundle has no rulebases/art.yaml");
  EXPECT_EQ(BundleSource(nothing).find("worlds", "u-trap").error().text(),
            "the bundle has no world.yaml");
}

}  // namespace
}  // namespace clew::runtime
