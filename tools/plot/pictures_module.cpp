// SPDX-License-Identifier: Apache-2.0
#include "plot/pictures_module.hpp"

#include <cairo-pdf.h>
#include <cairo.h>
#include <librsvg/rsvg.h>

#include <cmath>
#include <memory>

namespace clew::plot {
namespace {

constexpr double kPixelsPerUnit = 2.0;
constexpr double kPointsPerUnit = 0.75;

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
  return {"the picture cannot be rendered: " + message};
}

core::Error failed(cairo_status_t status) {
  return {std::string("the picture cannot be rendered: ") + cairo_status_to_string(status)};
}

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

using Handle = std::unique_ptr<RsvgHandle, FreeHandle>;
using Surface = std::unique_ptr<cairo_surface_t, FreeSurface>;

struct Size {
  double width = 0.0;
  double height = 0.0;
};

core::Result<Handle> read(std::string_view svg) {
  GError* error = nullptr;
  Handle handle(
      rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(svg.data()), svg.size(), &error));
  if (handle == nullptr) return failed(error);
  return core::Result<Handle>(std::move(handle));
}

Size size_of(RsvgHandle* handle, double scale) {
  Size size;
  rsvg_handle_get_intrinsic_size_in_pixels(handle, &size.width, &size.height);
  return {size.width * scale, size.height * scale};
}

core::Result<void> render(RsvgHandle* handle, cairo_surface_t* surface, const Size& size) {
  GError* error = nullptr;
  const std::unique_ptr<cairo_t, FreeContext> context(cairo_create(surface));
  const RsvgRectangle viewport{0.0, 0.0, size.width, size.height};
  if (!rsvg_handle_render_document(handle, context.get(), &viewport, &error)) return failed(error);
  return {};
}

core::Result<std::string> png_of(std::string_view svg) {
  const auto handle = read(svg);
  if (!handle.ok()) return handle.error();
  const Size size = size_of(handle->get(), kPixelsPerUnit);
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32,
                                                   static_cast<int>(std::ceil(size.width)),
                                                   static_cast<int>(std::ceil(size.height))));
  CLEW_RETURN_IF_ERROR(render(handle->get(), surface.get(), size));
  std::string png;
  const cairo_status_t status = cairo_surface_write_to_png_stream(surface.get(), append, &png);
  if (status != CAIRO_STATUS_SUCCESS) return failed(status);
  return png;
}

core::Result<std::string> pdf_of(std::string_view svg) {
  const auto handle = read(svg);
  if (!handle.ok()) return handle.error();
  const Size size = size_of(handle->get(), kPointsPerUnit);
  std::string pdf;
  const Surface surface(cairo_pdf_surface_create_for_stream(append, &pdf, size.width, size.height));
  CLEW_RETURN_IF_ERROR(render(handle->get(), surface.get(), size));
  cairo_surface_finish(surface.get());
  const cairo_status_t status = cairo_surface_status(surface.get());
  if (status != CAIRO_STATUS_SUCCESS) return failed(status);
  return pdf;
}

}  // namespace
}  // namespace clew::plot

void clew_render_picture(std::string_view svg, clew::plot::PictureFormat format,
                         clew::core::Result<std::string>& bytes) {
  bytes =
      format == clew::plot::PictureFormat::kPng ? clew::plot::png_of(svg) : clew::plot::pdf_of(svg);
}
