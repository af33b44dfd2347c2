// SPDX-License-Identifier: Apache-2.0
#include "run/run_report.hpp"

namespace clew::bridge {

std::string complaint(const RecordingAccount& account) {
  if (!account.failure.empty()) return "the recording failed: " + account.failure;
  std::string text;
  for (const std::string& loss : account.losses) {
    text += (text.empty() ? "the recording lacks " : ", ") + loss;
  }
  return text;
}

}  // namespace clew::bridge
