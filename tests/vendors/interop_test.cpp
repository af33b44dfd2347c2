// SPDX-License-Identifier: Apache-2.0
/// Against a third-party component: plain Cyclone DDS with the types that idlc makes, and
/// nothing of ours but the IDL and the configuration that the supervisor hands out.
#include <dds/dds.h>
#include <gtest/gtest.h>

#include "cyclonedds/configuration.hpp"
#include "edge_messages.hpp"
#include "generated_types.hpp"
#include "message_equality.hpp"
#include "random_messages.hpp"
#include "recording_listeners.hpp"
#include "test_domain.hpp"
#include "vendors/participant_factory.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {
namespace {

using Qos = std::unique_ptr<dds_qos_t, void (*)(dds_qos_t*)>;

Qos usual_qos() {
  Qos qos(dds_create_qos(), dds_delete_qos);
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 8);
  return qos;
}

/// Of each topic in a test that writes many: none must wait until the others are acknowledged.
constexpr int kMessages = 24;

class Stranger {
 public:
  explicit Stranger(int domain)
      : domain_(dds_create_domain(kDomain, cyclonedds_configuration({domain, "", 1.5}).c_str())),
        participant_(dds_create_participant(kDomain, nullptr, nullptr)) {
    EXPECT_GT(participant_, 0);
  }
  ~Stranger() { dds_delete(domain_); }
  Stranger(const Stranger&) = delete;
  Stranger& operator=(const Stranger&) = delete;

  dds_entity_t create_writer(domain::Topic topic, const std::string& name, const Qos& qos) {
    const dds_entity_t writer =
        dds_create_writer(participant_, create_topic(topic, name), qos.get(), nullptr);
    EXPECT_GT(writer, 0);
    return writer;
  }
  dds_entity_t create_reader(domain::Topic topic, const std::string& name, const Qos& qos,
                             const dds_listener_t* listener = nullptr) {
    const dds_entity_t reader =
        dds_create_reader(participant_, create_topic(topic, name), qos.get(), listener);
    EXPECT_GT(reader, 0);
    return reader;
  }
  /// Reads every message of `topic` into its C struct, and writes that struct to `<topic>_echo`.
  void echo(domain::Topic topic) {
    const std::string name(domain::topic_name(topic));
    echo_writer_ = create_writer(topic, name + "_echo", usual_qos());
    dds_listener_t* listener = dds_create_listener(this);
    dds_lset_data_available(listener, [](dds_entity_t reader, void* self) {
      void* sample = nullptr;
      dds_sample_info_t info{};
      while (dds_take(reader, &sample, &info, 1, 1) > 0) {
        if (info.valid_data) dds_write(static_cast<Stranger*>(self)->echo_writer_, sample);
        dds_return_loan(reader, &sample, 1);
      }
    });
    create_reader(topic, name, usual_qos(), listener);
    dds_delete_listener(listener);
  }

 private:
  static constexpr dds_domainid_t kDomain = 1000;  ///< inside this process

  dds_entity_t create_topic(domain::Topic topic, const std::string& name) {
    return dds_create_topic(participant_, &cyclone_type(topic), name.c_str(), nullptr, nullptr);
  }

  dds_entity_t domain_;
  dds_entity_t participant_;
  dds_entity_t echo_writer_ = 0;
};

class Interop : public testing::TestWithParam<Vendor> {
 protected:
  Interop() : stranger_(domain_.number()) {
    auto participant = create_participant(GetParam(), {domain_.number(), "test", 1.5}, discovery_);
    EXPECT_TRUE(participant.ok()) << participant.error().text();
    participant_ = std::move(participant).value();
  }
  static EndpointSpec spec(domain::Topic topic, const std::string& suffix = "") {
    return {std::string(domain::topic_name(topic)) + suffix, std::string(domain::type_name(topic)),
            "", kMessages};
  }
  std::string reported_policy() {
    EXPECT_TRUE(discovery_.wait_until([](const auto& e) { return !e.incompatible.empty(); }));
    const auto events = discovery_.events();
    EXPECT_TRUE(events.matched.empty());
    return events.incompatible.empty() ? "" : events.incompatible[0].policy;
  }

  TestDomain domain_;
  DiscoveryRecord discovery_;
  SampleRecord samples_;
  Stranger stranger_;
  std::unique_ptr<Participant> participant_;
};

std::string vendor_test_name(const testing::TestParamInfo<Vendor>& info) {
  return std::string(vendor_name(info.param));
}

