// SPDX-License-Identifier: Apache-2.0
#include "line/command_desk.hpp"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "run/limits.hpp"

namespace clew::bridge {

bool is_domain_number(const std::string& run) {
  return !run.empty() && run.size() <= 3 &&
         std::all_of(run.begin(), run.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

core::Result<int> connect_to_run(const std::string& run) {
  const auto deadline = Link::Time::clock::now() + kSilence;
  return is_domain_number(run) ? Link::connect(std::stoi(run), deadline)
                               : Link::connect(run, deadline);
}

void CommandDesk::welcome(std::unique_ptr<Link> link, Time now) {
  link->allow_payload(kMostHelloBytes);
  if (visitors_.size() >= kMostCommanders) visitors_.pop_front();
  visitors_.push_back({std::move(link), now});
}

std::vector<pollfd> CommandDesk::descriptors() const {
  std::vector<pollfd> descriptors;
  for (const Visitor& visitor : visitors_) {
    descriptors.push_back({visitor.link->socket(), visitor.link->poll_events(), 0});
  }
  return descriptors;
}

void CommandDesk::serve(const std::function<std::optional<CommandAnswer>(RunCommand&)>& decide,
                        Time now) {
  for (Visitor& visitor : visitors_) {
    visitor.link->flush();
    const bool open = visitor.link->receive();
    if (!visitor.command && !visitor.answered) {
      const auto frame = visitor.link->next();
      if (frame && frame->type == FrameType::kCommand) visitor.command = frame->as<RunCommand>();
    }
    if (visitor.command && !visitor.answered) {
      if (auto answer = decide(*visitor.command)) {
        visitor.link->post(FrameType::kAnswer, *std::move(answer));
        visitor.answered = true;
      }
    }
    const bool silent = !visitor.command && now - visitor.came_at > kHelloTimeout;
    if (!open || silent) visitor.link.reset();
  }
  visitors_.erase(std::remove_if(visitors_.begin(), visitors_.end(),
                                 [](const Visitor& visitor) { return !visitor.link; }),
                  visitors_.end());
}

void post_command(Link& link, const RunCommand& command) {
  link.post(FrameType::kHello, Hello{kCommander, ::getpid(), {}});
  link.post(FrameType::kCommand, command);
}

core::Result<CommandAnswer> answer_of(const Frame& frame) {
  const auto answer = frame.as<CommandAnswer>();
  if (frame.type != FrameType::kAnswer || !answer) {
    return core::Error{"the run takes no commands"};
  }
  if (!answer->done) return core::Error{answer->text};
  return *answer;
}

core::Result<CommandAnswer> command_run(const std::string& run, const RunCommand& command) {
  const auto socket = connect_to_run(run);
  if (!socket.ok()) return socket.error();
  Link link(*socket);
  post_command(link, command);
  const auto frame = link.wait_for_frame(Link::Time::clock::now() + kAssignmentTimeout);
  if (!frame.ok()) return frame.error();
  return answer_of(*frame);
}

}  // namespace clew::bridge
