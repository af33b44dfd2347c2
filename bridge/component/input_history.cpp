// SPDX-License-Identifier: Apache-2.0
#include "component/input_history.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace clew::bridge {
namespace {

using core::Error;
using core::Result;
using domain::Topic;

struct Head {
  std::uint64_t tick = 0;
  std::uint64_t bytes = 0;
};

struct Part {
  std::uint32_t topic = 0;
  std::uint32_t bytes = 0;
};

Error failed(const char* what) {
  return {std::string(what) + ": " + std::strerror(errno), "the history of inputs"};
}

off_t place_of(std::uint64_t tick) {
  return static_cast<off_t>(tick % InputHistory::kTicks * InputHistory::kBytesPerTick);
}

template <typename Value>
void append(std::string& bytes, const Value& value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof raw);
}

}  // namespace

Result<InputHistory> InputHistory::create() {
  const int descriptor = ::memfd_create("clew-inputs", MFD_CLOEXEC);
  if (descriptor < 0) return failed("memfd_create");
  return InputHistory(descriptor);
}

std::string InputHistory::path() const {
  return "/proc/" + std::to_string(::getpid()) + "/fd/" + std::to_string(descriptor_);
}

Result<InputHistory> InputHistory::open(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0) return failed(path.c_str());
  return InputHistory(descriptor);
}

InputHistory::InputHistory(InputHistory&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)) {}

InputHistory::~InputHistory() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Result<void> InputHistory::put(std::uint64_t tick, const runtime::TopicSet& present,
                               const domain::Messages& messages) {
  bytes_.assign(sizeof(Head), '\0');
  for (Topic topic : domain::kAllTopics) {
    if (!present[index_of(topic)]) continue;
    domain::visit_topic(topic, [&](auto constant) {
      const std::string_view cdr =
          std::get<constant.kIndex>(codecs_).encode(std::get<constant.kIndex>(messages));
      append(bytes_,
             Part{static_cast<std::uint32_t>(topic), static_cast<std::uint32_t>(cdr.size())});
      bytes_.append(cdr);
    });
  }
  CLEW_CHECK(bytes_.size() <= kBytesPerTick,
             "inputs of " + std::to_string(bytes_.size()) + " bytes");
  const Head head{tick, bytes_.size() - sizeof(Head)};
  std::memcpy(bytes_.data(), &head, sizeof head);
  const ssize_t written = ::pwrite(descriptor_, bytes_.data(), bytes_.size(), place_of(tick));
  if (written == static_cast<ssize_t>(bytes_.size())) return {};
  return failed("writing");
}

Result<runtime::TopicSet> InputHistory::get(std::uint64_t tick, domain::Messages& messages) const {
  Head head;
  const off_t place = place_of(tick);
  const ssize_t got = ::pread(descriptor_, &head, sizeof head, place);
  if (got != sizeof head || head.tick != tick || head.bytes == 0 || head.bytes > kBytesPerTick) {
    return Error{"the inputs of tick " + std::to_string(tick) + " are not kept any more"};
  }
  std::string bytes(head.bytes, '\0');
  if (::pread(descriptor_, bytes.data(), bytes.size(), place + static_cast<off_t>(sizeof head)) !=
      static_cast<ssize_t>(bytes.size())) {
    return failed("reading");
  }
  runtime::TopicSet present;
  for (std::string_view rest = bytes; !rest.empty();) {
    Part part;
    if (rest.size() < sizeof part) return failed("reading");
    std::memcpy(&part, rest.data(), sizeof part);
    rest.remove_prefix(sizeof part);
    if (part.topic >= domain::kTopicCount || part.bytes > rest.size()) return failed("reading");
    const auto decoded = domain::visit_topic(static_cast<Topic>(part.topic), [&](auto constant) {
      return std::get<constant.kIndex>(reading_codecs_)
          .decode(rest.substr(0, part.bytes), std::get<constant.kIndex>(messages));
    });
    if (!decoded.ok()) return decoded.error();
    present.set(part.topic);
    rest.remove_prefix(part.bytes);
  }
  return present;
}

}  // namespace clew::bridge
