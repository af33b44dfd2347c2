// SPDX-License-Identifier: Apache-2.0
#include "gateway/program_runs.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <utility>

#include "run/program_start.hpp"

namespace clew::bridge {
namespace {

constexpr std::size_t kMostAtOnce = 4;
constexpr std::size_t kMostOutputBytes = 32 * 1024 * 1024;

/// What was written to a file in memory, and closes it.
std::string take_output(int file) {
  struct stat facts {};
  ::fstat(file, &facts);
  const auto written = static_cast<std::size_t>(std::max<off_t>(facts.st_size, 0));
  std::string text(std::min(written, kMostOutputBytes), '\0');
  const ssize_t size = ::pread(file, text.data(), text.size(), 0);
  ::close(file);
  text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  return text;
}

int exit_status(int state) {
  return WIFSIGNALED(state) ? 128 + WTERMSIG(state) : WEXITSTATUS(state);
}

}  // namespace

ProgramRuns::~ProgramRuns() {
  for (const Running& each : running_) {
    ::kill(-each.process_id, SIGKILL);
    ::waitpid(each.process_id, nullptr, 0);
    ::close(each.out);
    ::close(each.err);
  }
}

core::Result<void> ProgramRuns::start(const std::vector<std::string>& words, Time now, Done done) {
  if (running_.size() >= kMostAtOnce) {
    return core::Error{"four runs are under way; wait for one of them"};
  }
  Running running{0, ::memfd_create("clew-out", MFD_CLOEXEC),
                  ::memfd_create("clew-err", MFD_CLOEXEC), now + patience_, std::move(done)};
  const int error = start_program(words, running.out, running.err, running.process_id);
  if (error != 0) {
    ::close(running.out);
    ::close(running.err);
    return core::Error{"cannot be started: " + std::string(std::strerror(error)), words.front()};
  }
  running_.push_back(std::move(running));
  return {};
}

bool ProgramRuns::poll(Time now) {
  for (auto each = running_.begin(); each != running_.end();) {
    int state = 0;
    if (now >= each->until) ::kill(-each->process_id, SIGKILL);
    if (::waitpid(each->process_id, &state, WNOHANG) != each->process_id) {
      ++each;
      continue;
    }
    ProgramEnd end{exit_status(state), take_output(each->out), take_output(each->err)};
    const Done done = std::move(each->done);
    each = running_.erase(each);
    done(std::move(end));
  }
  return !running_.empty();
}

}  // namespace clew::bridge
