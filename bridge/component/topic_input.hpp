// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string_view>
#include <utility>

#include "component/start_barrier.hpp"
#include "dds/participant.hpp"
#include "scan/scan_check.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {

/// What a run demands of a message beyond what its type does: of a scan, the arrangement of beams.
template <typename Message>
core::Result<void> check_in_run(const Message&, const domain::ScanLayout&) {
  return {};
}
inline core::Result<void> check_in_run(const domain::Scan& message,
                                       const domain::ScanLayout& layout) {
  return scan::check_arrangement(message, layout);
}

/// The reader's side of one topic: turns away what is no part of the run, decodes and checks the
/// rest.
template <typename Message>
class TopicInput : public SampleListener {
 public:
  /// Calls come on the vendor's threads, of one input never two at once.
  struct Handlers {
    std::function<void()> on_stranger;                   ///< a sample of a writer of no one's
    std::function<void(const core::Error&)> on_refused;  ///< a sample that is not one
    std::function<void(Message&)> on_message;            ///< which may be swapped with another
  };

  TopicInput(const StartBarrier& barrier, const domain::ScanLayout& layout, Handlers handlers)
      : barrier_(barrier), layout_(layout), handlers_(std::move(handlers)) {}

  void on_sample(std::string_view cdr, const RemoteEndpoint* writer) override {
    if (!accepts(writer)) return handlers_.on_stranger();
    auto checked = codec_.decode(cdr, message_);
    if (checked.ok()) checked = check_in_run(message_, layout_);
    if (!checked.ok()) return handlers_.on_refused(checked.error());
    handlers_.on_message(message_);
  }

 private:
  // The answer for a writer changes only when discovery has news.
  bool accepts(const RemoteEndpoint* writer) {
    const std::uint64_t version = barrier_.version();
    if (writer != known_writer_ || version != known_version_ || writer == nullptr) {
      known_accepted_ = barrier_.accepts(writer);
      known_writer_ = writer;
      known_version_ = version;
    }
    return known_accepted_;
  }

  const StartBarrier& barrier_;
  const domain::ScanLayout& layout_;
  const Handlers handlers_;
  Codec<Message> codec_;
  Message message_;
  const RemoteEndpoint* known_writer_ = nullptr;
  std::uint64_t known_version_ = 0;
  bool known_accepted_ = false;
};

}  // namespace clew::bridge
