// SPDX-License-Identifier: Apache-2.0
#include "supervisor/watchers.hpp"

#include <algorithm>
#include <utility>

#include "wire/codec.hpp"

namespace clew::bridge {
namespace {

/// More than a person opens windows.
constexpr std::size_t kMostWatchers = 32;

}  // namespace

void Watchers::welcome(std::unique_ptr<Link> link, const Hello& hello, Assignment run) {
  if (hello.idl_fingerprint != idl_fingerprint()) {
    link->post(FrameType::kNotice,
               Text{"the run was built from other IDL files: its fingerprint "
                    "is " +
                    std::string(idl_fingerprint()) + ", this one's is " + hello.idl_fingerprint});
    return;
  }
  if (links_.size() >= kMostWatchers) {
    link->post(FrameType::kNotice,
               Text{"the run has " + std::to_string(kMostWatchers) + " watchers already"});
    return;
  }
  link->post(FrameType::kAssignment, std::move(run));
  links_.push_back(std::move(link));
}

void Watchers::turn() {
  const auto has_gone = [](const std::unique_ptr<Link>& link) {
    if (!link->flush() || !link->receive()) return true;
    // It has nothing to say.
    while (link->next()) {
    }
    return false;
  };
  links_.erase(std::remove_if(links_.begin(), links_.end(), has_gone), links_.end());
}

void Watchers::tell(const std::string& line) {
  for (const auto& link : links_) link->post(FrameType::kNotice, Text{line});
}

void Watchers::add_descriptors(std::vector<pollfd>& descriptors) const {
  for (const auto& link : links_) {
    descriptors.push_back({link->socket(), link->poll_events(), 0});
  }
}

}  // namespace clew::bridge
