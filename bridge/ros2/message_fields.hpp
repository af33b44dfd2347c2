// SPDX-License-Identifier: Apache-2.0
/// The fields of every message of ROS 2 that Clew knows, in their order, and the messages' names.
/// CDR bytes, definitions and type hashes all follow from them; tests hold them to the definitions
/// that npm's @foxglove/rosmsg-msgs-common has.
#pragma once

#include <string_view>

#include "domain/field.hpp"
#include "ros2/messages.hpp"

namespace clew::ros2 {

/// Rules of values, besides those of domain/field.hpp. Texts and lists have no bound in ROS; those
/// here are how much is taken from a stranger.
struct UnboundedText {
  std::size_t bytes;
};
/// A `byte` of ROS, which has a type of its own in hashes.
struct Octet {};

inline constexpr UnboundedText kText{65536};
inline constexpr domain::ListUpTo<> kNumbers{std::size_t{1} << 26, {}};
inline constexpr domain::ListUpTo<> kItems{4096, {}};

/// `sensor_msgs/msg/LaserScan`.
template <typename Message>
inline constexpr std::string_view kTypeName{};

template <>
inline constexpr std::string_view kTypeName<Time> = "builtin_interfaces/msg/Time";
template <>
inline constexpr std::string_view kTypeName<Duration> = "builtin_interfaces/msg/Duration";
template <>
inline constexpr std::string_view kTypeName<Header> = "std_msgs/msg/Header";
template <>
inline constexpr std::string_view kTypeName<ColorRGBA> = "std_msgs/msg/ColorRGBA";
template <>
inline constexpr std::string_view kTypeName<Clock> = "rosgraph_msgs/msg/Clock";
template <>
inline constexpr std::string_view kTypeName<Vector3> = "geometry_msgs/msg/Vector3";
template <>
inline constexpr std::string_view kTypeName<Point> = "geometry_msgs/msg/Point";
template <>
inline constexpr std::string_view kTypeName<Quaternion> = "geometry_msgs/msg/Quaternion";
template <>
inline constexpr std::string_view kTypeName<Pose> = "geometry_msgs/msg/Pose";
template <>
inline constexpr std::string_view kTypeName<PoseStamped> = "geometry_msgs/msg/PoseStamped";
template <>
inline constexpr std::string_view kTypeName<PoseWithCovariance> =
    "geometry_msgs/msg/PoseWithCovariance";
template <>
inline constexpr std::string_view kTypeName<Twist> = "geometry_msgs/msg/Twist";
template <>
inline constexpr std::string_view kTypeName<TwistStamped> = "geometry_msgs/msg/TwistStamped";
template <>
inline constexpr std::string_view kTypeName<TwistWithCovariance> =
    "geometry_msgs/msg/TwistWithCovariance";
template <>
inline constexpr std::string_view kTypeName<Transform> = "geometry_msgs/msg/Transform";
template <>
inline constexpr std::string_view kTypeName<TransformStamped> =
    "geometry_msgs/msg/TransformStamped";
template <>
inline constexpr std::string_view kTypeName<TFMessage> = "tf2_msgs/msg/TFMessage";
template <>
inline constexpr std::string_view kTypeName<Odometry> = "nav_msgs/msg/Odometry";
template <>
inline constexpr std::string_view kTypeName<MapMetaData> = "nav_msgs/msg/MapMetaData";
template <>
inline constexpr std::string_view kTypeName<OccupancyGrid> = "nav_msgs/msg/OccupancyGrid";
template <>
inline constexpr std::string_view kTypeName<Path> = "nav_msgs/msg/Path";
template <>
inline constexpr std::string_view kTypeName<LaserScan> = "sensor_msgs/msg/LaserScan";
template <>
inline constexpr std::string_view kTypeName<CompressedImage> = "sensor_msgs/msg/CompressedImage";
template <>
inline constexpr std::string_view kTypeName<KeyValue> = "diagnostic_msgs/msg/KeyValue";
template <>
inline constexpr std::string_view kTypeName<DiagnosticStatus> =
    "diagnostic_msgs/msg/DiagnosticStatus";
template <>
inline constexpr std::string_view kTypeName<DiagnosticArray> =
    "diagnostic_msgs/msg/DiagnosticArray";
template <>
inline constexpr std::string_view kTypeName<Log> = "rcl_interfaces/msg/Log";
template <>
inline constexpr std::string_view kTypeName<UVCoordinate> = "visualization_msgs/msg/UVCoordinate";
template <>
inline constexpr std::string_view kTypeName<MeshFile> = "visualization_msgs/msg/MeshFile";
template <>
inline constexpr std::string_view kTypeName<Marker> = "visualization_msgs/msg/Marker";
template <>
inline constexpr std::string_view kTypeName<MarkerArray> = "visualization_msgs/msg/MarkerArray";
template <std::size_t kBytes>
inline constexpr std::string_view kTypeName<Gid<kBytes>> = "rmw_dds_common/msg/Gid";
template <std::size_t kBytes>
inline constexpr std::string_view kTypeName<NodeEntitiesInfo<kBytes>> =
    "rmw_dds_common/msg/NodeEntitiesInfo";
template <std::size_t kBytes>
inline constexpr std::string_view kTypeName<ParticipantEntitiesInfo<kBytes>> =
    "rmw_dds_common/msg/ParticipantEntitiesInfo";

}  // namespace clew::ros2

