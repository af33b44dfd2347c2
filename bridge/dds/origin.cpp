// SPDX-License-Identifier: Apache-2.0
#include "dds/origin.hpp"

#include <algorithm>
#include <charconv>

namespace clew::bridge {
namespace {

constexpr std::string_view kOriginKey = "clew_origin";
constexpr std::string_view kHopsKey = "clew_hops";
constexpr std::string_view kViaKey = "clew_via";

/// Calls `visit` with each part of a list, without its separators.
template <typename Visit>
void for_each_part(std::string_view list, char separator, const Visit& visit) {
  while (!list.empty()) {
    const std::size_t end = list.find(separator);
    if (end != 0) visit(list.substr(0, end));
    if (end == std::string_view::npos) return;
    list.remove_prefix(end + 1);
  }
}

std::string_view key_of(std::string_view entry) { return entry.substr(0, entry.find('=')); }

std::string_view value_of(std::string_view entry) {
  const std::size_t equals = entry.find('=');
  return equals == std::string_view::npos ? std::string_view() : entry.substr(equals + 1);
}

void append_entry(std::string& text, std::string_view key, std::string_view value) {
  text.append(key).append("=").append(value).append(";");
}

}  // namespace

std::string Origin::to_text() const {
  std::string text;
  if (id.empty()) return text;
  append_entry(text, kOriginKey, id);
  append_entry(text, kHopsKey, std::to_string(hops));
  std::string places;
  for (const std::string& place : via) places += (places.empty() ? "" : ",") + place;
  if (!places.empty()) append_entry(text, kViaKey, places);
  return text;
}

Origin Origin::parse(std::string_view user_data) {
  Origin origin;
  for_each_part(user_data, ';', [&](std::string_view entry) {
    const std::string_view value = value_of(entry);
    if (key_of(entry) == kOriginKey) origin.id = value;
    if (key_of(entry) == kHopsKey) {
      const char* end = value.data() + value.size();
      const auto read = std::from_chars(value.data(), end, origin.hops);
      // A number that is none stops a sample, rather than let it go round.
      if (read.ec != std::errc() || read.ptr != end || origin.hops < 1) origin.hops = kMostHops;
    }
    if (key_of(entry) != kViaKey) return;
    for_each_part(value, ',', [&](std::string_view place) { origin.via.emplace_back(place); });
  });
  return origin;
}

bool Origin::may_take(std::string_view user_data) const {
  const Origin other = parse(user_data);
  return other.id.empty() || (other.id != id && other.hops < kMostHops);
}

bool Origin::has_been_on(std::string_view place) const {
  return id == place || std::find(via.begin(), via.end(), place) != via.end();
}

std::string without_origin(std::string_view user_data, const std::vector<std::string>& keys) {
  std::string text;
  for_each_part(user_data, ';', [&](std::string_view entry) {
    const std::string_view key = key_of(entry);
    if (key == kOriginKey || key == kHopsKey || key == kViaKey) return;
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) return;
    text.append(entry).append(";");
  });
  return text;
}

}  // namespace clew::bridge
