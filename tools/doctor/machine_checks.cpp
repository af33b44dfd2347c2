// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <optional>

#include "dds/rtps_ports.hpp"
#include "doctor/doctor.hpp"
#include "runtime/config_source.hpp"
#include "vendors/loopback.hpp"

namespace clew::doctor {
namespace {

constexpr int kLastDdsPort =
    bridge::kPortBase + bridge::kPortsPerDomain * (bridge::kMaxDomain + 1) - 1;
/// The kernel's own default, with which all measurements were made.
constexpr long kLeastSocketBufferBytes = 212992;
/// A recorded run of five processes over both vendors has about 60 open in its busiest one.
constexpr rlim_t kLeastOpenFiles = 256;
constexpr double kLeastSharedMiB = 16.0;
constexpr long kCoarsestClock_ns = 1000;

Finding good(std::string check, std::string found) {
  return {std::move(check), true, std::move(found), {}};
}

Finding bad(std::string check, std::string found, std::string fix) {
  return {std::move(check), false, std::move(found), std::move(fix)};
}

Finding check_loopback() {
  const std::string name = bridge::loopback_interface();
  if (!name.empty()) return good("loopback", fmt::format("{} is up and has 127.0.0.1", name));
  return bad("loopback", "no interface that is up has 127.0.0.1",
             "ip addr add 127.0.0.1/8 dev lo; ip link set lo up");
}

/// Ports that the kernel hands out to any program must not be those of our domains.
Finding check_ports(const Machine& machine) {
  std::ifstream file(machine.proc + "/sys/net/ipv4/ip_local_port_range");
  long first = 0;
  long last = 0;
  if (!(file >> first >> last)) {
    return good("ports", "the kernel does not say which ports it hands out");
  }
  const std::string found =
      fmt::format("the kernel hands out {} to {}; domains 0 to {} use {} to {}", first, last,
                  bridge::kMaxDomain, bridge::kPortBase, kLastDdsPort);
  if (first > kLastDdsPort || last < bridge::kPortBase) return good("ports", found);
  return bad("ports", found,
             fmt::format("sysctl -w net.ipv4.ip_local_port_range='32768 {}', or --domain with a "
                         "number whose ports are below {}",
                         std::max(last, 60999L), first));
}

Finding check_socket_buffers(const Machine& machine) {
  std::ifstream file(machine.proc + "/sys/net/core/rmem_max");
  long bytes = 0;
  // A network namespace of its own does not show it: the host's holds.
  if (!(file >> bytes))
    return good("socket_buffers", "the kernel does not say how large they may be");
  const std::string found = fmt::format("a socket may buffer {} bytes", bytes);
  if (bytes >= kLeastSocketBufferBytes) return good("socket_buffers", found);
  return bad("socket_buffers", found,
             fmt::format("sysctl -w net.core.rmem_max={}", kLeastSocketBufferBytes));
}

Finding check_shared_memory(const Machine& machine) {
  struct statvfs status {};
  const std::string& path = machine.shared_memory;
  const std::string fix = "mount -t tmpfs tmpfs " + path + ", or remove files there";
  if (::statvfs(path.c_str(), &status) != 0 || ::access(path.c_str(), W_OK) != 0) {
    return bad("shared_memory", path + " is not there or cannot be written", fix);
  }
  const double free_MiB =
      static_cast<double>(status.f_bavail) * static_cast<double>(status.f_frsize) / (1 << 20);
  const std::string found = fmt::format("{:.0f} MiB are free in {}", free_MiB, path);
  return free_MiB >= kLeastSharedMiB ? good("shared_memory", found)
                                     : bad("shared_memory", found, fix);
}

Finding check_open_files() {
  rlimit limit{};
  ::getrlimit(RLIMIT_NOFILE, &limit);
  if (limit.rlim_cur == RLIM_INFINITY) return good("open_files", "as many as wanted");
  const std::string found = fmt::format("a process may have {} open", limit.rlim_cur);
  return limit.rlim_cur >= kLeastOpenFiles ? good("open_files", found)
                                           : bad("open_files", found, "ulimit -n 1024");
}

Finding check_clock() {
  timespec resolution{};
  ::clock_getres(CLOCK_MONOTONIC, &resolution);
  const long step_ns = resolution.tv_sec > 0 ? 1000000000L : resolution.tv_nsec;
  const std::string found = fmt::format("it steps by {} ns", step_ns);
  return step_ns <= kCoarsestClock_ns
             ? good("clock", found)
             : bad("clock", found, "a kernel with high-resolution timers (CONFIG_HIGH_RES_TIMERS)");
}

/// An option, so it is told and not judged.
Finding tell_realtime() {
  rlimit limit{};
  ::getrlimit(RLIMIT_RTPRIO, &limit);
  if (::geteuid() == 0 || limit.rlim_cur > 0) {
    return good("realtime_priority", "allowed: clew run --realtime-priority N");
  }
  return good("realtime_priority",
              "not allowed to this user; it is an option of clew run "
              "(limits.conf: rtprio)");
}

Finding check_configs() {
  const auto path = runtime::ConfigPath::from_environment();
  const auto graph = path.find("graphs", "default");
  if (!graph.ok()) {
    return bad("configs", graph.error().text(),
               "set CLEW_PATH to the directory that has graphs/ and worlds/");
  }
  return good("configs", fmt::format("{} graphs and {} worlds; {}", path.names("graphs").size(),
                                     path.names("worlds").size(), graph->file));
}

}  // namespace

std::vector<Finding> check_machine(const Machine& machine) {
  return {check_loopback(),
          check_ports(machine),
          check_socket_buffers(machine),
          check_shared_memory(machine),
          check_open_files(),
          check_clock(),
          tell_realtime(),
          check_configs()};
}

}  // namespace clew::doctor
