// SPDX-License-Identifier: Apache-2.0
#include "plot/png.hpp"

#include <cairo.h>
#include <librsvg/rsvg.h>

#include <cmath>
#include <memory>

namespace clew::plot {
namespace {

constexpr double kPixelsPerUnit = 2.0;

struct FreeHandle {
  void operator()(RsvgHandle* handle) const { g_object_unref(handle); }
};
struct FreeSurface {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
struct FreeContext {
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};

core::Error failed(GError* why) {
  const std::string message = why == nullptr ? "unknown reason" : why->message;
  g_clear_error(&why);
  return {"the picture cannot be rendered: " + message, {}, 0, 0};
}

core::Error failed(cairo_status_t status) {
  return {
      std::string("the picture cannot be rendered: ") + cairo_status_to_string(status), {}, 0, 0};
}

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

core::Result<std::string> render_png(std::string_view svg) {
  GError* error = nullptr;
  const std::unique_ptr<RsvgHandle, FreeHandle> handle(
      rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(svg.data()), svg.size(), &error));
  if (handle == nullptr) return failed(error);
  double width = 0.0;
  double height = 0.0;
  rsvg_handle_get_intrinsic_size_in_pixels(handle.get(), &width, &height);
  const std::unique_ptr<cairo_surface_t, FreeSurface> surface(cairo_image_surface_create(
      CAIRO_FORMAT_ARGB32, static_cast<int>(std::ceil(width * kPixelsPerUnit)),
      static_cast<int>(std::ceil(height * kPixelsPerUnit))));
  const std::unique_ptr<cairo_t, FreeContext> context(cairo_create(surface.get()));
  const RsvgRectangle viewport{0.0, 0.0, width * kPixelsPerUnit, height * kPixelsPerUnit};
  if (!rsvg_handle_render_document(handle.get(), context.get(), &viewport, &error)) {
    return failed(error);
  }
  std::string png;
  const cairo_status_t status = cairo_surface_write_to_png_stream(surface.get(), append, &png);
  if (status != CAIRO_STATUS_SUCCESS) return failed(status);
  return png;
}

}  // namespace clew::plot
