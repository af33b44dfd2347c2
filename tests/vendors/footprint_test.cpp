// SPDX-License-Identifier: Apache-2.0
/// What participants leave on the host: nothing on other interfaces, nothing in shared memory.
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <filesystem>
#include <set>
#include <string>

#include "recording_listeners.hpp"
#include "test_domain.hpp"
#include "vendors/participant_factory.hpp"

namespace clew::bridge {
namespace {

/// The UDP sockets of this process that can hear or speak beyond the loopback interface, each as
/// `address:port`.
std::set<std::string> sockets_beyond_loopback() {
  std::set<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    const int fd = std::stoi(entry.path().filename());
    sockaddr_in address{};
    socklen_t size = sizeof address;
    int type = 0;
    socklen_t type_size = sizeof type;
    if (getsockopt(fd, SOL_SOCKET, SO_TYPE, &type, &type_size) != 0 || type != SOCK_DGRAM) continue;
    if (getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size) != 0) continue;
    if (address.sin_family != AF_INET && address.sin_family != AF_INET6) continue;
    if (address.sin_port == 0) continue;  // bound to nothing: it cannot hear, and has not spoken
    char device[16] = "";
    socklen_t device_size = sizeof device;
    getsockopt(fd, SOL_SOCKET, SO_BINDTODEVICE, device, &device_size);
    const bool is_loopback =
        address.sin_family == AF_INET &&
        (ntohl(address.sin_addr.s_addr) == INADDR_LOOPBACK || std::string(device) == "lo");
    if (!is_loopback) {
      found.insert(std::to_string(ntohl(address.sin_addr.s_addr)) + ":" +
                   std::to_string(ntohs(address.sin_port)));
    }
  }
  return found;
}

std::set<std::string> shared_memory_files() {
  std::set<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator("/dev/shm")) {
    files.insert(entry.path().filename());
  }
  return files;
}

class Footprint : public testing::TestWithParam<Vendor> {};

INSTANTIATE_TEST_SUITE_P(BothVendors, Footprint,
                         testing::Values(Vendor::kCycloneDds, Vendor::kFastDds),
                         [](const auto& instance) {
                           return std::string(vendor_name(instance.param));
                         });

TEST_P(Footprint, IsOnTheLoopbackInterfaceAndNotInSharedMemory) {
  TestDomain domain;
  const std::set<std::string> sockets_before = sockets_beyond_loopback();
  const std::set<std::string> files_before = shared_memory_files();
  DiscoveryRecord discovery;
  SampleRecord samples;
  const auto first = create_participant(GetParam(), {domain.number(), "first", 1.5}, discovery);
  const auto second = create_participant(GetParam(), {domain.number(), "second", 1.5}, discovery);
  ASSERT_TRUE(first.ok() && second.ok());
  const EndpointSpec spec{"scan", "clew::msg::Scan", "", 8};
  const auto writer = (*first)->create_writer(spec);
  const auto reader = (*second)->create_reader(spec, samples);
  ASSERT_TRUE(writer.ok() && reader.ok());
  ASSERT_EQ((*writer)->write(std::string("\x00\x01\x00\x00", 4) + "data"), WriteStatus::kTaken);
  ASSERT_TRUE(samples.wait_for(1));

  EXPECT_EQ(sockets_beyond_loopback(), sockets_before);
  EXPECT_EQ(shared_memory_files(), files_before);
}

}  // namespace
}  // namespace clew::bridge
