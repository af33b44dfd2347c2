// SPDX-License-Identifier: Apache-2.0
#include "sweep/shard_folders.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>

#include "bench/results_file.hpp"
#include "bench/shards.hpp"
#include "core/quoted.hpp"
#include "files/whole_file.hpp"

namespace clew::sweep {

using core::Error;
using core::Result;

namespace {

namespace fs = std::filesystem;

constexpr char kCountKey[] = "shards";

std::string folder_in(const std::string& directory) {
  std::error_code ignored;
  const fs::path whole = fs::absolute(directory, ignored);
  return (whole / "shards").lexically_normal().string();
}

std::string note_in(const std::string& folder) { return folder + "/sweep.jsonl"; }

Result<bench::ResultsHeader> read_note(const std::string& folder) {
  auto reader = bench::LineReader::open(note_in(folder));
  if (!reader.ok()) return reader.error();
  const std::string* line = reader->next();
  return bench::read_header(line == nullptr ? "" : *line, note_in(folder));
}

Result<std::size_t> count_of(const bench::ResultsHeader& header, const std::string& folder) {
  const auto entry = header.configuration.find(kCountKey);
  const std::string text = entry == header.configuration.end() ? "" : entry->second;
  std::size_t count = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), count);
  if (read.ec == std::errc() && count >= 1 && count <= bench::kMostShards) return count;
  return Error{"does not say how many shards there are", note_in(folder), 1, 0};
}

}  // namespace

ShardFolders::ShardFolders(std::string folder, const bench::BenchPlan& plan, std::size_t count)
    : folder_(std::move(folder)), counts_(count) {
  const bench::Shards shards(plan, count);
  for (std::size_t number = 1; number <= count; ++number) {
    std::size_t runs = 0;
    for (const bench::Unit& unit : shards.units_of(number, 1)) runs += unit.end - unit.first;
    runs_.push_back(runs);
  }
}

Result<std::size_t> ShardFolders::count_in(const std::string& directory) {
  const std::string folder = folder_in(directory);
  std::error_code ignored;
  if (!fs::exists(note_in(folder), ignored)) return std::size_t{0};
  const auto header = read_note(folder);
  if (!header.ok()) return header.error();
  return count_of(*header, folder);
}

Result<ShardFolders> ShardFolders::open(const std::string& directory, const bench::BenchPlan& plan,
                                        const bench::BenchOrder& order, std::size_t count) {
  const std::string folder = folder_in(directory);
  bench::ResultsHeader header{order, plan.configuration};
  header.configuration[kCountKey] = std::to_string(count);
  std::error_code ignored;
  if (fs::exists(note_in(folder), ignored)) {
    const auto noted = read_note(folder);
    if (!noted.ok()) return noted.error();
    const std::string differs = bench::difference(noted->configuration, header.configuration);
    if (!differs.empty()) {
      return Error{differs +
                       "; go on with what it was made with, choose another --out, or begin again "
                       "with --force",
                   note_in(folder)};
    }
    return ShardFolders(folder, plan, count);
  }
  CLEW_RETURN_IF_ERROR(files::make_directory(folder));
  CLEW_RETURN_IF_ERROR(files::write_file(note_in(folder), header.text() + '\n'));
  return ShardFolders(folder, plan, count);
}

std::string ShardFolders::shard(std::size_t number) const {
  return folder_ + '/' + std::to_string(number);
}

std::string ShardFolders::last_words(std::size_t number) const {
  std::ifstream log(shard(number) + ".log");
  std::string last;
  for (std::string line; std::getline(log, line);) {
    if (!line.empty()) last = line;
  }
  return last;
}

std::size_t ShardFolders::done(std::size_t number) {
  const std::string path = shard(number) + '/' + bench::kResultsFile;
  Count& count = counts_[number - 1];
  std::error_code missing;
  const std::uint64_t size = fs::file_size(path, missing);
  if (missing || size < count.bytes) count = {};  // begun again
  std::ifstream file(path);
  file.seekg(static_cast<std::streamoff>(count.bytes));
  char buffer[65536];
  while (file.read(buffer, sizeof buffer), file.gcount() > 0) {
    count.bytes += static_cast<std::uint64_t>(file.gcount());
    count.lines += static_cast<std::size_t>(std::count(buffer, buffer + file.gcount(), '\n'));
  }
  return count.lines == 0 ? 0 : count.lines - 1;  // the first says what they depend on
}

std::string ShardFolders::job() const {
  std::ifstream file(folder_ + "/job");
  std::string job;
  std::getline(file, job);
  return job;
}

Result<void> ShardFolders::note_job(const std::string& job) const {
  return files::write_file(folder_ + "/job", job + '\n');
}

Result<void> ShardFolders::write_script(const std::string& program, const bench::BenchOrder& order,
                                        std::size_t cores) const {
  std::string words;
  for (const std::string& word : order.words()) words += ' ' + core::shell_word(word);
  return files::write_file(
      script(),
      fmt::format("#!/bin/sh\n"
                  "# A task of the sweep: goes on with one shard from where it is.\n"
                  "exec {} bench{} --shard \"$SLURM_ARRAY_TASK_ID/{}\" --jobs {} "
                  "--out {}/\"$SLURM_ARRAY_TASK_ID\"\n",
                  core::shell_word(program), words, count(), cores, core::shell_word(folder_)));
}

}  // namespace clew::sweep
