// SPDX-License-Identifier: Apache-2.0
#include "bench/results_file.hpp"

#include <nlohmann/json.hpp>
#include <utility>

namespace clew::bench {

using core::Error;
using core::Result;

namespace {

constexpr char kResultsFormat[] = "clew-bench/2";

/// The lists of an order, by their names in the file.
template <typename Order, typename Visit>
void for_each_list(Order& order, const Visit& visit) {
  visit("graphs", order.graphs);
  visit("with", order.with);
  visit("set", order.set);
  visit("vary", order.vary);
  visit("plugins", order.plugins);
}

nlohmann::ordered_json to_json(const BenchOrder& order) {
  nlohmann::ordered_json json;
  json["suite"] = order.suite;
  json["coverage"] = order.coverage;
  for_each_list(order, [&](const char* name, const auto& list) { json[name] = list; });
  if (!order.data.empty()) json["data"] = order.data;
  return json;
}

BenchOrder read_order(const nlohmann::json& json) {
  BenchOrder order;
  json.at("suite").get_to(order.suite);
  order.coverage = json.value("coverage", false);
  for_each_list(order, [&](const char* name, auto& list) { json.at(name).get_to(list); });
  if (json.contains("data")) json.at("data").get_to(order.data);
  return order;
}

}  // namespace

std::string ResultsHeader::text() const {
  nlohmann::ordered_json header;
  header["format"] = kResultsFormat;
  header["configuration"] = configuration;
  header["order"] = to_json(order);
  return header.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

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

Result<ResultsHeader> read_header(const std::string& line, const std::string& path) {
  const auto json = nlohmann::json::parse(line, nullptr, false);
  const auto format = json.is_object() ? json.find("format") : json.end();
  if (!json.is_object() || format == json.end() || *format != kResultsFormat) {
    std::string found = "is no file of results";
    if (json.is_object() && format != json.end() && format->is_string()) {
      found = "has the format " + format->get<std::string>();
    }
    return Error{found + "; expected format " + kResultsFormat, path, 1, 0};
  }
  try {
    return ResultsHeader{read_order(json.at("order")),
                         json.at("configuration").get<Configuration>()};
  } catch (const nlohmann::json::exception& error) {
    return Error{std::string("is no header of results: ") + error.what(), path, 1, 0};
  }
}

Result<ResultsFile> ResultsFile::open(const std::string& path, const ResultsHeader& header,
                                      bool restart, const Take& take, double patience_s) {
  auto lines = LineFile::open(path, patience_s);
  if (!lines.ok()) return lines.error();
  ResultsFile file(std::move(lines).value());
  if (restart) CLEW_RETURN_IF_ERROR(file.file_.clear());
  CLEW_RETURN_IF_ERROR(file.take_in(header, take));
  return file;
}

Result<void> ResultsFile::take_in(const ResultsHeader& header, const Take& take) {
  auto reader = LineReader::open(file_.path());
  if (!reader.ok()) return reader.error();
  const std::string* first = reader->next();
  if (first == nullptr) return append(header.text());
  const auto made_with = read_header(*first, file_.path());
  if (!made_with.ok()) return made_with.error();
  const std::string other = difference(made_with->configuration, header.configuration);
  if (!other.empty()) {
    return Error{other +
                     "; go on with what it was made with, choose another --out, or begin again "
                     "with --force",
                 file_.path()};
  }
  while (const std::string* line = reader->next()) {
    CLEW_RETURN_IF_ERROR(take(*line, reader->number()));
  }
  return reader->is_whole();
}

}  // namespace clew::bench
