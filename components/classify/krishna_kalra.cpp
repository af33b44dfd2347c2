// SPDX-License-Identifier: Apache-2.0
#include "classify/krishna_kalra.hpp"

#include <algorithm>
#include <utility>

namespace clew::classify {
namespace {

bool contains(const std::vector<std::string>& words, const char* word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

core::Result<std::unique_ptr<KrishnaKalra>> KrishnaKalra::create(
    const Parameters& parameters, const domain::BehaviourSetup& setup) {
  CLEW_RETURN_IF_ERROR(scan::SevenCones::check(setup.scan, "classify krishna_kalra"));
  if (parameters.nearness.near_full_ratio >= parameters.nearness.near_none_ratio) {
    return core::Error{"near_none_ratio must be more than near_full_ratio"};
  }
  std::optional<Som> som;
  if (contains(parameters.networks, "som")) {
    const auto resource = setup.resources.find("rulebases", parameters.som);
    if (!resource.ok()) return resource.error();
    auto parsed = Som::parse(*resource);
    if (!parsed.ok()) return parsed.error();
    som = std::move(parsed).value();
  }
  return std::make_unique<KrishnaKalra>(parameters, std::move(som));
}

KrishnaKalra::KrishnaKalra(const Parameters& parameters, std::optional<Som> som)
    : parameters_(parameters),
      som_(std::move(som)),
      art_runs_(contains(parameters.networks, "art")),
      art_bounds_{static_cast<std::uint32_t>(parameters.min_first_run),
                  static_cast<std::uint32_t>(parameters.min_second_run),
                  static_cast<std::uint32_t>(parameters.min_third_run)},
      sequence_(parameters.sliding),
      art_(parameters.art) {}

void KrishnaKalra::step(const domain::Odometry& odometry, const domain::Scan& scan,
                        domain::Landmark& landmark) {
  const Nearness near = nearness(eyes_.see(scan), parameters_.nearness);
  if (sequence_.add(spatial_class(near, parameters_.nearness))) presented_ = false;
  landmark.spatial_class = sequence_.current().spatial_class;
  landmark.run_length = sequence_.current().length;
  if (sequence_.complete() && !presented_) present(odometry.stamp.tick, landmark);
}

/// The neuron that recalls a vector, if its first two runs reach the neuron's lower bounds.
std::optional<std::uint32_t> KrishnaKalra::som_winner(const Triple& classes,
                                                      const RunLengths& lengths) const {
  if (!som_) return std::nullopt;
  const Som::Recall recall = som_->recall(classes);
  const auto& bounds = som_->neuron(recall.neuron).lower_bounds;
  if (recall.distance > parameters_.som_tolerance_classes || !bounds) return std::nullopt;
  if (lengths[0] < (*bounds)[0] || lengths[1] < (*bounds)[1]) return std::nullopt;
  return recall.neuron;
}

/// Presents the vector of the last three runs as soon as its third run is long enough.
void KrishnaKalra::present(std::uint64_t tick, domain::Landmark& landmark) {
  const Triple classes = sequence_.classes();
  const RunLengths lengths = sequence_.lengths();
  const std::optional<std::uint32_t> winner = som_winner(classes, lengths);
  const RunLengths& bounds = winner ? *som_->neuron(*winner).lower_bounds : art_bounds_;
  if (!reaches(lengths, bounds)) return;

  presented_ = true;
  landmark.presented = true;
  landmark.classes = classes;
  landmark.run_lengths = lengths;
  if (winner) {
    landmark.recognitions.push_back(
        {domain::Network::kSom, *winner, false, som_->neuron(*winner).weights});
  } else if (art_runs_) {
    const FuzzyArt::Answer answer = art_.present(classes, tick);
    landmark.recognitions.push_back({domain::Network::kFuzzyArt, answer.category, answer.created,
                                     art_.prototype(answer.category)});
  }
}

void KrishnaKalra::save(core::StateWriter& writer) const {
  writer(sequence_.state(), presented_, art_.state());
}

void KrishnaKalra::load(core::StateReader& reader) {
  const std::size_t categories = art_.state().categories.size();
  reader(sequence_.state(), presented_, art_.state());
  reader.check(art_.state().categories.size() == categories, "there are as many categories");
  art_.state().categories.resize(categories);  // also after a reader that ran short
  if (!reader.check(sequence_.is_valid(), "there is no such class")) sequence_.state() = {};
}

}  // namespace clew::classify
