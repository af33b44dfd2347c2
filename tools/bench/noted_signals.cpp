// SPDX-License-Identifier: Apache-2.0
#include "bench/noted_signals.hpp"

#include <poll.h>

namespace clew::bench {
namespace {

volatile std::sig_atomic_t end_signal = 0;
void note_signal(int number) { end_signal = number; }

}  // namespace

NotedSignals::NotedSignals() {
  end_signal = 0;
  struct sigaction action {};
  action.sa_handler = note_signal;
  ::sigaction(SIGINT, &action, &interrupt_);
  ::sigaction(SIGTERM, &action, &terminate_);
}

NotedSignals::~NotedSignals() {
  ::sigaction(SIGINT, &interrupt_, nullptr);
  ::sigaction(SIGTERM, &terminate_, nullptr);
}

int NotedSignals::noted() { return end_signal; }

bool NotedSignals::wait(double seconds) {
  if (end_signal == 0) ::poll(nullptr, 0, static_cast<int>(1000.0 * seconds));
  return end_signal == 0;
}

}  // namespace clew::bench
