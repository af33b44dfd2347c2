// SPDX-License-Identifier: Apache-2.0
#include "cyclonedds/raw_type.hpp"

#include <dds/ddsi/q_radmin.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <vector>

#include "core/check.hpp"

namespace clew::bridge {
namespace {

/// Cyclone casts between the pointers, so the C struct comes first.
struct RawSample : ddsi_serdata {
  std::size_t size = 0;     ///< of the content
  std::vector<char> bytes;  ///< the content, and zeros up to a multiple of 4
};

RawSample* as_raw(ddsi_serdata* sample) { return static_cast<RawSample*>(sample); }
const RawSample* as_raw(const ddsi_serdata* sample) {
  return static_cast<const RawSample*>(sample);
}

RawSample* new_sample(const ddsi_sertype* type, ddsi_serdata_kind kind, std::size_t size) {
  auto* sample = new RawSample;
  ddsi_serdata_init(sample, type, kind);
  // Without keys there is one instance: all samples must agree in their hash, or each is its own.
  sample->hash = 0;
  sample->size = size;
  sample->bytes.assign((size + 3) / 4 * 4, '\0');
  return sample;
}

// --- serdata: what Cyclone does with a sample ---

bool samples_have_equal_keys(const ddsi_serdata*, const ddsi_serdata*) { return true; }

std::uint32_t sample_size(const ddsi_serdata* sample) {
  return static_cast<std::uint32_t>(as_raw(sample)->size);
}

/// From the network: a chain of fragments that may overlap.
ddsi_serdata* sample_from_fragments(const ddsi_sertype* type, ddsi_serdata_kind kind,
                                    const nn_rdata* fragment, std::size_t size) {
  RawSample* sample = new_sample(type, kind, size);
  std::size_t filled = 0;
  for (; fragment != nullptr; fragment = fragment->nextfrag) {
    const std::size_t end = std::min<std::size_t>(fragment->maxp1, size);
    if (end <= filled) continue;
    const unsigned char* payload =
        NN_RMSG_PAYLOADOFF(fragment->rmsg, NN_RDATA_PAYLOAD_OFF(fragment));
    std::memcpy(sample->bytes.data() + filled, payload + (filled - fragment->min), end - filled);
    filled = end;
  }
  return sample;
}

/// From the writer.
ddsi_serdata* sample_from_pieces(const ddsi_sertype* type, ddsi_serdata_kind kind,
                                 ddsrt_msg_iovlen_t count, const ddsrt_iovec_t* pieces,
                                 std::size_t size) {
  RawSample* sample = new_sample(type, kind, size);
  std::size_t filled = 0;
  for (ddsrt_msg_iovlen_t i = 0; i < count; ++i) {
    const std::size_t part = std::min<std::size_t>(pieces[i].iov_len, size - filled);
    std::memcpy(sample->bytes.data() + filled, pieces[i].iov_base, part);
    filled += part;
  }
  return sample;
}

ddsi_serdata* sample_from_key_hash(const ddsi_sertype* type, const ddsi_keyhash*) {
  return new_sample(type, SDK_KEY, 0);
}

ddsi_serdata* sample_from_value(const ddsi_sertype*, ddsi_serdata_kind, const void*) {
  return nullptr;  // there are no values, only bytes
}

void copy_bytes(const ddsi_serdata* sample, std::size_t offset, std::size_t size, void* to) {
  std::memcpy(to, as_raw(sample)->bytes.data() + offset, size);
}

ddsi_serdata* lend_bytes(const ddsi_serdata* sample, std::size_t offset, std::size_t size,
                         ddsrt_iovec_t* to) {
  // The iovec is for reading, but its pointer is not const.
  to->iov_base = const_cast<char*>(as_raw(sample)->bytes.data()) + offset;
  to->iov_len = size;
  return ddsi_serdata_ref(sample);
}

void return_bytes(ddsi_serdata* sample, const ddsrt_iovec_t*) { ddsi_serdata_unref(sample); }

bool sample_to_value(const ddsi_serdata*, void*, void**, void*) { return false; }

ddsi_serdata* sample_to_key(const ddsi_serdata* sample) {
  return new_sample(sample->type, SDK_KEY, 0);
}

bool key_to_value(const ddsi_sertype*, const ddsi_serdata*, void*, void**, void*) { return true; }

void free_sample(ddsi_serdata* sample) { delete as_raw(sample); }

std::size_t print_sample(const ddsi_sertype* type, const ddsi_serdata* sample, char* to,
                         std::size_t size) {
  const int length =
      std::snprintf(to, size, "%s, %zu bytes", type->type_name, as_raw(sample)->size);
  return static_cast<std::size_t>(length);
}

void no_key_hash(const ddsi_serdata*, ddsi_keyhash* to, bool) {
  std::memset(to->value, 0, sizeof to->value);
}

#ifdef DDS_HAS_SHM
/// Shared memory is off; Debian's library has the places for it all the same.
ddsi_serdata* sample_from_shared_memory(const ddsi_sertype*, ddsi_serdata_kind, void*, void*) {
  return nullptr;
}
#endif

const ddsi_serdata_ops kSampleOperations = {samples_have_equal_keys,
                                            sample_size,
                                            sample_from_fragments,
                                            sample_from_pieces,
                                            sample_from_key_hash,
                                            sample_from_value,
                                            copy_bytes,
                                            lend_bytes,
                                            return_bytes,
                                            sample_to_value,
                                            sample_to_key,
                                            key_to_value,
                                            free_sample,
                                            print_sample,
                                            no_key_hash,
#ifdef DDS_HAS_SHM
                                            sample_size,
                                            sample_from_shared_memory
#endif
};

// --- sertype: what Cyclone asks of the type ---

void free_type(ddsi_sertype* type) {
  ddsi_sertype_fini(type);
  delete type;
}

void zero_values(const ddsi_sertype*, void*, std::size_t) {}

void resize_values(void** values, const ddsi_sertype*, void*, std::size_t, std::size_t count) {
  std::fill(values, values + count, nullptr);
}

void free_values(const ddsi_sertype*, void**, std::size_t, dds_free_op_t) {}

/// Asked only of two types with one name and these operations.
bool types_are_equal(const ddsi_sertype*, const ddsi_sertype*) { return true; }

std::uint32_t type_hash(const ddsi_sertype*) { return 0; }

/// No type information: endpoints match by the type's name.
ddsi_sertype_ops make_type_operations() {
  ddsi_sertype_ops operations{};
  operations.version = ddsi_sertype_v0;
  operations.free = free_type;
  operations.zero_samples = zero_values;
  operations.realloc_samples = resize_values;
  operations.free_samples = free_values;
  operations.equal = types_are_equal;
  operations.hash = type_hash;
  return operations;
}

const ddsi_sertype_ops kTypeOperations = make_type_operations();

}  // namespace

ddsi_sertype* make_raw_type(const std::string& name) {
  auto* type = new ddsi_sertype{};
  ddsi_sertype_init_flags(type, name.c_str(), &kTypeOperations, &kSampleOperations,
                          DDSI_SERTYPE_FLAG_TOPICKIND_NO_KEY);
  type->allowed_data_representation = DDS_DATA_REPRESENTATION_FLAG_XCDR1;
  return type;
}

ddsi_serdata* make_raw_sample(const ddsi_sertype* type, std::string_view cdr) {
  RawSample* sample = new_sample(type, SDK_DATA, cdr.size());
  std::memcpy(sample->bytes.data(), cdr.data(), cdr.size());
  return sample;
}

std::string_view raw_bytes(const ddsi_serdata* sample) {
  const RawSample* raw = as_raw(sample);
  return {raw->bytes.data(), raw->size};
}

}  // namespace clew::bridge
