// SPDX-License-Identifier: Apache-2.0
#include "hosts/hosted_component.hpp"

#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include "dds/rtps_ports.hpp"
#include "hosts/tcp_socket.hpp"
#include "log/log.hpp"
#include "run/limits.hpp"
#include "runtime/graph.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {
namespace {

using core::Error;
using core::Result;

/// Replaces the path of a file that is on the other host.
void put_here(std::string& path, const std::map<std::string, std::string>& here) {
  const auto found = here.find(path);
  path = found == here.end() ? std::string() : found->second;
}

}  // namespace

HostedComponent::HostedComponent(int socket, SSL_CTX& context, HostSurroundings& host, Time now)
    : line_(socket, context, HostRole::kHost, {}, now),
      host_(host),
      peer_address_(other_end(socket).text()),
      same_host_(own_end(socket).address == other_end(socket).address),
      connected_at_(now) {}

HostedComponent::~HostedComponent() {
  if (is_running()) child_->signal(SIGKILL);
}

void HostedComponent::add_descriptors(std::vector<pollfd>& descriptors) const {
  const bool reads = !link_ || !link_->has_unsent();
  if (!line_.is_closed()) descriptors.push_back({line_.socket(), line_.poll_events(reads), 0});
  if (link_) descriptors.push_back({link_->socket(), events_passed_to(line_, *link_), 0});
}

std::string HostedComponent::run() const {
  return order_ ? line_.peer() + '/' + order_->run_id : std::string();
}

const std::string& HostedComponent::stage() const {
  static const std::string kNone;
  return order_ ? order_->stage : kNone;
}

std::string HostedComponent::who() const {
  const std::string whose =
      line_.peer().empty() ? peer_address_ : line_.peer() + " (" + peer_address_ + ')';
  return order_ ? order_->stage + " for " + whose : whose;
}

bool HostedComponent::over() const { return line_.is_closed() && !is_running(); }

void HostedComponent::turn(Time now) {
  reads_ = !link_ || !link_->has_unsent();
  line_.turn(now, reads_);
  while (auto frame = line_.next()) handle(*std::move(frame));
  const bool waits = order_ && !child_ && !told_ && !line_.is_closed();
  if (waits && host_.clear_place(*this)) start(now);
  pass_on(now);
  watch_connection(now);  // first, so that why it is let go is told before how it ended
  watch_child(now);
}

void HostedComponent::handle(Frame frame) {
  if (frame.type == frame_type(HostFrame::kBeat)) return;
  if (frame.type == frame_type(HostFrame::kStart) && !order_) return take_order(frame);
  if (frame.type == frame_type(HostFrame::kAssigned) && order_ && !assigned_) {
    if (link_) assign(frame);  // else its component has ended meanwhile
    return;
  }
  if (order_ && is_of_component(frame)) {
    if (link_) link_->post_bytes(frame.type, frame.payload);
    return;
  }
  line_.close("sends what no relay does");
}

void HostedComponent::take_order(const Frame& frame) {
  order_ = frame.as<StartComponent>();
  if (!order_) return line_.close("sends what no relay does");
  if (const std::string fault = fault_of_order(); !fault.empty()) return refuse(fault);
  line_.allow_payload(kMostPayloadBytes);
  if (same_host_) return;  // the run holds its domain itself
  auto lock = host_.lock(order_->domain);
  if (!lock.ok()) return refuse(lock.error().text() + "; give the run another --domain");
  lock_ = std::move(lock).value();
}

std::string HostedComponent::fault_of_order() const {
  if (order_->version != host_.version || order_->idl_fingerprint != idl_fingerprint()) {
    return "has another build of clew: here " + host_.version + " (IDL " +
           std::string(idl_fingerprint()) + "), there " + order_->version + " (IDL " +
           order_->idl_fingerprint + ')';
  }
  if (!runtime::is_host_name(order_->stage)) return "'" + order_->stage + "' is no stage's name";
  const auto domain = check_domain(order_->domain);
  return domain.ok() ? std::string() : domain.error().text();
}

void HostedComponent::refuse(const std::string& why) {
  logs::warning("{} is refused: {}", who(), why);
  line_.post(frame_type(HostFrame::kRefused), Text{why});
  told_ = true;
  link_closed_at_ = std::chrono::steady_clock::now();
}

