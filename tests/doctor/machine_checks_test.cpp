// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "doctor/doctor.hpp"

namespace clew::doctor {
namespace {

namespace fs = std::filesystem;

/// A place that looks like /proc, with what a test puts there.
class MachineChecks : public ::testing::Test {
 protected:
  MachineChecks()
      : root_(fs::path(::testing::TempDir()) /
              (std::string("clew_doctor_") +
               ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(root_ / "sys/net/ipv4");
    fs::create_directories(root_ / "sys/net/core");
  }
  ~MachineChecks() override { fs::remove_all(root_); }

  void put(const std::string& file, const std::string& text) {
    std::ofstream(root_ / file) << text;
  }

  Finding found(const std::string& check) {
    const auto findings = check_machine({root_.string(), shared_memory_});
    const auto one = std::find_if(findings.begin(), findings.end(),
                                  [&](const Finding& each) { return each.check == check; });
    return one == findings.end() ? Finding{"none", false, "no such check", ""} : *one;
  }

  fs::path root_;
  std::string shared_memory_ = "/tmp";
};

TEST_F(MachineChecks, WhatIsGoodNeedsNoFix) {
  put("sys/net/ipv4/ip_local_port_range", "32768\t60999\n");
  put("sys/net/core/rmem_max", "212992\n");

  for (const Finding& each : check_machine({root_.string(), shared_memory_})) {
    EXPECT_TRUE(each.ok) << each.check << ": " << each.found;
    EXPECT_FALSE(each.found.empty()) << each.check;
    EXPECT_TRUE(each.fix.empty()) << each.check;
  }
}

TEST_F(MachineChecks, PortsOfDomainsMayNotBeHandedOut) {
  put("sys/net/ipv4/ip_local_port_range", "10000 60999");
  const Finding overlapping = found("ports");
  put("sys/net/ipv4/ip_local_port_range", "32400 60999");
  const Finding apart = found("ports");

  EXPECT_FALSE(overlapping.ok);
  EXPECT_EQ(overlapping.found,
            "the kernel hands out 10000 to 60999; domains 0 to 99 use 7400 to 32399");
  EXPECT_NE(overlapping.fix.find("net.ipv4.ip_local_port_range"), std::string::npos);
  EXPECT_TRUE(apart.ok);
}

TEST_F(MachineChecks, SmallSocketBuffersAreTold) {
  put("sys/net/core/rmem_max", "65536");

  const Finding finding = found("socket_buffers");

  EXPECT_FALSE(finding.ok);
  EXPECT_EQ(finding.found, "a socket may buffer 65536 bytes");
  EXPECT_EQ(finding.fix, "sysctl -w net.core.rmem_max=212992");
}

TEST_F(MachineChecks, WhatTheKernelDoesNotSayIsNoFault) {
  EXPECT_TRUE(found("ports").ok);
  EXPECT_TRUE(found("socket_buffers").ok);
}

TEST_F(MachineChecks, SharedMemoryThatIsNotThereIsTold) {
  shared_memory_ = (root_ / "nowhere").string();

  const Finding finding = found("shared_memory");

  EXPECT_FALSE(finding.ok);
  EXPECT_EQ(finding.found, shared_memory_ + " is not there or cannot be written");
}

}  // namespace
}  // namespace clew::doctor
