// SPDX-License-Identifier: Apache-2.0
#include "cyclonedds/refusal_log.hpp"

#include <dds/ddsrt/log.h>

#include <cstdio>
#include <mutex>
#include <set>
#include <string>
#include <string_view>

#include "core/terminal_text.hpp"

namespace clew::bridge {
namespace {

constexpr std::string_view kNotYetKnown = "Remote secure participant";
constexpr std::size_t kMostKinds = 100;

/// Lines of one kind differ in what follows their first number: a GUID, a subject, a code.
void say_once(void*, const dds_log_data_t* line) {
  static std::mutex mutex;
  static std::set<std::string> told;
  const std::string_view text = line->message;
  if (text.find(kNotYetKnown) != std::string_view::npos) return;
  const std::lock_guard lock(mutex);
  if (told.size() >= kMostKinds) return;
  if (!told.emplace(text.substr(0, text.find_first_of("0123456789"))).second) return;
  std::string shown(text.substr(0, text.find_last_not_of('\n') + 1));
  shown = core::terminal_text(shown) + '\n';
  std::fputs(shown.c_str(), stderr);
}

}  // namespace

void quieten_refusals() { dds_set_log_sink(say_once, nullptr); }

}  // namespace clew::bridge
