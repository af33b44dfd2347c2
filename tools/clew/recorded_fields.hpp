// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "recording/run_recording.hpp"
#include "wire/codec.hpp"
#include "wire/field_list.hpp"

namespace clew::tools {

/// Takes samples of a recording apart into their fields.
class FieldReader {
 public:
  /// Refused: bytes that are no message of the topic.
  core::Result<std::vector<bridge::Field>> fields_of(const bridge::SampleView& sample);

 private:
  domain::Messages messages_;
};

/// Drops fields that the recording's own type of the topic does not have: those of today's that
/// came since it was made.
void keep_recorded(const bridge::RunRecording& recording, domain::Topic topic,
                   std::vector<bridge::Field>& fields);

/// Whether a field is the length of a list.
bool is_length(const std::string& path);

/// Whether a field is `wanted`, or lies in it: `ranges_m[3]` in `ranges_m`, `stamp.tick` in
/// `stamp`.
bool lies_in(const std::string& path, const std::string& wanted);

/// Fields as an object: structs as objects, lists as arrays. A number that JSON does not have is
/// null.
nlohmann::ordered_json fields_json(const std::vector<bridge::Field>& fields);

/// What lies in `wanted` of the fields, as fields_json has it: a value, an object or an array; null
/// if nothing does.
nlohmann::ordered_json field_json(const std::vector<bridge::Field>& fields,
                                  const std::string& wanted);

/// The columns of a table of samples whose lists may have different lengths: each field's path, in
/// the order of idl/.
class FieldColumns {
 public:
  /// Adds the fields of a sample that are new. Lengths of lists have no column.
  void add(const std::vector<bridge::Field>& fields);
  const std::vector<std::string>& paths() const { return paths_; }
  /// A sample's values in the columns, as cells of CSV; empty where it has none.
  std::string row(const std::vector<bridge::Field>& fields) const;

 private:
  std::vector<std::string> paths_;
};

}  // namespace clew::tools
