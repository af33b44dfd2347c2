// SPDX-License-Identifier: Apache-2.0
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/json_line.hpp"
#include "core/nearest_name.hpp"
#include "hosts/host_identity.hpp"
#include "runtime/run_plan.hpp"
#include "security/key_directory.hpp"
#include "stages/all.hpp"
#include "supervisor/run_participants.hpp"

namespace clew::tools {
namespace {

using bridge::KeyDirectory;
using bridge::SecuredParticipant;
using bridge::Validity;
using bridge::Vendor;
using core::Result;

constexpr std::time_t kDay_s = 24 * 3600;
/// The clocks of two machines may differ.
constexpr std::time_t kEarlier_s = 3600;

struct KeysOptions {
  std::string directory;
  std::vector<std::string> graphs;
  std::string name = "clew";
  int authority_days = 3650;
  int days = 365;
  std::string host;
  std::string role = "host";
  bool json = false;
};

Validity from_now(int days) {
  const std::time_t now = std::time(nullptr);
  return {now - kEarlier_s, now + days * kDay_s};
}

std::string date(std::time_t time) { return fmt::format("{:%Y-%m-%d}", fmt::gmtime(time)); }

/// Adds what a participant of one graph may do to what it may do in others.
void merge(const SecuredParticipant& one, std::vector<SecuredParticipant>& all) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const SecuredParticipant& other) {
    return other.name == one.name;
  });
  if (found == all.end()) return all.push_back(one);
  found->rights.writes.insert(one.rights.writes.begin(), one.rights.writes.end());
  found->rights.reads.insert(one.rights.reads.begin(), one.rights.reads.end());
  for (const Vendor vendor : one.vendors) {
    const bool known = std::count(found->vendors.begin(), found->vendors.end(), vendor) > 0;
    if (!known) found->vendors.push_back(vendor);
  }
}

/// Those of the graphs that were named, as these say whom each vendor carries.
Result<std::vector<SecuredParticipant>> participants_of(const std::vector<std::string>& graphs) {
  std::vector<SecuredParticipant> all;
  for (const std::string& graph : graphs) {
    const auto plan =
        runtime::prepare_run(graph, {}, runtime::ConfigPath::from_environment(), stages::all());
    if (!plan.ok()) return plan.error();
    for (const auto& one : bridge::run_participants(plan->graph, {})) merge(one, all);
  }
  return all;
}

int init_command(const KeysOptions& options) {
  const Validity validity = from_now(options.authority_days);
  const auto made = KeyDirectory(options.directory).create(options.name, validity);
  if (!made.ok()) return complain(made.error());
  fmt::print("{}: authority '{}', valid until {}; next: clew keys mint {}\n", options.directory,
             options.name, date(validity.not_after), options.directory);
  return kExitGood;
}

int host_command(const KeysOptions& options) {
  if (!runtime::is_host_name(options.host)) {
    return complain({"found '" + options.host + "'; allowed: " + runtime::kHostNameRule, "name"});
  }
  if (options.role != "host" && options.role != "run") {
    return complain({core::unknown_name("role", options.role, {"host", "run"}), "--role"});
  }
  const bridge::HostRole role =
      options.role == "host" ? bridge::HostRole::kHost : bridge::HostRole::kRunner;
  const Validity validity = from_now(options.days);
  const auto minted = bridge::mint_host_identity(options.directory, options.host, role, validity);
  if (!minted.ok()) return complain(minted.error());
  fmt::print("{}: {} '{}', valid until {}; it is all that this computer needs\n",
             bridge::host_identity_directory(options.directory, options.host, role), options.role,
             options.host, date(validity.not_after));
  return kExitGood;
}

int mint_command(const KeysOptions& options) {
  auto participants =
      options.graphs.empty()
          ? Result<std::vector<SecuredParticipant>>(bridge::all_participants(stages::all()))
          : participants_of(options.graphs);
  if (!participants.ok()) return complain(participants.error());
  const KeyDirectory keys(options.directory);
  const Validity validity = from_now(options.days);
  for (const SecuredParticipant& one : *participants) {
    // The command line may give a stage another vendor than its graph.
    for (const Vendor vendor : {Vendor::kCycloneDds, Vendor::kFastDds}) {
      const auto minted = keys.mint(one.name, vendor, one.rights, validity);
      if (!minted.ok()) return complain(minted.error());
    }
    fmt::print("{}: writes {}; reads {}\n", one.name,
               one.rights.writes.empty() ? "nothing"
                                         : fmt::format("{}", fmt::join(one.rights.writes, ", ")),
               one.rights.reads.empty() ? "nothing"
                                        : fmt::format("{}", fmt::join(one.rights.reads, ", ")));
  }
  fmt::print("{} identities for each vendor, valid until {}\n", participants->size(),
             date(validity.not_after));
  return kExitGood;
}

