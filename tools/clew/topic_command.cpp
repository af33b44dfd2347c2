// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/json_line.hpp"
#include "clew/print_text.hpp"
#include "clew/topic_options.hpp"
#include "clew/topic_reading.hpp"
#include "core/nearest_name.hpp"
#include "core/terminal_text.hpp"
#include "line/user_data.hpp"

namespace clew::tools {
namespace {

using bridge::RemoteEndpoint;
using core::Error;
using core::Result;
using nlohmann::ordered_json;

struct ListOptions : TopicOptions {
  bool show_types = false;
  bool count = false;
  bool verbose = false;
};

ordered_json topic_json(const TopicOnWire& topic) {
  return {{"topic", topic.name},
          {"type", topic.type},
          {"writers", topic.writers.size()},
          {"readers", topic.readers.size()}};
}

/// Why a list is empty, where it is.
int complain_of_silence(const bridge::DomainWatch& watch) {
  return complain({fmt::format("nobody is on domain {}: 'clew run ... --domain {}' starts a run "
                               "there; only participants of this host on 127.0.0.1 are found, and "
                               "none of a run with --secure",
                               watch.domain(), watch.domain()),
                   {},
                   0,
                   0},
                  kExitFailed);
}

void print_topics(const std::vector<TopicOnWire>& topics, const ListOptions& options) {
  for (const TopicOnWire& topic : topics) {
    if (options.json) {
      print_text("{}\n", json_line(topic_json(topic)));
    } else if (options.verbose) {
      print_text("{} [{}], writers: {}, readers: {}\n", terminal_text(topic.name),
                 terminal_text(topic.type), topic.writers.size(), topic.readers.size());
    } else if (options.show_types) {
      print_text("{} [{}]\n", terminal_text(topic.name), terminal_text(topic.type));
    } else {
      print_text("{}\n", terminal_text(topic.name));
    }
  }
}

int list_command(const ListOptions& options) {
  const auto watch = join_domain(options);
  if (!watch.ok()) return complain(watch.error());
  const auto topics = topics_of(**watch);
  if (options.count) {
    print_text("{}\n", topics.size());
  } else {
    print_topics(topics, options);
  }
  return topics.empty() ? complain_of_silence(**watch) : kExitGood;
}

const char* reliability_of(const RemoteEndpoint& endpoint) {
  return endpoint.reliable ? "reliable" : "best_effort";
}
const char* durability_of(const RemoteEndpoint& endpoint) {
  return endpoint.transient_local ? "transient_local" : "volatile";
}

ordered_json endpoint_json(const RemoteEndpoint& endpoint) {
  const std::string stage = bridge::UserData::parse(endpoint.user_data).stage;
  return {
      {"kind", endpoint.is_writer ? "writer" : "reader"},
      {"stage", stage.empty() ? ordered_json(nullptr) : ordered_json(stage)},
      {"pid", endpoint.process_id == 0 ? ordered_json(nullptr) : ordered_json(endpoint.process_id)},
      {"guid", endpoint.guid},
      {"reliability", reliability_of(endpoint)},
      {"durability", durability_of(endpoint)}};
}

void print_endpoint(const RemoteEndpoint& endpoint) {
  const std::string stage = bridge::UserData::parse(endpoint.user_data).stage;
  print_text("  {} of {}, process {}, {}, {}, {}\n", endpoint.is_writer ? "writer" : "reader",
             stage.empty() ? "no stage" : terminal_text(stage),
             endpoint.process_id == 0 ? "unknown" : std::to_string(endpoint.process_id),
             reliability_of(endpoint), durability_of(endpoint), endpoint.guid);
}

int info_command(const ListOptions& options) {
  const auto watch = join_domain(options);
  if (!watch.ok()) return complain(watch.error());
  const auto topic = find_topic(**watch, options);
  if (!topic.ok()) return complain(topic.error());
  if (options.json) {
    ordered_json json = topic_json(*topic);
    json["endpoints"] = ordered_json::array();
    for (const auto& endpoint : topic->writers)
      json["endpoints"].push_back(endpoint_json(endpoint));
    for (const auto& endpoint : topic->readers)
      json["endpoints"].push_back(endpoint_json(endpoint));
    print_text("{}\n", json_line(json));
    return kExitGood;
  }
  print_text("type: {}\nwriters: {}\nreaders: {}\n", terminal_text(topic->type),
             topic->writers.size(), topic->readers.size());
  if (!options.verbose) return kExitGood;
  for (const RemoteEndpoint& endpoint : topic->writers) print_endpoint(endpoint);
  for (const RemoteEndpoint& endpoint : topic->readers) print_endpoint(endpoint);
  return kExitGood;
}

int type_command(const ListOptions& options) {
  const auto watch = join_domain(options);
  if (!watch.ok()) return complain(watch.error());
  const auto topic = find_topic(**watch, options);
  if (!topic.ok()) return complain(topic.error());
  if (options.json) {
    print_text("{}\n", json_line({{"topic", topic->name}, {"type", topic->type}}));
  } else {
    print_text("{}\n", terminal_text(topic->type));
  }
  return kExitGood;
}

/// Whether `type` is `wanted`, or its last word is: `Scan` is `clew::msg::Scan`.
bool is_type(const std::string& type, const std::string& wanted) {
  const std::string end = "::" + wanted;
  return type == wanted ||
         (type.size() > end.size() && type.compare(type.size() - end.size(), end.size(), end) == 0);
}

int find_command(const ListOptions& options) {
  const auto watch = join_domain(options);
  if (!watch.ok()) return complain(watch.error());
  auto topics = topics_of(**watch);
  if (topics.empty()) return complain_of_silence(**watch);
  std::vector<std::string> types;
  for (const TopicOnWire& topic : topics) types.push_back(topic.type);
  topics.erase(std::remove_if(topics.begin(), topics.end(),
                              [&](const auto& t) { return !is_type(t.type, options.type); }),
               topics.end());
  if (options.count) {
    print_text("{}\n", topics.size());
  } else {
    print_topics(topics, options);
  }
  if (!topics.empty()) return kExitGood;
  return complain({core::unknown_name("type on this domain", options.type, types), {}, 0, 0},
                  kExitFailed);
}

}  // namespace

CLI::App* add_topic_verb(CLI::App& topic, const char* name, const char* about,
                         const std::shared_ptr<TopicOptions>& options) {
  CLI::App* app = topic.add_subcommand(name, about);
  app->add_option("--domain", options->run,
                  "of a run or anybody else, or a run's name; else CLEW_DOMAIN_ID");
  app->add_option("--spin-time", options->spin_time_s,
                  "s to wait for discovery at most (3); a domain that falls silent is done sooner")
      ->check(number_between(0.1, 600));
  app->add_flag("--json", options->json, "print one JSON object a line");
  return app;
}

void add_topic_argument(CLI::App& verb, TopicOptions& options) {
  verb.add_option("topic", options.topic, "its name on the domain, see 'clew topic list'")
      ->required();
  verb.add_option("type", options.type, "where a topic has two, as clew::msg::Scan");
}

Result<std::unique_ptr<bridge::DomainWatch>> join_domain(const TopicOptions& options) {
  std::string run = options.run;
  const char* const variable = std::getenv("CLEW_DOMAIN_ID");
  if (run.empty() && variable != nullptr) run = variable;
  if (run.empty()) {
    return Error{"which domain? Give its number or the run's name, or set CLEW_DOMAIN_ID",
                 "--domain"};
  }
  const auto domain = bridge::domain_of_run(run);
  if (!domain.ok()) return Error{domain.error().message, "--domain"};
  auto watch = bridge::DomainWatch::join(*domain);
  if (!watch.ok()) return watch.error();
  using std::chrono::duration;
  (*watch)->settle(
      std::chrono::duration_cast<std::chrono::nanoseconds>(duration<double>(options.spin_time_s)));
  return watch;
}

std::vector<TopicOnWire> topics_of(const bridge::DomainWatch& watch) {
  std::vector<TopicOnWire> topics;
  for (RemoteEndpoint& endpoint : watch.endpoints()) {
    if (topics.empty() || topics.back().name != endpoint.topic ||
        topics.back().type != endpoint.type) {
      topics.push_back({endpoint.topic, endpoint.type, {}, {}});
    }
    auto& side = endpoint.is_writer ? topics.back().writers : topics.back().readers;
    side.push_back(std::move(endpoint));
  }
  return topics;
}

Result<TopicOnWire> find_topic(const bridge::DomainWatch& watch, const TopicOptions& options) {
  const bool slash = !options.topic.empty() && options.topic.front() == '/';
  const std::string other = slash ? options.topic.substr(1) : '/' + options.topic;
  std::vector<TopicOnWire> same_name;
  std::vector<std::string> names;
  for (TopicOnWire& topic : topics_of(watch)) {
    names.push_back(topic.name);
    if (topic.name == options.topic || topic.name == other) same_name.push_back(std::move(topic));
  }
  if (same_name.empty()) {
    const std::string where = fmt::format("topic on domain {}", watch.domain());
    if (!names.empty()) return Error{core::unknown_name(where, options.topic, names)};
    return Error{
        fmt::format("no topic '{}': nobody is on domain {}", options.topic, watch.domain())};
  }
  std::vector<std::string> types;
  for (TopicOnWire& topic : same_name) {
    if (topic.type == options.type) return std::move(topic);
    types.push_back(topic.type);
  }
  if (!options.type.empty()) {
    return Error{core::unknown_name("type of topic " + options.topic, options.type, types)};
  }
  if (same_name.size() == 1) return std::move(same_name.front());
  return Error{fmt::format("topic {} has {} types: name one of {} behind it", options.topic,
                           types.size(), fmt::join(types, ", "))};
}

void add_topic(CLI::App& main, int& status) {
  CLI::App* topic = main.add_subcommand("topic", "Look at the topics of a run, or of a DDS domain");
  topic->require_subcommand(1);

  const auto list = std::make_shared<ListOptions>();
  CLI::App* app = add_topic_verb(*topic, "list", "Name all topics", list);
  app->add_flag("-t,--show-types", list->show_types, "with their types");
  app->add_flag("-c,--count-topics", list->count, "only say how many there are");
  app->add_flag("-v,--verbose", list->verbose, "with their types, writers and readers");
  app->callback([list, &status] { status = list_command(*list); });

  const auto info = std::make_shared<ListOptions>();
  app = add_topic_verb(*topic, "info", "Tell who writes and who reads a topic", info);
  add_topic_argument(*app, *info);
  app->add_flag("-v,--verbose", info->verbose, "each endpoint with its stage, process and QoS");
  app->callback([info, &status] { status = info_command(*info); });

  const auto type = std::make_shared<ListOptions>();
  app = add_topic_verb(*topic, "type", "Tell the type of a topic", type);
  add_topic_argument(*app, *type);
  app->callback([type, &status] { status = type_command(*type); });

  const auto find = std::make_shared<ListOptions>();
  app = add_topic_verb(*topic, "find", "Name the topics of a type", find);
  app->add_option("type", find->type, "clew::msg::Scan, or its last word")->required();
  app->add_flag("-c,--count-topics", find->count, "only say how many there are");
  app->callback([find, &status] { status = find_command(*find); });

  add_topic_echo(*topic, status);
  add_topic_statistics(*topic, status);
}

}  // namespace clew::tools
