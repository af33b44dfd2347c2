// SPDX-License-Identifier: Apache-2.0
#include "supervisor/child_process.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "core/process_end.hpp"

namespace clew::bridge {
namespace {

std::vector<std::string> merged_environment(const std::map<std::string, std::string>& extra) {
  std::vector<std::string> merged;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    if (extra.count(text.substr(0, text.find('='))) == 0) merged.push_back(text);
  }
  for (const auto& [name, value] : extra) merged.push_back(name + '=' + value);
  return merged;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  result.reserve(texts.size() + 1);
  for (std::string& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

// Runs in the child, between fork and exec: only calls that are safe there.
[[noreturn]] void become(char* const* arguments, char** environment, const ChildCommand& command,
                         int parent, int error_pipe) {
  ::prctl(PR_SET_PDEATHSIG, command.brings_to_rest ? SIGTERM : SIGKILL);
  if (::getppid() != parent) core::end_at_once(1);
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  if (!command.keeps_terminal) {
    // A group of its own: Ctrl-C is for the supervisor, which then ends the run in order.
    ::setpgid(0, 0);
    const int nothing = ::open("/dev/null", O_RDONLY);
    if (nothing >= 0) ::dup2(nothing, STDIN_FILENO);
    ::dup2(STDERR_FILENO, STDOUT_FILENO);
  }
  if (command.inherited >= 0) ::fcntl(command.inherited, F_SETFD, 0);
  environ = environment;
  ::execvp(arguments[0], arguments);
  const int why = errno;
  const ssize_t written = ::write(error_pipe, &why, sizeof why);
  core::end_at_once(written == sizeof why ? 127 : 126);
}

}  // namespace

core::Result<ChildProcess> ChildProcess::start(const ChildCommand& command) {
  std::vector<std::string> arguments = command.arguments;
  std::vector<std::string> environment = merged_environment(command.environment);
  std::vector<char*> argument_pointers = pointers(arguments);
  std::vector<char*> environment_pointers = pointers(environment);
  const auto refuse = [&](int why) {
    const std::filesystem::path program = arguments.front();
    std::string text = "cannot be started: " + std::string(std::strerror(why));
    std::error_code code;
    if (program.has_parent_path() && program.is_relative()) {
      const std::string here = std::filesystem::current_path(code).string();
      text += " (a path from the working directory, " + here + ')';
    }
    return core::Error{text, arguments.front()};
  };
  int error_pipe[2];
  if (::pipe2(error_pipe, O_CLOEXEC) != 0) return refuse(errno);
  const int parent = ::getpid();
  const int child = ::fork();
  if (child == 0) {
    become(argument_pointers.data(), environment_pointers.data(), command, parent, error_pipe[1]);
  }
  const int fork_error = errno;
  ::close(error_pipe[1]);
  int exec_error = 0;
  // End of file means that exec has closed the pipe: the program runs.
  const ssize_t got = child < 0 ? 0 : ::read(error_pipe[0], &exec_error, sizeof exec_error);
  ::close(error_pipe[0]);
  if (child < 0) return refuse(fork_error);
  if (got > 0) {
    ::waitpid(child, nullptr, 0);
    return refuse(exec_error);
  }
  const bool own_group = !command.keeps_terminal;
  auto guard = own_group && command.may_start_others ? GroupGuard::start(child) : std::nullopt;
  return ChildProcess(child, own_group, std::move(guard));
}

bool ChildProcess::reap() {
  if (!running_ || ::waitpid(process_id_, &status_, WNOHANG) != process_id_) return false;
  running_ = false;
  if (guard_) ::kill(-process_id_, SIGKILL);
  return true;
}

std::string ChildProcess::end() const {
  if (WIFSIGNALED(status_)) {
    const int number = WTERMSIG(status_);
    return "was killed by signal " + std::to_string(number) + " (" + ::strsignal(number) + ")";
  }
  return "exited with status " + std::to_string(WEXITSTATUS(status_));
}

bool ChildProcess::was_killed() const {
  return !running_ && WIFSIGNALED(status_) && WTERMSIG(status_) == SIGKILL;
}

void ChildProcess::signal(int number) const {
  if (!running_) return;
  ::kill(own_group_ ? -process_id_ : process_id_, number);
}

}  // namespace clew::bridge
