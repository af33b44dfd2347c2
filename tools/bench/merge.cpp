// SPDX-License-Identifier: Apache-2.0
#include "bench/merge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "bench/run_order.hpp"
#include "files/whole_file.hpp"

namespace clew::bench {

using core::Error;
using core::Result;

namespace {

namespace fs = std::filesystem;

std::string file_in(const std::string& directory, const char* name) {
  return (fs::path(directory) / name).string();
}

Result<ShardDirectory> read_shard_directory(const std::string& directory) {
  const std::string path = file_in(directory, kResultsFile);
  auto reader = LineReader::open(path);
  if (!reader.ok()) return reader.error();
  const std::string* line = reader->next();
  auto header = read_header(line == nullptr ? "" : *line, path);
  if (!header.ok()) return header.error();
  const auto entry = header->configuration.find(kShardKey);
  if (entry == header->configuration.end()) {
    return Error{"is no shard: it was made without --shard", directory};
  }
  const auto shard = read_shard(entry->second);
  if (!shard.ok()) return Error{shard.error().message, path, 1, 0};
  header->configuration.erase(entry);
  return ShardDirectory{directory, std::move(header).value(), *shard};
}

/// Whether two shards may be of one bench.
Result<void> check_fit(const ShardDirectory& first, const ShardDirectory& other) {
  if (first.shard.count != other.shard.count) {
    return Error{fmt::format("is shard {}, but {} is shard {}: all must be of one N",
                             other.shard.text(), first.path, first.shard.text()),
                 other.path};
  }
  const std::string differs = difference(first.header.configuration, other.header.configuration);
  if (differs.empty()) return {};
  return Error{fmt::format("is a shard of another bench than {}: {}, there", first.path, differs),
               other.path};
}

Result<void> check_all_there(const std::vector<ShardDirectory>& shards) {
  std::string missing;
  std::size_t next = 1;
  for (const ShardDirectory& shard : shards) {
    for (; next < shard.shard.number; ++next) missing += fmt::format(" {}", next);
    next = shard.shard.number + 1;
  }
  const std::size_t count = shards.front().shard.count;
  for (; next <= count; ++next) missing += fmt::format(" {}", next);
  if (missing.empty()) return {};
  return Error{fmt::format("{} of {} shards are there; missing:{}", shards.size(), count, missing),
               "--merge"};
}

/// The lines of all shards side by side.
class ShardLines {
 public:
  ShardLines(const BenchPlan& plan, const std::vector<ShardDirectory>& shards)
      : order_(plan), dealt_(plan, shards.size()), shards_(shards) {}

  Result<void> open(const char* name, int header_lines) {
    for (const ShardDirectory& shard : shards_) {
      auto reader = LineReader::open(file_in(shard.path, name));
      if (!reader.ok()) return reader.error();
      for (int i = 0; i < header_lines; ++i) reader->next();
      readers_.push_back(std::move(reader).value());
    }
    return {};
  }

  /// Copies every run's line in the bench's order; each must be the next of its shard.
  Result<void> copy_results(NewFile& to) {
    for (std::size_t index = 0; index < order_.size(); ++index) {
      const std::size_t owner = owner_of(index);
      const std::string* line = readers_[owner].next();
      if (line == nullptr) return ends_early(owner, index);
      const auto key = read_run_key(*line);
      if (!key.ok()) return at_line(owner, key.error().message);
      if (order_.index_of(*key) != index) return out_of_place(owner, index, *key);
      CLEW_RETURN_IF_ERROR(to.write(*line + '\n'));
    }
    for (std::size_t owner = 0; owner < readers_.size(); ++owner) {
      CLEW_RETURN_IF_ERROR(readers_[owner].is_whole());
      if (readers_[owner].next() == nullptr) continue;
      return at_line(owner, "there is more than the runs of shard " + text_of(owner));
    }
    return {};
  }

  /// Copies the lines of the runs whose line is there.
  Result<void> copy_timing(NewFile& to) {
    std::vector<const std::string*> lines;
    for (LineReader& reader : readers_) lines.push_back(reader.next());
    for (std::size_t index = 0; index < order_.size(); ++index) {
      const std::size_t owner = owner_of(index);
      if (lines[owner] == nullptr) continue;
      const auto key = read_run_key(*lines[owner]);
      if (!key.ok() || order_.index_of(*key) != index) continue;
      CLEW_RETURN_IF_ERROR(to.write(*lines[owner] + '\n'));
      lines[owner] = readers_[owner].next();
    }
    return {};
  }

 private:
  std::size_t owner_of(std::size_t index) const {
    const auto [world, run] = order_.in_world(index);
    return dealt_.of(world, run) - 1;
  }
  std::string text_of(std::size_t owner) const { return shards_[owner].shard.text(); }

