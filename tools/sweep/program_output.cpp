// SPDX-License-Identifier: Apache-2.0
#include "sweep/program_output.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "run/program_start.hpp"

namespace clew::sweep {
namespace {

/// A file in memory that takes what a program writes.
class Output {
 public:
  explicit Output(const char* name) : file_(::memfd_create(name, MFD_CLOEXEC)) {}
  ~Output() { ::close(file_); }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  int file() const { return file_; }
  std::string text() const {
    std::string text;
    char buffer[4096];
    for (ssize_t got;
         (got = ::pread(file_, buffer, sizeof buffer, static_cast<off_t>(text.size()))) > 0;) {
      text.append(buffer, static_cast<std::size_t>(got));
    }
    return text;
  }

 private:
  int file_;
};

}  // namespace

core::Result<ProgramOutput> run_program(const std::vector<std::string>& words) {
  const Output out("clew-out");
  const Output err("clew-err");
  pid_t process = 0;
  const int error = bridge::start_program(words, out.file(), err.file(), process);
  if (error != 0) {
    return core::Error{std::string("cannot be started: ") + std::strerror(error), words.front()};
  }
  int state = 0;
  while (::waitpid(process, &state, 0) < 0 && errno == EINTR) {
  }
  const int status = WIFSIGNALED(state) ? 128 + WTERMSIG(state) : WEXITSTATUS(state);
  return ProgramOutput{status, out.text(), err.text()};
}

}  // namespace clew::sweep
