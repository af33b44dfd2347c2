// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "classify/krishna_kalra.hpp"
#include "domain/landmark_classes.hpp"
#include "domain/words.hpp"

namespace clew::classify {
namespace {

std::array<double, 3> as_numbers(const Triple& classes) {
  return {static_cast<double>(classes[0]), static_cast<double>(classes[1]),
          static_cast<double>(classes[2])};
}

template <typename Numbers>
std::vector<double> as_list(const Numbers& numbers) {
  return {numbers.begin(), numbers.end()};
}

const char* say_nearness(double degree, const NearnessParameters& parameters) {
  if (degree > parameters.very_near_degree) return "very near";
  return degree >= parameters.near_degree ? "near" : "far";
}

/// The vigilance test's |Y ^ Z| / |Y| of a landmark vector and a category; |Y| is 3.
double match_of(const Triple& classes, const FuzzyArt::Category& category) {
  double overlap = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double y = static_cast<double>(classes[i]) / domain::kLastClass;
    overlap += std::min(y, category.weights[i]) + std::min(1.0 - y, category.weights[i + 3]);
  }
  return overlap / 3.0;
}

void tell_runs(const ClassSequence& sequence, domain::Inside& inside) {
  std::string runs;
  const auto tell = [&](const Run& run) {
    domain::InsideGroup& item = inside.values.item("class_sequence");
    item.number("class", run.spatial_class);
    item.number("length", run.length, "ticks");
    runs += (runs.empty() ? "" : ", then ") + std::to_string(run.spatial_class) + " for " +
            domain::say_count(run.length, "tick");
  };
  for (const Run& run : sequence.state().ended) tell(run);
  if (sequence.current().length > 0) tell(sequence.current());
  inside.say("The class sequence is " + runs + ".");
}

}  // namespace

void KrishnaKalra::tell(const domain::Odometry& odometry, const domain::Scan& scan,
                        domain::Inside& inside) const {
  scan::SevenCones eyes = eyes_;
  const NearnessParameters& parameters = parameters_.nearness;
  const Nearness near = nearness(eyes.see(scan), parameters);
  const auto spatial_class = static_cast<std::size_t>(sequence_.current().spatial_class);
  inside.say("Obstacles are " + std::string(say_nearness(near.left, parameters)) +
             " on the left, " + say_nearness(near.centre, parameters) + " ahead and " +
             say_nearness(near.right, parameters) + " on the right: spatial class " +
             std::to_string(spatial_class) + ".");
  domain::InsideGroup& group = inside.values.group("nearness");
  group.number("left", near.left);
  group.number("ahead", near.centre);
  group.number("right", near.right);
  group.number("near_from", parameters.near_degree);
  group.number("very_near_above", parameters.very_near_degree);
  inside.values.number("spatial_class", static_cast<double>(spatial_class));
  tell_runs(sequence_, inside);
  inside.values.flag("vector_complete", sequence_.complete());
  inside.values.flag("vector_presented", presented_);
  if (sequence_.complete()) {
    tell_networks(odometry.stamp.tick, inside);
  } else {
    inside.say("Three runs make a landmark vector; there are not as many yet.");
  }
}

void KrishnaKalra::tell_networks(std::uint64_t tick, domain::Inside& inside) const {
  inside.values.list("vector", as_list(as_numbers(sequence_.classes())));
  inside.values.list("run_lengths", as_list(sequence_.lengths()), "ticks");
  if (som_) tell_som(inside);
  if (art_runs_) tell_art(tick, inside);
}

/// The lattice with the distance of each neuron from the vector.
void KrishnaKalra::tell_som(domain::Inside& inside) const {
  const auto vector = as_numbers(sequence_.classes());
  domain::InsideGrid lattice{Som::kColumns, {}, "column", "row", {}};
  for (std::uint32_t i = 0; i < Som::kNeurons; ++i) {
    lattice.values.push_back(
        std::sqrt(domain::squared_class_distance(som_->neuron(i).weights, vector)));
  }
  const Som::Recall recall = som_->recall(sequence_.classes());
  lattice.marked = recall.neuron;
  const Som::Neuron& winner = som_->neuron(recall.neuron);
  const bool near = recall.distance <= parameters_.som_tolerance_classes;
  const bool lasted = winner.lower_bounds && reaches(sequence_.lengths(), *winner.lower_bounds);
  domain::InsideGroup& som = inside.values.group("som");
  som.number("winner", recall.neuron);
  som.number("distance_classes", recall.distance);
  som.number("tolerance_classes", parameters_.som_tolerance_classes);
  som.list("winner_classes", as_list(winner.weights));
  if (winner.lower_bounds) som.list("lower_bounds", as_list(*winner.lower_bounds), "ticks");
  som.flag("recognises", near && lasted);
  som.grid("distances_classes", std::move(lattice));
  std::string why = " which is too far: the map does not know it.";
  if (near && !winner.lower_bounds) why = " but that neuron stands for no landmark.";
  if (near && winner.lower_bounds) {
    why = lasted ? " and the runs are long enough: the map knows it."
                 : " but the runs are shorter than that neuron asks for.";
  }
  inside.say("Of the self-organising map, neuron " + std::to_string(recall.neuron) +
             " is nearest to the vector, " + domain::say_number(recall.distance) + " classes off," +
             why);
}

void KrishnaKalra::tell_art(std::uint64_t tick, domain::Inside& inside) const {
  const Triple classes = sequence_.classes();
  const auto& categories = art_.state().categories;
  double best = 0.0;
  std::size_t used = 0;
  domain::InsideGroup& art = inside.values.group("art");
  art.number("vigilance", parameters_.art.vigilance);
  for (std::uint32_t i = 0; i < categories.size(); ++i) {
    if (!categories[i].used) continue;
    ++used;
    const double match = match_of(classes, categories[i]);
    best = std::max(best, match);
    domain::InsideGroup& item = art.item("categories");
    item.number("category", i);
    item.list("prototype_classes", as_list(art_.prototype(i)));
    item.number("match", match);
    item.number("since_last_win", static_cast<double>(tick - categories[i].last_win_tick), "ticks");
  }
  inside.say("ART holds " + std::to_string(used) + (used == 1 ? " category" : " categories") +
             (used == 0
                  ? "."
                  : "; the best one matches the vector to " + domain::say_percent(best) + ", and " +
                        domain::say_percent(parameters_.art.vigilance) + " is asked for."));
}

}  // namespace clew::classify
