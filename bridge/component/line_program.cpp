// SPDX-License-Identifier: Apache-2.0
#include "component/line_program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include "run/limits.hpp"

namespace clew::bridge {
namespace {

using Clock = std::chrono::steady_clock;
using core::Error;
using core::Result;

/// More than any answer: the longest scan has 2048 numbers.
constexpr std::size_t kLongestLine = std::size_t{1} << 20;

struct Pipes {
  std::array<int, 2> input{-1, -1};   ///< its end, ours
  std::array<int, 2> output{-1, -1};  ///< ours, its end
};

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (std::string& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

std::vector<std::string> environment_with(const std::map<std::string, std::string>& more) {
  std::vector<std::string> all;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    if (more.count(text.substr(0, text.find('='))) == 0) all.push_back(text);
  }
  for (const auto& [name, value] : more) all.push_back(name + '=' + value);
  return all;
}

/// 0, or why not. It gets the signals as a shell's child has them: we ignore some.
int spawn(pid_t& child, const Pipes& pipes, std::vector<std::string> arguments,
          std::vector<std::string> environment) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, pipes.input[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, pipes.output[1], STDOUT_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t all;
  sigfillset(&all);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigdefault(&attributes, &all);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  const int error = posix_spawnp(&child, arguments.front().c_str(), &actions, &attributes,
                                 pointers(arguments).data(), pointers(environment).data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

/// Whether the descriptor is ready for `events` before the deadline.
bool wait_for(int descriptor, short events, Clock::time_point deadline) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
  pollfd one{descriptor, events, 0};
  return ::poll(&one, 1, static_cast<int>(std::max<std::int64_t>(left.count(), 0))) > 0;
}

Error no_answer() {
  return {"it has not answered in time (a line must be written at once: is its output flushed?)"};
}

}  // namespace

Result<LineProgram> LineProgram::start(std::vector<std::string> arguments,
                                       const std::map<std::string, std::string>& environment) {
  const std::string name = arguments.front();
  const auto refuse = [&](int why) {
    return Error{fmt::format("cannot be started: {}", std::strerror(why)), name};
  };
  Pipes pipes;
  if (::pipe2(pipes.input.data(), O_CLOEXEC) != 0) return refuse(errno);
  pid_t child = 0;
  int why = ::pipe2(pipes.output.data(), O_CLOEXEC) != 0
                ? errno
                : spawn(child, pipes, std::move(arguments), environment_with(environment));
  ::close(pipes.input[0]);
  if (pipes.output[1] >= 0) ::close(pipes.output[1]);
  if (why == 0) {
    ::fcntl(pipes.input[1], F_SETFL, O_NONBLOCK);
    ::fcntl(pipes.output[0], F_SETFL, O_NONBLOCK);
    return LineProgram(child, pipes.input[1], pipes.output[0]);
  }
  ::close(pipes.input[1]);
  if (pipes.output[0] >= 0) ::close(pipes.output[0]);
  return refuse(why);
}

LineProgram::LineProgram(LineProgram&& other) noexcept
    : process_id_(std::exchange(other.process_id_, 0)),
      input_(std::exchange(other.input_, -1)),
      output_(std::exchange(other.output_, -1)),
      received_(std::move(other.received_)) {}

// It ends with its input, or else by force.
LineProgram::~LineProgram() {
  if (input_ >= 0) ::close(input_);
  if (output_ >= 0) ::close(output_);
  if (process_id_ == 0) return;
  const auto deadline = Clock::now() + kEndGrace;
  while (::waitpid(process_id_, nullptr, WNOHANG) == 0) {
    if (Clock::now() >= deadline) ::kill(process_id_, SIGKILL);
    ::poll(nullptr, 0, 1);
  }
}

Result<std::string> LineProgram::ask(const std::string& line, Clock::duration patience) {
  const auto deadline = Clock::now() + patience;
  CLEW_RETURN_IF_ERROR(check_silent());
  CLEW_RETURN_IF_ERROR(send(line + '\n', deadline));
  return take_line(deadline);
}

/// What is there before it was asked is no answer to anything.
Result<void> LineProgram::check_silent() {
  const auto open = receive();
  if (!open.ok()) return open.error();
  if (!received_.empty()) {
    return Error{fmt::format("it wrote '{}' without being asked: one line is allowed for each",
                             received_.substr(0, std::min<std::size_t>(received_.find('\n'), 40)))};
  }
  return {};
}

Result<void> LineProgram::send(const std::string& text, Time deadline) {
  std::size_t sent = 0;
  while (sent < text.size()) {
    const ssize_t now = ::write(input_, text.data() + sent, text.size() - sent);
    if (now >= 0) {
      sent += static_cast<std::size_t>(now);
    } else if (errno == EAGAIN) {
      if (!wait_for(input_, POLLOUT, deadline)) return no_answer();
    } else if (errno != EINTR) {
      return ended();
    }
  }
  return {};
}

Result<std::string> LineProgram::take_line(Time deadline) {
  while (true) {
    const std::size_t end = received_.find('\n');
    if (end != std::string::npos) {
      std::string line = received_.substr(0, end);
      received_.erase(0, end + 1);
      return line;
    }
    if (received_.size() > kLongestLine) {
      return Error{fmt::format("its line is longer than {} bytes", kLongestLine)};
    }
    if (!wait_for(output_, POLLIN, deadline)) return no_answer();
    const auto open = receive();
    if (!open.ok()) return open.error();
    if (!*open) return ended();
  }
}

/// Takes what is there, without waiting. False: it has closed its output.
Result<bool> LineProgram::receive() {
  std::array<char, 65536> bytes;
  while (true) {
    const ssize_t got = ::read(output_, bytes.data(), bytes.size());
    if (got > 0) received_.append(bytes.data(), static_cast<std::size_t>(got));
    if (got == 0) return false;
    if (got < 0 && errno == EAGAIN) return true;
    if (got < 0 && errno != EINTR) return Error{std::strerror(errno), "its output"};
    if (received_.size() > kLongestLine) return true;
  }
}

/// It has closed a pipe, and so is about to end, unless it only closed it.
Error LineProgram::ended() {
  int status = 0;
  const auto deadline = Clock::now() + kEndGrace;
  while (Clock::now() < deadline) {
    if (::waitpid(process_id_, &status, WNOHANG) == process_id_) {
      process_id_ = 0;
      if (WIFSIGNALED(status)) {
        return {fmt::format("it was killed by signal {} ({})", WTERMSIG(status),
                            ::strsignal(WTERMSIG(status)))};
      }
      return {fmt::format("it exited with status {}", WEXITSTATUS(status))};
    }
    ::poll(nullptr, 0, 1);
  }
  return {"it has closed its standard input or output"};
}

}  // namespace clew::bridge
