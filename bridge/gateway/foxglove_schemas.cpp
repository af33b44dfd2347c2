// SPDX-License-Identifier: Apache-2.0
#include "gateway/foxglove_schemas.hpp"

#include <nlohmann/json.hpp>

namespace clew::bridge {
namespace {

using nlohmann::ordered_json;

ordered_json type(const char* name) { return {{"type", name}}; }
ordered_json list(const ordered_json& items) { return {{"type", "array"}, {"items", items}}; }

/// All of its members are required.
ordered_json object(const std::string& title, const ordered_json& members) {
  ordered_json required = ordered_json::array();
  for (const auto& [name, member] : members.items()) required.push_back(name);
  return {{"title", title}, {"type", "object"}, {"properties", members}, {"required", required}};
}

ordered_json number_members(std::initializer_list<const char*> names) {
  ordered_json members = ordered_json::object();
  for (const char* name : names) members[name] = type("number");
  return members;
}

/// Viewers know a time by this title.
ordered_json time(const char* title = "time") {
  return object(title, {{"sec", type("integer")}, {"nsec", type("integer")}});
}
ordered_json vector3(const char* title = "foxglove.Vector3") {
  return object(title, number_members({"x", "y", "z"}));
}
ordered_json quaternion() {
  return object("foxglove.Quaternion", number_members({"x", "y", "z", "w"}));
}
ordered_json colour() { return object("foxglove.Color", number_members({"r", "g", "b", "a"})); }
ordered_json pose() {
  return object("foxglove.Pose", {{"position", vector3()}, {"orientation", quaternion()}});
}

ordered_json line() {
  return object("foxglove.LinePrimitive", {{"type", type("integer")},
                                           {"pose", pose()},
                                           {"thickness", type("number")},
                                           {"scale_invariant", type("boolean")},
                                           {"points", list(vector3("foxglove.Point3"))},
                                           {"color", colour()},
                                           {"colors", list(colour())},
                                           {"indices", list(type("integer"))}});
}

ordered_json cylinder() {
  return object("foxglove.CylinderPrimitive", {{"pose", pose()},
                                               {"size", vector3()},
                                               {"bottom_scale", type("number")},
                                               {"top_scale", type("number")},
                                               {"color", colour()}});
}

ordered_json entity() {
  const ordered_json pair =
      object("foxglove.KeyValuePair", {{"key", type("string")}, {"value", type("string")}});
  // Kinds that are never used are lists of anything.
  return object("foxglove.SceneEntity", {{"timestamp", time()},
                                         {"frame_id", type("string")},
                                         {"id", type("string")},
                                         {"lifetime", time("duration")},
                                         {"frame_locked", type("boolean")},
                                         {"metadata", list(pair)},
                                         {"arrows", list(type("object"))},
                                         {"cubes", list(type("object"))},
                                         {"spheres", list(type("object"))},
                                         {"cylinders", list(cylinder())},
                                         {"lines", list(line())},
                                         {"triangles", list(type("object"))},
                                         {"texts", list(type("object"))},
                                         {"models", list(type("object"))}});
}

ordered_json grid_members() {
  const ordered_json field =
      object("foxglove.PackedElementField",
             {{"name", type("string")}, {"offset", type("integer")}, {"type", type("integer")}});
  return {{"timestamp", time()},
          {"frame_id", type("string")},
          {"pose", pose()},
          {"column_count", type("integer")},
          {"cell_size", object("foxglove.Vector2", number_members({"x", "y"}))},
          {"row_stride", type("integer")},
          {"cell_stride", type("integer")},
          {"fields", list(field)},
          {"data", {{"type", "string"}, {"contentEncoding", "base64"}}}};
}

FoxgloveChannel channel(const char* topic, const std::string& name, const ordered_json& members) {
  return {topic, name, object(name, members).dump()};
}

std::vector<FoxgloveChannel> make_channels() {
  const ordered_json deletion =
      object("foxglove.SceneEntityDeletion",
             {{"timestamp", time()}, {"type", type("integer")}, {"id", type("string")}});
  const ordered_json transform =
      object("foxglove.FrameTransform", {{"timestamp", time()},
                                         {"parent_frame_id", type("string")},
                                         {"child_frame_id", type("string")},
                                         {"translation", vector3()},
                                         {"rotation", quaternion()}});
  return {channel("/foxglove/scene", "foxglove.SceneUpdate",
                  {{"deletions", list(deletion)}, {"entities", list(entity())}}),
          channel("/foxglove/scan", "foxglove.LaserScan",
                  {{"timestamp", time()},
                   {"frame_id", type("string")},
                   {"pose", pose()},
                   {"start_angle", type("number")},
                   {"end_angle", type("number")},
                   {"ranges", list(type("number"))},
                   {"intensities", list(type("number"))}}),
          channel("/foxglove/transforms", "foxglove.FrameTransforms",
                  {{"transforms", list(transform)}}),
          channel("/foxglove/path", "foxglove.PosesInFrame",
                  {{"timestamp", time()}, {"frame_id", type("string")}, {"poses", list(pose())}}),
          channel("/foxglove/log", "foxglove.Log",
                  {{"timestamp", time()},
                   {"level", type("integer")},
                   {"message", type("string")},
                   {"name", type("string")},
                   {"file", type("string")},
                   {"line", type("integer")}}),
          channel("/foxglove/seen", "foxglove.Grid", grid_members())};
}

}  // namespace

const std::vector<FoxgloveChannel>& foxglove_channels() {
  static const std::vector<FoxgloveChannel> channels = make_channels();
  return channels;
}

}  // namespace clew::bridge
