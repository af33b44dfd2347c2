// SPDX-License-Identifier: Apache-2.0
#include "process/identity.hpp"

namespace clew::bridge {

std::string Identity::user_data() const {
  std::string text = "clew_idl=" + idl_fingerprint + ';';
  if (!stage.empty()) text += "clew_stage=" + stage + ';';
  return text;
}

Identity Identity::parse(std::string_view user_data) {
  Identity identity;
  while (!user_data.empty()) {
    const std::size_t end = user_data.find(';');
    const std::string_view entry = user_data.substr(0, end);
    user_data.remove_prefix(end == std::string_view::npos ? user_data.size() : end + 1);
    const std::size_t equals = entry.find('=');
    if (equals == std::string_view::npos) continue;
    const std::string_view key = entry.substr(0, equals);
    const std::string value(entry.substr(equals + 1));
    if (key == "clew_idl") identity.idl_fingerprint = value;
    if (key == "clew_stage") identity.stage = value;
  }
  return identity;
}

}  // namespace clew::bridge
