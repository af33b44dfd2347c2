// SPDX-License-Identifier: Apache-2.0
#include "clew/fleet_processes.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <optional>
#include <string>

#include "core/process_end.hpp"
#include "recorder/recording_sink.hpp"
#include "recording/output_file.hpp"
#include "supervisor/process_run.hpp"

namespace clew::tools {
namespace {

using core::Error;
using core::Hash128;
using core::Result;
using fleet::RobotAlone;

constexpr int kLookPeriod_ms = 50;

/// Until its processes are gone.
Result<Hash128> run_one(const RobotAlone& robot, const bridge::ProcessLayout& layout, bool force) {
  std::optional<bridge::RecordingOrder> order;
  if (!robot.recording.empty()) {
    CLEW_RETURN_IF_ERROR(bridge::mcap::OutputFile::reserve(robot.recording, force));
    order = bridge::RecordingOrder{robot.recording, bridge::describe_run(robot.plan), 0.0, force};
  }
  const auto report = bridge::run_processes(robot.plan, layout, order, {});
  if (!report.ok()) {
    if (order) bridge::mcap::OutputFile::discard(robot.recording);
    return report.error();
  }
  if (!report->aborted.empty()) return Error{report->aborted};
  if (report->recording) {
    if (const std::string what = bridge::complaint(*report->recording); !what.empty()) {
      return Error{what};
    }
  }
  return *report->hash;
}

/// What one says to who started it: `=` and a hash, or `!` and why there is none.
std::string answer_of(const Result<Hash128>& result) {
  if (!result.ok()) return '!' + result.error().text();
  return '=' + std::string(reinterpret_cast<const char*>(&*result), sizeof(Hash128));
}

Result<Hash128> read_answer(const std::string& answer) {
  if (!answer.empty() && answer.front() == '!') return Error{answer.substr(1)};
  Hash128 hash;
  if (answer.size() != 1 + sizeof hash) return Error{"its run died"};
  std::memcpy(&hash, answer.data() + 1, sizeof hash);
  return hash;
}

/// A run of processes takes the signals and the children of its process for itself: so each robot
/// gets a process for its supervisor.
class Supervised {
 public:
  Supervised() = default;
  Supervised(const Supervised&) = delete;
  Supervised& operator=(const Supervised&) = delete;
  ~Supervised() {
    if (socket_ >= 0) ::close(socket_);
    if (process_ > 0) ::waitpid(process_, nullptr, 0);
  }

  Result<void> start(const RobotAlone& robot, const bridge::ProcessLayout& layout, bool force) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) return failed("a pipe for a robot cannot be made");
    const pid_t parent = ::getpid();
    process_ = ::fork();
    if (process_ == 0) {
      // Of a signal from the terminal it hears by its parent, once.
      ::setpgid(0, 0);
      ::prctl(PR_SET_PDEATHSIG, SIGTERM);
      if (::getppid() != parent) core::end_at_once(1);
      const std::string answer = answer_of(run_one(robot, layout, force));
      const bool told =
          ::write(ends[1], answer.data(), answer.size()) == static_cast<ssize_t>(answer.size());
      core::end_at_once(told ? 0 : 1);
    }
    const auto error = failed("a process for a robot cannot be made");
    ::close(ends[1]);
    socket_ = ends[0];
    return process_ > 0 ? Result<void>() : Result<void>(error);
  }

  pollfd to_poll() const { return {has_ended_ ? -1 : socket_, POLLIN, 0}; }
  bool has_ended() const { return has_ended_; }
  void signal(int number) const {
    if (process_ > 0 && !has_ended_) ::kill(process_, number);
  }
  /// Takes what there is to read.
  void read() {
    char bytes[4096];
    const ssize_t count = ::read(socket_, bytes, sizeof bytes);
    if (count > 0) answer_.append(bytes, static_cast<std::size_t>(count));
    has_ended_ = count == 0 || (count < 0 && errno != EINTR);
  }
  Result<Hash128> result() const { return read_answer(answer_); }

 private:
  static Error failed(const char* what) {
    return {std::string(what) + ": " + std::strerror(errno)};
  }

  pid_t process_ = -1;
  int socket_ = -1;
  bool has_ended_ = false;
  std::string answer_;
};

/// Until all have ended; gives the signal that was passed on to them, or 0.
int wait_for_all(std::vector<Supervised>& all, const std::function<int()>& interrupted) {
  int noted = 0;
  while (true) {
    std::vector<pollfd> polled;
    bool all_ended = true;
    for (const Supervised& one : all) {
      polled.push_back(one.to_poll());
      all_ended = all_ended && one.has_ended();
    }
    if (all_ended) return noted;
    ::poll(polled.data(), polled.size(), kLookPeriod_ms);
    if (const int number = interrupted(); number != 0) {
      noted = number;
      for (const Supervised& one : all) one.signal(number);
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
      if ((polled[i].revents & (POLLIN | POLLHUP)) != 0) all[i].read();
    }
  }
}

}  // namespace

fleet::AloneResults run_robots_as_processes(const std::vector<RobotAlone>& robots,
                                            const std::vector<bridge::ProcessLayout>& layouts,
                                            bool force, const std::function<int()>& interrupted) {
  fleet::AloneResults results;
  std::vector<Supervised> all(robots.size());
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const auto started = all[i].start(robots[i], layouts[i], force);
    if (started.ok()) continue;
    for (const Supervised& one : all) one.signal(SIGTERM);
    results.hashes.assign(robots.size(), started.error());
    return results;
  }
  results.interrupted_by = wait_for_all(all, interrupted);
  for (const Supervised& one : all) results.hashes.push_back(one.result());
  return results;
}

}  // namespace clew::tools
