// SPDX-License-Identifier: Apache-2.0
#include "bench/results_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "files/whole_file.hpp"

namespace clew::bench {
namespace {

using core::Error;
using core::Result;
using Configuration = std::map<std::string, std::string>;

constexpr char kResultsFormat[] = "clew-bench/1";

std::string header_text(const Configuration& configuration) {
  nlohmann::ordered_json header;
  header["format"] = kResultsFormat;
  header["configuration"] = configuration;
  return header.dump();
}

/// What one configuration has and the other has not, in words; empty if they are the same.
std::string difference(const Configuration& made_with, const Configuration& now) {
  for (const auto& [key, value] : made_with) {
    const auto other = now.find(key);
    if (other == now.end()) return "it has '" + key + "', which is not asked for now";
    if (other->second != value) {
      return "it was made with '" + key + "' " + value + ", now it is " + other->second;
    }
  }
  for (const auto& [key, value] : now) {
    if (made_with.count(key) == 0) return "'" + key + "' is new";
  }
  return "";
}

Result<Configuration> read_header(const std::string& line, const std::string& path) {
  const auto header = nlohmann::json::parse(line, nullptr, false);
  if (!header.is_object() || header.value("format", "") != kResultsFormat ||
      !header.contains("configuration") || !header["configuration"].is_object()) {
    return Error{std::string("is no file of results; expected format ") + kResultsFormat, path, 1,
                 0};
  }
  Configuration configuration;
  for (const auto& [key, value] : header["configuration"].items()) {
    configuration[key] = value.is_string() ? value.get<std::string>() : value.dump();
  }
  return configuration;
}

std::string read_all(int file) {
  std::string text;
  char buffer[65536];
  for (ssize_t got;
       (got = ::pread(file, buffer, sizeof buffer, static_cast<off_t>(text.size()))) > 0;) {
    text.append(buffer, static_cast<std::size_t>(got));
  }
  return text;
}

}  // namespace

Result<ResultsFile> ResultsFile::open(const std::string& path, const Configuration& configuration,
                                      bool restart) {
  const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    return Error{std::string("cannot be written: ") + std::strerror(errno), path, 0, 0};
  }
  ResultsFile file(path, descriptor);
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    return Error{"is being written by another bench", path, 0, 0};
  }
  if (restart && ::ftruncate(descriptor, 0) != 0) return file.failed("cannot be emptied");
  std::string text = read_all(descriptor);
  // What does not end in a newline was torn off by the end of its process.
  const std::size_t whole = text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1;
  if (whole != text.size()) {
    text.resize(whole);
    if (::ftruncate(descriptor, static_cast<off_t>(whole)) != 0) {
      return file.failed("cannot be cut");
    }
  }
  if (text.empty()) {
    CLEW_RETURN_IF_ERROR(file.write_line(header_text(configuration)));
  } else {
    CLEW_RETURN_IF_ERROR(file.take_in(text, configuration));
  }
  return file;
}

ResultsFile::ResultsFile(ResultsFile&& other) noexcept
    : path_(std::move(other.path_)),
      file_(std::exchange(other.file_, -1)),
      lines_(std::move(other.lines_)) {}

ResultsFile::~ResultsFile() {
  if (file_ >= 0) ::close(file_);
}

Result<void> ResultsFile::take_in(const std::string& text, const Configuration& configuration) {
  std::istringstream stream(text);
  std::string line;
  std::getline(stream, line);
  const auto made_with = read_header(line, path_);
  if (!made_with.ok()) return made_with.error();
  const std::string other = difference(*made_with, configuration);
  if (!other.empty()) {
    return Error{other +
                     "; go on with what it was made with, choose another --out, or begin again "
                     "with --force",
                 path_, 0, 0};
  }
  for (int number = 2; std::getline(stream, line); ++number) {
    if (!nlohmann::json::accept(line)) return Error{"is no line of JSON", path_, number, 0};
    lines_.push_back(line);
  }
  return {};
}

Result<void> ResultsFile::append(const std::string& line) {
  CLEW_RETURN_IF_ERROR(write_line(line));
  lines_.push_back(line);
  return {};
}

Result<void> ResultsFile::write_line(const std::string& line) {
  if (files::write_all(file_, line + '\n')) return {};
  return failed("cannot be written");
}

Error ResultsFile::failed(const std::string& what) const {
  return {what + ": " + std::strerror(errno), path_, 0, 0};
}

}  // namespace clew::bench
