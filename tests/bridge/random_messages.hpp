// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>

#include "domain/messages.hpp"

namespace clew::bridge {

/// Fills a message with acceptable values that differ from the default and from each other; lists
/// and texts have any length up to their bound.
class RandomMessages {
 public:
  explicit RandomMessages(unsigned seed) : engine_(seed) {}

  void fill(domain::Command& m);
  void fill(domain::Event& m);
  void fill(domain::Guidance& m);
  void fill(domain::Landmark& m);
  void fill(domain::Odometry& m);
  void fill(domain::Scan& m);
  void fill(domain::State& m);
  void fill(domain::Target& m);

 private:
  double number(double low, double high);
  std::uint32_t count(std::size_t last);
  bool coin() { return count(1) == 1; }
  std::string text(std::size_t bound);
  void fill(domain::TickStamp& stamp);
  void fill(domain::Pose2& pose);
  void fill(domain::Motion& motion);
  void fill(domain::EventEntry& entry);

  std::mt19937 engine_;
};

}  // namespace clew::bridge
