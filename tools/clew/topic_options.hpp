// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "watch/domain_watch.hpp"

namespace clew::tools {

/// What the verbs of `clew topic` have in common.
struct TopicOptions {
  std::string run;           ///< empty: that of CLEW_DOMAIN_ID
  double spin_time_s = 3.0;  ///< how long discovery is waited for at most
  bool json = false;
  std::string topic;
  std::string type;  ///< empty: the only one that the topic has
};

/// A topic of a domain: its endpoints of one type.
struct TopicOnWire {
  std::string name;
  std::string type;
  std::vector<bridge::RemoteEndpoint> writers;
  std::vector<bridge::RemoteEndpoint> readers;
};

/// Adds a verb with the options that all have.
CLI::App* add_topic_verb(CLI::App& topic, const char* name, const char* about,
                         const std::shared_ptr<TopicOptions>& options);
/// The argument of a verb that is about one topic; and its type, which two may share a name.
void add_topic_argument(CLI::App& verb, TopicOptions& options);

/// Looks on at the domain that the options name, and waits until discovery has told what there is.
core::Result<std::unique_ptr<bridge::DomainWatch>> join_domain(const TopicOptions& options);

/// All topics by name and type, of all that is known by now.
std::vector<TopicOnWire> topics_of(const bridge::DomainWatch& watch);

/// The topic that the options name, with or without a slash before it. Refused: one that is not
/// there, one that is of another type, and one of two types where none is named.
core::Result<TopicOnWire> find_topic(const bridge::DomainWatch& watch, const TopicOptions& options);

}  // namespace clew::tools
