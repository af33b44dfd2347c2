// SPDX-License-Identifier: Apache-2.0
#include "clew/process_usage.hpp"

#include <unistd.h>

#include <fstream>
#include <sstream>
#include <string>

namespace clew::tools {

std::optional<ProcessUsage> usage_of(std::int64_t process_id) {
  std::ifstream file("/proc/" + std::to_string(process_id) + "/stat");
  std::string line;
  if (process_id <= 0 || !std::getline(file, line)) return std::nullopt;
  // The second word is the program's name in brackets, which may hold blanks and brackets.
  const std::size_t name_end = line.rfind(')');
  if (name_end == std::string::npos) return std::nullopt;
  std::istringstream words(line.substr(name_end + 1));
  std::string passed_over;
  // Words 3 to 13, and those from 16 to 23, of proc(5).
  for (int word = 3; word <= 13; ++word) words >> passed_over;
  double user_ticks = 0.0;
  double system_ticks = 0.0;
  words >> user_ticks >> system_ticks;
  for (int word = 16; word <= 23; ++word) words >> passed_over;
  std::uint64_t resident_pages = 0;
  if (!(words >> resident_pages)) return std::nullopt;
  ProcessUsage usage;
  usage.cpu_s = (user_ticks + system_ticks) / static_cast<double>(::sysconf(_SC_CLK_TCK));
  usage.resident_bytes = resident_pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  return usage;
}

}  // namespace clew::tools
