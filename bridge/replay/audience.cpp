// SPDX-License-Identifier: Apache-2.0
#include "replay/audience.hpp"

#include <poll.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "run/limits.hpp"
#include "supervisor/launcher.hpp"
#include "supervisor/shutdown.hpp"

namespace clew::bridge {

Audience::Audience()
    : barrier_(kReplayName, {},
               {[this] {
                  news_ = true;
                  wake_.ring();
                },
                [this](std::string text) {
                  {
                    const std::lock_guard<std::mutex> lock(mutex_);
                    notices_.push_back(std::move(text));
                  }
                  wake_.ring();
                },
                [this](std::string text) {
                  {
                    const std::lock_guard<std::mutex> lock(mutex_);
                    fatal_ = std::move(text);
                  }
                  wake_.ring();
                }}) {}

void Audience::expect_readers(const runtime::TopicSet& topics, const TopicNames& names) {
  for (domain::Topic topic : domain::kAllTopics) {
    if (!topics[index_of(topic)]) continue;
    barrier_.expect({{published_name(topic, names), false, {}, false}});
  }
}

core::Result<void> Audience::start_readers(const std::vector<std::string>& commands,
                                           const WireSettings& settings) {
  if (commands.empty()) return {};
  environment_.emplace(settings.domain, kLease_s, settings.run_id);
  if (!environment_->failure().empty()) return core::Error{environment_->failure()};
  for (const std::string& text : commands) {
    ChildCommand command;
    command.arguments = {"/bin/sh", "-c", text};
    command.environment = environment_->variables();
    auto child = ChildProcess::start(command);
    if (!child.ok()) return child.error();
    Member reader;
    reader.stage = text;
    reader.third_party = true;
    reader.child = std::move(child).value();
    readers_.push_back(std::move(reader));
  }
  return {};
}

void Audience::end_readers(bool orderly) {
  const auto deadline = std::chrono::steady_clock::now() + kEndGrace;
  const auto running = [](Member& reader) {
    reader.child->reap();
    return reader.child->running();
  };
  while (orderly && std::any_of(readers_.begin(), readers_.end(), running) &&
         std::chrono::steady_clock::now() < deadline) {
    ::poll(nullptr, 0, 1);
  }
  end_processes(readers_, orderly);
}

std::vector<std::string> Audience::take_notices() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(notices_, {});
}

std::optional<std::string> Audience::fatal() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return fatal_;
}

}  // namespace clew::bridge
