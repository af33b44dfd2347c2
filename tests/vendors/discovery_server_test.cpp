// SPDX-License-Identifier: Apache-2.0
/// What Fast DDS's discovery server can do for a secured run, with the program itself:
/// docs/hosts.md says why runs over hosts do without it, and this is what that rests on.
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "fastdds/security_properties.hpp"
#include "recording_listeners.hpp"
#include "security/run_security.hpp"
#include "test_domain.hpp"
#include "vendors/participant_factory.hpp"

namespace clew::bridge {
namespace {

constexpr char kServerProgram[] = "fast-discovery-server";
/// Two clients meet in a tenth of it.
constexpr std::chrono::seconds kNeverMeet{4};

/// Fast DDS's own program, on 127.0.0.1, while this lives.
class DiscoveryServer {
 public:
  /// `more` are options of its own.
  DiscoveryServer(int port, const std::vector<std::string>& more) {
    std::vector<std::string> words = {kServerProgram,      "-i", "0", "-l", "127.0.0.1", "-p",
                                      std::to_string(port)};
    words.insert(words.end(), more.begin(), more.end());
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    if (posix_spawnp(&pid_, kServerProgram, nullptr, nullptr, arguments.data(), environ) != 0) {
      pid_ = -1;
    }
  }
  ~DiscoveryServer() {
    if (pid_ <= 0) return;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  DiscoveryServer(const DiscoveryServer&) = delete;
  DiscoveryServer& operator=(const DiscoveryServer&) = delete;

  bool runs() const { return pid_ > 0 && waitpid(pid_, nullptr, WNOHANG) == 0; }

 private:
  pid_t pid_ = -1;
};

/// A participant with what it is told.
struct Peer {
  DiscoveryRecord discovery;
  SampleRecord samples;
  std::unique_ptr<Participant> participant;
  std::unique_ptr<SampleWriter> writer;
  std::unique_ptr<SampleReader> reader;

  void join(int domain, const std::string& name, const std::optional<SecurityFiles>& security) {
    auto joined =
        create_participant(Vendor::kFastDds, {domain, name, 1.5, {}, false, security}, discovery);
    ASSERT_TRUE(joined.ok()) << joined.error().text();
    participant = std::move(joined).value();
  }
};

class DiscoveryServerTest : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v fast-discovery-server >/dev/null") != 0) {
      GTEST_SKIP() << "no " << kServerProgram << " (package fastdds-tools)";
    }
    // The first participant of a process takes the variable out of the environment: those that come
    // later find it, and are the server's clients.
    Peer first;
    first.join(domain_.number(), "first", std::nullopt);
    setenv("ROS_DISCOVERY_SERVER", ("127.0.0.1:" + std::to_string(port())).c_str(), 1);
  }
  void TearDown() override { unsetenv("ROS_DISCOVERY_SERVER"); }

  void open_pair(const RunSecurity::Shared& security) {
    const auto identity = [&](const char* name) {
      return security ? std::optional(security->files(name, Vendor::kFastDds)) : std::nullopt;
    };
    const EndpointSpec spec{"scan", "clew::msg::Scan", "clew_idl=1;", 8};
    writer_.join(domain_.number(), "writer", identity("writer"));
    reader_.join(domain_.number(), "reader", identity("reader"));
    auto writer = writer_.participant->create_writer(spec);
    auto reader = reader_.participant->create_reader(spec, reader_.samples);
    ASSERT_TRUE(writer.ok() && reader.ok());
    writer_.writer = std::move(writer).value();
    reader_.reader = std::move(reader).value();
  }
  void expect_that_they_never_meet() {
    std::this_thread::sleep_for(kNeverMeet);
    EXPECT_EQ(writer_.discovery.events().matched.size(), 0u);
    EXPECT_EQ(reader_.discovery.events().matched.size(), 0u);
  }

  static RunSecurity::Shared mint() {
    const std::vector<Vendor> fast = {Vendor::kFastDds};
    const auto minted = RunSecurity::mint({{"writer", fast, {{"scan"}, {}}},
                                           {"reader", fast, {{}, {"scan"}}},
                                           {"server", fast, {{}, {}}}});
    EXPECT_TRUE(minted.ok()) << minted.error().text();
    return *minted;
  }

  /// The server's: of this domain alone, since tests run side by side, and below those of DDS.
  int port() const { return 5100 + domain_.number(); }

  TestDomain domain_;
  Peer writer_;
  Peer reader_;
};

TEST_F(DiscoveryServerTest, OpenClientsMeetThroughIt) {
  const DiscoveryServer server(port(), {});
  open_pair(nullptr);
  EXPECT_TRUE(writer_.discovery.wait_for_matches(1));
  EXPECT_TRUE(reader_.discovery.wait_for_matches(1));
}

TEST_F(DiscoveryServerTest, OpenClientsDoNotMeetWithoutIt) {
  open_pair(nullptr);
  expect_that_they_never_meet();
}

TEST_F(DiscoveryServerTest, SecuredClientsDoNotMeetThroughAnOpenOne) {
  const DiscoveryServer server(port(), {});
  open_pair(mint());
  expect_that_they_never_meet();
  EXPECT_TRUE(server.runs());
}

/// It takes its GUID from its certificate, and so is not the one that the variable names.
TEST_F(DiscoveryServerTest, SecuredClientsDoNotMeetThroughASecuredOne) {
  const auto security = mint();
  std::string properties;
  for (const auto& [name, value] :
       fastdds_security_properties(security->files("server", Vendor::kFastDds))) {
    properties += "<property><name>" + name + "</name><value>" + value + "</value></property>";
  }
  const std::string profile =
      testing::TempDir() + "clew-discovery-server-" + std::to_string(getpid()) + ".xml";
  std::ofstream(profile)
      << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<profiles xmlns=\"http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles\">"
         "<participant profile_name=\"server\" is_default_profile=\"true\"><domainId>"
      << domain_.number()
      << "</domainId><rtps><prefix>44.53.00.5f.45.50.52.4f.53.49.4d.41</prefix>"
         "<builtin><discovery_config><discoveryProtocol>SERVER</discoveryProtocol>"
         "</discovery_config></builtin><propertiesPolicy><properties>"
      << properties << "</properties></propertiesPolicy></rtps></participant></profiles>";
  const DiscoveryServer server(port(), {"-x", profile});
  open_pair(security);
  expect_that_they_never_meet();
  EXPECT_TRUE(server.runs());
  std::remove(profile.c_str());
}

}  // namespace
}  // namespace clew::bridge
