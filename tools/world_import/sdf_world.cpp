// SPDX-License-Identifier: Apache-2.0
#include "world_import/sdf_world.hpp"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <array>
#include <cmath>
#include <limits>
#include <sstream>

#include "core/angle.hpp"
#include "core/math.hpp"
#include "world_import/picture_file.hpp"

namespace clew::world_import {
namespace {

using core::Error;
using core::Result;
using tinyxml2::XMLElement;

constexpr double kMostTilt_rad = 1e-3;

/// `inner`, given in the frame of `outer`.
Pose2 composed(const Pose2& outer, const Pose2& inner) {
  const double c = core::cos(outer.heading_rad);
  const double s = core::sin(outer.heading_rad);
  return {outer.x_m + c * inner.x_m - s * inner.y_m, outer.y_m + s * inner.x_m + c * inner.y_m,
          core::wrap_angle_rad(outer.heading_rad + inner.heading_rad)};
}

class SdfReader {
 public:
  explicit SdfReader(const std::string& path) : path_(path) {}

  Result<WorldDraft> read(const std::string& text) {
    tinyxml2::XMLDocument document;
    if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
      return Error{document.ErrorStr(), path_, document.ErrorLineNum(), 0};
    }
    const XMLElement* sdf = document.FirstChildElement("sdf");
    const XMLElement* world = sdf == nullptr ? nullptr : sdf->FirstChildElement("world");
    if (world == nullptr) return Error{"is no SDF world: no <world> in <sdf>", path_, 1, 0};
    for (const XMLElement* model = world->FirstChildElement("model"); model != nullptr;
         model = model->NextSiblingElement("model")) {
      CLEW_RETURN_IF_ERROR(read_model(*model));
    }
    if (draft_.circles.empty() && draft_.polygons.empty()) {
      return Error{"has no obstacle", path_, world->GetLineNum(), 0};
    }
    return draft_;
  }

 private:
  Error refuse(const XMLElement& at, const std::string& why) const {
    return {fmt::format("model {}: {}", model_, why), path_, at.GetLineNum(), 0};
  }

  /// The numbers in an element's text; `count` of them.
  Result<std::vector<double>> numbers(const XMLElement& element, std::size_t count) const {
    std::istringstream words(element.GetText() == nullptr ? "" : element.GetText());
    std::vector<double> values;
    for (double value = 0.0; words >> value;) values.push_back(value);
    bool finite = values.size() == count && words.eof();
    for (const double value : values) finite = finite && std::isfinite(value);
    if (finite) return values;
    return refuse(element,
                  fmt::format("<{}> is '{}'; expected {} numbers", element.Name(),
                              element.GetText() == nullptr ? "" : element.GetText(), count));
  }

  /// The pose that an element has of its own: x, y and yaw.
  Result<Pose2> pose_of(const XMLElement& element) const {
    const XMLElement* pose = element.FirstChildElement("pose");
    if (pose == nullptr) return Pose2{};
    const auto values = numbers(*pose, 6);
    if (!values.ok()) return values.error();
    if (std::fabs((*values)[3]) > kMostTilt_rad || std::fabs((*values)[4]) > kMostTilt_rad) {
      return refuse(*pose, "is tilted; allowed are bodies that stand upright");
    }
    return Pose2{(*values)[0], (*values)[1], core::wrap_angle_rad((*values)[5])};
  }

  Result<void> read_model(const XMLElement& model) {
    model_ = model.Attribute("name") == nullptr ? "without a name" : model.Attribute("name");
    const auto of_model = pose_of(model);
    if (!of_model.ok()) return of_model.error();
    for (const XMLElement* link = model.FirstChildElement("link"); link != nullptr;
         link = link->NextSiblingElement("link")) {
      const auto of_link = pose_of(*link);
      if (!of_link.ok()) return of_link.error();
      for (const XMLElement* body = link->FirstChildElement("collision"); body != nullptr;
           body = body->NextSiblingElement("collision")) {
        const auto of_body = pose_of(*body);
        if (!of_body.ok()) return of_body.error();
        CLEW_RETURN_IF_ERROR(read_body(*body, composed(composed(*of_model, *of_link), *of_body)));
      }
    }
    return {};
  }

