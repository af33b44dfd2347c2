// SPDX-License-Identifier: Apache-2.0
#include "run/end_signals.hpp"

#include <sys/signalfd.h>
#include <unistd.h>

#include <initializer_list>

namespace clew::bridge {

EndSignals::EndSignals() {
  sigemptyset(&set_);
  for (int number : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) sigaddset(&set_, number);
  ::sigprocmask(SIG_BLOCK, &set_, &before_);
  descriptor_ = ::signalfd(-1, &set_, SFD_NONBLOCK | SFD_CLOEXEC);
}

EndSignals::~EndSignals() {
  ::close(descriptor_);
  ::sigprocmask(SIG_SETMASK, &before_, nullptr);
}

int EndSignals::take() {
  int asked = 0;
  signalfd_siginfo info{};
  while (::read(descriptor_, &info, sizeof info) == sizeof info) {
    if (info.ssi_signo != SIGCHLD) asked = static_cast<int>(info.ssi_signo);
  }
  return asked;
}

}  // namespace clew::bridge
