// SPDX-License-Identifier: Apache-2.0
#include "echo_process.hpp"

#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string>

#include "core/check.hpp"

namespace clew::bridge {

EchoProcess::EchoProcess(Vendor vendor, int domain, int core) {
  const std::string name(vendor_name(vendor));
  const std::string number = std::to_string(domain);
  cpu_set_t cores;
  CPU_ZERO(&cores);
  if (core >= 0) CPU_SET(static_cast<unsigned>(core), &cores);
  int ends[2];
  CLEW_CHECK(pipe2(ends, O_CLOEXEC) == 0, "no pipe");
  pid_ = fork();
  if (pid_ == 0) {
    if (core >= 0) sched_setaffinity(0, sizeof cores, &cores);
    dup2(ends[0], STDIN_FILENO);
    execl(CLEW_BRIDGE_ECHO, CLEW_BRIDGE_ECHO, name.c_str(), number.c_str(), nullptr);
    _exit(127);
  }
  close(ends[0]);
  stdin_ = ends[1];
}

void EchoProcess::kill_it() {
  kill(pid_, SIGKILL);
  end();
}

int EchoProcess::end() {
  if (stdin_ < 0) return status_;
  close(stdin_);
  stdin_ = -1;
  waitpid(pid_, &status_, 0);
  return status_;
}

}  // namespace clew::bridge
