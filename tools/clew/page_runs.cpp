// SPDX-License-Identifier: Apache-2.0
#include "clew/page_runs.hpp"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "clew/json_line.hpp"
#include "clew/own_program.hpp"
#include "clew/typed_line.hpp"
#include "files/whole_file.hpp"
#include "gateway/insides_answer.hpp"
#include "runtime/config_source.hpp"
#include "stages/all.hpp"
#include "view/registry_json.hpp"

namespace clew::tools {
namespace {

using bridge::WebResponse;
using core::Error;
using core::Result;
using nlohmann::ordered_json;

/// A run that takes longer is killed.
constexpr auto kPatience = std::chrono::minutes(5);
constexpr auto kPollPeriod = std::chrono::milliseconds(5);

WebResponse refusal(const std::string& why) {
  return {400, "application/json", json_line({{"error", why}}), {}};
}

/// The last line that the program printed, if it is an object.
ordered_json last_object(const std::string& out) {
  const std::size_t end = out.find_last_not_of('\n');
  if (end == std::string::npos) return nullptr;
  const std::size_t before = out.rfind('\n', end);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  const auto parsed = ordered_json::parse(out.substr(begin, end + 1 - begin), nullptr, false);
  return parsed.is_object() ? parsed : ordered_json(nullptr);
}

}  // namespace

Result<std::unique_ptr<PageRuns>> PageRuns::create(bridge::ViewContent& content,
                                                   std::vector<std::string> recordings,
                                                   std::vector<std::string> plugins) {
  auto folder = files::ScratchFolder::make("clew-view");
  if (!folder.ok()) return folder.error();
  return std::unique_ptr<PageRuns>(
      new PageRuns(content, std::move(recordings), std::move(plugins), std::move(folder).value()));
}

PageRuns::PageRuns(bridge::ViewContent& content, std::vector<std::string> recordings,
                   std::vector<std::string> plugins, files::ScratchFolder folder)
    : content_(content),
      paths_(std::move(recordings)),
      plugins_(std::move(plugins)),
      folder_(std::move(folder)),
      programs_(kPatience) {
  const auto path = runtime::ConfigPath::from_environment();
  names_ = {path.names("graphs"), path.names("worlds")};
}

void PageRuns::serve_with(bridge::WebServer& server) {
  server_ = &server;
  content_.offer("/choices", json_line({{"stages", view::registry_json(stages::all())},
                                        {"graphs", names_.graphs},
                                        {"worlds", names_.worlds}}));
  content_.on_post("/branch", [this](const std::string& body, Answer answer) {
    branch(body, std::move(answer));
  });
  content_.on_post("/explain", [this](const std::string& body, Answer answer) {
    explain(body, std::move(answer));
  });
  content_.on_post(
      "/run", [this](const std::string& body, Answer answer) { run(body, std::move(answer)); });
}

void PageRuns::branch(const std::string& body, Answer answer) {
  auto command = view::read_branch(body, paths_.size(), stages::all());
  if (!command.ok()) return answer(refusal(command.error().message));
  std::vector<std::string> words = {"replay", paths_[command->recording]};
  words.insert(words.end(), command->words.begin(), command->words.end());
  for (const view::EditedRules& edited : command->rules) {
    const std::string file = folder_.path() + "/rules-" + std::to_string(++rule_bases_) + ".yaml";
    const auto written = files::write_file(file, edited.text);
    if (!written.ok()) return answer(refusal(written.error().text()));
    words.push_back("--set=" + edited.place + '=' + file);
  }
  record(std::move(words), command->what, std::move(answer));
}

void PageRuns::explain(const std::string& body, Answer answer) {
  auto command = view::read_question(body, paths_.size());
  if (!command.ok()) return answer(refusal(command.error().message));
  std::vector<std::string> words = {"explain", paths_[command->recording]};
  words.insert(words.end(), command->words.begin(), command->words.end());
  name_plugins(words);
  const std::string line = typed_line(words);
  start(std::move(words), answer, [line, answer](const bridge::ProgramEnd& end) {
    answer(bridge::insides_answer(end, line));
  });
}

void PageRuns::run(const std::string& body, Answer answer) {
  auto command = view::read_run(body, names_, stages::all());
  if (!command.ok()) return answer(refusal(command.error().message));
  std::string world = command->world;
  if (!command->world_text.empty()) {
    world = folder_.path() + "/world-" + std::to_string(count_ + 1) + ".yaml";
    const auto written = files::write_file(world, command->world_text);
    if (!written.ok()) return answer(refusal(written.error().text()));
  }
  std::vector<std::string> words = {"run", command->graph, "--world",
                                    world, "--layout",     "composed"};
  words.insert(words.end(), command->words.begin(), command->words.end());
  record(std::move(words), command->what, std::move(answer));
}

void PageRuns::record(std::vector<std::string> words, const std::string& what, Answer answer) {
  const std::string file = folder_.path() + "/run-" + std::to_string(++count_) + ".mcap";
  name_plugins(words);
  words.insert(words.end(), {"--record", file, "--json"});
  const std::string line = typed_line(words);
  start(std::move(words), answer, [this, line, file, what, answer](const bridge::ProgramEnd& end) {
    finish(end, line, file, what, answer);
  });
}

void PageRuns::name_plugins(std::vector<std::string>& words) const {
  for (const std::string& plugin : plugins_) words.insert(words.end(), {"--plugin", plugin});
}

void PageRuns::start(std::vector<std::string> words, const Answer& answer,
                     bridge::ProgramRuns::Done done) {
  words.insert(words.begin(), own_program());
  const auto started = programs_.start(words, std::chrono::steady_clock::now(), std::move(done));
  if (!started.ok()) return answer(refusal(started.error().text()));
  if (std::exchange(polls_, true)) return;
  server_->repeat(kPollPeriod,
                  [this] { return polls_ = programs_.poll(std::chrono::steady_clock::now()); });
}

void PageRuns::finish(const bridge::ProgramEnd& end, const std::string& line,
                      const std::string& file, const std::string& what, const Answer& answer) {
  const ordered_json report = last_object(end.out);
  auto recording = bridge::ServedRecording::open({file});
  if (report.is_null() || !recording.ok()) {
    return answer(refusal(end.err.empty() ? "status " + std::to_string(end.status) : end.err));
  }
  paths_.push_back(file);
  const std::size_t number = content_.add_recording(std::move(recording).value());
  answer({200,
          "application/json",
          json_line({{"command", line}, {"recording", number}, {"name", what}, {"report", report}}),
          {}});
}

}  // namespace clew::tools
