// SPDX-License-Identifier: Apache-2.0
#include "supervisor/run_recording_control.hpp"

#include <utility>

#include "recording/output_file.hpp"

namespace clew::bridge {

RunRecordingControl::RunRecordingControl(const RecordingOrder& order, ChildCommand recorder,
                                         OnRecordError on_error, bool drops)
    : client_(order, std::move(recorder), drops),
      path_(order.path),
      overwrite_(order.overwrite),
      on_error_(on_error) {}

void RunRecordingControl::serve(Time now) {
  client_.serve(now);
  for (std::string& line : client_.take_lines()) lines_.push_back(std::move(line));
  if (!ended() || told_) return;
  told_ = true;
  const std::string what = complaint(*client_.account());
  if (what.empty()) return;
  if (on_error_ == OnRecordError::kStop) {
    failure_ = what;
  } else {
    lines_.push_back(what);
  }
}

RecordingAccount RunRecordingControl::finish() const {
  RecordingAccount account = client_.account().value_or(
      RecordingAccount{"the recorder did not end in time", {}, 0, false});
  if (!account.failure.empty() || account.nothing) return account;
  const auto named = mcap::OutputFile::give_name(path_, overwrite_);
  if (!named.ok()) account.failure = named.error().text();
  return account;
}

}  // namespace clew::bridge
