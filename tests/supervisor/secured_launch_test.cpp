// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "sleeping_process.hpp"
#include "small_plan.hpp"
#include "stages/all.hpp"
#include "supervisor/launcher.hpp"
#include "supervisor/run_participants.hpp"

namespace clew::bridge {
namespace {

using Names = std::set<std::string>;

const SecuredParticipant& participant(const std::vector<SecuredParticipant>& all,
                                      const std::string& name) {
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const SecuredParticipant& one) { return one.name == name; });
  EXPECT_NE(found, all.end()) << name;
  return *found;
}

std::string text_in(const std::string& path) {
  std::ifstream stream(path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(RunParticipants, MayDoWhatTheWiringSays) {
  const auto plan = small_plan();

  const auto all = run_participants(plan.graph, {});

  ASSERT_EQ(all.size(), 5u);
  EXPECT_EQ(participant(all, "sense").rights.writes, Names{"scan"});
  EXPECT_EQ(participant(all, "sense").rights.reads, Names{"state"});
  EXPECT_EQ(participant(all, "control").rights.writes, Names{"command"});
  EXPECT_EQ(participant(all, "drive").rights.writes, (Names{"state", "odometry", "target"}));
  EXPECT_EQ(participant(all, "drive").rights.reads, Names{"command"});
  EXPECT_EQ(participant(all, kWatcherName).rights.writes, Names{});
  EXPECT_EQ(participant(all, kObserverIdentity).rights.writes, Names{});
}

TEST(RunParticipants, OfAGroupMayDoWhatItsStagesMay) {
  const auto plan =
      small_plan({}, {}, "{behaviour: turn_then_step, process: {group: robot}}", "{group: robot}");

  const auto all = run_participants(plan.graph, {});

  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(participant(all, "robot").rights.writes,
            (Names{"scan", "state", "odometry", "target"}));
  EXPECT_EQ(participant(all, "robot").rights.reads, (Names{"command", "state"}));
}

TEST(RunParticipants, OfSomebodyElseMayUseEitherVendor) {
  const auto plan = small_plan("my_control");
  ProcessLayout layout;
  layout.stage_middleware["sense"] = "fastdds";

  const auto all = run_participants(plan.graph, layout);

  EXPECT_EQ(participant(all, "control").vendors.size(), 2u);
  EXPECT_EQ(participant(all, "sense").vendors, std::vector<Vendor>{Vendor::kFastDds});
  EXPECT_EQ(participant(all, "drive").vendors, std::vector<Vendor>{Vendor::kCycloneDds});
}

TEST(AllParticipants, MayDoWhatAnyGraphAsksOfTheirStages) {
  const auto plan = small_plan();

  const auto all = all_participants(stages::all());

  for (const SecuredParticipant& one : run_participants(plan.graph, {})) {
    const Rights& rights = participant(all, one.name).rights;
    EXPECT_TRUE(std::includes(rights.writes.begin(), rights.writes.end(), one.rights.writes.begin(),
                              one.rights.writes.end()))
        << one.name;
    EXPECT_TRUE(std::includes(rights.reads.begin(), rights.reads.end(), one.rights.reads.begin(),
                              one.rights.reads.end()))
        << one.name;
  }
}

class SecuredLaunch : public testing::Test {
 protected:
  SecuredLaunch() {
    auto minted = RunSecurity::mint(run_participants(plan_.graph, layout_));
    EXPECT_TRUE(minted.ok()) << minted.error().text();
    security_ = std::move(minted).value();
  }
  Launcher launcher() {
    const auto start = [this](const ChildCommand& command) {
      started_ = command;
      return start_sleeping(command);
    };
    return Launcher(plan_, layout_, 5, Spooling::kNothing, start, security_);
  }

  runtime::RunPlan plan_ = small_plan("my_control");
  ProcessLayout layout_;
  RunSecurity::Shared security_;
  ChildCommand started_;
};

TEST_F(SecuredLaunch, GivesEachOfOursItsOwnIdentity) {
  auto members = list_members(plan_, layout_);
  const Launcher launcher = this->launcher();
  const auto expected = [&](const std::string& name) {
    return security_->files(name, Vendor::kCycloneDds).private_key;
  };

  EXPECT_EQ(launcher.assignment_for(*find_member(members, "sense")).security->private_key,
            expected("sense"));
  EXPECT_EQ(launcher.assignment_for(*find_member(members, "drive")).security->private_key,
            expected("drive"));
  EXPECT_EQ(launcher.assignment_for_watcher().security->private_key, expected(kWatcherName));
  EXPECT_EQ(launcher.assignment_for_observer().security->private_key, expected(kObserverIdentity));
}

TEST_F(SecuredLaunch, TellsAThirdPartyItsIdentityInTheWordsOfEitherVendor) {
  auto members = list_members(plan_, layout_);
  Member& control = *find_member(members, "control");
  const Launcher launcher = this->launcher();

  ASSERT_TRUE(launcher.start(control).ok());

  const std::string cyclone = security_->files("control", Vendor::kCycloneDds).private_key;
  const std::string fast = security_->files("control", Vendor::kFastDds).private_key;
  EXPECT_NE(started_.environment.at("CYCLONEDDS_URI")
                .find("<PrivateKey>file:" + cyclone + "</PrivateKey>"),
            std::string::npos);
  EXPECT_NE(text_in(started_.environment.at("FASTRTPS_DEFAULT_PROFILES_FILE"))
                .find("<value>file://" + fast + "</value>"),
            std::string::npos);
  end_now(*control.child);
}

TEST_F(SecuredLaunch, TellsNoKeyByTheEnvironmentOfOurs) {
  auto members = list_members(plan_, layout_);
  Member& sense = *find_member(members, "sense");
  const Launcher launcher = this->launcher();

  ASSERT_TRUE(launcher.start(sense).ok());

  EXPECT_EQ(started_.environment.at("CYCLONEDDS_URI").find("PrivateKey"), std::string::npos);
  end_now(*sense.child);
}

}  // namespace
}  // namespace clew::bridge
