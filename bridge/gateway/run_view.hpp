// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/result.hpp"
#include "gateway/live_feed.hpp"
#include "run/run_page.hpp"

namespace clew::bridge {

/// The page of a run, with a gateway once somebody has asked for it. If that dies, whoever asks
/// next gets another.
class RunView : public RunPage {
 public:
  /// Starts a gateway that finds the run by `run`, at `port` (0: any free one).
  using Start =
      std::function<core::Result<std::unique_ptr<LiveFeed>>(int port, const std::string& run)>;

  explicit RunView(Start start) : start_(std::move(start)) {}

  const std::string& address() const override { return address_; }
  std::optional<core::Result<std::string>> open(const std::string& run) override;
  /// The same, and waits until it is there.
  core::Result<void> open_at(int port, const std::string& run);
  void add(std::string_view spool) override;
  void add_intervention(const domain::Intervention& intervention) override;

  /// Null: nobody has asked.
  LiveFeed* feed() const { return is_open() ? feed_.get() : nullptr; }

 private:
  void begin();

  Start start_;
  std::unique_ptr<LiveFeed> feed_;
  std::string address_;
  /// So far. They are few, and what comes after them is not understood without them.
  std::vector<domain::Intervention> interventions_;
};

}  // namespace clew::bridge
