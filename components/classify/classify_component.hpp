// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "classify/classifier.hpp"
#include "runtime/component.hpp"

namespace clew::classify {

/// Says what place the robot senses.
class ClassifyComponent final : public runtime::Component {
 public:
  static std::vector<runtime::PortInfo> ports();

  explicit ClassifyComponent(std::unique_ptr<Classifier> classifier);

  void step(const runtime::TickInputs& inputs, runtime::TickOutputs& outputs) override;
  void save(core::StateWriter& writer) const override { classifier_->save(writer); }
  void load(core::StateReader& reader) override { classifier_->load(reader); }
  void tell(const runtime::TickInputs& samples, domain::Inside& inside) const override;

 private:
  std::unique_ptr<Classifier> classifier_;
};

}  // namespace clew::classify
