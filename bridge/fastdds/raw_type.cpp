// SPDX-License-Identifier: Apache-2.0
#include "fastdds/raw_type.hpp"

#include <cstring>

namespace clew::bridge {
namespace {

/// What is set aside for a sample at first; a longer one gets more.
constexpr std::uint32_t kUsualSize = 512;

}  // namespace

using eprosima::fastrtps::rtps::SerializedPayload_t;

FastRawType::FastRawType(const std::string& name) {
  setName(name.c_str());
  m_typeSize = kUsualSize;
  m_isGetKeyDefined = false;
  auto_fill_type_information(false);
  auto_fill_type_object(false);
}

bool FastRawType::serialize(void* view, SerializedPayload_t* payload) {
  const auto& cdr = *static_cast<const std::string_view*>(view);
  if (cdr.size() > payload->max_size) return false;
  std::memcpy(payload->data, cdr.data(), cdr.size());
  payload->length = static_cast<std::uint32_t>(cdr.size());
  payload->encapsulation = CDR_LE;
  return true;
}

bool FastRawType::deserialize(SerializedPayload_t* payload, void* string) {
  static_cast<std::string*>(string)->assign(reinterpret_cast<const char*>(payload->data),
                                            payload->length);
  return true;
}

std::function<std::uint32_t()> FastRawType::getSerializedSizeProvider(void* view) {
  return [view] {
    return static_cast<std::uint32_t>(static_cast<const std::string_view*>(view)->size());
  };
}

void* FastRawType::createData() { return new std::string; }

void FastRawType::deleteData(void* string) { delete static_cast<std::string*>(string); }

}  // namespace clew::bridge
