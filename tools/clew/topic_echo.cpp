// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "clew/command_line.hpp"
#include "clew/exit_status.hpp"
#include "clew/json_line.hpp"
#include "clew/print_text.hpp"
#include "clew/recorded_fields.hpp"
#include "clew/sample_output.hpp"
#include "clew/topic_reading.hpp"
#include "core/nearest_name.hpp"
#include "core/terminal_text.hpp"
#include "log/log.hpp"

namespace clew::tools {
namespace {

using bridge::DomainWatch;
using bridge::Field;
using core::Error;
using core::Result;
using domain::Topic;

class EchoVerb : public TopicVerb {
 public:
  explicit EchoVerb(const ReaderOptions& options) : options_(options) {}

  Result<void> prepare(DomainWatch& watch, const TopicOnWire& topic) override {
    if (!options_.raw) {
      const auto known = check_type(topic, "; --raw shows its bytes");
      if (!known.ok()) return known.error();
      topic_ = *known;
      name_ = core::terminal_text(topic.name);
      CLEW_RETURN_IF_ERROR(check_fields());
    }
    return watch.read(topic.name, topic.type);
  }

  Result<bool> take(const DomainWatch::Arrival& arrival) override {
    if (options_.raw) {
      print_bytes(arrival.cdr);
      return !options_.once;
    }
    bridge::SampleView sample{topic_, 0, 0, arrival.cdr};
    const auto fields = reader_.fields_of(sample);
    if (!fields.ok()) {
      note_malformed(fields.error());
      return true;
    }
    const auto stamp = stamp_of(topic_, arrival.cdr);
    sample.tick = stamp->tick;
    sample.sequence = stamp->sequence;
    note_sequence(sample.sequence);
    print(sample, kept(*fields));
    return !options_.once;
  }

  void end() override {
    if (malformed_ > 1) {
      logs::warning("{} samples were no {}", malformed_, domain::type_name(topic_));
    }
    if (lost_ > 0) logs::warning("{} samples were lost on the way", lost_);
    if (cut_ > 0) {
      logs::info(
          "{} samples have longer lists than the first one, whose columns "
          "these are; --json tells all",
          cut_);
    }
  }

 private:
  Result<void> check_fields() const {
    const auto names = bridge::field_names(topic_);
    for (const std::string& wanted : options_.fields) {
      const std::string plain = without_indices(wanted);
      if (std::any_of(names.begin(), names.end(),
                      [&](const std::string& name) { return lies_in(name, plain); })) {
        continue;
      }
      const std::string what = "field of " + std::string(domain::topic_name(topic_));
      return Error{core::unknown_name(what, wanted, names), "--field"};
    }
    return {};
  }

  std::vector<Field> kept(std::vector<Field> fields) const {
    const auto unwanted = [this](const Field& field) {
      const bool in_list = field.path.find('[') != std::string::npos || is_length(field.path);
      return (options_.no_lists && in_list) ||
             (options_.no_texts && std::holds_alternative<std::string>(field.value));
    };
    fields.erase(std::remove_if(fields.begin(), fields.end(), unwanted), fields.end());
    return fields;
  }

  void print(const bridge::SampleView& sample, const std::vector<Field>& fields) {
    if (options_.json) {
      print_text("{}\n", sample_json(sample, fields, options_.fields));
    } else if (options_.csv) {
      print_row(sample, chosen_fields(fields, options_.fields));
    } else {
      print_sample(sample, shortened(chosen_fields(fields, options_.fields)));
    }
  }

  /// Of each list the first items, of each text the first characters, as many as are wanted.
  std::vector<Field> shortened(std::vector<Field> fields) const {
    const std::size_t most = options_.most_items;
    if (most == 0) return fields;
    std::string list;
    std::size_t count = 0;
    const auto is_too_many = [&](Field& field) {
      if (auto* text = std::get_if<std::string>(&field.value); text && text->size() > most) {
        *text = text->substr(0, most) + "...";
      }
      const std::size_t bracket = field.path.find('[');
      if (bracket == std::string::npos || field.path.back() != ']') return false;
      if (field.path.substr(0, bracket) != list) {
        list = field.path.substr(0, bracket);
        count = 0;
      }
      return ++count > most;
    };
    // One at a time and in order: it counts.
    std::vector<Field> kept;
    for (Field& field : fields) {
      if (!is_too_many(field)) kept.push_back(std::move(field));
    }
    return kept;
  }

  /// The columns are those of the first sample.
  void print_row(const bridge::SampleView& sample, const std::vector<Field>& fields) {
    if (columns_.paths().empty()) {
      columns_.add(fields);
      print_text("tick,sequence");
      for (const std::string& path : columns_.paths()) print_text(",{}", path);
      print_text("\n");
    }
    FieldColumns own = columns_;
    own.add(fields);
    if (own.paths().size() > columns_.paths().size()) ++cut_;
    print_text("{},{}{}{}\n", sample.tick, sample.sequence, columns_.paths().empty() ? "" : ",",
               columns_.row(fields));
  }

  void print_bytes(std::string_view cdr) const {
    std::string hex;
    for (const char byte : cdr) hex += fmt::format("{:02x}", static_cast<unsigned char>(byte));
    if (options_.json) {
      print_text("{}\n", json_line({{"bytes", hex}}));
    } else {
      print_text("{}\n", hex);
    }
  }

  /// Anybody may write anything: such a sample is left out, and the others are shown.
  void note_malformed(const Error& why) {
    if (++malformed_ > 1) return;
    logs::warning("a sample of {} is no {} and is left out: {}", name_, domain::type_name(topic_),
                  why.message);
  }

  void note_sequence(std::uint64_t sequence) {
    if (last_sequence_ && sequence > *last_sequence_ + 1) {
      const std::uint64_t gap = sequence - *last_sequence_ - 1;
      lost_ += gap;
      if (options_.tell_lost) logs::warning("{} samples lost", gap);
    }
    last_sequence_ = sequence;
  }

  const ReaderOptions& options_;
  Topic topic_ = Topic::kCommand;
  FieldReader reader_;
  FieldColumns columns_;
  std::optional<std::uint64_t> last_sequence_;
  std::string name_;
  std::uint64_t lost_ = 0;
  std::uint64_t malformed_ = 0;
  std::uint64_t cut_ = 0;
};

}  // namespace

void add_topic_echo(CLI::App& topic, int& status) {
  const auto options = std::make_shared<ReaderOptions>();
  CLI::App* app =
      add_topic_reader(topic, "echo", "Print the samples of a topic as they come", options);
  app->add_option("--field", options->fields,
                  "only this one, as stamp.sim_time_s or ranges_m[3]; may be repeated")
      ->allow_extra_args(false);
  app->add_flag("--csv", options->csv, "a table, with a header");
  app->add_flag("--raw", options->raw, "the bytes, of whatever type, in hexadecimal");
  app->add_flag("--no-arr", options->no_lists, "without lists");
  app->add_flag("--no-str", options->no_texts, "without texts");
  app->add_option("-l,--truncate-length", options->most_items,
                  "so many items of a list and characters of a text, for people (all)")
      ->check(number_between(1, 1e6));
  app->add_flag("--lost-messages", options->tell_lost, "say at once how many were lost");
  app->callback([options, &status] {
    if (options->csv && (options->json || options->raw)) {
      status = complain({"--csv is a format of its own: leave out the other", {}, 0, 0});
      return;
    }
    EchoVerb verb(*options);
    status = read_topic(*options, verb);
  });
}

}  // namespace clew::tools
