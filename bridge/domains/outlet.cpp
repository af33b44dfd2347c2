// SPDX-License-Identifier: Apache-2.0
#include "domains/outlet.hpp"

namespace clew::domains {

void Outlet::pass(std::string_view cdr) {
  flush();
  if (waiting_.empty() && write(cdr)) return;
  if (waiting_.size() >= kMostSamples || bytes_ + cdr.size() > kMostBytes) {
    ++passage_.dropped;
    return;
  }
  bytes_ += cdr.size();
  waiting_.emplace_back(cdr);
}

void Outlet::flush() {
  while (!waiting_.empty() && write(waiting_.front())) {
    bytes_ -= waiting_.front().size();
    waiting_.pop_front();
  }
}

bool Outlet::write(std::string_view cdr) {
  switch (writer_->write(cdr)) {
    case bridge::WriteStatus::kTaken:
      ++passage_.passed;
      return true;
    case bridge::WriteStatus::kWouldBlock:
      return false;
    case bridge::WriteStatus::kFailed:
      ++passage_.failed;
      return true;
  }
  return true;
}

}  // namespace clew::domains
