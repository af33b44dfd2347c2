// SPDX-License-Identifier: Apache-2.0
#include "gateway/run_view.hpp"

#include "run/sample_account.hpp"

namespace clew::bridge {

std::optional<core::Result<std::string>> RunView::open(const std::string& run) {
  if (feed_ && is_open() && !feed_->goes_on()) {
    feed_.reset();
    address_.clear();
  }
  if (!feed_) {
    auto started = start_(0, run);
    if (!started.ok()) return started.error();
    feed_ = std::move(started).value();
  }
  const auto polled = feed_->poll();
  if (!polled.ok()) {
    feed_.reset();
    return polled.error();
  }
  if (feed_->address().empty()) return std::nullopt;
  if (!is_open()) begin();
  return address_;
}

core::Result<void> RunView::open_at(int port, const std::string& run) {
  auto started = start_(port, run);
  if (!started.ok()) return started.error();
  feed_ = std::move(started).value();
  CLEW_RETURN_IF_ERROR(feed_->wait_for_address());
  begin();
  return {};
}

void RunView::begin() {
  address_ = feed_->address();
  for (const domain::Intervention& earlier : interventions_) feed_->add(spooled(earlier));
}

void RunView::add(std::string_view spool) {
  if (is_open()) feed_->add(spool);
}

void RunView::add_intervention(const domain::Intervention& intervention) {
  interventions_.push_back(intervention);
  if (is_open()) feed_->add(spooled(intervention));
}

}  // namespace clew::bridge
