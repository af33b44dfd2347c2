// SPDX-License-Identifier: Apache-2.0
#include "hosts/host_list.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include "core/nearest_name.hpp"
#include "core/yaml_reader.hpp"
#include "hosts/tcp_socket.hpp"
#include "runtime/graph.hpp"

namespace clew::bridge {
namespace {

using core::Error;
using core::Result;
using core::YamlNode;

bool is_ipv4(const std::string& text) {
  in_addr address{};
  return ::inet_pton(AF_INET, text.c_str(), &address) == 1;
}

Result<std::string> read_text(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return Error{"cannot be read", path};
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

Result<void> read_hosts(const YamlNode& root, HostList& list) {
  const auto node = root.at("hosts");
  if (!node.ok()) return node.error();
  const auto entries = node->entries();
  if (!entries.ok()) return entries.error();
  for (const YamlNode::Entry& entry : *entries) {
    if (!runtime::is_host_name(entry.key)) {
      return entry.key_node.error("host is '" + entry.key +
                                  "'; allowed: " + runtime::kHostNameRule);
    }
    if (entry.key == "here") {
      return entry.key_node.error(
          "host is 'here'; allowed: another name, since 'here' is this host");
    }
    const auto text = entry.value.string();
    if (!text.ok()) return text.error();
    const auto address = read_tcp_address(*text);
    if (!address.ok()) return entry.value.error(address.error().message);
    if (address->port == 0) {
      return entry.value.error("found '" + *text + "'; allowed: a port from 1 to 65535");
    }
    list.hosts.emplace(entry.key, *address);
  }
  if (list.hosts.empty()) return node->error("expected at least one host");
  return {};
}

}  // namespace

Result<TcpAddress> read_tcp_address(const std::string& text) {
  const std::size_t colon = text.find(':');
  TcpAddress result{text.substr(0, colon), kHostPort};
  const Error refused{"found '" + text +
                      "'; allowed: an IPv4 address and a port from 0 to 65535, " +
                      "as 10.0.0.2:" + std::to_string(kHostPort)};
  if (!is_ipv4(result.address)) return refused;
  if (colon == std::string::npos) return result;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + colon + 1, end, result.port);
  if (error != std::errc() || stop != end) return refused;
  return result;
}

Result<HostList> HostList::read(const std::string& path) {
  const auto text = read_text(path);
  if (!text.ok()) return text.error();
  const auto root = YamlNode::parse(*text, path);
  if (!root.ok()) return root.error();
  CLEW_RETURN_IF_ERROR(root->check_keys({"identity", "here", "hosts"}));
  HostList list;
  const auto identity = root->at("identity");
  if (!identity.ok()) return identity.error();
  const auto folder = identity->string();
  if (!folder.ok()) return folder.error();
  if (folder->empty()) return identity->error("found an empty text; expected a directory");
  list.identity = (std::filesystem::path(path).parent_path() / *folder).string();
  if (const auto here = root->find("here")) {
    const auto address = here->string();
    if (!address.ok()) return address.error();
    if (!is_ipv4(*address)) {
      return here->error("here is " + here->found() + "; allowed: an IPv4 address of this host");
    }
    list.here = *address;
  }
  CLEW_RETURN_IF_ERROR(read_hosts(*root, list));
  return list;
}

Result<TcpAddress> HostList::find(const std::string& host) const {
  const auto found = hosts.find(host);
  if (found != hosts.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& [name, address] : hosts) known.push_back(name);
  return Error{core::unknown_name("host", host, known)};
}

Result<std::vector<std::string>> HostList::addresses(const std::vector<std::string>& used) const {
  std::vector<std::string> all = {here};
  for (const std::string& host : used) {
    const auto found = find(host);
    if (!found.ok()) return found.error();
    if (all.front().empty()) {
      const auto own = address_towards(*found);
      if (!own.ok()) return own.error();
      all.front() = *own;
    }
    if (std::count(all.begin(), all.end(), found->address) == 0) all.push_back(found->address);
  }
  return all;
}

}  // namespace clew::bridge
