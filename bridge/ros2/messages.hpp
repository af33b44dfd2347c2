// SPDX-License-Identifier: Apache-2.0
/// The messages of ROS 2 that Clew writes and reads, as plain structs; message_fields.hpp lists
/// their fields. Units and signs are those of REP 103, frames those of REP 105.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace clew::ros2 {

struct Time {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
};
struct Duration {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
};

struct Header {
  Time stamp;
  std::string frame_id;
};
struct ColorRGBA {
  float r = 0.0F;
  float g = 0.0F;
  float b = 0.0F;
  float a = 0.0F;
};

struct Clock {
  Time clock;
};

struct Vector3 {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
};
struct Point {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
};
struct Quaternion {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  double w = 1.0;
};
struct Pose {
  Point position;
  Quaternion orientation;
};
struct PoseStamped {
  Header header;
  Pose pose;
};
struct PoseWithCovariance {
  Pose pose;
  std::array<double, 36> covariance{};
};
struct Twist {
  Vector3 linear;
  Vector3 angular;
};
struct TwistStamped {
  Header header;
  Twist twist;
};
struct TwistWithCovariance {
  Twist twist;
  std::array<double, 36> covariance{};
};
struct Transform {
  Vector3 translation;
  Quaternion rotation;
};
struct TransformStamped {
  Header header;
  std::string child_frame_id;
  Transform transform;
};
struct TFMessage {
  std::vector<TransformStamped> transforms;
};

struct Odometry {
  Header header;
  std::string child_frame_id;
  PoseWithCovariance pose;
  TwistWithCovariance twist;
};
struct MapMetaData {
  Time map_load_time;
  float resolution = 0.0F;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  Pose origin;
};
struct OccupancyGrid {
  Header header;
  MapMetaData info;
  std::vector<std::int8_t> data;
};
struct Path {
  Header header;
  std::vector<PoseStamped> poses;
};

struct LaserScan {
  Header header;
  float angle_min = 0.0F;
  float angle_max = 0.0F;
  float angle_increment = 0.0F;
  float time_increment = 0.0F;
  float scan_time = 0.0F;
  float range_min = 0.0F;
  float range_max = 0.0F;
  std::vector<float> ranges;
  std::vector<float> intensities;
};
struct CompressedImage {
  Header header;
  std::string format;
  std::vector<std::uint8_t> data;
};

struct KeyValue {
  std::string key;
  std::string value;
};
struct DiagnosticStatus {
  static constexpr std::uint8_t kOk = 0;
  static constexpr std::uint8_t kWarn = 1;
  static constexpr std::uint8_t kError = 2;
  static constexpr std::uint8_t kStale = 3;

  std::uint8_t level = kOk;
  std::string name;
  std::string message;
  std::string hardware_id;
  std::vector<KeyValue> values;
};
struct DiagnosticArray {
  Header header;
  std::vector<DiagnosticStatus> status;
};

struct Log {
  static constexpr std::uint8_t kInfo = 20;
  static constexpr std::uint8_t kWarn = 30;
  static constexpr std::uint8_t kError = 40;

  Time stamp;
  std::uint8_t level = kInfo;
  std::string name;
  std::string msg;
  std::string file;
  std::string function;
  std::uint32_t line = 0;
};

struct UVCoordinate {
  float u = 0.0F;
  float v = 0.0F;
};
struct MeshFile {
  std::string filename;
  std::vector<std::uint8_t> data;
};
struct Marker {
  static constexpr std::int32_t kCube = 1;
  static constexpr std::int32_t kSphere = 2;
  static constexpr std::int32_t kCylinder = 3;
  static constexpr std::int32_t kText = 9;
  static constexpr std::int32_t kAdd = 0;
  static constexpr std::int32_t kDeleteAll = 3;

  Header header;
  std::string ns;
  std::int32_t id = 0;
  std::int32_t type = 0;
  std::int32_t action = 0;
  Pose pose;
  Vector3 scale;
  ColorRGBA color;
  Duration lifetime;
  bool frame_locked = false;
  std::vector<Point> points;
  std::vector<ColorRGBA> colors;
  std::string texture_resource;
  CompressedImage texture;
  std::vector<UVCoordinate> uv_coordinates;
  std::string text;
  std::string mesh_resource;
  MeshFile mesh_file;
  bool mesh_use_embedded_materials = false;
};
struct MarkerArray {
  std::vector<Marker> markers;
};

/// What identifies a participant or an endpoint: its GUID, and zeros up to the size that a
/// distribution has (Jazzy 16 bytes, Humble 24).
template <std::size_t kBytes>
struct Gid {
  std::array<std::uint8_t, kBytes> data{};
};
template <std::size_t kBytes>
struct NodeEntitiesInfo {
  std::string node_namespace;
  std::string node_name;
  std::vector<Gid<kBytes>> reader_gid_seq;
  std::vector<Gid<kBytes>> writer_gid_seq;
};
template <std::size_t kBytes>
struct ParticipantEntitiesInfo {
  Gid<kBytes> gid;
  std::vector<NodeEntitiesInfo<kBytes>> node_entities_info_seq;
};

}  // namespace clew::ros2
