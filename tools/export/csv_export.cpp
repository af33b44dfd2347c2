// SPDX-License-Identifier: Apache-2.0
#include "export/csv_export.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "clew/recorded_fields.hpp"
#include "recording/output_file.hpp"

namespace clew::exports {
namespace {

namespace fs = std::filesystem;
using core::Error;
using core::Result;

/// Calls visit(sample, fields) for each sample of the topic.
template <typename Visit>
Result<void> for_each_sample(const bridge::RunRecording& recording, domain::Topic topic,
                             const Visit& visit) {
  auto samples = recording.samples({{topic}});
  tools::FieldReader reader;
  while (true) {
    const auto sample = samples.next();
    if (!sample.ok()) return sample.error();
    if (!*sample) return {};
    auto fields = reader.fields_of(**sample);
    if (!fields.ok()) return Error{fields.error().message, recording.path()};
    tools::keep_recorded(recording, topic, *fields);
    const Result<void> visited = visit(**sample, *fields);
    if (!visited.ok()) return visited;
  }
}

Result<void> export_topic(const bridge::RunRecording& recording, domain::Topic topic,
                          const std::string& path, bool force) {
  tools::FieldColumns columns;
  CLEW_RETURN_IF_ERROR(for_each_sample(recording, topic, [&](const auto&, const auto& fields) {
    columns.add(fields);
    return Result<void>();
  }));
  auto file = bridge::mcap::OutputFile::create(path, force);
  if (!file.ok()) return file.error();
  std::string line = "tick,sequence";
  for (const std::string& column : columns.paths()) line += ',' + column;
  CLEW_RETURN_IF_ERROR(file->append(line + '\n'));
  CLEW_RETURN_IF_ERROR(
      for_each_sample(recording, topic, [&](const auto& sample, const auto& fields) {
        return file->append(
            fmt::format("{},{},{}\n", sample.tick, sample.sequence, columns.row(fields)));
      }));
  return file->publish();
}

}  // namespace

core::Result<void> export_csv(const bridge::RunRecording& recording, const std::string& directory,
                              bool force) {
  std::error_code error;
  if (fs::exists(directory, error) && !force) {
    return Error{"exists; --force replaces the tables in it", directory};
  }
  fs::create_directories(directory, error);
  if (error) return Error{error.message(), directory};
  for (const auto& [topic, schema] : recording.description().schemas) {
    const std::string name = std::string(domain::topic_name(topic)) + ".csv";
    CLEW_RETURN_IF_ERROR(
        export_topic(recording, topic, (fs::path(directory) / name).string(), force));
  }
  return {};
}

}  // namespace clew::exports
