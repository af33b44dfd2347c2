// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clew/topic_options.hpp"
#include "domain/topics.hpp"

namespace clew::tools {

/// What the verbs have in common that read samples.
struct ReaderOptions : TopicOptions {
  bool once = false;
  std::optional<double> timeout_s;
  std::size_t window = 10000;
  // of echo
  std::vector<std::string> fields;  ///< empty: all
  bool csv = false;
  bool raw = false;
  bool no_lists = false;
  bool no_texts = false;
  bool tell_lost = false;
  std::size_t most_items = 0;  ///< of a list, and characters of a text; 0: all
};

/// What a verb does with what it reads. Both say whether to go on.
class TopicVerb {
 public:
  virtual ~TopicVerb() = default;
  /// What it needs besides the topic. Refused: a topic that the verb makes no sense of.
  virtual core::Result<void> prepare(bridge::DomainWatch& watch, const TopicOnWire& topic) = 0;
  virtual core::Result<bool> take(const bridge::DomainWatch::Arrival& arrival) = 0;
  /// Once a second.
  virtual bool report() { return true; }
  virtual void end() {}
};

/// The topic of ours whose messages have this type; none of a stranger's.
std::optional<domain::Topic> topic_of_type(const std::string& type);

/// The stamp of a sample; none if its bytes are no message.
std::optional<domain::TickStamp> stamp_of(domain::Topic topic, std::string_view cdr);

/// The topic of ours that has the type of this one. Refused, with `otherwise` behind it: a type of
/// somebody else, and one of other IDL files.
core::Result<domain::Topic> check_type(const TopicOnWire& topic, const char* otherwise);

/// Reads the topic that the options name until the verb has enough, a signal asks for an end, or
/// nobody writes it any more. Returns the exit status.
int read_topic(const ReaderOptions& options, TopicVerb& verb);

/// Adds a verb that reads samples, with the options that all have.
CLI::App* add_topic_reader(CLI::App& topic, const char* name, const char* about,
                           const std::shared_ptr<ReaderOptions>& options);

/// echo; and hz, bw and delay.
void add_topic_echo(CLI::App& topic, int& status);
void add_topic_statistics(CLI::App& topic, int& status);

}  // namespace clew::tools
