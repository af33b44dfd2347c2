// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "core/result.hpp"
#include "security/signature.hpp"

namespace clew::tools {

/// What the signature beside a recording says.
struct SignatureFacts {
  std::optional<bridge::Signature> signature;
  std::string untrusted;  ///< why it is not of whom the user asked for; empty if it is

  bool good() const { return untrusted.empty() && (!signature || signature->fault.empty()); }
  /// The end of the line `signature`; empty if there is nothing to say.
  std::string text() const;
  /// Adds `signature` and `untrusted`.
  void add_to(nlohmann::ordered_json& json) const;
};

/// Reads it; `signed_by` is the file of a certificate, or empty: of anybody, or of nobody.
core::Result<SignatureFacts> read_signature_facts(const std::string& recording,
                                                  const std::string& signed_by);

}  // namespace clew::tools
