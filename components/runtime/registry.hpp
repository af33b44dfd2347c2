// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/check.hpp"
#include "core/parameters.hpp"
#include "core/result.hpp"
#include "runtime/stage.hpp"

namespace clew::runtime {

/// One line of a stage's list of behaviours.
template <typename Behaviour>
struct Registration {
  using Make = std::function<core::Result<std::unique_ptr<Behaviour>>(
      const core::ParameterValues&, const domain::BehaviourSetup&)>;

  VariantInfo info;
  Make make;
};

/// The list of all behaviours of one kind, in the order in which `clew list` prints them.
template <typename Behaviour>
class Registry {
 public:
  Registry(std::initializer_list<Registration<Behaviour>> registrations)
      : registrations_(registrations) {}

  const std::vector<Registration<Behaviour>>& all() const { return registrations_; }

  /// Puts one at the end. Refused: a name that is taken.
  core::Result<void> add(Registration<Behaviour> added) {
    for (const auto& registration : registrations_) {
      if (registration.info.name == added.info.name) {
        return core::Error{"there is a behaviour '" + added.info.name + "' already"};
      }
    }
    registrations_.push_back(std::move(added));
    return {};
  }

  std::vector<VariantInfo> variants() const {
    std::vector<VariantInfo> infos;
    for (const auto& registration : registrations_) infos.push_back(registration.info);
    return infos;
  }

  /// Makes the behaviour of a checked choice.
  core::Result<std::unique_ptr<Behaviour>> make(const PartChoice& choice,
                                                const domain::BehaviourSetup& setup) const {
    for (const auto& registration : registrations_) {
      if (registration.info.name == choice.name) {
        return registration.make(choice.parameters, setup);
      }
    }
    CLEW_CHECK(false, "behaviour '" + choice.name + "' was not checked");
  }

 private:
  std::vector<Registration<Behaviour>> registrations_;
};

/// A registration of `Class`, which has a struct `Class::Parameters` with visit_parameters, and
///
///     static core::Result<std::unique_ptr<Class>> create(const Parameters&,
///                                                        const domain::BehaviourSetup&);
template <typename Behaviour, typename Class>
Registration<Behaviour> registration(std::string name, std::string summary, TopicSet needs = {}) {
  using Parameters = typename Class::Parameters;
  return {{std::move(name), std::move(summary), core::describe_parameters<Parameters>(), needs},
          [](const core::ParameterValues& values,
             const domain::BehaviourSetup& setup) -> core::Result<std::unique_ptr<Behaviour>> {
            auto made = Class::create(core::read_parameters<Parameters>(values), setup);
            if (!made.ok()) return made.error();
            return std::unique_ptr<Behaviour>(std::move(made).value());
          }};
}

}  // namespace clew::runtime
