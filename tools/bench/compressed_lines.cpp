// SPDX-License-Identifier: Apache-2.0
#include "bench/compressed_lines.hpp"

#include <zstd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <vector>

#include "bench/line_file.hpp"

namespace clew::bench {

using core::Error;
using core::Result;

namespace {

constexpr int kLevel =
    6;  // lines of results shrink to a tenth or less, at 100 MB a second and more

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

struct FreeCompressor {
  void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
};

Error cannot_read(const std::string& path) {
  return {std::string("cannot be read: ") + std::strerror(errno), path};
}

/// Compresses what there is of the input; `mode` ZSTD_e_end ends the frame.
Result<void> feed(ZSTD_CCtx* context, ZSTD_inBuffer input, ZSTD_EndDirective mode,
                  std::vector<char>& buffer, NewFile& to) {
  while (true) {
    ZSTD_outBuffer output{buffer.data(), buffer.size(), 0};
    const std::size_t left = ZSTD_compressStream2(context, &output, &input, mode);
    if (ZSTD_isError(left)) return Error{ZSTD_getErrorName(left)};
    CLEW_RETURN_IF_ERROR(to.write(std::string(buffer.data(), output.pos)));
    const bool is_done = mode == ZSTD_e_end ? left == 0 : input.pos == input.size;
    if (is_done) return {};
  }
}

}  // namespace

struct CompressedInput::State {
  struct Free {
    void operator()(std::FILE* open) const { std::fclose(open); }
    void operator()(ZSTD_DCtx* expander) const { ZSTD_freeDCtx(expander); }
  };
  std::unique_ptr<std::FILE, Free> file;
  std::unique_ptr<ZSTD_DCtx, Free> context{ZSTD_createDCtx()};
  std::vector<char> in = std::vector<char>(ZSTD_DStreamInSize());
  std::vector<char> out = std::vector<char>(ZSTD_DStreamOutSize());
  ZSTD_inBuffer input{nullptr, 0, 0};
  bool is_frame_open = false;
};

CompressedInput::CompressedInput(const std::string& path) : state_(std::make_unique<State>()) {
  state_->file.reset(std::fopen(path.c_str(), "re"));
}

CompressedInput::~CompressedInput() = default;

bool CompressedInput::is_open() const { return state_->file != nullptr; }

CompressedInput::int_type CompressedInput::underflow() {
  State& state = *state_;
  while (is_open() && damage_.empty()) {
    if (state.input.pos == state.input.size) {
      const std::size_t got = std::fread(state.in.data(), 1, state.in.size(), state.file.get());
      if (got == 0 && state.is_frame_open) damage_ = "it ends in the middle";
      if (got == 0) break;
      state.input = {state.in.data(), got, 0};
    }
    ZSTD_outBuffer output{state.out.data(), state.out.size(), 0};
    const std::size_t left = ZSTD_decompressStream(state.context.get(), &output, &state.input);
    if (ZSTD_isError(left)) damage_ = ZSTD_getErrorName(left);
    state.is_frame_open = left != 0;
    if (output.pos == 0) continue;
    setg(state.out.data(), state.out.data(), state.out.data() + output.pos);
    return traits_type::to_int_type(*gptr());
  }
  return traits_type::eof();
}

Result<void> compress_file(const std::string& path) {
  const File from(std::fopen(path.c_str(), "re"));
  if (!from) return cannot_read(path);
  auto to = NewFile::open(path + kCompressedEnding);
  if (!to.ok()) return to.error();
  const std::unique_ptr<ZSTD_CCtx, FreeCompressor> context(ZSTD_createCCtx());
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, kLevel);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
  std::vector<char> in(ZSTD_CStreamInSize());
  std::vector<char> out(ZSTD_CStreamOutSize());
  for (std::size_t got; (got = std::fread(in.data(), 1, in.size(), from.get())) > 0;) {
    CLEW_RETURN_IF_ERROR(feed(context.get(), {in.data(), got, 0}, ZSTD_e_continue, out, *to));
  }
  if (std::ferror(from.get()) != 0) return cannot_read(path);
  CLEW_RETURN_IF_ERROR(feed(context.get(), {nullptr, 0, 0}, ZSTD_e_end, out, *to));
  CLEW_RETURN_IF_ERROR(to->finish());
  if (std::remove(path.c_str()) == 0) return {};
  return Error{std::string("cannot be removed: ") + std::strerror(errno), path};
}

Result<void> expand_file(const std::string& path) {
  const std::string compressed = path + kCompressedEnding;
  CompressedInput from(compressed);
  if (!from.is_open()) return cannot_read(compressed);
  auto to = NewFile::open(path);
  if (!to.ok()) return to.error();
  std::vector<char> buffer(1 << 16);
  for (std::streamsize got;
       (got = from.sgetn(buffer.data(), static_cast<std::streamsize>(buffer.size()))) > 0;) {
    CLEW_RETURN_IF_ERROR(to->write(std::string(buffer.data(), static_cast<std::size_t>(got))));
  }
  if (!from.damage().empty()) return Error{"is damaged: " + from.damage(), compressed};
  CLEW_RETURN_IF_ERROR(to->finish());
  if (std::remove(compressed.c_str()) == 0) return {};
  return Error{std::string("cannot be removed: ") + std::strerror(errno), compressed};
}

}  // namespace clew::bench