void HostedComponent::start(Time now) {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    return refuse(std::string("cannot start it: ") + std::strerror(errno));
  }
  link_ = std::make_unique<Link>(ends[0]);
  ChildCommand command;
  command.arguments = {host_.program, "component",
                       "-",           order_->stage,
                       "--domain",    std::to_string(order_->domain),
                       "--line",      std::to_string(ends[1])};
  for (const std::string& allowed : host_.allowed) {
    command.arguments.insert(command.arguments.end(), {"--allow", allowed});
  }
  command.inherited = ends[1];
  command.brings_to_rest = true;  // it ends at once, unless it moves a robot
  command.may_start_others = !host_.allowed.empty();
  auto child = ChildProcess::start(command);
  ::close(ends[1]);
  if (!child.ok()) {
    link_.reset();
    return refuse(child.error().text());
  }
  child_.emplace(std::move(child).value());
  line_.post(frame_type(HostFrame::kStarted), Text{});
  logs::info("{} is process {}", who(), child_->process_id());
  beat_at_ = now;
}

// The paths of the other host mean nothing here: what is in the files comes along.
void HostedComponent::assign(const Frame& frame) {
  auto told = frame.as<AssignedElsewhere>();
  if (!told) return line_.close("sends an assignment that is none");
  assigned_ = true;
  Assignment& assignment = told->assignment;
  if (assignment.domain != order_->domain || assignment.hosts.empty() || !assignment.security) {
    return end("sends an assignment that is not what it ordered");
  }
  realtime_ = assignment.pace == Pace::kRealtime;
  // In real time nobody takes its place, and it brings a robot to rest by itself.
  if (!realtime_) guard_ = GroupGuard::start(child_->process_id(), kHostLostAfter);
  std::map<std::string, std::string> here;
  for (const auto& [path, content] : told->files) {
    const auto& file = files_.emplace_back(std::make_unique<MemoryFile>("clew-hosted", content));
    if (!file->failure().empty()) return end(file->failure());
    here[path] = file->path();
  }
  if (auto& security = assignment.security) {
    for (std::string* path : {&security->authority, &security->certificate, &security->private_key,
                              &security->governance, &security->permissions}) {
      put_here(*path, here);
    }
  }
  assignment.input_histories = host_.input_files(run(), assignment.stages);
  link_->post(FrameType::kAssignment, std::move(assignment));
}

void HostedComponent::pass_on(Time now) {
  if (!link_) return;
  bool open = link_->flush();
  if (line_.unsent_bytes() < kMostRelayedBytes) {
    open = link_->receive() && open;
    while (const auto frame = link_->next()) {
      if (is_of_component(*frame)) line_.post_bytes(frame->type, frame->payload);
    }
  }
  if (open) return;
  link_.reset();
  link_closed_at_ = now;
}

void HostedComponent::watch_child(Time now) {
  if (!child_) return;
  child_->reap();
  if (is_running()) {
    const bool late = link_closed_at_ && !lost_at_ && now - *link_closed_at_ > kLastMoment;
    if (late) child_->signal(SIGKILL);
    return;
  }
  guard_.reset();
  if (told_ || link_) return;  // what it said last is still to be passed on
  told_ = true;
  logs::info("{} {}", who(), child_->end());
  const int status = child_->status();
  line_.post(frame_type(HostFrame::kEnded),
             ComponentEnd{WIFSIGNALED(status) ? WTERMSIG(status) : 0,
                          WIFEXITED(status) ? WEXITSTATUS(status) : 0});
  link_closed_at_ = now;
}

void HostedComponent::watch_connection(Time now) {
  if (!line_.is_closed()) tend_connection(now);
  if (!line_.is_closed()) return;
  if (!lost_at_) {
    lost_at_ = now;
    link_.reset();  // the component sees that its run is gone
    if (!told_ && !line_.was_left()) logs::warning("{} is let go: {}", who(), line_.why());
  }
  const std::chrono::milliseconds grace = realtime_ ? kRestTimeout + kLastMoment : kEndGrace;
  if (is_running() && now - *lost_at_ > grace) child_->signal(SIGKILL);
}

void HostedComponent::tend_connection(Time now) {
  const bool late = is_newcomer() && now - connected_at_ > kHelloTimeout;
  if (late) return line_.close("said nothing");
  const bool unheard = line_.is_open() && now - line_.heard_at() > kHostLostAfter;
  if (unheard && reads_) return line_.close("was not heard for 2 s");
  // It reads how the component ended, and leaves.
  const bool done = told_ && line_.unsent_bytes() == 0;
  if (done && now - *link_closed_at_ > kLastMoment) return line_.close("the component has ended");
  if (order_ && !told_) beat(now);
}

void HostedComponent::beat(Time now) {
  if (now - beat_at_ < kHostBeatPeriod) return;
  beat_at_ = now;
  line_.post(frame_type(HostFrame::kBeat), Text{});
  if (guard_) guard_->beat();
}

void HostedComponent::end(const std::string& why) {
  line_.close(why);
  if (is_running()) child_->signal(SIGKILL);
}

}  // namespace clew::bridge
