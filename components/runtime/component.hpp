// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bitset>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/archive.hpp"
#include "core/check.hpp"
#include "domain/inside.hpp"
#include "domain/topics.hpp"

namespace clew::runtime {

using domain::Topic;
using TopicSet = std::bitset<domain::kTopicCount>;

/// A declared input or output of a component. A component has at most one port a topic.
struct PortInfo {
  enum class Direction : std::uint8_t { kInput, kOutput };
  enum class Need : std::uint8_t {
    kRequired,  ///< the graph is refused if nobody writes it
    kOptional,  ///< read if somebody writes it
    /// Of an input: read, and then required, only if nobody writes `instead_of`. Of an output:
    /// written only if no other stage writes the topic.
    kFallback
  };

  Topic topic = Topic::kState;
  Direction direction = Direction::kInput;
  Need need = Need::kRequired;
  Topic instead_of = Topic::kState;  ///< with kFallback
  bool delayed = false;              ///< an input of the tick before; absent at tick 0
  std::string doc;                   ///< one line
};

inline PortInfo required_input(Topic topic, std::string doc) {
  return {topic,         PortInfo::Direction::kInput, PortInfo::Need::kRequired, topic, false,
          std::move(doc)};
}
inline PortInfo optional_input(Topic topic, std::string doc) {
  return {topic,         PortInfo::Direction::kInput, PortInfo::Need::kOptional, topic, false,
          std::move(doc)};
}
inline PortInfo fallback_input(Topic topic, Topic instead_of, std::string doc) {
  return {topic,         PortInfo::Direction::kInput, PortInfo::Need::kFallback, instead_of, false,
          std::move(doc)};
}
inline PortInfo delayed_input(Topic topic, std::string doc) {
  return {topic,         PortInfo::Direction::kInput, PortInfo::Need::kRequired, topic, true,
          std::move(doc)};
}
inline PortInfo output(Topic topic, std::string doc) {
  return {topic,         PortInfo::Direction::kOutput, PortInfo::Need::kRequired, topic, false,
          std::move(doc)};
}

/// A stage that is there for it takes the topic over.
inline PortInfo fallback_output(Topic topic, std::string doc) {
  return {topic,         PortInfo::Direction::kOutput, PortInfo::Need::kFallback, topic, false,
          std::move(doc)};
}

/// The inputs of one tick. Reading a topic that is no declared input is a mistake and aborts.
class TickInputs {
 public:
  TickInputs(const domain::Messages& messages, TopicSet declared, TopicSet present,
             std::uint64_t tick)
      : messages_(messages), declared_(declared), present_(present), tick_(tick) {}

  std::uint64_t tick() const { return tick_; }

  /// The sample, or null if the port is not wired, or delayed and this is tick 0.
  template <typename Message>
  const Message* find() const {
    constexpr auto kIndex = static_cast<std::size_t>(domain::topic_of<Message>());
    CLEW_CHECK(declared_[kIndex], std::string(domain::topic_name(domain::topic_of<Message>())) +
                                      " is not a declared input");
    return present_[kIndex] ? &std::get<kIndex>(messages_) : nullptr;
  }
  /// The sample of a port that is required.
  template <typename Message>
  const Message& get() const {
    const Message* message = find<Message>();
    CLEW_CHECK(message != nullptr,
               std::string(domain::topic_name(domain::topic_of<Message>())) + " is not present");
    return *message;
  }

 private:
  const domain::Messages& messages_;
  TopicSet declared_;
  TopicSet present_;
  std::uint64_t tick_;
};

/// Sees where the parts of a component's step begin and end, for a profile. No result depends on
/// it.
class PartObserver {
 public:
  virtual ~PartObserver() = default;
  virtual void begin_part(std::string_view name) = 0;
  virtual void end_part() = 0;
};

/// A part of a step, as long as its scope. Parts of a step follow one another.
class Part {
 public:
  /// The observer may be null.
  Part(PartObserver* observer, std::string_view name) : observer_(observer) {
    if (observer_ != nullptr) observer_->begin_part(name);
  }
  ~Part() {
    if (observer_ != nullptr) observer_->end_part();
  }
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;

 private:
  PartObserver* observer_;
};

/// The outputs of one tick. They come reset to default values, with the stamp set: a step that
/// writes nothing has said *nothing*.
class TickOutputs {
 public:
  TickOutputs(domain::Messages& messages, TopicSet declared, PartObserver* parts = nullptr)
      : messages_(messages), declared_(declared), parts_(parts) {}

  /// The sample, or null if another stage has taken this fallback output over.
  template <typename Message>
  Message* find() {
    constexpr auto kIndex = static_cast<std::size_t>(domain::topic_of<Message>());
    return declared_[kIndex] ? &std::get<kIndex>(messages_) : nullptr;
  }
  /// The sample of a declared output.
  template <typename Message>
  Message& get() {
    Message* message = find<Message>();
    CLEW_CHECK(message != nullptr, std::string(domain::topic_name(domain::topic_of<Message>())) +
                                       " is not a declared output");
    return *message;
  }

  /// A part of the step begins, and ends with the scope of what is returned: `name` is what a
  /// profile calls it.
  [[nodiscard]] Part part(std::string_view name) const { return {parts_, name}; }

 private:
  domain::Messages& messages_;
  TopicSet declared_;
  PartObserver* parts_;
};

/// A stage at work: a pure function of its inputs, its parameters and its saved state.
class Component {
 public:
  virtual ~Component() = default;

  /// Called once a tick, in order of ticks from 0 or from the tick after a loaded state. Never
  /// throws or blocks.
  virtual void step(const TickInputs& inputs, TickOutputs& outputs) = 0;

  /// The whole state between two ticks.
  virtual void save(core::StateWriter& writer) const = 0;
  /// Takes up a saved state; the caller checks reader.complete().
  virtual void load(core::StateReader& reader) = 0;

  /// Tells its inside as it is after the last step. `samples` are the inputs and the outputs of
  /// that step. Changes nothing: asked or not, the next step and the saved state are the same.
  virtual void tell(const TickInputs& samples, domain::Inside& inside) const {
    static_cast<void>(samples);
    static_cast<void>(inside);
  }
};

}  // namespace clew::runtime
