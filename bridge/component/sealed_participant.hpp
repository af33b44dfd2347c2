// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "dds/participant.hpp"
#include "line/run_key.hpp"

namespace clew::bridge {

/// A participant whose endpoints have the seal of a run: those of the others believe what it says.
class SealedParticipant : public Participant {
 public:
  SealedParticipant(std::unique_ptr<Participant> participant, RunKey key)
      : participant_(std::move(participant)), key_(std::move(key)) {}

  std::string guid() const override { return participant_->guid(); }
  core::Result<std::unique_ptr<SampleWriter>> create_writer(const EndpointSpec& spec) override {
    return participant_->create_writer(sealed(spec));
  }
  core::Result<std::unique_ptr<SampleReader>> create_reader(const EndpointSpec& spec,
                                                            SampleListener& listener) override {
    return participant_->create_reader(sealed(spec), listener);
  }

 private:
  EndpointSpec sealed(EndpointSpec spec) const {
    const UserData data = UserData::parse(spec.user_data);
    // A component of somebody else's tells no stage, and has no seal.
    if (!data.stage.empty()) spec.user_data = key_.sealed(data, guid()).to_text();
    return spec;
  }

  std::unique_ptr<Participant> participant_;
  const RunKey key_;
};

}  // namespace clew::bridge
