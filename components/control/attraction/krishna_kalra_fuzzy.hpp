// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "control/attraction/krishna_kalra_rules.hpp"
#include "control/controller.hpp"
#include "core/angle.hpp"
#include "core/result.hpp"
#include "domain/setup.hpp"

namespace clew::control {

enum class TargetTurn : std::uint8_t { kClipped, kBangBang };

struct KrishnaKalraFuzzyParameters {
  std::string rules = "krishna_kalra_control";
  TargetTurn target_turn = TargetTurn::kClipped;
  double behind_band_rad = core::radians(10.0);
};

template <typename Visitor>
void visit_parameters(Visitor& visit, KrishnaKalraFuzzyParameters& p) {
  visit.file("rules", p.rules, "rulebases", "rule base: the constants of eqs 1 to 10");
  visit.choice("target_turn", p.target_turn,
               {{"clipped", TargetTurn::kClipped}, {"bang_bang", TargetTurn::kBangBang}},
               "eq. 3: the difference angle clipped to c, or always c as printed");
  visit.angle("behind_band_deg", p.behind_band_rad, {0.0, 90.0},
              "a target within this angle of straight behind keeps the side it was on");
}

/// The fuzzy navigation scheme of Krishna & Kalra 2000, section 2.1: a target reaching and an
/// obstacle avoiding module, weighted by how near the obstacles are.
///
/// With u_i the readings as shares of the range, u_l, u_c, u_r the least of the left three, the
/// centre one and the least of the right three, and near + far = 1:
///
///     w1 = far(u_l) far(u_c) far(u_r),   w2 = 1 - w1                         (eq. 7)
///     y  = w1 y^t + w2 y^o               turn, clockwise positive            (eq. 7)
///     s  = w1 s^t + w2 s^o               step                                (eq. 8)
///
/// *Deviation:* eqs 4 and 5 are misprinted (far goes up where near goes up, and each is defined by
/// itself); read here as near falling from 1 to 0 between two shares of the range. *Deviation:* eq.
/// 3 as printed is bang-bang (its memberships never overlap, so the turn is always c or -c) and 0/0
/// at 0; the default clips the difference angle to [-c, c] instead.
class KrishnaKalraFuzzy final : public Controller {
 public:
  using Parameters = KrishnaKalraFuzzyParameters;
  using Readings = std::array<double, KrishnaKalraRules::kSensors>;

  struct State {
    bool target_on_right = false;  ///< the last time that it was clearly on one side
  };

  /// Refuses a scan that is not of seven cones over the front, as the paper's is.
  static core::Result<std::unique_ptr<KrishnaKalraFuzzy>> create(
      const Parameters& parameters, const domain::BehaviourSetup& setup);

  KrishnaKalraFuzzy(const Parameters& parameters, const KrishnaKalraRules& rules)
      : parameters_(parameters), rules_(rules) {}

  domain::Motion step(const domain::Odometry& odometry, const domain::Scan& scan,
                      const core::Vec2& target_odom) override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override;
  void tell(const domain::Odometry& odometry, const domain::Scan& scan,
            const core::Vec2& target_odom, domain::Inside& inside) const override;

  // The parts of the law, for tests. Readings and distances as shares of the range; turns in
  // radians, clockwise positive.

  /// Eq. 4: near(u).
  double near(double u) const;
  /// Eqs 1 to 3: y^t, from the difference angle (target to the right is positive).
  double target_turn_rad(double difference_angle_rad) const;
  /// Eq. 6: y^o.
  double obstacle_turn_rad(const Readings& u) const;
  /// Eq. 9: s^t.
  double target_step_m(double u_t) const;
  /// Eq. 10: s^o.
  double obstacle_step_m(const Readings& u) const;
  /// Eq. 7: w1, the weight of the target module.
  double target_weight(const Readings& u) const;

 private:
  void tell_surface(const Readings& u, double difference_angle_rad, domain::Inside& inside) const;
  double keep_side_behind(double difference_angle_rad);

  Parameters parameters_;
  KrishnaKalraRules rules_;
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, KrishnaKalraFuzzy::State& s) {
  visit(s.target_on_right);
}

}  // namespace clew::control
