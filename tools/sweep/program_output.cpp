// SPDX-License-Identifier: Apache-2.0
#include "sweep/program_output.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

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

/// Starts a program in a group of its own; the error's number.
int spawn(std::vector<std::string> words, const Output& out, const Output& err, pid_t& process) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_init(&actions);
  posix_spawnattr_init(&attributes);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, out.file(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err.file(), STDERR_FILENO);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  const int error =
      ::posix_spawnp(&process, pointers.front(), &actions, &attributes, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  return error;
}

}  // namespace

core::Result<ProgramOutput> run_program(const std::vector<std::string>& words) {
  const Output out("clew-out");
  const Output err("clew-err");
  pid_t process = 0;
  const int error = spawn(words, out, err, process);
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