/// All that is wrong with a directory, and with what the graphs need of it.
std::vector<bridge::CredentialFault> faults_in(const KeyDirectory& keys,
                                               std::vector<SecuredParticipant> participants) {
  // Whatever else is there shall be good, too.
  for (const auto& [name, vendor] : keys.identities()) merge({name, {vendor}, {}}, participants);
  const std::time_t now = std::time(nullptr);
  std::vector<bridge::CredentialFault> faults;
  const KeyDirectory::Shared shared = keys.read_shared(now, faults);
  for (const SecuredParticipant& one : participants) {
    for (const Vendor vendor : one.vendors) {
      keys.read_identity(shared, one.name, vendor, one.rights, now, faults);
    }
  }
  return faults;
}

int check_keys_command(const KeysOptions& options) {
  auto participants = participants_of(options.graphs);
  if (!participants.ok()) return complain(participants.error());
  const KeyDirectory keys(options.directory);
  const auto faults = faults_in(keys, std::move(participants).value());
  for (const bridge::CredentialFault& fault : faults) {
    if (options.json) {
      fmt::print("{}\n", json_line({{"file", fault.file}, {"fault", fault.text}}));
    } else {
      fmt::print("{}: {}\n", fault.file, fault.text);
    }
  }
  if (!faults.empty()) return kExitFailed;
  if (!options.json) fmt::print("good: {} identities\n", keys.identities().size());
  return kExitGood;
}

CLI::App* add_part(CLI::App& keys, const char* name, const char* about, KeysOptions& options) {
  CLI::App* app = keys.add_subcommand(name, about);
  app->add_option("directory", options.directory, "of the keys")->required();
  return app;
}

}  // namespace

void add_keys(CLI::App& main, int& status) {
  CLI::App* keys =
      main.add_subcommand("keys", "Make and check the keys of runs with 'clew run --secure=DIR'");
  keys->require_subcommand(1);
  const auto options = std::make_shared<KeysOptions>();

  CLI::App* init = add_part(*keys, "init", "Make a directory with an authority", *options);
  init->add_option("--name", options->name, "of the authority")
      ->check(CLI::Validator(
          [](const std::string& name) {
            const bool plain = std::all_of(name.begin(), name.end(), [](unsigned char letter) {
              return letter >= ' ' && letter <= '~';
            });
            return name.empty() || name.size() > 64 || !plain
                       ? "found '" + name + "'; allowed: 1 to 64 letters of ASCII"
                       : std::string();
          },
          ""))
      ->capture_default_str();
  init->add_option("--days", options->authority_days, "that it is valid")
      ->check(number_between(1, 36500))
      ->capture_default_str();
  init->callback([options, &status] { status = init_command(*options); });

  CLI::App* mint = add_part(*keys, "mint", "Make an identity for each process of a run", *options);
  mint->add_option("graph", options->graphs,
                   "names or paths: what each process may write and read follows from their wiring "
                   "(any graph in which each stage has a process of its own)");
  mint->add_option("--days", options->days, "that it is valid")
      ->check(number_between(1, 36500))
      ->capture_default_str();
  mint->callback([options, &status] { status = mint_command(*options); });

  CLI::App* host =
      add_part(*keys, "host", "Make the identity of a computer in runs over hosts", *options);
  host->add_option("name", options->host, "of the computer, as in the file of hosts")->required();
  host->add_option("--role", options->role,
                   "host: it starts components for others; run: it runs graphs over hosts")
      ->capture_default_str();
  host->add_option("--days", options->days, "that it is valid")
      ->check(number_between(1, 36500))
      ->capture_default_str();
  host->callback([options, &status] { status = host_command(*options); });

  CLI::App* check = add_part(*keys, "check", "Tell all that is wrong with the keys", *options);
  check->get_option("directory")->check(CLI::ExistingDirectory);
  check->add_option("graph", options->graphs, "names or paths that the keys shall be fit for, too");
  check->add_flag("--json", options->json, "a line a fault");
  check->callback([options, &status] { status = check_keys_command(*options); });
}

}  // namespace clew::tools
