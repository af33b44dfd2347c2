// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/own_program.hpp"
#include "clew/version.hpp"
#include "dds/rtps_ports.hpp"
#include "hosts/host_service.hpp"
#include "hosts/relay.hpp"
#include "run/end_signals.hpp"

namespace clew::tools {
namespace {

struct HostOptions {
  std::string listen = fmt::format("{}:{}", bridge::kLoopbackAddress, bridge::kHostPort);
  bridge::HostOrder order;
};

int host_command(const HostOptions& options) {
  const auto address = bridge::read_tcp_address(options.listen);
  if (!address.ok()) return complain({address.error().message, "--listen"});
  bridge::HostOrder order = options.order;
  order.listen = *address;
  order.program = own_program();
  order.version = version_text();
  bridge::EndSignals signals;  // before anybody is told that it listens
  const auto service = bridge::HostService::open(order);
  if (!service.ok()) return complain(service.error());
  fmt::print("host {} listens on {}\n", (*service)->name(), (*service)->address().text());
  std::fflush(stdout);
  (*service)->run(signals);
  return kExitGood;
}

}  // namespace

void add_host(CLI::App& main, int& status) {
  const auto options = std::make_shared<HostOptions>();
  CLI::App* app = main.add_subcommand("host", "Start components of runs on other computers");
  app->add_option("--listen", options->listen, "ADDRESS:PORT; port 0: any free one")
      ->capture_default_str();
  app->add_option("--identity", options->order.identity,
                  "a directory with who this host is, of 'clew keys host'")
      ->check(given_name())
      ->required();
  app->add_option(
         "--allow", options->order.allowed,
         "a program as the graph names it; a plug-in by the full path of its file, which must "
         "be the same, with the same bytes, on both computers; may be repeated")
      ->allow_extra_args(false);
  app->callback([options, &status] { status = host_command(*options); });
}

void add_relay(CLI::App& main, int& status) {
  const auto order = std::make_shared<bridge::RelayOrder>();
  CLI::App* app = main.add_subcommand("relay", "Be a component that runs on another host");
  app->group("");
  app->add_option("hosts", order->hosts_file, "the file of hosts")->required();
  app->add_option("host", order->host, "on which the component runs")->required();
  app->add_option("stage", order->stage, "or group")->required();
  app->add_option("--domain", order->domain, "of the run")->required();
  app->add_option("--fallback", order->fallback,
                  "where it runs if the host is lost: a host, or local");
  app->callback([order, &status] {
    order->program = own_program();
    order->version = version_text();
    status = bridge::run_relay(*order);
  });
}

}  // namespace clew::tools
