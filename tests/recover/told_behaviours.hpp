// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "recover/recover_component.hpp"
#include "tests/recover/scene.hpp"
#include "tests/source_files.hpp"

namespace clew::recover {

/// Says trap when it is told to.
class ToldDetector final : public TrapDetector {
 public:
  std::optional<TrapEvidence> observe(const Situation& situation) override {
    ++observed;
    pursued = situation.pursued_odom;
    if (!trap) return std::nullopt;
    if (at_a_glance) return TrapEvidence{std::nullopt, "seen"};
    return TrapEvidence{EarlierVisit{3, {1, 2}, 9.0, 7}, "told so"};
  }
  void start_afresh() override { ++ends; }
  void save(core::StateWriter&) const override {}
  void load(core::StateReader&) override {}

  bool trap = false;
  bool at_a_glance = false;
  core::Vec2 pursued = core::Vec2::Zero();
  int observed = 0;
  int ends = 0;
};

/// Turns by an angle of its own, and ends as it is told to.
class ToldEscape final : public Escape {
 public:
  explicit ToldEscape(double turn_rad) : turn_rad_(turn_rad) {}
  bool reads_local_map() const override { return reads_map; }
  void watch(const Situation& situation) override {
    ++watched;
    local_map = situation.local_map;
  }
  void begin(const Situation&, const TrapEvidence& evidence) override {
    ++begins;
    reason = evidence.text;
  }
  bool take_up(const Situation&, const TrapEvidence&) override { return takes_up; }
  EscapeStatus step(const Situation&, domain::Guidance& guidance) override {
    if (virtual_target) {
      guidance.target_x_m = virtual_target->x();
      guidance.target_y_m = virtual_target->y();
      guidance.target_is_virtual = true;
    } else {
      guidance.has_override = true;
      guidance.override_motion.turn_rad = turn_rad_;
    }
    guidance.why = "told";
    return status;
  }
  void save(core::StateWriter&) const override {}
  void load(core::StateReader&) override {}

  EscapeStatus status = EscapeStatus::kActive;
  bool takes_up = false;
  bool reads_map = false;
  std::optional<core::Vec2> virtual_target;
  int begins = 0;
  int watched = 0;
  const map::LocalMap* local_map = nullptr;
  std::string reason;

 private:
  double turn_rad_;
};

class RecoverComponentTest : public ::testing::Test {
 protected:
  RecoverComponentTest() {
    make_component();
    for (const domain::Topic topic : {domain::Topic::kOdometry, domain::Topic::kScan,
                                      domain::Topic::kTarget, domain::Topic::kLandmark}) {
      inputs_.set(index_of(topic));
    }
    for (const domain::Topic topic : {domain::Topic::kGuidance, domain::Topic::kEvent}) {
      outputs_.set(index_of(topic));
    }
  }

  void make_component(std::optional<map::LocalMap> local_map = {}, bool maps_late = false) {
    RecoverComponent::Parts parts;
    parts.local_map = std::move(local_map);
    parts.maps_late = maps_late;
    detector_ = add(parts.detector, "told", std::make_unique<ToldDetector>());
    shadow_ = add(parts.shadows.emplace_back(), "watcher", std::make_unique<ToldDetector>());
    first_ = add(parts.escapes.emplace_back(), "first", std::make_unique<ToldEscape>(0.1));
    second_ = add(parts.escapes.emplace_back(), "second", std::make_unique<ToldEscape>(0.2));
    parts.immediate_memory =
        ImmediateMemory::parse(tests::rule_base("krishna_kalra_actions")).value();
    component_ = std::make_unique<RecoverComponent>(std::move(parts));
  }

  template <typename Told, typename Behaviour>
  static Told* add(Named<Behaviour>& slot, const char* name, std::unique_ptr<Told> behaviour) {
    Told* told = behaviour.get();
    slot.name = name;
    slot.behaviour = std::move(behaviour);
    return told;
  }

  const domain::Guidance& step(const Scene& scene = {}) {
    std::get<domain::Odometry>(messages_) = scene.odometry();
    std::get<domain::Scan>(messages_) = scene.scan();
    std::get<domain::Landmark>(messages_) = scene.landmark();
    std::get<domain::Target>(messages_).x_m = scene.target().x();
    std::get<domain::Target>(messages_).y_m = scene.target().y();
    std::get<domain::Target>(messages_).waypoint = waypoint_;
    if (heading_rad_) {
      auto& target = std::get<domain::Target>(messages_);
      target.radius_m = 0.2;
      target.has_heading = true;
      target.heading_rad = *heading_rad_;
      target.heading_tolerance_rad = 0.1;
    }
    std::get<domain::Guidance>(messages_) = {};
    std::get<domain::Event>(messages_) = {};
    runtime::TickOutputs outputs(messages_, outputs_);
    component_->step({messages_, inputs_, inputs_, tick_++}, outputs);
    return std::get<domain::Guidance>(messages_);
  }

  std::vector<domain::EventKind> events() const {
    std::vector<domain::EventKind> kinds;
    const auto& entries = std::get<domain::Event>(messages_).entries;
    for (const auto& entry : entries) kinds.push_back(entry.kind);
    return kinds;
  }
  const domain::EventEntry& event(std::size_t i) const {
    return std::get<domain::Event>(messages_).entries[i];
  }

  ToldDetector* detector_ = nullptr;
  ToldDetector* shadow_ = nullptr;
  ToldEscape* first_ = nullptr;
  ToldEscape* second_ = nullptr;
  std::unique_ptr<RecoverComponent> component_;
  domain::Messages messages_;
  runtime::TopicSet inputs_;
  runtime::TopicSet outputs_;
  std::uint64_t tick_ = 0;
  std::uint32_t waypoint_ = 1;
  std::optional<double> heading_rad_;  // that the mission wants
};

}  // namespace clew::recover
