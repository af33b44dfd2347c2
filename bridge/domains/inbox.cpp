// SPDX-License-Identifier: Apache-2.0
#include "domains/inbox.hpp"

#include <utility>

namespace clew::domains {

void Inbox::add(News news) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    news_.push_back(std::move(news));
  }
  changed_.ring();
}

void Inbox::add_sample(SampleCame sample, const bridge::RemoteEndpoint* writer) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (writer != nullptr) {
      add_writer_locked(sample.domain, *writer);
      sample.writer = writer->guid;
    }
    if (bytes_ + sample.cdr.size() > most_bytes_) {
      ++dropped_;
      return;
    }
    bytes_ += sample.cdr.size();
    news_.emplace_back(std::move(sample));
  }
  changed_.ring();
}

void Inbox::add_writer(std::size_t domain, const bridge::RemoteEndpoint& writer) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    add_writer_locked(domain, writer);
  }
  changed_.ring();
}

void Inbox::add_writer_locked(std::size_t domain, const bridge::RemoteEndpoint& writer) {
  if (!known_.emplace(domain, writer.guid).second) return;
  news_.emplace_back(WriterFound{domain, writer});
}

void Inbox::remove_writer(std::size_t domain, const std::string& guid) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (known_.erase({domain, guid}) == 0) return;
    news_.emplace_back(WriterLost{domain, guid});
  }
  changed_.ring();
}

std::vector<News> Inbox::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  bytes_ = 0;
  return std::exchange(news_, {});
}

std::uint64_t Inbox::dropped() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return dropped_;
}

}  // namespace clew::domains
