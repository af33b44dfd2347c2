// SPDX-License-Identifier: Apache-2.0
/// What the supervisor does for who looks on.
#include <utility>

#include "supervisor/supervisor.hpp"

namespace clew::bridge {

/// Who looks on gets states when he comes, and when another behaviour is put in. A component hands
/// them over from when it hears of it, so what is planned for later is told when drive may be there
/// soon: all hear of it before, and of no change so early that its checkpoints are over by then.
void Supervisor::show_what_is_new() {
  bool news = !shown_ && page() != nullptr && page()->is_open();
  const std::uint64_t soon = started_ticks(members_) + lead_;
  while (!changed_at_.empty() && *changed_at_.begin() <= soon) {
    changed_at_.erase(changed_at_.begin());
    news = news || shown_;
  }
  if (news) show();
}

void Supervisor::show() {
  shown_ = true;
  launcher_.spool();
  if (observer_) observer_->spool();
  for (const Member& member : members_) {
    if (member.link) member.link->post(FrameType::kSpool, Text{});
  }
}

void Supervisor::hand_on(std::string spool, std::uint64_t end_tick) {
  if (page() != nullptr) page()->add(spool);
  if (recording_) recording_->add(std::move(spool), end_tick);
}

}  // namespace clew::bridge
