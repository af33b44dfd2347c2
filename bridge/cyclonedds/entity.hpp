// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/dds.h>

#include <memory>
#include <string>
#include <utility>

#include "core/result.hpp"

namespace clew::bridge {

/// A handle of Cyclone DDS that is deleted with its owner; 0 for none.
class CycloneEntity {
 public:
  CycloneEntity() = default;
  explicit CycloneEntity(dds_entity_t handle) : handle_(handle) {}
  ~CycloneEntity() { reset(); }
  CycloneEntity(CycloneEntity&& other) noexcept : handle_(std::exchange(other.handle_, 0)) {}
  CycloneEntity& operator=(CycloneEntity&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }

  dds_entity_t handle() const { return handle_; }
  /// Deletes the entity now. It returns when no listener of it is running any more.
  void reset() {
    if (handle_ > 0) dds_delete(handle_);
    handle_ = 0;
  }

 private:
  dds_entity_t handle_ = 0;
};

/// `what` failed with `code`, in Cyclone's words.
inline core::Error cyclone_error(const std::string& what, dds_return_t code) {
  return {"Cyclone DDS: " + what + ": " + dds_strretcode(code), {}};
}

using CycloneQos = std::unique_ptr<dds_qos_t, void (*)(dds_qos_t*)>;
inline CycloneQos make_cyclone_qos() { return {dds_create_qos(), dds_delete_qos}; }

}  // namespace clew::bridge
