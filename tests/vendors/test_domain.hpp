// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace clew::bridge {

/// A DDS domain that nobody on this host uses, ours while this lives: it holds the port of the
/// domain's multicast discovery, which participants here do without.
class TestDomain {
 public:
  TestDomain();
  ~TestDomain();
  TestDomain(const TestDomain&) = delete;
  TestDomain& operator=(const TestDomain&) = delete;

  int number() const { return number_; }

 private:
  int number_ = -1;
  int socket_ = -1;
};

}  // namespace clew::bridge
