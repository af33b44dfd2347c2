// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "dds/participant.hpp"

namespace clew::domains {

/// What became of the samples of a topic on its way from one domain to another.
struct Passage {
  std::string topic;     ///< where it comes from
  std::string as;        ///< its name on the other side
  std::size_t from = 0;  ///< domains, as in the file
  std::size_t to = 0;
  std::uint64_t passed = 0;      ///< in the history of a writer
  std::uint64_t filtered = 0;    ///< a condition does not hold
  std::uint64_t thinned = 0;     ///< more often than the rate
  std::uint64_t refused = 0;     ///< came from there, or through too many bridges
  std::uint64_t unreadable = 0;  ///< no message of its type, so that no condition can hold
  std::uint64_t dropped = 0;     ///< a reader is too slow, and the queue full
  std::uint64_t failed = 0;      ///< the writer does not take it
};

/// A writer of a bridge, and what waits for it. Nothing here waits for anybody.
class Outlet {
 public:
  /// Bytes and samples that wait at most.
  static constexpr std::size_t kMostBytes = std::size_t{32} << 20;
  static constexpr std::size_t kMostSamples = 100000;

  Outlet(std::unique_ptr<bridge::SampleWriter> writer, Passage& passage)
      : writer_(std::move(writer)), passage_(passage) {}

  /// Behind what waits already.
  void pass(std::string_view cdr);
  /// Writes what waits, as far as the writer takes it.
  void flush();
  bool waits() const { return !waiting_.empty(); }

  // Writers whose samples it carries: without any it is closed once nothing waits.
  void add_source() { ++sources_; }
  void remove_source() { --sources_; }
  bool is_done() const { return sources_ == 0 && waiting_.empty(); }

 private:
  /// Whether the writer is done with the sample.
  bool write(std::string_view cdr);

  std::unique_ptr<bridge::SampleWriter> writer_;
  Passage& passage_;
  std::deque<std::string> waiting_;
  std::size_t bytes_ = 0;
  std::size_t sources_ = 0;
};

}  // namespace clew::domains
