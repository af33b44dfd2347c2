// SPDX-License-Identifier: Apache-2.0
#include "line/wake_up.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>

#include "core/check.hpp"

namespace clew::bridge {

WakeUp::WakeUp() : descriptor_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  CLEW_CHECK(descriptor_ >= 0, "no descriptor is left");
}

WakeUp::~WakeUp() { ::close(descriptor_); }

void WakeUp::ring() const {
  // It fails when it has rung too often, and then it is readable already.
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = ::write(descriptor_, &one, sizeof one);
}

void WakeUp::wait_beside(const std::vector<int>& descriptors, std::chrono::nanoseconds most) const {
  std::vector<pollfd> polled = {{descriptor_, POLLIN, 0}};
  for (const int descriptor : descriptors) polled.push_back({descriptor, POLLIN, 0});
  const auto left = std::max(most, std::chrono::nanoseconds::zero());
  const auto whole_s = std::chrono::duration_cast<std::chrono::seconds>(left);
  const timespec timeout{whole_s.count(), (left - whole_s).count()};
  ::ppoll(polled.data(), polled.size(), &timeout, nullptr);
  std::uint64_t rings = 0;
  [[maybe_unused]] const ssize_t count = ::read(descriptor_, &rings, sizeof rings);
}

}  // namespace clew::bridge
