// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "dds/participant.hpp"
#include "line/wake_up.hpp"

namespace clew::domains {

using Time = std::chrono::steady_clock::time_point;

/// A writer of somebody else is there.
struct WriterFound {
  std::size_t domain = 0;
  bridge::RemoteEndpoint writer;
};
/// It is gone, after all its samples.
struct WriterLost {
  std::size_t domain = 0;
  std::string guid;
};
struct SampleCame {
  std::size_t domain = 0;
  std::string writer;  ///< GUID; empty where the vendor does not tell
  bool reliable = false;
  bool transient_local = false;  ///< of the reader that took it
  Time at;
  std::string cdr;
};
/// Something for people.
struct Notice {
  std::string text;
};
using News = std::variant<WriterFound, WriterLost, SampleCame, Notice>;

/// What the vendors' threads tell, in order, for the one thread of the bridge. Of samples it holds
/// so many bytes; then it drops what comes, and counts it.
class Inbox {
 public:
  explicit Inbox(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  void add(News news);
  /// A sample, and before it its writer, if nobody has told of that yet.
  void add_sample(SampleCame sample, const bridge::RemoteEndpoint* writer);
  /// A writer; one that is known already is passed over.
  void add_writer(std::size_t domain, const bridge::RemoteEndpoint& writer);
  void remove_writer(std::size_t domain, const std::string& guid);

  std::vector<News> take();
  std::uint64_t dropped() const;
  /// Waits until something has come, the descriptor can be read, or the time is over.
  void wait(int descriptor, std::chrono::nanoseconds most) const {
    changed_.wait_beside({descriptor}, most);
  }

 private:
  void add_writer_locked(std::size_t domain, const bridge::RemoteEndpoint& writer);

  const std::size_t most_bytes_;
  bridge::WakeUp changed_;
  mutable std::mutex mutex_;
  std::vector<News> news_;
  std::size_t bytes_ = 0;
  std::uint64_t dropped_ = 0;
  std::set<std::pair<std::size_t, std::string>> known_;  ///< domain and GUID of writers told of
};

}  // namespace clew::domains
