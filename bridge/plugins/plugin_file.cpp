// SPDX-License-Identifier: Apache-2.0
#include "plugins/plugin_file.hpp"

#include <gelf.h>
#include <libelf.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>

#include "core/hash128.hpp"

namespace clew::bridge {
namespace {

namespace fs = std::filesystem;
using core::Error;
using core::Result;

constexpr std::uintmax_t kMaxFileBytes = 256u << 20;
#if defined(__x86_64__)
constexpr unsigned kMachine = EM_X86_64;
#elif defined(__aarch64__)
constexpr unsigned kMachine = EM_AARCH64;
#else
#error "say which machine this is"
#endif

Result<std::string> read_bytes(const std::string& path) {
  std::error_code code;
  if (!fs::is_regular_file(path, code)) {
    return Error{code ? "cannot be read: " + code.message() : "is no regular file", path};
  }
  if (fs::file_size(path, code) > kMaxFileBytes) {
    return Error{"is larger than 256 MiB", path};
  }
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  if (!stream) return Error{"cannot be read", path};
  return bytes.str();
}

/// The descriptor among the notes of a segment.
std::optional<plugin::Descriptor> find_note(const Elf_Data& notes) {
  std::size_t offset = 0;
  auto* const data = const_cast<Elf_Data*>(&notes);  // libelf only reads
  GElf_Nhdr header{};
  std::size_t owner = 0;
  std::size_t content = 0;
  const auto* const bytes = static_cast<const char*>(notes.d_buf);
  while ((offset = gelf_getnote(data, offset, &header, &owner, &content)) > 0) {
    const bool ours = header.n_namesz == 5 && std::memcmp(bytes + owner, "clew", 5) == 0;
    if (!ours || header.n_descsz < sizeof(std::uint32_t)) continue;
    // Of another form only the number of the form is sure.
    plugin::Descriptor descriptor;
    const std::size_t size = std::min<std::size_t>(header.n_descsz, sizeof descriptor);
    std::memcpy(static_cast<void*>(&descriptor), bytes + content, size);
    if (header.n_descsz != sizeof descriptor && descriptor.abi == plugin::kAbi) continue;
    return descriptor;
  }
  return std::nullopt;
}

Result<plugin::Descriptor> read_descriptor(const std::string& path, std::string& bytes) {
  const auto refuse = [&path](const std::string& why) { return Error{why, path}; };
  elf_version(EV_CURRENT);
  const std::unique_ptr<Elf, int (*)(Elf*)> elf(elf_memory(bytes.data(), bytes.size()), elf_end);
  GElf_Ehdr header{};
  if (!elf || elf_kind(elf.get()) != ELF_K_ELF || gelf_getehdr(elf.get(), &header) == nullptr ||
      header.e_type != ET_DYN) {
    return refuse("is no shared library");
  }
  if (header.e_machine != kMachine || gelf_getclass(elf.get()) != ELFCLASS64) {
    return refuse("is a shared library of another kind of machine");
  }
  std::size_t segments = 0;
  if (elf_getphdrnum(elf.get(), &segments) != 0) return refuse("is a broken shared library");
  std::optional<plugin::Descriptor> found;
  for (std::size_t i = 0; i < segments; ++i) {
    GElf_Phdr segment{};
    if (gelf_getphdr(elf.get(), static_cast<int>(i), &segment) == nullptr) {
      return refuse("is a broken shared library");
    }
    // The linker maps segments as they are declared, and dies where the file has ended.
    const bool is_there =
        segment.p_offset <= bytes.size() && segment.p_filesz <= bytes.size() - segment.p_offset;
    if (!is_there) return refuse("is cut off: it lacks a part that it declares");
    if (segment.p_type != PT_NOTE || found) continue;
    const Elf_Data* notes =
        elf_getdata_rawchunk(elf.get(), static_cast<std::int64_t>(segment.p_offset),
                             segment.p_filesz, segment.p_align == 8 ? ELF_T_NHDR8 : ELF_T_NHDR);
    if (notes != nullptr) found = find_note(*notes);
  }
  if (found) return *found;
  return refuse("is a shared library, but no plug-in of clew: it has no CLEW_PLUGIN");
}

/// Whether a text ends within its array and needs no quoting anywhere.
template <std::size_t Size>
bool is_word(const std::array<char, Size>& text) {
  const auto end = std::find(text.begin(), text.end(), '\0');
  return end != text.end() && end != text.begin() && std::all_of(text.begin(), end, [](char c) {
           return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' ||
                  c == '.';
         });
}

}  // namespace

Result<PluginFile> read_plugin_file(const std::string& path) {
  auto bytes = read_bytes(path);
  if (!bytes.ok()) return bytes.error();
  std::error_code code;
  const fs::path absolute = fs::canonical(path, code);
  if (code) return Error{"cannot be read: " + code.message(), path};
  PluginFile file{absolute.string(), core::hash128(*bytes).hex(), {}};
  const auto descriptor = read_descriptor(path, *bytes);
  if (!descriptor.ok()) return descriptor.error();
  file.descriptor = *descriptor;
  const auto& d = file.descriptor;
  if (d.abi == plugin::kAbi && !(is_word(d.name) && is_word(d.version) && is_word(d.fingerprint) &&
                                 is_word(d.clew_version))) {
    return Error{"has a broken descriptor: a name, a version or a fingerprint is none", path};
  }
  return file;
}

Result<void> check_fits(const PluginFile& file) {
  const plugin::Descriptor& d = file.descriptor;
  if (d.abi != plugin::kAbi) {
    return Error{"is a plug-in of interface " + std::to_string(d.abi) +
                     "; this clew has interface " + std::to_string(plugin::kAbi) +
                     "; build it again",
                 file.path};
  }
  const std::string fingerprint = d.fingerprint.data();
  if (fingerprint != CLEW_PLUGIN_FINGERPRINT) {
    return Error{"was built with the headers of another clew (" +
                     std::string(d.clew_version.data()) + ", fingerprint " + fingerprint +
                     "; this is " CLEW_PLUGIN_CLEW_VERSION ", fingerprint " CLEW_PLUGIN_FINGERPRINT
                     "); build it again",
                 file.path};
  }
  if (d.layout == plugin::layout()) return {};
  return Error{
      "was built by a compiler, or with options, that lay out types in another way; build "
      "it with the compiler and the standard library of this clew",
      file.path};
}

}  // namespace clew::bridge