  Result<void> read_body(const XMLElement& body, const Pose2& pose) {
    const XMLElement* geometry = body.FirstChildElement("geometry");
    const XMLElement* shape = geometry == nullptr ? nullptr : geometry->FirstChildElement();
    if (shape == nullptr) return refuse(body, "a collision without geometry");
    const std::string kind = shape->Name();
    if (kind == "plane" || kind == "empty") return {};
    if (kind == "cylinder" || kind == "sphere") return read_round(*shape, pose);
    if (kind == "box") return read_box(*shape, pose);
    return refuse(*shape, "<" + kind + ">; allowed: cylinder, sphere, box, plane");
  }

  Result<void> read_round(const XMLElement& shape, const Pose2& pose) {
    const XMLElement* radius = shape.FirstChildElement("radius");
    if (radius == nullptr) return refuse(shape, "no <radius>");
    const auto values = numbers(*radius, 1);
    if (!values.ok()) return values.error();
    if ((*values)[0] <= 0.0) return refuse(*radius, "a radius that is not positive");
    draft_.circles.push_back({{pose.x_m, pose.y_m}, (*values)[0]});
    return {};
  }

  Result<void> read_box(const XMLElement& shape, const Pose2& pose) {
    const XMLElement* size = shape.FirstChildElement("size");
    if (size == nullptr) return refuse(shape, "no <size>");
    const auto values = numbers(*size, 3);
    if (!values.ok()) return values.error();
    const double x = (*values)[0] / 2.0;
    const double y = (*values)[1] / 2.0;
    if (x <= 0.0 || y <= 0.0) return refuse(*size, "a side that is not positive");
    std::vector<Vec2> corners;
    for (const auto& [dx, dy] : {std::pair{-x, -y}, {x, -y}, {x, y}, {-x, y}}) {
      const Pose2 corner = composed(pose, {dx, dy, 0.0});
      corners.emplace_back(corner.x_m, corner.y_m);
    }
    draft_.polygons.push_back(std::move(corners));
    return {};
  }

  const std::string& path_;
  std::string model_;
  WorldDraft draft_;
};

void fit_bounds(WorldDraft& draft) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  draft.bounds_min = Vec2(kInfinite, kInfinite);
  draft.bounds_max = -draft.bounds_min;
  const auto include = [&](const Vec2& least, const Vec2& most) {
    draft.bounds_min = draft.bounds_min.cwiseMin(least);
    draft.bounds_max = draft.bounds_max.cwiseMax(most);
  };
  for (const WorldDraft::Circle& circle : draft.circles) {
    const Vec2 reach(circle.radius_m, circle.radius_m);
    include(circle.centre - reach, circle.centre + reach);
  }
  for (const std::vector<Vec2>& polygon : draft.polygons) {
    for (const Vec2& corner : polygon) include(corner, corner);
  }
}

}  // namespace

Result<WorldDraft> read_sdf_world(const std::string& path) {
  const auto text = read_file(path);
  if (!text.ok()) return text.error();
  auto draft = SdfReader(path).read(*text);
  if (draft.ok()) fit_bounds(*draft);
  return draft;
}

// Start, goal and its radius are those of the benchmark's run.py; beyond the goal there is room to
// turn.
void add_barn_mission(WorldDraft& draft) {
  constexpr double kBehindGoal_m = 1.5;
  draft.start = Pose2{-2.25, 3.0, 1.57};
  draft.target = Vec2(-2.25, 13.0);
  draft.target_radius_m = 1.0;
  draft.bounds_max.y() = std::max(draft.bounds_max.y(), draft.target->y() + kBehindGoal_m);
}

}  // namespace clew::world_import
