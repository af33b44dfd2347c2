// SPDX-License-Identifier: Apache-2.0
#include "clew/signature_facts.hpp"

#include <fmt/format.h>

#include <vector>

#include "security/kept_file.hpp"

namespace clew::tools {

using core::Error;
using core::Result;

std::string SignatureFacts::text() const {
  if (!signature) return untrusted;
  const std::string whose = fmt::format("'{}', key {}", signature->signer, signature->key);
  if (!signature->fault.empty()) {
    return fmt::format("DOES NOT HOLD: {}; it calls itself that of {}", signature->fault, whose);
  }
  return untrusted.empty() ? "holds, of " + whose : "NOT TRUSTED: " + untrusted;
}

void SignatureFacts::add_to(nlohmann::ordered_json& json) const {
  json["signature"] = nullptr;
  if (signature) {
    json["signature"] = {{"signer", signature->signer},
                         {"key", signature->key},
                         {"holds", signature->fault.empty()},
                         {"fault", signature->fault}};
  }
  json["untrusted"] = untrusted;
}

Result<SignatureFacts> read_signature_facts(const std::string& recording,
                                            const std::string& signed_by) {
  auto signature = bridge::read_signature(recording);
  if (!signature.ok()) return signature.error();
  SignatureFacts facts{std::move(signature).value(), {}};
  if (signed_by.empty()) return facts;
  std::vector<bridge::CredentialFault> faults;
  const std::string certificate =
      bridge::read_kept_file(signed_by, bridge::Secrecy::kPublic, faults);
  if (!faults.empty()) return Error{faults.front().text, faults.front().file};
  if (!facts.signature) {
    facts.untrusted = "it is not signed";
    return facts;
  }
  auto objection = bridge::objection_to_signer(*facts.signature, certificate);
  if (!objection.ok()) return Error{objection.error().message, signed_by};
  facts.untrusted = std::move(objection).value();
  return facts;
}

}  // namespace clew::tools
