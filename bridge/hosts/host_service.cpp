// SPDX-License-Identifier: Apache-2.0
#include "hosts/host_service.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <utility>

#include "hosts/tcp_socket.hpp"
#include "log/log.hpp"
#include "run/end_signals.hpp"
#include "run/limits.hpp"

namespace clew::bridge {
namespace {

using Clock = std::chrono::steady_clock;
using core::Error;
using core::Result;

/// Connections at a time: more than any robot has components. Each may hold ten files: sockets,
/// keys and inputs; a process may have 1024.
constexpr std::size_t kMostComponents = 96;

}  // namespace

Result<std::unique_ptr<HostService>> HostService::open(const HostOrder& order) {
  const auto identity = HostIdentity::read(order.identity, HostRole::kHost, std::time(nullptr));
  if (!identity.ok()) return identity.error();
  auto context = make_tls_context(*identity, HostRole::kHost);
  if (!context.ok()) return context.error();
  const auto listening = listen_on(order.listen);
  if (!listening.ok()) return listening.error();
  return std::unique_ptr<HostService>(
      new HostService(order, std::move(context).value(), identity->name, *listening));
}

HostService::HostService(HostOrder order, TlsContextPtr context, std::string name, int listening)
    : context_(std::move(context)), name_(std::move(name)), listening_(listening) {
  surroundings_.program = std::move(order.program);
  surroundings_.version = std::move(order.version);
  surroundings_.allowed = std::move(order.allowed);
  surroundings_.clear_place = [this](const HostedComponent& newcomer) {
    return clear_place(newcomer);
  };
  surroundings_.lock = [this](int domain) { return lock(domain); };
  surroundings_.input_files = [this](const std::string& run,
                                     const std::vector<std::string>& stages) {
    return input_files(run, stages);
  };
}

HostService::~HostService() { ::close(listening_); }

TcpAddress HostService::address() const { return own_end(listening_); }

void HostService::run(EndSignals& signals) {
  while (signals.take() == 0) {
    std::vector<pollfd> descriptors = {{signals.descriptor(), POLLIN, 0}};
    if (accepts_) descriptors.push_back({listening_, POLLIN, 0});
    for (const auto& component : components_) component->add_descriptors(descriptors);
    ::poll(descriptors.data(), descriptors.size(), static_cast<int>(kPollPeriod.count()));
    const auto now = Clock::now();
    accept(now);
    // By number: a component that starts may end others.
    for (std::size_t i = 0; i < components_.size(); ++i) components_[i]->turn(now);
    forget(now);
  }
  // Those that move a robot bring it to rest.
  const auto deadline = Clock::now() + kRestTimeout;
  for (const auto& component : components_) component->leave("the host ends");
  while (!components_.empty() && Clock::now() < deadline) {
    ::poll(nullptr, 0, static_cast<int>(kPollPeriod.count()));
    for (const auto& component : components_) component->turn(Clock::now());
    forget(Clock::now());
  }
  components_.clear();
}

void HostService::accept(Time now) {
  for (std::size_t i = 0; i < kMostNewcomers; ++i) {
    const int socket = accept_next(listening_);
    if (socket < 0) {
      note_refusal(errno);
      break;
    }
    if (components_.size() >= kMostComponents) {
      logs::warning("{} is turned away: {} are connected, which is the most",
                    other_end(socket).text(), components_.size());
      ::close(socket);
      continue;
    }
    components_.push_back(std::make_unique<HostedComponent>(socket, *context_, surroundings_, now));
  }
  send_surplus_away();
}

// While descriptors are short, who waits would end every poll at once: it is tried once a period.
void HostService::note_refusal(int reason) {
  const bool nobody = reason == EAGAIN || reason == EWOULDBLOCK;
  if (!nobody && accepts_) logs::warning("cannot take a connection: {}", std::strerror(reason));
  accepts_ = nobody;
}

void HostService::send_surplus_away() {
  const auto is_newcomer = [](const auto& component) { return component->is_newcomer(); };
  auto newcomers = std::count_if(components_.begin(), components_.end(), is_newcomer);
  for (; newcomers > static_cast<std::ptrdiff_t>(kMostNewcomers); --newcomers) {
    const auto oldest = std::find_if(components_.begin(), components_.end(), is_newcomer);
    (*oldest)->end("said nothing, and too many have come after it");
  }
}

void HostService::forget(Time now) {
  for (const auto& component : components_) {
    const auto memory = memory_.find(component->run());
    if (memory != memory_.end()) memory->second.used_at = now;
  }
  components_.erase(std::remove_if(components_.begin(), components_.end(),
                                   [](const auto& component) { return component->over(); }),
                    components_.end());
  for (auto memory = memory_.begin(); memory != memory_.end();) {
    const bool old = now - memory->second.used_at > kRunForgottenAfter;
    memory = old ? memory_.erase(memory) : std::next(memory);
  }
}

// A connection that broke may not be noticed here yet, and its component lives.
bool HostService::clear_place(const HostedComponent& newcomer) {
  bool clear = true;
  for (const auto& other : components_) {
    if (other.get() == &newcomer || other->run() != newcomer.run() ||
        other->stage() != newcomer.stage() || !other->is_running()) {
      continue;
    }
    other->end("another one takes its place");
    clear = false;
  }
  return clear;
}

Result<std::shared_ptr<DomainLock>> HostService::lock(int domain) {
  if (auto held = locks_[domain].lock()) return held;
  auto taken = DomainLock::take(domain);
  if (!taken.ok()) return taken.error();
  auto shared = std::make_shared<DomainLock>(std::move(taken).value());
  locks_[domain] = shared;
  return shared;
}

std::map<std::string, std::string> HostService::input_files(
    const std::string& run, const std::vector<std::string>& stages) {
  RunMemory& memory = memory_[run];
  memory.used_at = Clock::now();
  std::map<std::string, std::string> files;
  for (const std::string& stage : stages) {
    auto found = memory.inputs.find(stage);
    if (found == memory.inputs.end()) {
      auto history = InputHistory::create();
      if (!history.ok()) continue;
      found = memory.inputs.emplace(stage, std::move(history).value()).first;
    }
    files[stage] = found->second.path();
  }
  return files;
}

}  // namespace clew::bridge