namespace clew::domain {

using ros2::kItems;
using ros2::kNumbers;
using ros2::kText;
using ros2::Octet;

template <>
inline constexpr auto kFields<ros2::Time> = std::make_tuple(field("sec", &ros2::Time::sec),
                                                            field("nanosec", &ros2::Time::nanosec));

template <>
inline constexpr auto kFields<ros2::Duration> =
    std::make_tuple(field("sec", &ros2::Duration::sec), field("nanosec", &ros2::Duration::nanosec));

template <>
inline constexpr auto kFields<ros2::Header> = std::make_tuple(
    field("stamp", &ros2::Header::stamp), field("frame_id", &ros2::Header::frame_id, kText));

template <>
inline constexpr auto kFields<ros2::ColorRGBA> = std::make_tuple(field("r", &ros2::ColorRGBA::r),
                                                                 field("g", &ros2::ColorRGBA::g),
                                                                 field("b", &ros2::ColorRGBA::b),
                                                                 field("a", &ros2::ColorRGBA::a));

template <>
inline constexpr auto kFields<ros2::Clock> = std::make_tuple(field("clock", &ros2::Clock::clock));

template <>
inline constexpr auto kFields<ros2::Vector3> = std::make_tuple(field("x", &ros2::Vector3::x),
                                                               field("y", &ros2::Vector3::y),
                                                               field("z", &ros2::Vector3::z));

template <>
inline constexpr auto kFields<ros2::Point> = std::make_tuple(field("x", &ros2::Point::x),
                                                             field("y", &ros2::Point::y),
                                                             field("z", &ros2::Point::z));

template <>
inline constexpr auto kFields<ros2::Quaternion> = std::make_tuple(field("x", &ros2::Quaternion::x),
                                                                  field("y", &ros2::Quaternion::y),
                                                                  field("z", &ros2::Quaternion::z),
                                                                  field("w", &ros2::Quaternion::w));

template <>
inline constexpr auto kFields<ros2::Pose> = std::make_tuple(
    field("position", &ros2::Pose::position), field("orientation", &ros2::Pose::orientation));

template <>
inline constexpr auto kFields<ros2::PoseStamped> = std::make_tuple(
    field("header", &ros2::PoseStamped::header), field("pose", &ros2::PoseStamped::pose));

template <>
inline constexpr auto kFields<ros2::PoseWithCovariance> =
    std::make_tuple(field("pose", &ros2::PoseWithCovariance::pose),
                    field("covariance", &ros2::PoseWithCovariance::covariance));

template <>
inline constexpr auto kFields<ros2::Twist> =
    std::make_tuple(field("linear", &ros2::Twist::linear), field("angular", &ros2::Twist::angular));

template <>
inline constexpr auto kFields<ros2::TwistStamped> = std::make_tuple(
    field("header", &ros2::TwistStamped::header), field("twist", &ros2::TwistStamped::twist));

template <>
inline constexpr auto kFields<ros2::TwistWithCovariance> =
    std::make_tuple(field("twist", &ros2::TwistWithCovariance::twist),
                    field("covariance", &ros2::TwistWithCovariance::covariance));

template <>
inline constexpr auto kFields<ros2::Transform> =
    std::make_tuple(field("translation", &ros2::Transform::translation),
                    field("rotation", &ros2::Transform::rotation));

template <>
inline constexpr auto kFields<ros2::TransformStamped> =
    std::make_tuple(field("header", &ros2::TransformStamped::header),
                    field("child_frame_id", &ros2::TransformStamped::child_frame_id, kText),
                    field("transform", &ros2::TransformStamped::transform));

template <>
inline constexpr auto kFields<ros2::TFMessage> =
    std::make_tuple(field("transforms", &ros2::TFMessage::transforms, kItems));

template <>
inline constexpr auto kFields<ros2::Odometry> =
    std::make_tuple(field("header", &ros2::Odometry::header),
                    field("child_frame_id", &ros2::Odometry::child_frame_id, kText),
                    field("pose", &ros2::Odometry::pose), field("twist", &ros2::Odometry::twist));

template <>
inline constexpr auto kFields<ros2::MapMetaData> = std::make_tuple(
    field("map_load_time", &ros2::MapMetaData::map_load_time),
    field("resolution", &ros2::MapMetaData::resolution), field("width", &ros2::MapMetaData::width),
    field("height", &ros2::MapMetaData::height), field("origin", &ros2::MapMetaData::origin));

template <>
inline constexpr auto kFields<ros2::OccupancyGrid> = std::make_tuple(
    field("header", &ros2::OccupancyGrid::header), field("info", &ros2::OccupancyGrid::info),
    field("data", &ros2::OccupancyGrid::data, kNumbers));

template <>
inline constexpr auto kFields<ros2::Path> = std::make_tuple(field("header", &ros2::Path::header),
                                                            field("poses", &ros2::Path::poses,
                                                                  kItems));

template <>
inline constexpr auto kFields<ros2::LaserScan> = std::make_tuple(
    field("header", &ros2::LaserScan::header), field("angle_min", &ros2::LaserScan::angle_min),
    field("angle_max", &ros2::LaserScan::angle_max),
    field("angle_increment", &ros2::LaserScan::angle_increment),
    field("time_increment", &ros2::LaserScan::time_increment),
    field("scan_time", &ros2::LaserScan::scan_time),
    field("range_min", &ros2::LaserScan::range_min),
    field("range_max", &ros2::LaserScan::range_max),
    field("ranges", &ros2::LaserScan::ranges, kNumbers),
    field("intensities", &ros2::LaserScan::intensities, kNumbers));

template <>
inline constexpr auto kFields<ros2::CompressedImage> =
    std::make_tuple(field("header", &ros2::CompressedImage::header),
                    field("format", &ros2::CompressedImage::format, kText),
                    field("data", &ros2::CompressedImage::data, kNumbers));

template <>
inline constexpr auto kFields<ros2::KeyValue> = std::make_tuple(
    field("key", &ros2::KeyValue::key, kText), field("value", &ros2::KeyValue::value, kText));

template <>
inline constexpr auto kFields<ros2::DiagnosticStatus> =
    std::make_tuple(field("level", &ros2::DiagnosticStatus::level, Octet{}),
                    field("name", &ros2::DiagnosticStatus::name, kText),
                    field("message", &ros2::DiagnosticStatus::message, kText),
                    field("hardware_id", &ros2::DiagnosticStatus::hardware_id, kText),
                    field("values", &ros2::DiagnosticStatus::values, kItems));

template <>
inline constexpr auto kFields<ros2::DiagnosticArray> =
    std::make_tuple(field("header", &ros2::DiagnosticArray::header),
                    field("status", &ros2::DiagnosticArray::status, kItems));

template <>
inline constexpr auto kFields<ros2::Log> = std::make_tuple(
    field("stamp", &ros2::Log::stamp), field("level", &ros2::Log::level),
    field("name", &ros2::Log::name, kText), field("msg", &ros2::Log::msg, kText),
    field("file", &ros2::Log::file, kText), field("function", &ros2::Log::function, kText),
    field("line", &ros2::Log::line));

template <>
inline constexpr auto kFields<ros2::UVCoordinate> =
    std::make_tuple(field("u", &ros2::UVCoordinate::u), field("v", &ros2::UVCoordinate::v));

template <>
inline constexpr auto kFields<ros2::MeshFile> =
    std::make_tuple(field("filename", &ros2::MeshFile::filename, kText),
                    field("data", &ros2::MeshFile::data, kNumbers));

template <>
inline constexpr auto kFields<ros2::Marker> = std::make_tuple(
    field("header", &ros2::Marker::header), field("ns", &ros2::Marker::ns, kText),
    field("id", &ros2::Marker::id), field("type", &ros2::Marker::type),
    field("action", &ros2::Marker::action), field("pose", &ros2::Marker::pose),
    field("scale", &ros2::Marker::scale), field("color", &ros2::Marker::color),
    field("lifetime", &ros2::Marker::lifetime), field("frame_locked", &ros2::Marker::frame_locked),
    field("points", &ros2::Marker::points, kItems), field("colors", &ros2::Marker::colors, kItems),
    field("texture_resource", &ros2::Marker::texture_resource, kText),
    field("texture", &ros2::Marker::texture),
    field("uv_coordinates", &ros2::Marker::uv_coordinates, kItems),
    field("text", &ros2::Marker::text, kText),
    field("mesh_resource", &ros2::Marker::mesh_resource, kText),
    field("mesh_file", &ros2::Marker::mesh_file),
    field("mesh_use_embedded_materials", &ros2::Marker::mesh_use_embedded_materials));

template <>
inline constexpr auto kFields<ros2::MarkerArray> =
    std::make_tuple(field("markers", &ros2::MarkerArray::markers, kItems));

template <std::size_t kBytes>
inline constexpr auto kFields<ros2::Gid<kBytes>> = std::make_tuple(field("data",
                                                                         &ros2::Gid<kBytes>::data));

template <std::size_t kBytes>
inline constexpr auto kFields<ros2::NodeEntitiesInfo<kBytes>> = std::make_tuple(
    field("node_namespace", &ros2::NodeEntitiesInfo<kBytes>::node_namespace, TextUpTo{256}),
    field("node_name", &ros2::NodeEntitiesInfo<kBytes>::node_name, TextUpTo{256}),
    field("reader_gid_seq", &ros2::NodeEntitiesInfo<kBytes>::reader_gid_seq, kItems),
    field("writer_gid_seq", &ros2::NodeEntitiesInfo<kBytes>::writer_gid_seq, kItems));

template <std::size_t kBytes>
inline constexpr auto kFields<ros2::ParticipantEntitiesInfo<kBytes>> =
    std::make_tuple(field("gid", &ros2::ParticipantEntitiesInfo<kBytes>::gid),
                    field("node_entities_info_seq",
                          &ros2::ParticipantEntitiesInfo<kBytes>::node_entities_info_seq, kItems));

}  // namespace clew::domain
