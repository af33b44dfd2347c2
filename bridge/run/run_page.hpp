// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/result.hpp"
#include "domain/intervention.hpp"

namespace clew::bridge {

/// What shows a run while it goes on, from its start or from when somebody asks for it. Nothing
/// here waits.
class RunPage {
 public:
  virtual ~RunPage() = default;

  /// Where it is; empty: nobody has opened it, or it is on its way.
  virtual const std::string& address() const = 0;
  bool is_open() const { return !address().empty(); }
  /// Opens it if it is not there; by `run`, a name or the number of a domain, it finds the run when
  /// somebody commands it. The address; none: it is on its way, ask again.
  virtual std::optional<core::Result<std::string>> open(const std::string& run) = 0;

  /// Takes what components wrote, as they spool it for a recorder. Before it is open that is lost.
  virtual void add(std::string_view spool) = 0;
  /// Takes what somebody changed in the run, also before it is open.
  virtual void add_intervention(const domain::Intervention& intervention) = 0;
};

}  // namespace clew::bridge
