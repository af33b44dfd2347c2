// SPDX-License-Identifier: Apache-2.0
#include "contract/own_process.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <string>

#include "core/process_end.hpp"

namespace clew::contract {
namespace {

core::Error failed(const std::string& what) { return {what}; }

[[noreturn]] void answer(int pipe, const std::function<core::Result<void>()>& work,
                         unsigned timeout_s) {
  ::alarm(timeout_s);
  const auto result = work();
  const std::string text = result.ok() ? std::string() : result.error().text();
  std::size_t written = 0;
  while (written < text.size()) {
    const auto count = ::write(pipe, text.data() + written, text.size() - written);
    if (count <= 0) break;
    written += static_cast<std::size_t>(count);
  }
  std::fflush(nullptr);
  core::end_at_once(result.ok() ? 0 : 1);
}

std::string read_all(int pipe) {
  std::string text;
  std::array<char, 4096> buffer{};
  while (true) {
    const auto count = ::read(pipe, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace

core::Result<void> in_own_process(const std::function<core::Result<void>()>& work,
                                  unsigned timeout_s) {
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) return failed(std::strerror(errno));
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child < 0) return failed(std::strerror(errno));
  if (child == 0) {
    ::close(ends[0]);
    answer(ends[1], work, timeout_s);
  }
  ::close(ends[1]);
  const std::string text = read_all(ends[0]);
  ::close(ends[0]);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status)) {
    if (WTERMSIG(status) == SIGALRM) {
      return failed("does not end within " + std::to_string(timeout_s) + " s");
    }
    return failed("was ended by signal " + std::to_string(WTERMSIG(status)) + " (" +
                  strsignal(WTERMSIG(status)) + ')');
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  return failed(text.empty() ? "ended the process" : text);
}

}  // namespace clew::contract
