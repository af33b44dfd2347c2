// SPDX-License-Identifier: Apache-2.0
#include "gateway/insides_answer.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "gateway/json_text.hpp"

namespace clew::bridge {
namespace {

using nlohmann::ordered_json;

/// The objects that a program printed, one a line; null if that is not what it printed.
ordered_json all_objects(const std::string& out) {
  ordered_json objects = ordered_json::array();
  for (std::size_t begin = 0; begin < out.size();) {
    const std::size_t end = std::min(out.find('\n', begin), out.size());
    auto parsed = ordered_json::parse(out.substr(begin, end - begin), nullptr, false);
    if (!parsed.is_object()) return nullptr;
    objects.push_back(std::move(parsed));
    begin = end + 1;
  }
  return objects;
}

}  // namespace

WebResponse insides_answer(const ProgramEnd& end, const std::string& line) {
  const ordered_json stages = all_objects(end.out);
  if (end.status == 0 && stages.is_array()) {
    return {200, "application/json", json_text({{"command", line}, {"stages", stages}}), {}};
  }
  const std::string why = end.err.empty() ? "status " + std::to_string(end.status) : end.err;
  return {400, "application/json", json_text({{"error", why}}), {}};
}

}  // namespace clew::bridge
