// SPDX-License-Identifier: Apache-2.0
#include "sweep/slurm.hpp"

#include <charconv>
#include <optional>
#include <sstream>

#include "sweep/program_output.hpp"

namespace clew::sweep {

using core::Error;
using core::Result;

namespace {

std::string last_line(const std::string& text) {
  const std::size_t end = text.find_last_not_of(" \n");
  if (end == std::string::npos) return {};
  const std::size_t begin = text.rfind('\n', end);
  return text.substr(begin == std::string::npos ? 0 : begin + 1,
                     end - (begin == std::string::npos ? std::size_t{0} - 1 : begin));
}

/// What a command of Slurm prints, or its complaint.
Result<std::string> ask(const std::vector<std::string>& words) {
  const auto output = run_program(words);
  if (!output.ok()) {
    return Error{output.error().message + "; is Slurm installed here (Debian: slurm-client)?",
                 words.front()};
  }
  if (output->status == 0) return output->out;
  const std::string complaint = last_line(output->err);
  return Error{
      complaint.empty() ? "ended with status " + std::to_string(output->status) : complaint,
      words.front()};
}

Result<std::size_t> read_number(const std::string& text, const std::string& of) {
  std::size_t number = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  if (read.ec == std::errc() && read.ptr == text.data() + text.size()) return number;
  return Error{"found '" + text + "'; expected a number in what it printed", of};
}

/// Those allocated and those idle of `allocated/idle/other/total`.
Result<std::size_t> read_up_cores(const std::string& text) {
  std::size_t cores = 0;
  std::istringstream counts(text);
  for (int i = 0; i < 2; ++i) {
    std::string count;
    std::getline(counts, count, '/');
    const auto number = read_number(count, "sinfo");
    if (!number.ok()) return number.error();
    cores += *number;
  }
  return cores;
}

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \n");
  if (begin == std::string::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \n") - begin + 1);
}

}  // namespace

std::string array_text(const std::vector<std::size_t>& tasks) {
  std::string text;
  for (std::size_t i = 0; i < tasks.size();) {
    std::size_t end = i + 1;
    while (end < tasks.size() && tasks[end] == tasks[end - 1] + 1) ++end;
    text += (text.empty() ? "" : ",") + std::to_string(tasks[i]);
    if (end - i > 1) text += '-' + std::to_string(tasks[end - 1]);
    i = end;
  }
  return text;
}

Result<std::map<std::size_t, TaskState>> read_tasks(const std::string& text) {
  std::map<std::size_t, TaskState> tasks;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    line = trimmed(line);
    if (line.empty()) continue;
    const std::size_t bar = line.find('|');
    const auto number = read_number(line.substr(0, bar), "squeue");
    if (!number.ok()) return number.error();
    const std::string state = bar == std::string::npos ? "" : line.substr(bar + 1);
    // Completing ones have ended; those of a node that is lost are completing for ever.
    if (state == "CG") continue;
    tasks[*number] = state == "R" ? TaskState::kRunning : TaskState::kWaiting;
  }
  return tasks;
}

Result<std::size_t> read_cores(const std::string& text) {
  std::size_t of_all = 0;
  std::optional<std::size_t> of_default;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    line = trimmed(line);
    if (line.empty()) continue;
    const std::size_t bar = line.find('|');
    const auto cores = read_up_cores(bar == std::string::npos ? line : line.substr(bar + 1));
    if (!cores.ok()) return cores.error();
    of_all += *cores;
    const bool is_default = bar != std::string::npos && bar > 0 && line[bar - 1] == '*';
    if (is_default) of_default = of_default.value_or(0) + *cores;
  }
  return of_default.value_or(of_all);
}

Result<std::size_t> Slurm::cores() {
  std::vector<std::string> words = {"sinfo", "--noheader", "--format=%P|%C"};
  if (!partition_.empty()) words.push_back("--partition=" + partition_);
  const auto text = ask(words);
  if (!text.ok()) return text.error();
  const auto cores = read_cores(*text);
  if (!cores.ok() || *cores > 0) return cores;
  if (trimmed(*text).empty() && !partition_.empty()) {
    return Error{"there is no partition '" + partition_ + "'; sinfo lists them", "--on"};
  }
  return Error{"no node is up", "sinfo"};
}

Result<std::string> Slurm::submit(const ArrayOrder& order) {
  std::vector<std::string> words = {"sbatch",
                                    "--parsable",
                                    "--requeue",
                                    "--open-mode=append",
                                    "--ntasks=1",
                                    "--job-name=" + order.name,
                                    "--array=" + array_text(order.tasks),
                                    "--cpus-per-task=" + std::to_string(order.cores),
                                    "--output=" + order.log};
  if (!partition_.empty()) words.push_back("--partition=" + partition_);
  words.push_back(order.script);
  const auto text = ask(words);
  if (!text.ok()) return text.error();
  // On a federation: `id;cluster`.
  const std::string job = trimmed(text->substr(0, text->find(';')));
  const auto number = read_number(job, "sbatch");
  if (!number.ok()) return number.error();
  return job;
}

Result<std::map<std::size_t, TaskState>> Slurm::tasks(const std::string& job) {
  const auto text = ask({"squeue", "--noheader", "--array", "--format=%K|%t", "--jobs=" + job});
  if (text.ok()) return read_tasks(*text);
  // So says squeue some minutes after the job's last task has ended.
  const bool is_over = text.error().message.find("Invalid job id") != std::string::npos;
  if (is_over) return std::map<std::size_t, TaskState>();
  return text.error();
}

Result<void> Slurm::cancel(const std::string& job) {
  const auto text = ask({"scancel", job});
  return text.ok() ? Result<void>() : Result<void>(text.error());
}

}  // namespace clew::sweep
