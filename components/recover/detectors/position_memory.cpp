// SPDX-License-Identifier: Apache-2.0
#include "recover/detectors/position_memory.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clew::recover {
namespace {

constexpr std::size_t kFirstSlots = 64;

/// Spreads keys of neighbouring cells over the table: the finaliser of splitmix64 (Steele, Lea &
/// Flood 2014, "Fast splittable pseudorandom number generators", section 5).
std::uint64_t mixed(std::uint64_t key) {
  key = (key ^ (key >> 30)) * 0xbf58476d1ce4e5b9u;
  key = (key ^ (key >> 27)) * 0x94d049bb133111ebu;
  return key ^ (key >> 31);
}

}  // namespace

PositionMemory::PositionMemory(double grid_m, std::size_t capacity)
    : grid_m_(grid_m), half_capacity_(std::max<std::size_t>(1, capacity / 2)) {}

void PositionMemory::add(const Visit& visit) {
  if (generations_[0].cells.size() >= half_capacity_ &&
      generations_[0].find(key_at(visit.pose_odom.position())) == nullptr) {
    std::swap(generations_[0], generations_[1]);
    generations_[0].clear();
  }
  Cell& cell = generations_[0].find_or_add(key_at(visit.pose_odom.position()));
  if (!cell.visits.full()) {
    cell.visits.push_back(visit);
    return;
  }
  cell.visits[cell.next] = visit;
  cell.next = static_cast<std::uint32_t>((cell.next + 1) % kVisitsPerCell);
}

void PositionMemory::clear() {
  for (Generation& generation : generations_) generation.clear();
}

std::uint64_t PositionMemory::key_at(const core::Vec2& position_odom) const {
  const auto [x, y] = indices(position_odom);
  return key_of(x, y);
}

std::array<std::int64_t, 2> PositionMemory::indices(const core::Vec2& position_odom) const {
  // A place beyond comes from a file only.
  constexpr double kFarthest = 1LL << 40;
  const auto index = [&](double coordinate_m) {
    return static_cast<std::int64_t>(
        std::floor(std::clamp(coordinate_m / grid_m_, -kFarthest, kFarthest)));
  };
  return {index(position_odom.x()), index(position_odom.y())};
}

std::uint64_t PositionMemory::key_of(std::int64_t x, std::int64_t y) {
  const auto outward = [](std::int64_t i) { return static_cast<std::uint64_t>(i < 0 ? ~i : i); };
  const std::uint64_t sum = outward(x) + outward(y);
  const std::uint64_t cantor = sum * (sum + 1) / 2 + outward(y);
  return 4 * cantor + (x < 0 ? 1u : 0u) + (y < 0 ? 2u : 0u);
}

/// The slot of a key, or the empty one where it would be. At most half of the slots are taken.
std::size_t PositionMemory::Generation::slot_of(std::uint64_t key) const {
  std::size_t slot = static_cast<std::size_t>(mixed(key)) & (slots.size() - 1);
  while (slots[slot] != 0 && cells[slots[slot] - 1].key != key) {
    slot = (slot + 1) & (slots.size() - 1);
  }
  return slot;
}

const PositionMemory::Cell* PositionMemory::Generation::find(std::uint64_t key) const {
  if (cells.empty()) return nullptr;
  const std::uint32_t found = slots[slot_of(key)];
  return found == 0 ? nullptr : &cells[found - 1];
}

PositionMemory::Cell& PositionMemory::Generation::find_or_add(std::uint64_t key) {
  if (2 * (cells.size() + 1) > slots.size()) {
    slots.resize(std::max(kFirstSlots, 2 * slots.size()));
    index_all();
  }
  const std::size_t slot = slot_of(key);
  if (slots[slot] == 0) {
    cells.push_back({});
    cells.back().key = key;
    slots[slot] = static_cast<std::uint32_t>(cells.size());
  }
  return cells[slots[slot] - 1];
}

void PositionMemory::Generation::clear() {
  cells.clear();
  std::fill(slots.begin(), slots.end(), 0u);
}

void PositionMemory::Generation::index_all() {
  std::fill(slots.begin(), slots.end(), 0u);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    slots[slot_of(cells[i].key)] = static_cast<std::uint32_t>(i + 1);
  }
}

void PositionMemory::save(core::StateWriter& writer) const {
  for (const Generation& generation : generations_) writer(generation.cells);
}

void PositionMemory::load(core::StateReader& reader) {
  for (Generation& generation : generations_) {
    reader(generation.cells);
    for (Cell& cell : generation.cells) {
      if (!reader.check(cell.next < kVisitsPerCell, "a cell has no such visit")) cell.next = 0;
    }
    std::size_t slots = kFirstSlots;
    while (slots < 2 * generation.cells.size()) slots *= 2;
    generation.slots.assign(slots, 0);
    generation.index_all();
  }
}

}  // namespace clew::recover
