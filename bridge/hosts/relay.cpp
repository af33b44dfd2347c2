// SPDX-License-Identifier: Apache-2.0
#include "hosts/relay.hpp"

#include <poll.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <ctime>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "hosts/host_frames.hpp"
#include "hosts/host_list.hpp"
#include "hosts/tcp_socket.hpp"
#include "hosts/tls_line.hpp"
#include "line/link.hpp"
#include "log/log.hpp"
#include "run/limits.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {
namespace {

using Clock = std::chrono::steady_clock;
using core::Error;
using core::Result;

/// How long the other host is tried, after the first: together they get no more than one alone.
constexpr auto kOtherHostPatience = kHostPatience - kFallBackAfter;

Result<std::string> read_file(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return Error{"cannot be read", path};
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

/// The same run on the same boot of the same computer.
Result<std::string> run_of_parent() {
  auto boot = read_file("/proc/sys/kernel/random/boot_id");
  if (!boot.ok()) return boot.error();
  if (!boot->empty() && boot->back() == '\n') boot->pop_back();
  return *boot + '/' + std::to_string(::getppid());
}

Result<AssignedElsewhere> with_files(Assignment assignment) {
  AssignedElsewhere told{std::move(assignment), {}};
  told.assignment.input_histories.clear();
  if (const auto& security = told.assignment.security) {
    for (const std::string& path :
         {security->authority, security->certificate, security->private_key, security->governance,
          security->permissions}) {
      auto content = read_file(path);
      if (!content.ok()) return content.error();
      told.files[path] = *std::move(content);
    }
  }
  return told;
}

void die_by(int signal) {
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  std::signal(signal, SIG_DFL);
  sigset_t all;
  sigemptyset(&all);
  sigaddset(&all, signal);
  ::sigprocmask(SIG_UNBLOCK, &all, nullptr);
  ::raise(signal);
}

/// A connection to a host, and what became of it.
struct Connection {
  std::unique_ptr<TlsLine> line;  ///< with the component started
  std::string why;                ///< why there is none
  bool refused = false;           ///< and trying again is no use
};

class Relay {
 public:
  Relay(const RelayOrder& order, TcpAddress address, TlsContextPtr context)
      : order_(order),
        host_(order.host),
        address_(std::move(address)),
        context_(std::move(context)) {}
  /// Where it goes if the host does not answer.
  void fall_back_to(TcpAddress address) { other_address_ = std::move(address); }

  int run() {
    auto run_id = run_of_parent();
    if (!run_id.ok()) return fail_run(run_id.error().text());
    run_id_ = *std::move(run_id);
    const bool has_other = other_address_ || order_.fallback == kFallbackHere;
    Connection connection = find_host(has_other ? Clock::duration(kFallBackAfter) : kHostPatience);
    if (!connection.line && !connection.refused && other_address_) {
      warn("does not answer: " + connection.why + "; the component runs on " + order_.fallback);
      host_ = order_.fallback;
      address_ = *std::exchange(other_address_, std::nullopt);
      connection = find_host(kOtherHostPatience);
    }
    if (connection.line) {
      line_ = std::move(connection.line);
      return pass_on();
    }
    if (connection.refused) return fail_run(connection.why);
    if (order_.fallback == kFallbackHere) return run_here(connection.why);
    warn("does not answer: " + connection.why);
    die_by(SIGKILL);
    return 1;
  }

 private:
  /// `text` may be what the host says.
  void warn(const std::string& text) const {
    logs::warning("host {} ({}) {}", host_, address_.text(), text);
  }

  Connection find_host(Clock::duration patience) {
    const auto deadline = Clock::now() + patience;
    bool told = false;
    while (true) {
      Connection connection = connect(std::min(deadline, Clock::now() + kHostLostAfter));
      if (connection.line || connection.refused || Clock::now() >= deadline) return connection;
      if (!std::exchange(told, true)) warn("does not answer yet: " + connection.why);
      ::poll(nullptr, 0, static_cast<int>(kReconnectPeriod.count()));
    }
  }

  Connection connect(Clock::time_point deadline) {
    const auto socket = begin_connecting(address_);
    if (!socket.ok()) return {nullptr, socket.error().message, false};
    auto line =
        std::make_unique<TlsLine>(*socket, *context_, HostRole::kRunner, host_, Clock::now());
    line->allow_payload(kMostPayloadBytes);
    line->post(frame_type(HostFrame::kStart),
               StartComponent{order_.version, std::string(idl_fingerprint()), run_id_, order_.stage,
                              order_.domain});
    while (Clock::now() < deadline) {
      pollfd descriptor{line->socket(), line->poll_events(), 0};
      ::poll(&descriptor, 1, static_cast<int>(kPollPeriod.count()));
      line->turn(Clock::now());
      while (const auto frame = line->next()) {
        if (frame->type == frame_type(HostFrame::kStarted)) return {std::move(line), {}, false};
        if (frame->type != frame_type(HostFrame::kRefused)) continue;
        const auto why = frame->as<Text>();
        return {nullptr, why ? why->text : "refused", true};
      }
      if (line->is_closed()) return {nullptr, line->why(), line->was_refused()};
      beat(*line, Clock::now());
    }
    return {nullptr, "no answer", false};
  }

  void beat(TlsLine& line, Clock::time_point now) {
    if (!line.is_open() || now - beat_at_ < kHostBeatPeriod) return;
    beat_at_ = now;
    line.post(frame_type(HostFrame::kBeat), Text{});
  }

  int pass_on() {
    while (true) {
      const bool reads = !link_ || !link_->has_unsent();
      std::vector<pollfd> descriptors = {{line_->socket(), line_->poll_events(reads), 0}};
      if (link_) descriptors.push_back({link_->socket(), events_passed_to(*line_, *link_), 0});
      ::poll(descriptors.data(), descriptors.size(), static_cast<int>(kPollPeriod.count()));
      const auto now = Clock::now();
      line_->turn(now, reads);
      while (auto frame = line_->next()) {
        if (frame->type == frame_type(HostFrame::kEnded)) return end_likewise(*frame);
        if (is_of_component(*frame) && !hand_over(*std::move(frame))) return 1;
      }
      if (!serve_supervisor()) {
        line_->close("the run is over");
        return status_;
      }
      beat(*line_, now);
      if (reads && now - line_->heard_at() > kHostLostAfter) line_->close("was not heard for 2 s");
      if (line_->is_closed()) {
        warn("is lost: " + line_->why());
        die_by(SIGKILL);
        return 1;
      }
    }
  }

  /// To the supervisor, which knows this process and not that of the other host.
  bool hand_over(Frame frame) {
    if (!link_) {
      const auto socket = Link::connect(order_.domain, Clock::now() + kHelloTimeout);
      if (!socket.ok()) {
        logs::error("{}", socket.error().text());
        return false;
      }
      link_ = std::make_unique<Link>(*socket);
    }
    if (frame.type == FrameType::kHello) {
      auto hello = frame.as<Hello>();
      if (!hello) return false;
      hello->process_id = ::getpid();
      return link_->post(FrameType::kHello, *std::move(hello));
    }
    return link_->post_bytes(frame.type, frame.payload);
  }

  /// False when it is gone, or has been told that the run cannot go on.
  bool serve_supervisor() {
    if (!link_) return true;
    bool open = link_->flush();
    if (line_->unsent_bytes() >= kMostRelayedBytes) return open;
    open = link_->receive() && open;
    while (auto frame = link_->next()) {
      if (frame->type != FrameType::kAssignment) {
        line_->post_bytes(frame->type, frame->payload);
        continue;
      }
      auto assignment = frame->as<Assignment>();
      if (!assignment) return false;
      auto told = with_files(*std::move(assignment));
      if (!told.ok()) {
        status_ = fail_run(told.error().text());
        return false;
      }
      line_->post(frame_type(HostFrame::kAssigned), *std::move(told));
    }
    return open;
  }

  int end_likewise(const Frame& frame) {
    if (link_) link_->flush_until(Clock::now() + kEndGrace);
    const auto end = frame.as<ComponentEnd>();
    if (!end) return 1;
    if (end->signal > 0 && end->signal < NSIG) die_by(end->signal);
    return end->status;
  }

  /// The run can do nothing about it: it ends, and says why.
  int fail_run(const std::string& why) {
    const std::string text =
        order_.stage + ": host " + host_ + " (" + address_.text() + "): " + why;
    if (!link_ && !meet_supervisor()) return 1;
    link_->post(FrameType::kFatal, Text{text});
    link_->flush_until(Clock::now() + kEndGrace);
    return 1;
  }

  bool meet_supervisor() {
    const auto socket = Link::connect(order_.domain, Clock::now() + kHelloTimeout);
    if (!socket.ok()) return false;
    link_ = std::make_unique<Link>(*socket);
    link_->post(FrameType::kHello, Hello{order_.stage, ::getpid(), std::string(idl_fingerprint())});
    return link_->wait_for_frame(Clock::now() + kAssignmentTimeout).ok();
  }

  int run_here(const std::string& why) {
    warn("does not answer: " + why + "; the component runs here");
    const std::string domain = std::to_string(order_.domain);
    const char* const words[] = {
        order_.program.c_str(), "component", "-", order_.stage.c_str(), "--domain",
        domain.c_str(),         nullptr};
    ::execvp(words[0], const_cast<char* const*>(words));
    return 1;
  }

  const RelayOrder& order_;
  std::string host_;
  TcpAddress address_;
  std::optional<TcpAddress> other_address_;  ///< until it is needed
  TlsContextPtr context_;
  std::unique_ptr<TlsLine> line_;  ///< to the host
  std::unique_ptr<Link> link_;     ///< to the supervisor
  std::string run_id_;
  int status_ = 0;  ///< when the run is over
  Clock::time_point beat_at_{};
};

int complain(const Error& error) {
  logs::error("{}", error.text());
  return 1;
}

}  // namespace

int run_relay(const RelayOrder& order) {
  const auto list = HostList::read(order.hosts_file);
  if (!list.ok()) return complain(list.error());
  const auto address = list->find(order.host);
  if (!address.ok()) return complain(address.error());
  const auto identity = HostIdentity::read(list->identity, HostRole::kRunner, std::time(nullptr));
  if (!identity.ok()) return complain(identity.error());
  auto context = make_tls_context(*identity, HostRole::kRunner);
  if (!context.ok()) return complain(context.error());
  Relay relay(order, *address, std::move(context).value());
  if (!order.fallback.empty() && order.fallback != kFallbackHere) {
    auto other = list->find(order.fallback);
    if (!other.ok()) return complain(other.error());
    relay.fall_back_to(*std::move(other));
  }
  return relay.run();
}

}  // namespace clew::bridge
