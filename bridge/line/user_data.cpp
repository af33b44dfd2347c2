// SPDX-License-Identifier: Apache-2.0
#include "line/user_data.hpp"

namespace clew::bridge {

std::string UserData::to_text() const {
  std::string text = "clew_idl=" + idl_fingerprint + ';';
  if (!stage.empty()) text += "clew_stage=" + stage + ';';
  if (!seal.empty()) text += "clew_seal=" + seal + ';';
  return text;
}

UserData UserData::parse(std::string_view text) {
  UserData parsed;
  while (!text.empty()) {
    const std::size_t end = text.find(';');
    const std::string_view entry = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    const std::size_t equals = entry.find('=');
    if (equals == std::string_view::npos) continue;
    const std::string_view key = entry.substr(0, equals);
    const std::string value(entry.substr(equals + 1));
    if (key == "clew_idl") parsed.idl_fingerprint = value;
    if (key == "clew_stage") parsed.stage = value;
    if (key == "clew_seal") parsed.seal = value;
  }
  return parsed;
}

}  // namespace clew::bridge
