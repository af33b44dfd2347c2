// SPDX-License-Identifier: Apache-2.0
#include "ros2/message_type.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include "core/check.hpp"

namespace clew::ros2 {
namespace {

std::string fields_json(const std::string& name, const std::vector<FieldDescription>& fields) {
  std::string text = fmt::format(R"({{"type_name": "{}", "fields": [)", name);
  const char* separator = "";
  for (const FieldDescription& field : fields) {
    text += fmt::format(
        R"({}{{"name": "{}", "type": {{"type_id": {}, "capacity": {}, "string_capacity": {}, )"
        R"("nested_type_name": "{}"}}}})",
        separator, field.name, field.type_id, field.capacity, field.string_capacity,
        field.nested_type);
    separator = ", ";
  }
  return text + "]}";
}

std::string sha256_hex(const std::string& text) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  const int done =
      EVP_Digest(text.data(), text.size(), digest.data(), &size, EVP_sha256(), nullptr);
  CLEW_CHECK(done == 1, "OpenSSL has no SHA-256");
  std::string hex;
  for (unsigned int i = 0; i < size; ++i) hex += fmt::format("{:02x}", digest[i]);
  return hex;
}

std::string fields_text(const std::vector<FieldDescription>& fields) {
  std::string text;
  for (const FieldDescription& field : fields) {
    text += field.definition_type + ' ' + field.name + '\n';
  }
  return text;
}

std::string definition_text(const TypeDescription& type) {
  std::string text = fields_text(type.fields);
  for (const auto& [name, fields] : type.referenced) {
    text += std::string(80, '=') + "\nMSG: " + describing::short_name(name) + '\n';
    text += fields_text(fields);
  }
  return text;
}

/// `sensor_msgs::msg::dds_::LaserScan_`: rmw_cyclonedds and rmw_fastrtps both name types so.
std::string dds_name(const std::string& name) {
  const std::size_t first = name.find('/');
  const std::size_t last = name.rfind('/');
  return name.substr(0, first) + "::" + name.substr(first + 1, last - first - 1) +
         "::dds_::" + name.substr(last + 1) + '_';
}

}  // namespace

std::string describing::short_name(std::string_view type_name) {
  const std::size_t first = type_name.find('/');
  const std::size_t last = type_name.rfind('/');
  return std::string(type_name.substr(0, first)) + std::string(type_name.substr(last));
}

std::string canonical_json(const TypeDescription& type) {
  std::string text = R"({"type_description": )" + fields_json(type.name, type.fields) +
                     R"(, "referenced_type_descriptions": [)";
  const char* separator = "";
  for (const auto& [name, fields] : type.referenced) {
    text += separator + fields_json(name, fields);
    separator = ", ";
  }
  return text + "]}";
}

MessageType message_type_of(const TypeDescription& type) {
  return {type.name, dds_name(type.name), "RIHS01_" + sha256_hex(canonical_json(type)),
          definition_text(type)};
}

}  // namespace clew::ros2
