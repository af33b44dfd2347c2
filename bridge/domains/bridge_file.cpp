// SPDX-License-Identifier: Apache-2.0
#include "domains/bridge_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/nearest_name.hpp"
#include "core/yaml_fields.hpp"
#include "core/yaml_reader.hpp"
#include "dds/rtps_ports.hpp"
#include "line/command_desk.hpp"

namespace clew::domains {
namespace {

using core::Error;
using core::Result;
using core::YamlNode;

constexpr char kFormat[] = "clew-bridge/1";
constexpr std::int64_t kMostDepth = 10000;
constexpr double kMost_hz = 1e6;

std::size_t stars_in(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '*'));
}

/// The text of a key; none if it is missing.
Result<std::optional<std::string>> text_at(const YamlNode& map, const char* key) {
  const auto node = map.find(key);
  if (!node) return std::optional<std::string>();
  auto text = node->string();
  if (!text.ok()) return text.error();
  if (text->empty()) return node->error("found an empty text");
  return std::optional<std::string>(std::move(text).value());
}

Result<JoinedDomain> read_domain(const YamlNode::Entry& entry) {
  const YamlNode& node = entry.value;
  CLEW_RETURN_IF_ERROR(node.check_keys({"domain", "run", "middleware", "network"}));
  JoinedDomain joined;
  joined.name = entry.key;
  const auto number = text_at(node, "domain");
  if (!number.ok()) return number.error();
  const auto run = text_at(node, "run");
  if (!run.ok()) return run.error();
  if (number->has_value() == run->has_value()) {
    return node.error("expected a 'domain' or a 'run', one of the two");
  }
  joined.run = *number ? **number : **run;
  if (*number) {
    const YamlNode place = *node.find("domain");
    if (!bridge::is_domain_number(joined.run)) {
      return place.error(
          fmt::format("found '{}'; allowed: 0 to {}", joined.run, bridge::kMaxDomain));
    }
    const auto good = bridge::check_domain(std::stoi(joined.run));
    if (!good.ok()) return place.error(good.error().message);
  }
  const auto middleware = text_at(node, "middleware");
  if (!middleware.ok()) return middleware.error();
  if (*middleware) {
    const auto vendor = bridge::vendor_from_name(**middleware);
    if (!vendor) {
      return node.find("middleware")
          ->error("found '" + **middleware + "'; allowed: cyclonedds, fastdds");
    }
    joined.vendor = *vendor;
  }
  if (const auto network = node.find("network")) {
    const auto value = network->boolean();
    if (!value.ok()) return value.error();
    joined.on_network = *value;
  }
  return joined;
}

Result<void> read_domains(const YamlNode& root, BridgeFile& file) {
  const auto node = root.at("domains");
  if (!node.ok()) return node.error();
  const auto entries = node->entries();
  if (!entries.ok()) return entries.error();
  for (const YamlNode::Entry& entry : *entries) {
    auto joined = read_domain(entry);
    if (!joined.ok()) return joined.error();
    for (const JoinedDomain& other : file.domains) {
      if (other.run == joined->run && other.on_network == joined->on_network) {
        return entry.value.error(
            fmt::format("'{}' and '{}' are the same domain", other.name, joined->name));
      }
    }
    file.domains.push_back(std::move(joined).value());
  }
  if (file.domains.size() < 2) return node->error("expected at least two domains");
  return {};
}

/// The place of a domain in the file, by its name.
Result<std::size_t> find_domain(const YamlNode& node, const BridgeFile& file) {
  const auto name = node.string();
  if (!name.ok()) return name.error();
  std::vector<std::string> names;
  for (std::size_t i = 0; i < file.domains.size(); ++i) {
    if (file.domains[i].name == *name) return i;
    names.push_back(file.domains[i].name);
  }
  return node.error(core::unknown_name("domain", *name, names));
}

Result<void> read_ends(const YamlNode& node, const BridgeFile& file, TopicRule& rule) {
  const auto from_node = node.at("from");
  if (!from_node.ok()) return from_node.error();
  const auto from = find_domain(*from_node, file);
  if (!from.ok()) return from.error();
  rule.from = *from;
  const auto to_node = node.at("to");
  if (!to_node.ok()) return to_node.error();
  std::vector<YamlNode> targets = {*to_node};
  if (to_node->kind() == core::YamlKind::kList) targets = *to_node->items();
  if (targets.empty()) return to_node->error("the list is empty; expected at least one domain");
  for (const YamlNode& target : targets) {
    const auto to = find_domain(target, file);
    if (!to.ok()) return to.error();
    if (*to == rule.from) return target.error("that is where the topic comes from");
    if (std::find(rule.to.begin(), rule.to.end(), *to) != rule.to.end()) {
      return target.error("it stands twice in the list");
    }
    rule.to.push_back(*to);
  }
  return {};
}

