// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <chrono>
#include <map>
#include <nlohmann/json.hpp>

#include "clew/command_line.hpp"
#include "clew/json_line.hpp"
#include "clew/print_text.hpp"
#include "clew/topic_reading.hpp"
#include "watch/arrival_window.hpp"

namespace clew::tools {
namespace {

using bridge::DomainWatch;
using core::Error;
using core::Result;
using domain::Topic;
using std::chrono::steady_clock;

double seconds_of(steady_clock::time_point at) {
  return std::chrono::duration<double>(at.time_since_epoch()).count();
}

/// Of samples of any type: when they come, and how large they are.
class RateVerb : public TopicVerb {
 public:
  enum class What : std::uint8_t { kRate, kBandwidth };
  RateVerb(const ReaderOptions& options, What what)
      : options_(options), what_(what), window_(options.window) {}

  Result<void> prepare(DomainWatch& watch, const TopicOnWire& topic) override {
    name_ = topic.name;
    topic_ = topic_of_type(topic.type);
    return watch.read(topic.name, topic.type);
  }

  Result<bool> take(const DomainWatch::Arrival& arrival) override {
    std::optional<std::uint64_t> sequence;
    if (topic_) {
      if (const auto stamp = stamp_of(*topic_, arrival.cdr)) sequence = stamp->sequence;
    }
    window_.add(seconds_of(arrival.at), arrival.cdr.size(), sequence);
    return true;
  }

  bool report() override {
    if (!window_.rate_hz()) return true;
    if (what_ == What::kRate) {
      report_rate();
    } else {
      report_bandwidth();
    }
    return !options_.once;
  }

 private:
  void report_rate() const {
    const auto intervals = window_.intervals_s();
    if (options_.json) {
      print_text("{}\n", json_line({{"topic", name_},
                                    {"rate_hz", *window_.rate_hz()},
                                    {"min_s", intervals->min},
                                    {"max_s", intervals->max},
                                    {"stddev_s", intervals->stddev},
                                    {"window", window_.count()},
                                    {"lost", window_.lost()}}));
      return;
    }
    print_text(
        "average rate: {:.3f} Hz\n  min: {:.6f} s max: {:.6f} s std dev: {:.6f} s window: "
        "{} lost: {}\n",
        *window_.rate_hz(), intervals->min, intervals->max, intervals->stddev, window_.count(),
        window_.lost());
  }

  void report_bandwidth() const {
    const auto sizes = window_.sizes_bytes();
    if (options_.json) {
      print_text("{}\n", json_line({{"topic", name_},
                                    {"bytes_per_s", *window_.bytes_per_s()},
                                    {"mean_bytes", sizes->mean},
                                    {"min_bytes", sizes->min},
                                    {"max_bytes", sizes->max},
                                    {"window", window_.count()}}));
      return;
    }
    print_text("{:.0f} B/s from {} samples\n  size mean: {:.1f} B min: {:.0f} B max: {:.0f} B\n",
               *window_.bytes_per_s(), window_.count(), sizes->mean, sizes->min, sizes->max);
  }

  const ReaderOptions& options_;
  const What what_;
  std::string name_;
  std::optional<Topic> topic_;
  bridge::ArrivalWindow window_;
};

/// The time from the beginning of a tick, which drive's state tells, to the tick's sample.
class DelayVerb : public TopicVerb {
 public:
  explicit DelayVerb(const ReaderOptions& options) : options_(options), delays_(options.window) {}

  Result<void> prepare(DomainWatch& watch, const TopicOnWire& topic) override {
    name_ = topic.name;
    const auto known = check_type(topic, ": its samples have no tick");
    if (!known.ok()) return known.error();
    topic_ = *known;
    if (topic_ == Topic::kState) {
      return Error{"state is what begins a tick; name a topic that follows from it"};
    }
    const std::string type(domain::type_name(Topic::kState));
    const std::string state = topic.name.substr(0, topic.name.rfind('/') + 1) +
                              std::string(domain::topic_name(Topic::kState));
    CLEW_RETURN_IF_ERROR(watch.read(topic.name, topic.type));
    return watch.read(state, type);
  }

  Result<bool> take(const DomainWatch::Arrival& arrival) override {
    const bool begins = arrival.reader == 1;
    const auto stamp = stamp_of(begins ? Topic::kState : topic_, arrival.cdr);
    if (!stamp) return true;
    // The reply may overtake the state on its way here.
    auto& own = begins ? begun_s_ : ended_s_;
    auto& other = begins ? ended_s_ : begun_s_;
    const double now_s = seconds_of(arrival.at);
    const auto found = other.find(stamp->tick);
    if (found == other.end()) {
      own[stamp->tick] = now_s;
      if (own.size() > kMostOpenTicks) own.erase(own.begin());
      return true;
    }
    delays_.add(begins ? found->second - now_s : now_s - found->second);
    other.erase(found);
    return true;
  }

  bool report() override {
    const auto delay = delays_.spread();
    if (!delay) return true;
    if (options_.json) {
      print_text("{}\n", json_line({{"topic", name_},
                                    {"mean_s", delay->mean},
                                    {"min_s", delay->min},
                                    {"max_s", delay->max},
                                    {"stddev_s", delay->stddev},
                                    {"window", delay->count}}));
    } else {
      print_text(
          "average delay since the tick began: {:.6f} s\n  min: {:.6f} s max: {:.6f} s std "
          "dev: {:.6f} s window: {}\n",
          delay->mean, delay->min, delay->max, delay->stddev, delay->count);
    }
    return !options_.once;
  }

 private:
  /// More than a run is ahead of itself; the others' counterparts were lost.
  static constexpr std::size_t kMostOpenTicks = 1024;

  const ReaderOptions& options_;
  std::string name_;
  Topic topic_ = Topic::kCommand;
  std::map<std::uint64_t, double> begun_s_;
  std::map<std::uint64_t, double> ended_s_;
  bridge::NumberWindow delays_;
};

}  // namespace

void add_topic_statistics(CLI::App& topic, int& status) {
  const auto add = [&](const char* name, const char* about, const auto& make_verb) {
    const auto options = std::make_shared<ReaderOptions>();
    CLI::App* app = add_topic_reader(topic, name, about, options);
    app->add_option("-w,--window", options->window, "of how many samples (10000)")
        ->check(number_between(2, 1e6));
    app->callback([options, make_verb, &status] {
      auto verb = make_verb(*options);
      status = read_topic(*options, verb);
    });
  };
  add("hz", "Tell how many samples a second a topic has",
      [](const ReaderOptions& o) { return RateVerb(o, RateVerb::What::kRate); });
  add("bw", "Tell how many bytes a second a topic has",
      [](const ReaderOptions& o) { return RateVerb(o, RateVerb::What::kBandwidth); });
  add("delay", "Tell how long after the beginning of its tick a topic's sample comes",
      [](const ReaderOptions& o) { return DelayVerb(o); });
}

}  // namespace clew::tools
