// SPDX-License-Identifier: Apache-2.0
#include "clew/topic_reading.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "clew/command_line.hpp"
#include "clew/exit_status.hpp"
#include "clew/print_text.hpp"
#include "line/user_data.hpp"
#include "log/log.hpp"
#include "run/end_signals.hpp"
#include "wire/codec.hpp"

namespace clew::tools {
namespace {

using bridge::DomainWatch;
using core::Error;
using core::Result;
using domain::Topic;
using std::chrono::steady_clock;

/// A killed component is back before.
constexpr std::chrono::seconds kGoneAfter{2};
/// A writer whose QoS fits may be discovered after one whose QoS does not.
constexpr std::chrono::seconds kMisfitAfter{1};
constexpr std::chrono::milliseconds kLookPeriod{100};
constexpr std::chrono::seconds kReportPeriod{1};

bool has_writer(const DomainWatch& watch, const TopicOnWire& topic) {
  for (const bridge::RemoteEndpoint& endpoint : watch.endpoints()) {
    if (endpoint.is_writer && endpoint.topic == topic.name && endpoint.type == topic.type) {
      return true;
    }
  }
  return false;
}

/// Looks after a reading that goes on: whether there are writers, and whether anything comes.
class Patience {
 public:
  Patience(const ReaderOptions& options, const DomainWatch& watch, const TopicOnWire& topic)
      : options_(options), watch_(watch), topic_(topic) {}

  void note_sample() { came_ = true; }
  /// The exit status, if the reading is to end: all writers are gone, or what was waited for does
  /// not come.
  std::optional<int> ended(steady_clock::time_point now) {
    if (now < next_look_) return std::nullopt;
    next_look_ = now + kLookPeriod;
    if (has_writer(watch_, topic_)) {
      last_writer_ = now;
      had_writer_ = true;
    }
    if (had_writer_ && now - last_writer_ > kGoneAfter) {
      logs::info("nobody writes {} any more", topic_.name);
      return came_ ? kExitGood : kExitFailed;
    }
    if (came_) return std::nullopt;
    const std::string policy = watch_.incompatible_policy();
    if (!policy.empty() && now - begun_ > kMisfitAfter) {
      return complain(
          {fmt::format("the writer of {} and this reader do not fit: {}", topic_.name, policy),
           {},
           0,
           0},
          kExitFailed);
    }
    if (options_.timeout_s &&
        std::chrono::duration<double>(now - begun_).count() > *options_.timeout_s) {
      return complain(
          {fmt::format("nothing came on {} within {} s", topic_.name, *options_.timeout_s),
           {},
           0,
           0},
          kExitFailed);
    }
    return std::nullopt;
  }

 private:
  const ReaderOptions& options_;
  const DomainWatch& watch_;
  const TopicOnWire& topic_;
  const steady_clock::time_point begun_ = steady_clock::now();
  steady_clock::time_point next_look_ = begun_;
  steady_clock::time_point last_writer_ = begun_;
  bool had_writer_ = false;
  bool came_ = false;
};

int follow(const ReaderOptions& options, DomainWatch& watch, const TopicOnWire& topic,
           bridge::EndSignals& signals, TopicVerb& verb) {
  Patience patience(options, watch, topic);
  auto next_report = steady_clock::now() + kReportPeriod;
  while (signals.take() == 0) {
    for (const DomainWatch::Arrival& arrival : watch.take()) {
      patience.note_sample();
      const auto goes_on = verb.take(arrival);
      if (!goes_on.ok()) return complain(goes_on.error(), kExitFailed);
      if (!*goes_on) return kExitGood;
    }
    const auto now = steady_clock::now();
    if (now >= next_report) {
      next_report = now + kReportPeriod;
      if (!verb.report()) return kExitGood;
    }
    if (const auto status = patience.ended(now)) return *status;
    watch.wait(signals.descriptor(), kLookPeriod);
  }
  return kExitGood;
}

}  // namespace

std::optional<Topic> topic_of_type(const std::string& type) {
  for (const Topic topic : domain::kAllTopics) {
    if (domain::type_name(topic) == type) return topic;
  }
  return std::nullopt;
}

std::optional<domain::TickStamp> stamp_of(Topic topic, std::string_view cdr) {
  return domain::visit_topic(topic, [&](auto constant) -> std::optional<domain::TickStamp> {
    typename decltype(constant)::Message message;
    if (!bridge::decode(cdr, &message, bridge::Values::kAny).ok()) return std::nullopt;
    return message.stamp;
  });
}

Result<Topic> check_type(const TopicOnWire& topic, const char* otherwise) {
  const auto known = topic_of_type(topic.type);
  if (!known) {
    return Error{fmt::format("{} has type {}, which is none of Clew's{}", topic.name, topic.type,
                             otherwise)};
  }
  for (const bridge::RemoteEndpoint& writer : topic.writers) {
    const std::string idl = bridge::UserData::parse(writer.user_data).idl_fingerprint;
    if (idl.empty() || idl == bridge::idl_fingerprint()) continue;
    return Error{
        fmt::format("the writer of {} was built from other IDL files: its fingerprint is "
                    "{}, this one's is {}",
                    topic.name, idl, bridge::idl_fingerprint())};
  }
  return *known;
}

int read_topic(const ReaderOptions& options, TopicVerb& verb) {
  bridge::EndSignals signals;
  const auto watch = join_domain(options);
  if (!watch.ok()) return complain(watch.error());
  const auto topic = find_topic(**watch, options);
  if (!topic.ok()) return complain(topic.error());
  if (auto good = verb.prepare(**watch, *topic); !good.ok()) return complain(good.error());
  const int status = follow(options, **watch, *topic, signals, verb);
  verb.end();
  if ((*watch)->dropped() > 0) {
    logs::warning("{} samples came faster than they were taken", (*watch)->dropped());
  }
  return status;
}

CLI::App* add_topic_reader(CLI::App& topic, const char* name, const char* about,
                           const std::shared_ptr<ReaderOptions>& options) {
  CLI::App* app = add_topic_verb(topic, name, about, options);
  add_topic_argument(*app, *options);
  app->add_flag("--once", options->once, "end after the first line");
  app->add_option("--timeout", options->timeout_s, "s to wait for the first sample (for ever)")
      ->check(number_between(0, 1e6));
  return app;
}

}  // namespace clew::tools
