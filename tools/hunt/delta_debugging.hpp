// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace clew::hunt {

/// The items without those at [first, last).
template <typename Item>
std::vector<Item> without(const std::vector<Item>& items, std::size_t first, std::size_t last) {
  std::vector<Item> rest(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(first));
  rest.insert(rest.end(), items.begin() + static_cast<std::ptrdiff_t>(last), items.end());
  return rest;
}

/// A part of `items` for which `fails` is true and from which no single item can be taken away
/// without making it false: 1-minimal (Zeller & Hildebrandt 2002, "Simplifying and isolating
/// failure-inducing input", algorithm ddmin). `fails(items)` is true. It is asked of the empty list
/// first, and of each part at most once a round; one that answers false from some time on ends the
/// search early, with the best part so far.
///
/// *Deviation:* parts that lie side by side are tried at each granularity before complements, and a
/// complement that fails keeps the granularity, as in the paper; the answers are not remembered,
/// since a caller's test may be told to give up.
template <typename Item, typename Fails>
std::vector<Item> minimise(std::vector<Item> items, const Fails& fails) {
  if (items.empty() || fails(std::vector<Item>())) return {};
  std::size_t parts = 2;
  while (items.size() > 1) {
    const std::size_t size = (items.size() + parts - 1) / parts;
    bool reduced = false;
    for (std::size_t first = 0; first < items.size() && !reduced; first += size) {
      const std::size_t last = std::min(first + size, items.size());
      const std::vector<Item> part(items.begin() + static_cast<std::ptrdiff_t>(first),
                                   items.begin() + static_cast<std::ptrdiff_t>(last));
      if (part.size() == items.size() || !fails(part)) continue;
      items = part;
      parts = 2;
      reduced = true;
    }
    // With two parts each is the other's complement.
    for (std::size_t first = 0; first < items.size() && !reduced && parts > 2; first += size) {
      const auto rest = without(items, first, std::min(first + size, items.size()));
      if (!fails(rest)) continue;
      items = rest;
      parts = std::max<std::size_t>(parts - 1, 2);
      reduced = true;
    }
    if (reduced) continue;
    if (size == 1) break;
    parts = std::min(2 * parts, items.size());
  }
  return items;
}

}  // namespace clew::hunt
