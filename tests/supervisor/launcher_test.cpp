// SPDX-License-Identifier: Apache-2.0
#include "supervisor/launcher.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "component/process_host.hpp"
#include "run/limits.hpp"
#include "sleeping_process.hpp"
#include "small_plan.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {
namespace {

using Texts = std::vector<std::string>;

class Launch : public testing::Test {
 protected:
  Launch() { layout_.program = "/opt/clew bin/clew"; }
  Launcher launcher() {
    return Launcher(plan_, layout_, 5, Spooling::kSamples, [this](const ChildCommand& command) {
      started_ = command;
      return start_sleeping(command);
    });
  }

  runtime::RunPlan plan_ = small_plan("my_control, --fast");
  ProcessLayout layout_;
  ChildCommand started_;
};

TEST_F(Launch, StartsOurComponentsByTheirNameAndTellsTheDomain) {
  auto members = list_members(plan_, layout_);
  Member& sense = *find_member(members, "sense");

  ASSERT_TRUE(launcher().start(sense).ok());

  EXPECT_EQ(started_.arguments, (Texts{"/opt/clew bin/clew", "component", "-", "sense"}));
  EXPECT_EQ(started_.environment.at("CLEW_DOMAIN_ID"), "5");
  EXPECT_FALSE(started_.may_start_others);
  end_now(*sense.child);
}

TEST_F(Launch, StartsARelayForAComponentOnAnotherHostAndTellsAllWhereToMeet) {
  layout_.hosts =
      HostsLayout{"my hosts.yaml", {{"sense", "robot"}}, {"127.0.0.1", "10.0.0.2"}, "local"};
  auto members = list_members(plan_, layout_);
  Member& sense = *find_member(members, "sense");
  Member& drive = *find_member(members, "drive");
  const Launcher starter = launcher();

  ASSERT_TRUE(starter.start(sense).ok());
  EXPECT_EQ(started_.arguments, (Texts{"/opt/clew bin/clew", "relay", "my hosts.yaml", "robot",
                                       "sense", "--domain", "5", "--fallback", "local"}));
  end_now(*sense.child);
  ASSERT_TRUE(starter.start(drive).ok());
  EXPECT_EQ(started_.arguments, (Texts{"/opt/clew bin/clew", "component", "-", "drive"}));
  end_now(*drive.child);
  EXPECT_EQ(starter.assignment_for(drive).hosts, (Texts{"127.0.0.1", "10.0.0.2"}));
  EXPECT_EQ(starter.assignment_for(drive).lease_s, kLeaseOverHosts_s);
  EXPECT_EQ(starter.start_timeout(),
            std::chrono::duration<double>(3.0 * plan_.graph.start_timeout_s));
  EXPECT_EQ(starter.assignment_for_watcher().hosts, (Texts{"127.0.0.1", "10.0.0.2"}));

  auto control = find_member(members, "control");
  ASSERT_TRUE(starter.start(*control).ok());
  EXPECT_NE(started_.environment.at("CYCLONEDDS_URI").find("<Peer Address=\"10.0.0.2\"/>"),
            std::string::npos);
  end_now(*control->child);
}

TEST_F(Launch, StartsAThirdPartyByItsOwnCommandWithWhatItsVendorReads) {
  auto members = list_members(plan_, layout_);
  Member& control = *find_member(members, "control");

  ASSERT_TRUE(launcher().start(control).ok());

  EXPECT_EQ(started_.arguments, (Texts{"my_control", "--fast"}));
  EXPECT_TRUE(started_.may_start_others);
  EXPECT_NE(started_.environment.at("CYCLONEDDS_URI").find("<ExternalDomainId>5<"),
            std::string::npos);
  EXPECT_EQ(started_.environment.at("CLEW_STAGE"), "control");
  EXPECT_EQ(started_.environment.at("CLEW_TICK_S"), "0.3");
  end_now(*control.child);
}

TEST_F(Launch, TellsAThirdPartyAFileOfFastDdsProfilesThatIsThereAsLongAsItself) {
  auto members = list_members(plan_, layout_);
  Member& control = *find_member(members, "control");
  std::string path;
  {
    const Launcher lives = launcher();
    ASSERT_TRUE(lives.start(control).ok());
    path = started_.environment.at("FASTRTPS_DEFAULT_PROFILES_FILE");

    std::ifstream file(path);
    const std::string text{std::istreambuf_iterator<char>(file), {}};

    EXPECT_NE(text.find("<domainId>5</domainId>"), std::string::npos) << text;
    EXPECT_NE(text.find("<interfaceWhiteList><address>127.0.0.1<"), std::string::npos);
  }
  EXPECT_FALSE(std::ifstream(path).good());
  end_now(*control.child);
}

TEST_F(Launch, StartsTheRelayOfAProgramThatSpeaksLinesAsAComponentOfOurs) {
  plan_ = small_plan("my_control", ", via: json_lines");
  auto members = list_members(plan_, layout_);
  Member& control = *find_member(members, "control");

  ASSERT_TRUE(launcher().start(control).ok());

  EXPECT_FALSE(control.third_party);
  EXPECT_EQ(started_.arguments, (Texts{"/opt/clew bin/clew", "component", "-", "control"}));
  EXPECT_TRUE(started_.may_start_others) << "what the program starts ends with the relay";
  end_now(*control.child);
}

TEST_F(Launch, HoldsEverybodyUntilTheRunGoesIfDriveIsSomeoneElses) {
  EXPECT_FALSE(launcher().assignment_for({"sense"}, "cyclonedds").waits_for_go);

  plan_ = small_plan("my_control", "", "{exec: [./my_drive], behaviour: turn_then_step}");

  EXPECT_TRUE(launcher().assignment_for({"sense"}, "cyclonedds").waits_for_go);
}

TEST_F(Launch, PutsAPrefixInFrontAndLeavesItTheTerminal) {
  layout_.prefix["sense"] = "gdb --args";
  auto members = list_members(plan_, layout_);
  Member& sense = *find_member(members, "sense");

  ASSERT_TRUE(launcher().start(sense).ok());

  EXPECT_EQ(started_.arguments[2], "exec gdb --args \"$@\"");
  EXPECT_TRUE(started_.keeps_terminal);
  EXPECT_TRUE(launcher().patient());
  EXPECT_EQ(launcher().assignment_for(sense).lease_s, kPatientLease_s);
  end_now(*sense.child);
}

TEST_F(Launch, TellsAPersonWhatToTypeQuotedForAShell) {
  layout_.external = {"sense"};
  auto members = list_members(plan_, layout_);

  EXPECT_EQ(launcher().how_to_start(*find_member(members, "sense")),
            "waiting for sense; start it with: '/opt/clew bin/clew' component - sense --domain 5");
}

TEST_F(Launch, AdmitsEachComponentOnceAndThirdPartiesNever) {
  auto members = list_members(plan_, layout_);
  const std::string fingerprint(idl_fingerprint());
  const Launcher launcher = this->launcher();

  EXPECT_EQ(*launcher.admit({"sense", 1, fingerprint}, members), find_member(members, "sense"));
  EXPECT_EQ(*launcher.admit({"control", 1, fingerprint}, members), nullptr);
  EXPECT_EQ(*launcher.admit({"plan", 1, fingerprint}, members), nullptr);
  EXPECT_FALSE(launcher.admit({"sense", 1, "00"}, members).ok());
}

TEST_F(Launch, TellsAComponentWhomToWaitFor) {
  auto members = list_members(plan_, layout_);

  const Assignment drive = launcher().assignment_for(*find_member(members, "drive"));

  const auto command = std::find_if(drive.expected.begin(), drive.expected.end(),
                                    [](const auto& one) { return one.topic == "command"; });
  ASSERT_NE(command, drive.expected.end());
  EXPECT_TRUE(command->is_writer);
  EXPECT_EQ(command->stage, "control");
  EXPECT_TRUE(command->third_party);
  EXPECT_EQ(drive.lease_s, kLease_s);
  EXPECT_EQ(drive.lead, kLead);
}

class GroupLaunch : public Launch {
 protected:
  GroupLaunch() {
    const std::string process = "{group: robot, restart_limit: 7}";
    plan_ = small_plan({}, {}, "{behaviour: turn_then_step, process: " + process + '}', process);
  }
};

TEST_F(GroupLaunch, MakesOneMemberOfAGroup) {
  layout_.external = {"sense"};

  auto members = list_members(plan_, layout_);

  ASSERT_EQ(members.size(), 2u);
  const Member& robot = *find_member(members, "robot");
  EXPECT_EQ(robot.stages, (Texts{"drive", "sense"}));
  EXPECT_TRUE(robot.starts_ticks);
  EXPECT_TRUE(robot.external);
  EXPECT_EQ(find_member(members, "control")->stages, Texts{"control"});
}

TEST_F(GroupLaunch, StartsTheGroupByItsNameAndTellsItsStages) {
  layout_.prefix["sense"] = "nice";
  auto members = list_members(plan_, layout_);
  Member& robot = *find_member(members, "robot");

  ASSERT_TRUE(launcher().start(robot).ok());
  const Assignment assignment = launcher().assignment_for(robot);
  const Assignment control = launcher().assignment_for(*find_member(members, "control"));

  EXPECT_EQ(started_.arguments[2], "exec nice \"$@\"");
  EXPECT_EQ(started_.arguments.back(), "robot");
  EXPECT_EQ(assignment.stages, (Texts{"drive", "sense"}));
  EXPECT_EQ(assignment.bundle.count("world.yaml"), 1u);
  EXPECT_EQ(assignment.peers, Texts{"control"});
  EXPECT_EQ(control.bundle.count("world.yaml"), 0u);
  EXPECT_EQ(control.peers, Texts{"robot"});
  end_now(*robot.child);
}

TEST_F(GroupLaunch, GoesOnFromTheCheckpointsOfItsStages) {
  auto members = list_members(plan_, layout_);
  Member& robot = *find_member(members, "robot");

  ProcessStart start;
  start.next_tick = 64;
  start.checkpoints = {{"drive", {64, "d", {}, {}}}, {"sense", {64, "s", {}, {}}}};
  robot.begin(start);

  const auto parts = unpack_checkpoints(*launcher().assignment_for(robot).checkpoint);
  ASSERT_TRUE(parts.ok()) << parts.error().text();
  EXPECT_EQ(parts->at("drive").node, "d");
  EXPECT_EQ(parts->at("sense").node, "s");
}

TEST_F(Launch, SaysWhatCannotBeStarted) {
  auto members = list_members(plan_, layout_);
  const Launcher real(plan_, layout_, 5, Spooling::kNothing);

  const auto started = real.start(*find_member(members, "sense"));

  ASSERT_FALSE(started.ok());
  EXPECT_NE(started.error().text().find("sense: "), std::string::npos);
  EXPECT_NE(started.error().text().find("No such file or directory"), std::string::npos);
}

}  // namespace
}  // namespace clew::bridge
