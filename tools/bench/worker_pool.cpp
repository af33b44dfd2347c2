// SPDX-License-Identifier: Apache-2.0
#include "bench/worker_pool.hpp"

#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>

#include "bench/noted_signals.hpp"
#include "core/check.hpp"
#include "core/process_end.hpp"

namespace clew::bench {
namespace {

using core::Error;
using core::Result;

enum class FrameType : std::uint8_t { kLine, kDone, kError };

/// What goes before the text of a frame.
struct FrameHead {
  std::uint32_t size = 0;
  FrameType type = FrameType::kLine;
};

bool send_all(int socket, const char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t sent = ::send(socket, bytes, size, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    bytes += sent;
    size -= static_cast<std::size_t>(sent);
  }
  return true;
}

bool send_frame(int socket, FrameType type, const std::string& text) {
  const FrameHead head{static_cast<std::uint32_t>(text.size()), type};
  std::string bytes(sizeof head, '\0');
  std::memcpy(bytes.data(), &head, sizeof head);
  bytes += text;
  return send_all(socket, bytes.data(), bytes.size());
}

/// The life of a worker: units come as numbers until the line closes.
[[noreturn]] void serve(int socket, pid_t parent, const Work& work) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) core::end_at_once(1);  // it died before the line above
  std::signal(SIGINT, SIG_IGN);                     // the parent decides
  std::signal(SIGTERM, SIG_DFL);
  std::uint64_t unit = 0;
  while (::recv(socket, &unit, sizeof unit, MSG_WAITALL) == static_cast<ssize_t>(sizeof unit)) {
    bool wanted = true;
    const auto done = work(static_cast<std::size_t>(unit), [&](const std::string& line) {
      wanted = wanted && send_frame(socket, FrameType::kLine, line);
      return wanted;
    });
    if (!done.ok()) {
      send_frame(socket, FrameType::kError, done.error().text());
      core::end_at_once(1);
    }
    if (!wanted || !send_frame(socket, FrameType::kDone, "")) break;
  }
  core::end_at_once(0);
}

class Pool {
 public:
  Pool(const std::vector<std::size_t>& units, const PoolOptions& options)
      : units_(units), options_(options) {}
  ~Pool() {
    for (const Worker& worker : workers_) {
      ::kill(worker.process, SIGKILL);
      ::close(worker.socket);
    }
    for (const Worker& worker : workers_) ::waitpid(worker.process, nullptr, 0);
  }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  Result<void> start(const Work& work) {
    const pid_t parent = ::getpid();
    for (std::size_t i = 0; i < options_.workers && i < units_.size(); ++i) {
      int sockets[2];
      if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets) != 0) {
        return failed("a worker's line");
      }
      const pid_t process = ::fork();
      if (process < 0) return failed("a worker");
      if (process == 0) {
        // The lines of the workers before are not this one's to keep open.
        for (const Worker& other : workers_) ::close(other.socket);
        ::close(sockets[0]);
        serve(sockets[1], parent, work);
      }
      ::close(sockets[1]);
      workers_.push_back({process, sockets[0], true, {}});
      hand_out(workers_.back());
    }
    return {};
  }

  Result<PoolEnd> run() {
    while (busy() > 0) {
      std::vector<pollfd> polled;
      for (const Worker& worker : workers_) {
        polled.push_back({worker.is_busy ? worker.socket : -1, POLLIN, 0});
      }
      const int ready = ::poll(polled.data(), polled.size(), -1);
      if (NotedSignals::noted() != 0) return PoolEnd{NotedSignals::noted()};
      if (ready < 0 && errno == EINTR) continue;
      if (ready < 0) return failed("poll");
      for (std::size_t i = 0; i < workers_.size(); ++i) {
        if (polled[i].revents != 0) CLEW_RETURN_IF_ERROR(receive(workers_[i]));
      }
    }
    return PoolEnd{};
  }

 private:
  struct Worker {
    pid_t process;
    int socket;
    bool is_busy;
    std::string received;
  };

  static Error failed(const std::string& what) { return {what + ": " + std::strerror(errno)}; }

  std::size_t busy() const {
    std::size_t count = 0;
    for (const Worker& worker : workers_) count += worker.is_busy ? 1 : 0;
    return count;
  }

  void hand_out(Worker& worker) {
    worker.is_busy = next_ < units_.size();
    if (!worker.is_busy) return;
    const std::uint64_t unit = units_[next_++];
    send_all(worker.socket, reinterpret_cast<const char*>(&unit), sizeof unit);
  }

  Result<void> receive(Worker& worker) {
    char buffer[65536];
    const ssize_t got = ::recv(worker.socket, buffer, sizeof buffer, 0);
    if (got < 0 && errno == EINTR) return {};
    if (got <= 0) return Error{"a worker process died"};
    worker.received.append(buffer, static_cast<std::size_t>(got));
    FrameHead head;
    while (worker.received.size() >= sizeof head) {
      std::memcpy(&head, worker.received.data(), sizeof head);
      if (worker.received.size() < sizeof head + head.size) return {};
      const std::string text = worker.received.substr(sizeof head, head.size);
      worker.received.erase(0, sizeof head + head.size);
      CLEW_RETURN_IF_ERROR(take(worker, head.type, text));
    }
    return {};
  }

  Result<void> take(Worker& worker, FrameType type, const std::string& text) {
    switch (type) {
      case FrameType::kLine:
        return options_.on_line(text);
      case FrameType::kDone:
        hand_out(worker);
        return {};
      case FrameType::kError:
        break;
    }
    return Error{text};
  }

  const std::vector<std::size_t>& units_;
  const PoolOptions& options_;
  std::vector<Worker> workers_;
  std::size_t next_ = 0;
};

}  // namespace

Result<PoolEnd> run_in_workers(const std::vector<std::size_t>& units, const Work& work,
                               const PoolOptions& options) {
  CLEW_CHECK(options.workers > 0, "a pool without workers");
  const NotedSignals signals;
  Pool pool(units, options);
  CLEW_RETURN_IF_ERROR(pool.start(work));
  return pool.run();
}

}  // namespace clew::bench
