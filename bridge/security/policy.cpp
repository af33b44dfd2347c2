// SPDX-License-Identifier: Apache-2.0
#include "security/policy.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <tinyxml2.h>

#include <cstring>
#include <ctime>
#include <set>

namespace clew::bridge {
namespace {

using core::Error;
using core::Result;
using tinyxml2::XMLElement;

constexpr char kHead[] =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<dds xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" "
    "xsi:noNamespaceSchemaLocation=\"http://www.omg.org/spec/DDS-Security/20170901/"
    "omg_shared_ca_{}.xsd\">\n";

/// All domains: Cyclone DDS asks for a number of its own, not the one on the wire.
constexpr char kAllDomains[] = "<domains><id_range><min>0</min><max>230</max></id_range></domains>";

constexpr char kTimeFormat[] = "%Y-%m-%dT%H:%M:%S";

/// A setting of a governance document, and what is strong enough.
struct Setting {
  const char* element;
  std::set<std::string> allowed;
};

const std::vector<Setting>& domain_settings() {
  static const std::vector<Setting> kSettings = {
      {"allow_unauthenticated_participants", {"false", "FALSE", "0"}},
      {"enable_join_access_control", {"true", "TRUE", "1"}},
      {"discovery_protection_kind", {"ENCRYPT"}},
      {"liveliness_protection_kind", {"ENCRYPT"}}};
  return kSettings;
}

const std::vector<Setting>& topic_settings() {
  static const std::vector<Setting> kSettings = {
      {"enable_discovery_protection", {"true", "TRUE", "1"}},
      {"enable_liveliness_protection", {"true", "TRUE", "1"}},
      {"enable_read_access_control", {"true", "TRUE", "1"}},
      {"enable_write_access_control", {"true", "TRUE", "1"}},
      {"metadata_protection_kind", {"SIGN", "ENCRYPT"}},
      {"data_protection_kind", {"ENCRYPT"}}};
  return kSettings;
}

std::string text_of(const XMLElement* element) {
  const char* const text = element != nullptr ? element->GetText() : nullptr;
  if (text == nullptr) return {};
  const std::string all(text);
  const auto first = all.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return {};
  return all.substr(first, all.find_last_not_of(" \t\r\n") - first + 1);
}

std::string text_of(const XMLElement& parent, const char* element) {
  return text_of(parent.FirstChildElement(element));
}

/// The first setting that is not strong enough.
std::string weakness_in(const XMLElement& rule, const std::vector<Setting>& settings) {
  for (const Setting& setting : settings) {
    const std::string found = text_of(rule, setting.element);
    if (setting.allowed.count(found) > 0) continue;
    return fmt::format("{} is '{}'; allowed: {}", setting.element, found,
                       *setting.allowed.rbegin());
  }
  return {};
}

std::string weakness_of_topics(const XMLElement& domain_rule) {
  const XMLElement* const rules = domain_rule.FirstChildElement("topic_access_rules");
  bool covers_all = false;
  const XMLElement* rule = rules != nullptr ? rules->FirstChildElement("topic_rule") : nullptr;
  for (; rule != nullptr; rule = rule->NextSiblingElement("topic_rule")) {
    if (std::string weakness = weakness_in(*rule, topic_settings()); !weakness.empty()) {
      return weakness;
    }
    covers_all = covers_all || text_of(*rule, "topic_expression") == "*";
  }
  return covers_all ? "" : "has no topic_rule for '*'";
}

std::string time_text(std::time_t time) {
  return fmt::format(fmt::runtime(std::string("{:") + kTimeFormat + '}'), fmt::gmtime(time));
}

Result<std::time_t> read_time(const XMLElement& grant, const char* element) {
  const XMLElement* const validity = grant.FirstChildElement("validity");
  const std::string text = validity != nullptr ? text_of(*validity, element) : std::string();
  std::tm parts{};
  const char* const end = ::strptime(text.c_str(), kTimeFormat, &parts);
  if (end == nullptr || (*end != '\0' && std::strcmp(end, "Z") != 0)) {
    return Error{
        fmt::format("{} is '{}'; expected a time such as 2026-11-28T00:00:00", element, text), {}};
  }
  return ::timegm(&parts);
}

std::string topics_text(const char* element, const std::set<std::string>& topics) {
  if (topics.empty()) return {};
  std::string text = fmt::format("<{}><topics>", element);
  for (const std::string& topic : topics) text += fmt::format("<topic>{}</topic>", topic);
  return text + fmt::format("</topics></{}>\n", element);
}

void add_topics(const XMLElement& rule, const char* element, std::set<std::string>& topics) {
  for (const XMLElement* one = rule.FirstChildElement(element); one != nullptr;
       one = one->NextSiblingElement(element)) {
    const XMLElement* const list = one->FirstChildElement("topics");
    const XMLElement* topic = list != nullptr ? list->FirstChildElement("topic") : nullptr;
    for (; topic != nullptr; topic = topic->NextSiblingElement("topic")) {
      topics.insert(text_of(topic));
    }
  }
}

Result<Grant> read_grant(const XMLElement& element) {
  Grant grant;
  grant.subject = text_of(element, "subject_name");
  const auto not_before = read_time(element, "not_before");
  if (!not_before.ok()) return not_before.error();
  const auto not_after = read_time(element, "not_after");
  if (!not_after.ok()) return not_after.error();
  grant.validity = {*not_before, *not_after};
  if (element.FirstChildElement("deny_rule") != nullptr) {
    return Error{"has a deny_rule; allowed: allow_rule", {}};
  }
  for (const XMLElement* rule = element.FirstChildElement("allow_rule"); rule != nullptr;
       rule = rule->NextSiblingElement("allow_rule")) {
    add_topics(*rule, "publish", grant.rights.writes);
    add_topics(*rule, "subscribe", grant.rights.reads);
  }
  const std::string rest = text_of(element, "default");
  if (rest != "DENY") return Error{"default is '" + rest + "'; allowed: DENY", {}};
  return grant;
}

}  // namespace

std::string governance_text() {
  return fmt::format(kHead, "governance") +
         fmt::format(
             "<domain_access_rules><domain_rule>\n{}\n"
             "<allow_unauthenticated_participants>false</allow_unauthenticated_participants>\n"
             "<enable_join_access_control>true</enable_join_access_control>\n"
             "<discovery_protection_kind>ENCRYPT</discovery_protection_kind>\n"
             "<liveliness_protection_kind>ENCRYPT</liveliness_protection_kind>\n"
             "<rtps_protection_kind>NONE</rtps_protection_kind>\n"
             "<topic_access_rules><topic_rule>\n"
             "<topic_expression>*</topic_expression>\n"
             "<enable_discovery_protection>true</enable_discovery_protection>\n"
             "<enable_liveliness_protection>true</enable_liveliness_protection>\n"
             "<enable_read_access_control>true</enable_read_access_control>\n"
             "<enable_write_access_control>true</enable_write_access_control>\n"
             "<metadata_protection_kind>SIGN</metadata_protection_kind>\n"
             "<data_protection_kind>ENCRYPT</data_protection_kind>\n"
             "</topic_rule></topic_access_rules>\n"
             "</domain_rule></domain_access_rules></dds>\n",
             kAllDomains);
}

std::string governance_weakness(const std::string& text) {
  tinyxml2::XMLDocument document;
  if (document.Parse(text.c_str(), text.size()) != tinyxml2::XML_SUCCESS) return "is no XML";
  const XMLElement* const root = document.FirstChildElement("dds");
  const XMLElement* const rules =
      root != nullptr ? root->FirstChildElement("domain_access_rules") : nullptr;
  const XMLElement* rule = rules != nullptr ? rules->FirstChildElement("domain_rule") : nullptr;
  if (rule == nullptr) return "has no domain_rule";
  for (; rule != nullptr; rule = rule->NextSiblingElement("domain_rule")) {
    std::string weakness = weakness_in(*rule, domain_settings());
    if (weakness.empty()) weakness = weakness_of_topics(*rule);
    if (!weakness.empty()) return weakness;
  }
  return {};
}

std::string permissions_text(const Grant& grant) {
  return fmt::format(kHead, "permissions") +
         fmt::format(
             "<permissions><grant name=\"{}\">\n<subject_name>{}</subject_name>\n"
             "<validity><not_before>{}</not_before><not_after>{}</not_after></validity>\n"
             "<allow_rule>\n{}\n{}{}</allow_rule>\n<default>DENY</default>\n"
             "</grant></permissions></dds>\n",
             grant.subject, grant.subject, time_text(grant.validity.not_before),
             time_text(grant.validity.not_after), kAllDomains,
             topics_text("publish", grant.rights.writes),
             topics_text("subscribe", grant.rights.reads));
}

Result<std::vector<Grant>> read_permissions(const std::string& text) {
  tinyxml2::XMLDocument document;
  if (document.Parse(text.c_str(), text.size()) != tinyxml2::XML_SUCCESS) {
    return Error{"is no XML", {}};
  }
  const XMLElement* const root = document.FirstChildElement("dds");
  const XMLElement* const all = root != nullptr ? root->FirstChildElement("permissions") : nullptr;
  const XMLElement* element = all != nullptr ? all->FirstChildElement("grant") : nullptr;
  std::vector<Grant> grants;
  for (; element != nullptr; element = element->NextSiblingElement("grant")) {
    auto grant = read_grant(*element);
    if (!grant.ok()) return grant.error();
    grants.push_back(std::move(grant).value());
  }
  return grants;
}

}  // namespace clew::bridge
