// SPDX-License-Identifier: Apache-2.0
#include "hosts/host_list.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <ostream>

#include "vendors/network_addresses.hpp"

namespace clew::bridge {
namespace {

class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& text)
      : path_(testing::TempDir() + "clew-hosts-" + std::to_string(::getpid()) + ".yaml") {
    std::ofstream(path_) << text;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

std::string refusal_of(const std::string& text) {
  const TemporaryFile file(text);
  const auto list = HostList::read(file.path());
  if (list.ok()) return "none";
  const std::string told = list.error().text();
  return told.substr(file.path().size() + 1);
}

TEST(HostList, SaysWhoIsWhere) {
  const TemporaryFile file(
      "identity: keys/desk.run\n"
      "here: 10.0.0.1\n"
      "hosts:\n"
      "  robot: 10.0.0.2:7000\n"
      "  arm: 10.0.0.3\n");

  const auto list = HostList::read(file.path());

  ASSERT_TRUE(list.ok()) << list.error().text();
  EXPECT_EQ(list->identity, testing::TempDir() + "keys/desk.run");
  EXPECT_EQ(list->find("robot")->text(), "10.0.0.2:7000");
  EXPECT_EQ(list->find("arm")->text(), "10.0.0.3:7447");
  EXPECT_EQ(list->find("robbot").error().text(),
            "unknown host 'robbot' (did you mean 'robot'?); allowed: arm, robot");
}

TEST(HostList, ComponentsMeetAtTheAddressesOfTheirHostsEachOnce) {
  HostList list;
  list.here = "10.0.0.1";
  list.hosts = {{"a", {"10.0.0.2", 1}}, {"b", {"10.0.0.3", 1}}, {"c", {"10.0.0.2", 2}}};

  EXPECT_EQ(*list.addresses({"a", "c"}), (std::vector<std::string>{"10.0.0.1", "10.0.0.2"}));
  EXPECT_FALSE(list.addresses({"d"}).ok());
}

TEST(HostList, TheOwnAddressIsThatWhichLeadsToTheOthers) {
  HostList list;
  list.hosts = {{"a", {"127.0.0.5", 1}}};

  EXPECT_EQ(*list.addresses({"a"}), (std::vector<std::string>{"127.0.0.1", "127.0.0.5"}));
}

TEST(HostList, AParticipantSpeaksAtTheAddressThatItsHostHas) {
  const auto network = network_of({"192.0.2.1", "127.0.0.1"});

  ASSERT_TRUE(network.ok());
  EXPECT_EQ((*network)->own, "127.0.0.1");
  EXPECT_EQ((*network)->peers.size(), 2u);
  EXPECT_FALSE(network_of({})->has_value());
  EXPECT_EQ(network_of({"192.0.2.1"}).error().text(),
            "no interface of this host that is up has one of the addresses of the run's hosts, "
            "192.0.2.1");
}

// They come with an assignment, maybe from another computer, and become part of XML.
TEST(HostList, AnAddressThatIsNoneIsRefusedAlsoBesideTheOwnOne) {
  const std::map<std::string, std::string> told_of = {
      {"10.0.0.2\"/>", "10.0.0.2\"/>"}, {std::string("10.0.0.2\0", 9), "10.0.0.2\\x00"}, {"", ""}};
  for (const auto& [bad, told] : told_of) {
    const auto network = network_of({"127.0.0.1", bad});

    ASSERT_FALSE(network.ok()) << bad;
    EXPECT_EQ(network.error().text(),
              "found '" + told + "'; allowed: an IPv4 address of a host of the run");
  }
}

struct Refused {
  std::string text;
  std::string fault;
};
std::ostream& operator<<(std::ostream& out, const Refused& one) { return out << one.fault; }

class BadHostList : public testing::TestWithParam<Refused> {};

TEST_P(BadHostList, IsRefusedWithItsPlace) {
  EXPECT_EQ(refusal_of(GetParam().text), GetParam().fault);
}

const std::string kAddressRule =
    "; allowed: an IPv4 address and a port from 0 to 65535, as 10.0.0.2:7447";

INSTANTIATE_TEST_SUITE_P(
    Each, BadHostList,
    testing::Values(
        Refused{"hosts: {a: 10.0.0.2}\n", "1:1: missing key 'identity'"},
        Refused{"identity: k\n", "1:1: missing key 'hosts'"},
        Refused{"identity: k\nhosts: {}\n", "2:8: expected at least one host"},
        Refused{"identity: k\nhost: {a: 10.0.0.2}\n",
                "2:1: unknown key 'host' (did you mean 'hosts'?); allowed: identity, here, hosts"},
        Refused{"identity: k\nhosts: {a: robot.local}\n",
                "2:12: found 'robot.local'" + kAddressRule},
        Refused{"identity: k\nhosts: {a: 10.0.0.2:70000}\n",
                "2:12: found '10.0.0.2:70000'" + kAddressRule},
        Refused{"identity: k\nhosts: {a: '10.0.0.2:'}\n", "2:12: found '10.0.0.2:'" + kAddressRule},
        Refused{"identity: k\nhosts: {a: 10.0.0.2:0}\n",
                "2:12: found '10.0.0.2:0'; allowed: a port from 1 to 65535"},
        Refused{"identity: k\nhosts: {here: 10.0.0.2}\n",
                "2:9: host is 'here'; allowed: another name, since 'here' is this host"},
        Refused{"identity: k\nhosts: {-a: 10.0.0.2}\n",
                "2:9: host is '-a'; allowed: up to 48 letters, digits, '-', '.' and '_', the first "
                "no '-'"},
        Refused{"identity: k\nhere: desk\nhosts: {a: 10.0.0.2}\n",
                "2:7: here is 'desk'; allowed: an IPv4 address of this host"}));

}  // namespace
}  // namespace clew::bridge
