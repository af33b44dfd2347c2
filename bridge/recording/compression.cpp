// SPDX-License-Identifier: Apache-2.0
#include "recording/compression.hpp"

#include <lz4frame.h>
#include <zstd.h>

#include <cstring>
#include <memory>

#include "core/check.hpp"

namespace clew::bridge::mcap {
namespace {

core::Error broken(std::string_view what, const std::string& why) {
  return {std::string(what) + " data cannot be unpacked: " + why};
}

core::Error wrong_size(std::string_view what, std::size_t expected_bytes) {
  return broken(what, "it does not hold the " + std::to_string(expected_bytes) +
                          " bytes that were announced");
}

core::Result<void> unpack_zstd(std::string_view packed, std::size_t expected_bytes, char* out) {
  const std::size_t written = ZSTD_decompress(out, expected_bytes, packed.data(), packed.size());
  if (ZSTD_isError(written) != 0) return broken("zstd", ZSTD_getErrorName(written));
  if (written != expected_bytes) return wrong_size("zstd", expected_bytes);
  return {};
}

struct FreeLz4 {
  void operator()(LZ4F_dctx* context) const { LZ4F_freeDecompressionContext(context); }
};

core::Result<void> unpack_lz4(std::string_view packed, std::size_t expected_bytes, char* out) {
  LZ4F_dctx* raw_context = nullptr;
  const LZ4F_errorCode_t created = LZ4F_createDecompressionContext(&raw_context, LZ4F_VERSION);
  CLEW_CHECK(LZ4F_isError(created) == 0, LZ4F_getErrorName(created));
  const std::unique_ptr<LZ4F_dctx, FreeLz4> context(raw_context);

  std::size_t read_total = 0;
  std::size_t written_total = 0;
  std::size_t wanted = 1;  // 0 once the frame has ended
  while (wanted != 0) {
    std::size_t read = packed.size() - read_total;
    std::size_t written = expected_bytes - written_total;
    wanted = LZ4F_decompress(context.get(), out + written_total, &written,
                             packed.data() + read_total, &read, nullptr);
    if (LZ4F_isError(wanted) != 0) return broken("lz4", LZ4F_getErrorName(wanted));
    read_total += read;
    written_total += written;
    if (wanted != 0 && read == 0 && written == 0) return wrong_size("lz4", expected_bytes);
  }
  if (written_total != expected_bytes || read_total != packed.size()) {
    return wrong_size("lz4", expected_bytes);
  }
  return {};
}

}  // namespace

std::string_view compression_name(Compression compression) {
  switch (compression) {
    case Compression::kNone:
      return "";
    case Compression::kZstd:
      return "zstd";
    case Compression::kLz4:
      break;
  }
  return "lz4";
}

std::optional<Compression> compression_from_name(std::string_view name) {
  for (const auto known : {Compression::kNone, Compression::kZstd, Compression::kLz4}) {
    if (name == compression_name(known)) return known;
  }
  return std::nullopt;
}

void compress(Compression compression, std::string_view bytes, std::string& packed) {
  if (compression == Compression::kNone) {
    packed = bytes;
  } else if (compression == Compression::kZstd) {
    packed.resize(ZSTD_compressBound(bytes.size()));
    const std::size_t written = ZSTD_compress(packed.data(), packed.size(), bytes.data(),
                                              bytes.size(), ZSTD_CLEVEL_DEFAULT);
    CLEW_CHECK(ZSTD_isError(written) == 0, ZSTD_getErrorName(written));
    packed.resize(written);
  } else {
    packed.resize(LZ4F_compressFrameBound(bytes.size(), nullptr));
    const std::size_t written =
        LZ4F_compressFrame(packed.data(), packed.size(), bytes.data(), bytes.size(), nullptr);
    CLEW_CHECK(LZ4F_isError(written) == 0, LZ4F_getErrorName(written));
    packed.resize(written);
  }
}

core::Result<void> decompress(Compression compression, std::string_view packed,
                              std::size_t expected_bytes, ByteBuffer& bytes) {
  char* const out = bytes.resize(expected_bytes);
  if (compression == Compression::kZstd) return unpack_zstd(packed, expected_bytes, out);
  if (compression == Compression::kLz4) return unpack_lz4(packed, expected_bytes, out);
  if (packed.size() != expected_bytes) return wrong_size("uncompressed", expected_bytes);
  if (!packed.empty()) std::memcpy(out, packed.data(), packed.size());
  return {};
}

}  // namespace clew::bridge::mcap
