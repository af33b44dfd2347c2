// SPDX-License-Identifier: Apache-2.0
#include "plot/png.hpp"

#include "core/shared_library.hpp"
#include "plot/pictures_module.hpp"

namespace clew::plot {
namespace {

core::Result<std::string> render(std::string_view svg, PictureFormat format) {
  const auto module = core::SharedLibrary::load(kPicturesModule);
  if (!module.ok()) return module.error();
  const auto render_picture = module->function<RenderPicture>(kRenderPicture);
  if (!render_picture.ok()) return render_picture.error();
  core::Result<std::string> bytes = std::string();
  (*render_picture)(svg, format, bytes);
  return bytes;
}

}  // namespace

core::Result<std::string> render_png(std::string_view svg) {
  return render(svg, PictureFormat::kPng);
}

core::Result<std::string> render_pdf(std::string_view svg) {
  return render(svg, PictureFormat::kPdf);
}

}  // namespace clew::plot