  Error at_line(std::size_t owner, const std::string& message) const {
    return {message, readers_[owner].path(), readers_[owner].number(), 0};
  }

  Error ends_early(std::size_t owner, std::size_t index) const {
    const auto whole = readers_[owner].is_whole();
    if (!whole.ok()) return whole.error();
    return {fmt::format("shard {} is not whole: {} is missing; go on with it by the command that "
                        "began it",
                        text_of(owner), run_text(order_.key_of(index))),
            readers_[owner].path()};
  }

  Error out_of_place(std::size_t owner, std::size_t index, const RunKey& found) const {
    const std::string expected = run_text(order_.key_of(index));
    const auto place = order_.index_of(found);
    if (!place) return at_line(owner, run_text(found) + " is no run of this bench");
    if (owner_of(*place) != owner) {
      return at_line(owner,
                     fmt::format("{} is a run of shard {}, this is shard {}", run_text(found),
                                 text_of(owner_of(*place)), text_of(owner)));
    }
    return at_line(owner, fmt::format("found {}, expected {}: a run is missing or stands twice, or "
                                      "the shard was ended before it was put in order; go on with "
                                      "it by the command that began it",
                                      run_text(found), expected));
  }

  RunOrder order_;
  Shards dealt_;
  const std::vector<ShardDirectory>& shards_;
  std::vector<LineReader> readers_;
};

}  // namespace

Result<std::vector<ShardDirectory>> read_shards(const std::vector<std::string>& directories) {
  std::vector<ShardDirectory> shards;
  for (const std::string& directory : directories) {
    auto shard = read_shard_directory(directory);
    if (!shard.ok()) return shard.error();
    if (!shards.empty()) CLEW_RETURN_IF_ERROR(check_fit(shards.front(), *shard));
    for (const ShardDirectory& other : shards) {
      if (other.shard.number != shard->shard.number) continue;
      return Error{fmt::format("is shard {}, and so is {}: once is allowed", shard->shard.text(),
                               other.path),
                   directory};
    }
    shards.push_back(std::move(shard).value());
  }
  std::sort(shards.begin(), shards.end(), [](const ShardDirectory& a, const ShardDirectory& b) {
    return a.shard.number < b.shard.number;
  });
  CLEW_RETURN_IF_ERROR(check_all_there(shards));
  return shards;
}

Result<void> merge_lines(const BenchPlan& plan, const ResultsHeader& header,
                         const std::vector<ShardDirectory>& shards, const std::string& directory) {
  ShardLines results(plan, shards);
  CLEW_RETURN_IF_ERROR(results.open(kResultsFile, 1));
  auto merged = NewFile::open(file_in(directory, kResultsFile));
  if (!merged.ok()) return merged.error();
  CLEW_RETURN_IF_ERROR(merged->write(header.text() + '\n'));
  CLEW_RETURN_IF_ERROR(results.copy_results(*merged));
  ShardLines timing(plan, shards);
  CLEW_RETURN_IF_ERROR(timing.open(kTimingFile, 0));
  auto merged_timing = NewFile::open(file_in(directory, kTimingFile));
  if (!merged_timing.ok()) return merged_timing.error();
  CLEW_RETURN_IF_ERROR(timing.copy_timing(*merged_timing));
  // The results come last: they say that all is there.
  CLEW_RETURN_IF_ERROR(merged_timing->finish());
  return merged->finish();
}

Result<BenchEnd> merge_shards(const BenchPlan& plan, const BenchOrder& order,
                              const std::vector<ShardDirectory>& shards,
                              const runtime::ConfigPath& configs,
                              const std::vector<runtime::StageInfo>& stages,
                              const BenchOptions& options) {
  const std::string differs = difference(shards.front().header.configuration, plan.configuration);
  if (!differs.empty()) {
    return Error{differs + "; merge with what it was made with", shards.front().path};
  }
  for (const ShardDirectory& shard : shards) {
    std::error_code none;
    if (std::filesystem::equivalent(shard.path, options.directory, none)) {
      return Error{"is a shard itself; choose another --out", options.directory};
    }
  }
  const ResultsHeader header{order, plan.configuration};
  CLEW_RETURN_IF_ERROR(files::make_directory(options.directory));
  CLEW_RETURN_IF_ERROR(expand_results(options.directory, options.restart));
  const auto held =
      ResultsFile::open(file_in(options.directory, kResultsFile), header, options.restart,
                        [](const auto&, int) { return Result<void>(); });
  if (!held.ok()) return held.error();
  CLEW_RETURN_IF_ERROR(merge_lines(plan, header, shards, options.directory));
  return finish_bench(plan, configs, stages, options);
}

}  // namespace clew::bench
