// SPDX-License-Identifier: Apache-2.0
/// What the module `libclew-pictures.so` exports. It alone links the graphics libraries, so that a
/// component's process, which is the same program, does not map them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/result.hpp"

namespace clew::plot {

enum class PictureFormat : std::uint8_t { kPng, kPdf };

/// Renders an SVG picture into the bytes of a file of that format.
using RenderPicture = void(std::string_view svg, PictureFormat format,
                           core::Result<std::string>& bytes);

inline constexpr const char* kPicturesModule = "libclew-pictures.so";
inline constexpr const char* kRenderPicture = "clew_render_picture";

}  // namespace clew::plot

extern "C" __attribute__((visibility("default"))) clew::plot::RenderPicture clew_render_picture;
