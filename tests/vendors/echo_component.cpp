// SPDX-License-Identifier: Apache-2.0
/// A process for the tests: writes every sample of topic `question` to topic `answer`, until its
/// standard input ends.
///
///     clew_bridge_echo cyclonedds|fastdds DOMAIN
#include <unistd.h>

#include <cstdlib>
#include <iostream>

#include "echo_process.hpp"
#include "patient_writer.hpp"
#include "vendors/participant_factory.hpp"

namespace {

using namespace clew::bridge;

class Deaf : public DiscoveryListener {
  void on_participants(const std::set<std::string>&) override {}
  void on_matched(const RemoteEndpoint&) override {}
  void on_unmatched(const RemoteEndpoint&) override {}
  void on_incompatible_qos(const std::string&, bool, const std::string&) override {}
  void on_inconsistent_type(const RemoteEndpoint&) override {}
};

class Echo : public SampleListener {
 public:
  explicit Echo(SampleWriter& writer) : writer_(writer) {}
  void on_sample(std::string_view cdr, const RemoteEndpoint*) override { writer_.write(cdr); }

 private:
  PatientWriter writer_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  Deaf discovery;
  const auto vendor = vendor_from_name(argv[1]);
  if (!vendor) return 2;
  auto participant = create_participant(*vendor, {std::atoi(argv[2]), "echo", 1.5}, discovery);
  if (!participant.ok()) {
    std::cerr << participant.error().text() << '\n';
    return 1;
  }
  const auto writer = (*participant)->create_writer({"answer", "clew::msg::Test", "", kEchoDepth});
  if (!writer.ok()) return 1;
  Echo echo(**writer);
  const auto reader =
      (*participant)->create_reader({"question", "clew::msg::Test", "", kEchoDepth}, echo);
  if (!reader.ok()) return 1;
  char byte = 0;
  while (read(STDIN_FILENO, &byte, 1) > 0) {
  }
  return 0;
}
