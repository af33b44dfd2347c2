// SPDX-License-Identifier: Apache-2.0
/// Serialised samples as Cyclone DDS keeps them: a type that is a name, and samples that are bytes.
#pragma once

#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>

#include <string>
#include <string_view>

namespace clew::bridge {

/// A keyless type of this name. The caller owns one reference, which dds_create_topic_sertype takes
/// over when it succeeds.
ddsi_sertype* make_raw_type(const std::string& name);

/// A sample of `type` with these bytes, encapsulation included. The caller owns one reference,
/// which dds_writecdr takes over.
ddsi_serdata* make_raw_sample(const ddsi_sertype* type, std::string_view cdr);

/// The bytes of a sample of a raw type.
std::string_view raw_bytes(const ddsi_serdata* sample);

}  // namespace clew::bridge
