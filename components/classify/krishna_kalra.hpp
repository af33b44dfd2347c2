// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "classify/class_sequence.hpp"
#include "classify/classifier.hpp"
#include "classify/fuzzy_art.hpp"
#include "classify/som.hpp"
#include "classify/spatial_classes.hpp"
#include "core/result.hpp"
#include "domain/setup.hpp"
#include "scan/seven_cones.hpp"

namespace clew::classify {

struct KrishnaKalraParameters {
  std::vector<std::string> networks = {"som", "art"};
  NearnessParameters nearness;
  bool sliding = true;
  std::string som = "krishna_kalra_som";
  double som_tolerance_classes = 0.5;
  FuzzyArtParameters art;
  std::int64_t min_first_run = 3;
  std::int64_t min_second_run = 2;
  std::int64_t min_third_run = 1;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, KrishnaKalraParameters& p) {
  visit.words("networks", p.networks, {"som", "art"},
              "which networks of the second layer run; []: spatial classes only");
  visit.number("near_full_ratio", p.nearness.near_full_ratio, "1", {0.0, 1.0},
               "eq. 4: nearness is 1 up to this share of the range");
  visit.number("near_none_ratio", p.nearness.near_none_ratio, "1", {0.0, 1.0},
               "eq. 4: nearness is 0 beyond this share of the range");
  visit.number("very_near_degree", p.nearness.very_near_degree, "1", {0.0, 1.0},
               "a reading is very near above this degree of nearness");
  visit.number("near_degree", p.nearness.near_degree, "1", {0.0, 1.0},
               "a reading is near at or above this degree of nearness");
  visit.flag("sliding", p.sliding,
             "true: the window of three runs moves by one run; false: by three");
  visit.file("som", p.som, "rulebases", "trained map");
  visit.number("som_tolerance_classes", p.som_tolerance_classes, "1", {0.0, 8.0},
               "greatest distance, in classes, at which a neuron recognises a landmark vector");
  visit.number("vigilance", p.art.vigilance, "1", {0.0, 1.0}, "ART: rho of appendix B");
  visit.number("learning_rate", p.art.learning_rate, "1", {0.0, 1.0}, "ART: beta of appendix B");
  visit.number("choice_delta", p.art.choice_delta, "1", {0.0, 1.0}, "ART: delta of appendix B");
  visit.integer(
      "capacity", p.art.capacity, "1", {1, 4096},
      "ART: greatest number of categories; then the one that won least recently is replaced");
  visit.integer("forget_ticks", p.art.forget_ticks, "ticks", {0, 1e9},
                "ART: a category that has not won for this long is forgotten; 0: never");
  visit.integer("min_first_run", p.min_first_run, "ticks", {1, 1000},
                "ART: least length of a landmark's first run");
  visit.integer("min_second_run", p.min_second_run, "ticks", {1, 1000},
                "ART: least length of a landmark's second run");
  visit.integer("min_third_run", p.min_third_run, "ticks", {1, 1000},
                "ART: least length of a landmark's third run");
}

/// The double layered classifier of Krishna & Kalra 2000, section 3: a fuzzy rule base tells the
/// spatial class of each scan, and changes of class make landmark vectors, which a self-organising
/// map recalls and fuzzy ART learns.
///
/// A vector is presented once, when its third run reaches the lower bound t3 of the neuron that
/// recalls it. ART is the map's backup: it takes what the map does not know, with lower bounds that
/// are the same for all vectors. The paper gives ART none; without them every flicker between two
/// classes is a landmark.
class KrishnaKalra final : public Classifier {
 public:
  using Parameters = KrishnaKalraParameters;

  /// Refuses sensors that leave one of the seven sectors without a beam, and a trained map that is
  /// not well formed.
  static core::Result<std::unique_ptr<KrishnaKalra>> create(const Parameters& parameters,
                                                            const domain::BehaviourSetup& setup);

  KrishnaKalra(const Parameters& parameters, std::optional<Som> som);

  void step(const domain::Odometry& odometry, const domain::Scan& scan,
            domain::Landmark& landmark) override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override;
  void tell(const domain::Odometry& odometry, const domain::Scan& scan,
            domain::Inside& inside) const override;

 private:
  void tell_networks(std::uint64_t tick, domain::Inside& inside) const;
  void tell_som(domain::Inside& inside) const;
  void tell_art(std::uint64_t tick, domain::Inside& inside) const;
  std::optional<std::uint32_t> som_winner(const Triple& classes, const RunLengths& lengths) const;
  void present(std::uint64_t tick, domain::Landmark& landmark);

  Parameters parameters_;
  std::optional<Som> som_;
  bool art_runs_;
  RunLengths art_bounds_;
  scan::SevenCones eyes_{std::numeric_limits<double>::infinity()};
  ClassSequence sequence_;
  FuzzyArt art_;
  bool presented_ = false;  // the vector that ends with the run that lasts
};

}  // namespace clew::classify