Result<void> read_names(const YamlNode& node, TopicRule& rule) {
  const auto topic_node = node.at("topic");
  if (!topic_node.ok()) return topic_node.error();
  const auto topic = text_at(node, "topic");
  if (!topic.ok()) return topic.error();
  rule.topic = **topic;
  if (stars_in(rule.topic) > 1) return topic_node->error("at most one '*' is allowed");
  const auto as = text_at(node, "as");
  if (!as.ok()) return as.error();
  rule.as = as->value_or(rule.topic);
  if (stars_in(rule.as) != stars_in(rule.topic)) {
    return node.find("as")->error("it needs a '*' where the topic has one, and none otherwise");
  }
  const auto type = text_at(node, "type");
  if (!type.ok()) return type.error();
  rule.type = type->value_or("");
  return {};
}

Result<void> read_where(const YamlNode& node, TopicRule& rule) {
  std::vector<YamlNode> items = {node};
  if (node.kind() == core::YamlKind::kList) items = *node.items();
  for (const YamlNode& item : items) {
    const auto text = item.string();
    if (!text.ok()) return text.error();
    auto condition = Condition::parse(*text);
    if (!condition.ok()) return item.error(condition.error().message);
    if (!rule.type.empty()) {
      const auto good = condition->check(rule.type);
      if (!good.ok()) return item.error(good.error().message);
    }
    rule.where.push_back(std::move(condition).value());
  }
  return {};
}

Result<void> read_limits(const YamlNode& node, TopicRule& rule) {
  if (const auto rate = node.find("rate_hz")) {
    const auto value = rate->number();
    if (!value.ok()) return value.error();
    if (*value <= 0.0 || *value > kMost_hz) {
      return rate->error(fmt::format("found {}; allowed: above 0, up to {}", *value, kMost_hz));
    }
    rule.rate_hz = *value;
  }
  if (const auto depth = node.find("depth")) {
    const auto value = depth->integer();
    if (!value.ok()) return value.error();
    if (*value < 1 || *value > kMostDepth) {
      return depth->error(fmt::format("found {}; allowed: 1 to {}", *value, kMostDepth));
    }
    rule.depth = static_cast<int>(*value);
  }
  const auto reliability = text_at(node, "reliability");
  if (!reliability.ok()) return reliability.error();
  if (!*reliability) return {};
  if (**reliability != "copied" && **reliability != "best_effort") {
    return node.find("reliability")
        ->error("found '" + **reliability + "'; allowed: copied, best_effort");
  }
  rule.best_effort = **reliability == "best_effort";
  return {};
}

Result<TopicRule> read_rule(const YamlNode& node, const BridgeFile& file) {
  CLEW_RETURN_IF_ERROR(node.check_keys(
      {"topic", "from", "to", "as", "type", "rate_hz", "where", "depth", "reliability"}));
  TopicRule rule;
  CLEW_RETURN_IF_ERROR(read_names(node, rule));
  CLEW_RETURN_IF_ERROR(read_ends(node, file, rule));
  if (const auto where = node.find("where")) CLEW_RETURN_IF_ERROR(read_where(*where, rule));
  CLEW_RETURN_IF_ERROR(read_limits(node, rule));
  return rule;
}

bool is_same_way(const TopicRule& a, const TopicRule& b) {
  return a.from == b.from && a.topic == b.topic && a.as == b.as && a.type == b.type &&
         std::find_first_of(a.to.begin(), a.to.end(), b.to.begin(), b.to.end()) != a.to.end();
}

}  // namespace

std::optional<std::string> TopicRule::renamed(const std::string& found) const {
  const std::size_t star = topic.find('*');
  if (star == std::string::npos) return found == topic ? std::optional(as) : std::nullopt;
  const std::string head = topic.substr(0, star);
  const std::string tail = topic.substr(star + 1);
  if (found.size() < head.size() + tail.size() || found.compare(0, head.size(), head) != 0 ||
      found.compare(found.size() - tail.size(), tail.size(), tail) != 0) {
    return std::nullopt;
  }
  const std::string middle = found.substr(star, found.size() - head.size() - tail.size());
  std::string name = as;
  return name.replace(name.find('*'), 1, middle);
}

Result<BridgeFile> read_bridge_file(const core::Resource& resource) {
  const auto root = YamlNode::parse(resource.text, resource.file);
  if (!root.ok()) return root.error();
  CLEW_RETURN_IF_ERROR(core::check_format(*root, kFormat));
  CLEW_RETURN_IF_ERROR(root->check_keys({"format", "domains", "topics"}));
  BridgeFile file;
  CLEW_RETURN_IF_ERROR(read_domains(*root, file));
  const auto topics = root->at("topics");
  if (!topics.ok()) return topics.error();
  const auto items = topics->items();
  if (!items.ok()) return items.error();
  if (items->empty()) return topics->error("the list is empty; expected at least one topic");
  for (const YamlNode& item : *items) {
    auto rule = read_rule(item, file);
    if (!rule.ok()) return rule.error();
    for (const TopicRule& other : file.rules) {
      if (is_same_way(other, *rule)) return item.error("that is asked for twice");
    }
    file.rules.push_back(std::move(rule).value());
  }
  return file;
}

}  // namespace clew::domains
