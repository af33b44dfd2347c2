// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <utility>

#include "ros2/messages.hpp"

namespace clew::robot {

using Time = std::chrono::steady_clock::time_point;

inline double seconds_between(Time from, Time to) {
  return std::chrono::duration<double>(to - from).count();
}

/// The newest message of a topic, and how old it is. Its age is measured here, from its arrival:
/// the robot's clock may be any. A message that repeats the stamp of the one before is no news,
/// since a driver that hangs may go on to publish; stamps that are always zero say nothing.
///
/// One writer is listened to. Another one takes over when the first has been silent for
/// `timeout_s`, as after a restart.
template <typename Message>
class Latest {
 public:
  explicit Latest(double timeout_s) : timeout_s_(timeout_s) {}

  /// Whether what this writer says is listened to.
  bool listens_to(const std::string& writer, Time now) const {
    return !is_there_ || writer == writer_ || age_s(now) > timeout_s_;
  }
  /// Whether it was news, and is kept.
  bool take(Message message, const std::string& writer, Time now) {
    const ros2::Time& stamp = message.header.stamp;
    const ros2::Time& before = message_.header.stamp;
    const bool has_stamp = stamp.sec != 0 || stamp.nanosec != 0;
    const bool repeats = is_there_ && writer == writer_ && has_stamp && stamp.sec == before.sec &&
                         stamp.nanosec == before.nanosec;
    if (repeats) return false;
    message_ = std::move(message);
    writer_ = writer;
    arrived_ = now;
    is_there_ = true;
    return true;
  }

  bool is_there() const { return is_there_; }
  const Message& message() const { return message_; }
  Time arrived() const { return arrived_; }
  double age_s(Time now) const { return seconds_between(arrived_, now); }

 private:
  double timeout_s_;
  bool is_there_ = false;
  Message message_;
  std::string writer_;
  Time arrived_{};
};

}  // namespace clew::robot
