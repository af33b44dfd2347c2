// SPDX-License-Identifier: Apache-2.0
#include "clew/field_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "clew/recorded_fields.hpp"
#include "core/nearest_name.hpp"
#include "plot/line_chart.hpp"
#include "plot/plot.hpp"
#include "replay/live_checks.hpp"

namespace clew::tools {
namespace {

using bridge::Field;
using core::Error;
using core::Result;

/// A truth value is 0 or 1; none: no number, or none that can be drawn.
std::optional<double> number_of(const bridge::FieldValue& value) {
  if (const auto* truth = std::get_if<bool>(&value)) return *truth ? 1.0 : 0.0;
  if (const auto* whole = std::get_if<std::uint64_t>(&value)) return static_cast<double>(*whole);
  if (const auto* number = std::get_if<double>(&value);
      number != nullptr && std::isfinite(*number)) {
    return *number;
  }
  return std::nullopt;
}

Error no_such_field(const std::string& topic, const std::string& field,
                    const std::vector<Field>& known) {
  std::vector<std::string> names;
  for (const Field& each : known) {
    if (number_of(each.value)) names.push_back(each.path);
  }
  return Error{core::unknown_name("number of " + topic, field, names), "--field"};
}

/// The values of one field over the run's seconds.
Result<std::vector<plot::Point>> read_values(const bridge::RunRecording& recording,
                                             const std::string& topic, const std::string& path) {
  const auto known = bridge::recorded_topic(recording, topic);
  if (!known.ok()) return known.error();
  auto samples = recording.samples({{*known}});
  FieldReader reader;
  std::vector<plot::Point> points;
  std::vector<Field> last;
  while (true) {
    const auto sample = samples.next();
    if (!sample.ok()) return sample.error();
    if (!*sample) break;
    auto fields = reader.fields_of(**sample);
    if (!fields.ok()) return Error{fields.error().message, recording.path()};
    keep_recorded(recording, (*sample)->topic, *fields);
    const auto found = std::find_if(fields->begin(), fields->end(),
                                    [&](const Field& field) { return field.path == path; });
    const auto value = found == fields->end() ? std::nullopt : number_of(found->value);
    const double time_s = static_cast<double>((*sample)->tick) * recording.description().tick_s;
    if (value) points.push_back({time_s, *value});
    last = std::move(fields).value();
  }
  if (points.empty()) return no_such_field(topic, path, last);
  return points;
}

/// What stands after the last underscore of a name, if it is a unit.
std::string unit_of(const std::string& field) {
  const std::pair<const char*, const char*> units[] = {
      {"_m", "m"}, {"_s", "s"}, {"_rad", "rad"}, {"_mps", "m/s"}, {"_radps", "rad/s"}};
  const std::string name = field.substr(0, field.find('['));
  for (const auto& [ending, unit] : units) {
    const std::string end = ending;
    if (name.size() > end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0) {
      return unit;
    }
  }
  return {};
}

}  // namespace

Result<void> plot_fields(const std::vector<std::string>& recordings,
                         const std::vector<std::string>& fields, const std::string& output) {
  plot::LineChart chart;
  chart.title = fields.size() == 1 ? fields.front() : "Fields over time";
  chart.x_label = "time, s";
  chart.y_label = unit_of(fields.front());
  for (const std::string& path : recordings) {
    const auto recording = bridge::RunRecording::open(path);
    if (!recording.ok()) return recording.error();
    for (const std::string& field : fields) {
      const std::size_t dot = field.find('.');
      if (dot == std::string::npos) {
        return Error{fmt::format("found '{}', expected TOPIC.FIELD, as state.speed_mps", field),
                     "--field"};
      }
      auto points = read_values(*recording, field.substr(0, dot), field.substr(dot + 1));
      if (!points.ok()) return points.error();
      if (unit_of(field) != chart.y_label) chart.y_label.clear();
      const std::string name = std::filesystem::path(path).stem().string();
      chart.lines.push_back({recordings.size() == 1 ? field
                             : fields.size() == 1   ? name
                                                    : name + ' ' + field,
                             std::move(points).value()});
    }
  }
  return plot::write_picture(plot::draw(chart), output);
}

}  // namespace clew::tools
