// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "core/result.hpp"

namespace clew::bridge {

/// A DDS domain that belongs to one run on this host while the object lives. The same socket takes
/// the connections of the run's components.
class DomainLock {
 public:
  /// Takes `domain`, or else the first free one: held by no run, and with no socket of any program
  /// on its ports. Refused: a number that check_domain refuses, and one that is held.
  static core::Result<DomainLock> take(std::optional<int> domain);

  DomainLock(DomainLock&& other) noexcept;
  DomainLock& operator=(DomainLock&&) = delete;
  ~DomainLock();

  int domain() const { return domain_; }
  /// A listening socket: its readiness to read means that a component connects.
  int socket() const { return socket_; }

 private:
  DomainLock(int domain, int socket) : domain_(domain), socket_(socket) {}

  int domain_;
  int socket_;
};

/// A name by which a run is found while the object lives; its socket takes connections, too.
class RunName {
 public:
  static constexpr std::size_t kMostNameBytes = 64;

  /// Refused: a name that could be taken for something else, and one that another run has.
  static core::Result<RunName> take(const std::string& name);

  RunName(RunName&& other) noexcept;
  RunName& operator=(RunName&&) = delete;
  ~RunName();

  int socket() const { return socket_; }

 private:
  explicit RunName(int socket) : socket_(socket) {}

  int socket_;
};

}  // namespace clew::bridge
