// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/topic/TopicDataType.hpp>
#include <string>
#include <string_view>

namespace clew::bridge {

/// Serialised samples as Fast DDS sees them: a keyless type that is a name, and copies bytes. A
/// writer is given a std::string_view, a reader a std::string, both with the encapsulation.
class FastRawType : public eprosima::fastdds::dds::TopicDataType {
 public:
  explicit FastRawType(const std::string& name);

  bool serialize(void* view, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override;
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* string) override;
  std::function<std::uint32_t()> getSerializedSizeProvider(void* view) override;
  void* createData() override;
  void deleteData(void* string) override;
  bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }
};

}  // namespace clew::bridge