INSTANTIATE_TEST_SUITE_P(BothVendors, Interop,
                         testing::Values(Vendor::kCycloneDds, Vendor::kFastDds), vendor_test_name);

/// The default, the least and the greatest values, and some at random.
template <typename Message>
std::vector<Message> many_messages() {
  std::vector<Message> messages(kMessages);
  EdgeMessages(false).fill(messages[1]);
  EdgeMessages(true).fill(messages[2]);
  RandomMessages random(17);
  std::for_each(messages.begin() + 3, messages.end(), [&](Message& m) { random.fill(m); });
  return messages;
}

/// As Cyclone writes it: options in the header, and the size a multiple of 4.
std::string without_options(std::string_view cdr) {
  std::string bytes(cdr);
  bytes.at(2) = bytes.at(3) = '\0';
  bytes.resize((bytes.size() + 3) / 4 * 4);
  return bytes;
}

TEST_P(Interop, CComponentsReadEveryMessageAndWriteTheSameBytes) {
  for (const domain::Topic topic : domain::kAllTopics) {
    domain::visit_topic(topic, [&](auto constant) {
      using Message = typename decltype(constant)::Message;
      stranger_.echo(topic);
      const auto writer = participant_->create_writer(spec(topic));
      const auto reader = participant_->create_reader(spec(topic, "_echo"), samples_);
      ASSERT_TRUE(writer.ok() && reader.ok());
      Codec<Message> codec;
      for (const Message& sent : many_messages<Message>()) {
        const std::size_t before = samples_.samples().size();
        const std::string bytes(codec.encode(sent));

        ASSERT_EQ((*writer)->write(bytes), WriteStatus::kTaken);

        ASSERT_TRUE(samples_.wait_for(before + 1)) << domain::type_name(topic);
        const std::string echo(samples_.samples().back());
        EXPECT_EQ(without_options(echo), without_options(bytes)) << domain::type_name(topic);
        Message received;
        const core::Result<void> result = codec.decode(echo, received);
        ASSERT_TRUE(result.ok()) << result.error().text();
        EXPECT_TRUE(received == sent) << domain::type_name(topic);
      }
    });
  }
}

TEST_P(Interop, NamesThePolicyThatKeepsItsReaderFromABestEffortWriter) {
  const auto reader = participant_->create_reader(spec(domain::Topic::kTarget), samples_);
  ASSERT_TRUE(reader.ok());
  const Qos qos = usual_qos();
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_BEST_EFFORT, 0);

  stranger_.create_writer(domain::Topic::kTarget, "target", qos);

  EXPECT_EQ(reported_policy(), "RELIABILITY");
  EXPECT_EQ(discovery_.events().incompatible.at(0).topic, "target");
  EXPECT_FALSE(discovery_.events().incompatible.at(0).local_is_writer);
}

TEST_P(Interop, NamesThePolicyThatKeepsItsReaderFromAVolatileWriterThatWasThereBefore) {
  const Qos qos = usual_qos();
  dds_qset_durability(qos.get(), DDS_DURABILITY_VOLATILE);
  stranger_.create_writer(domain::Topic::kTarget, "target", qos);

  const auto reader = participant_->create_reader(spec(domain::Topic::kTarget), samples_);

  ASSERT_TRUE(reader.ok());
  EXPECT_EQ(reported_policy(), "DURABILITY");
}

TEST_P(Interop, NamesThePolicyThatKeepsItsWriterFromAReaderWithADeadline) {
  const auto writer = participant_->create_writer(spec(domain::Topic::kTarget));
  ASSERT_TRUE(writer.ok());
  const Qos qos = usual_qos();
  dds_qset_deadline(qos.get(), DDS_MSECS(50));

  stranger_.create_reader(domain::Topic::kTarget, "target", qos);

  EXPECT_EQ(reported_policy(), "DEADLINE");
  EXPECT_TRUE(discovery_.events().incompatible.at(0).local_is_writer);
}

TEST_P(Interop, ReportsAStrangerWithAnotherType) {
  const auto reader = participant_->create_reader(spec(domain::Topic::kTarget), samples_);
  ASSERT_TRUE(reader.ok());

  stranger_.create_writer(domain::Topic::kCommand, "target", usual_qos());

  ASSERT_TRUE(discovery_.wait_until([](const auto& e) { return e.inconsistent.size() == 1; }));
  EXPECT_EQ(discovery_.events().inconsistent.at(0).type, "clew::msg::Command");
}

}  // namespace
}  // namespace clew::bridge
