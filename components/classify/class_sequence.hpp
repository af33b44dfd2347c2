// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "core/bounded_vector.hpp"

namespace clew::classify {

/// A spatial class that lasted.
struct Run {
  std::uint8_t spatial_class = 8;
  std::uint32_t length = 0;  ///< ticks
};

/// Three classes, no two neighbours equal, oldest first: a landmark vector.
using Triple = std::array<std::uint8_t, 3>;
/// How long each lasted, or must last, in ticks.
using RunLengths = std::array<std::uint32_t, 3>;

/// Whether each run is at least as long as its lower bound.
inline bool reaches(const RunLengths& lengths, const RunLengths& bounds) {
  return lengths[0] >= bounds[0] && lengths[1] >= bounds[1] && lengths[2] >= bounds[2];
}

/// The changes of class on the way: Krishna & Kalra 2000, section 3.1 and figure 2. Two runs that
/// ended and the one that lasts make a landmark vector.
///
/// *Deviation:* the paper waits for the third class to change, too; by then the robot is past the
/// corner that the immediate memory should turn it at.
class ClassSequence {
 public:
  struct State {
    core::BoundedVector<Run, 2> ended;  ///< oldest first
    Run current;                        ///< length 0 before the first class
  };

  /// With `sliding` the window moves on by one run, else the next vector begins after this one.
  explicit ClassSequence(bool sliding) : sliding_(sliding) {}

  /// Takes the class of this tick. True if a new run begins with it.
  bool add(std::uint8_t spatial_class);

  /// Whether there are three runs.
  bool complete() const { return state_.ended.full(); }
  /// Classes and lengths of the three runs; only if complete().
  Triple classes() const;
  RunLengths lengths() const;
  /// The run that lasts.
  const Run& current() const { return state_.current; }

  /// Whether its state, which may come from a file, is one that a sequence can have.
  bool is_valid() const;

  State& state() { return state_; }
  const State& state() const { return state_; }

 private:
  bool sliding_;
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, Run& r) {
  visit(r.spatial_class, r.length);
}
template <typename Visitor>
void visit_fields(Visitor& visit, ClassSequence::State& s) {
  visit(s.ended, s.current);
}

}  // namespace clew::classify
