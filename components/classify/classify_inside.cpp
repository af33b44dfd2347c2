// SPDX-License-Identifier: Apache-2.0
#include "classify/classify_component.hpp"
#include "domain/words.hpp"

namespace clew::classify {

void ClassifyComponent::tell(const runtime::TickInputs& samples, domain::Inside& inside) const {
  domain::Inside part;
  classifier_->tell(samples.get<domain::Odometry>(), samples.get<domain::Scan>(), part);
  inside.add("classifier", std::move(part));
  const auto& landmark = samples.get<domain::Landmark>();
  inside.values.flag("presented_now", landmark.presented);
  if (!landmark.presented) {
    inside.say("No landmark vector was presented in this tick.");
    return;
  }
  if (landmark.recognitions.empty()) inside.say("The vector was presented; nobody knew it.");
  for (const domain::Recognition& recognition : landmark.recognitions) {
    const bool by_som = recognition.network == domain::Network::kSom;
    const std::string who = by_som ? "neuron " : "category ";
    inside.say("The vector was presented, and " + std::string(by_som ? "the map" : "ART") +
               (recognition.created ? " made " : " answered with ") + who +
               std::to_string(recognition.neuron) + (recognition.created ? " of it." : "."));
    domain::InsideGroup& item = inside.values.item("answers");
    item.text("network", by_som ? "som" : "fuzzy_art");
    item.number("winner", recognition.neuron);
    item.flag("created", recognition.created);
    item.list("prototype_classes",
              {recognition.prototype_classes.begin(), recognition.prototype_classes.end()});
  }
}

}  // namespace clew::classify
