// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "clew/plugin_fingerprint.h"
#include "core/geometry.hpp"
#include "domain/setup.hpp"
#include "domain/topics.hpp"

namespace clew::plugin {

/// The form of the descriptor itself, and of the function that adds behaviours.
inline constexpr std::uint32_t kAbi = 1;

/// What a compiler made of the types that a plug-in shares with the program that loads it.
using Layout = std::array<std::uint32_t, 8>;

constexpr Layout layout() {
  return {std::uint32_t{__GXX_ABI_VERSION},
#ifdef _GLIBCXX_USE_CXX11_ABI
          std::uint32_t{_GLIBCXX_USE_CXX11_ABI},
#else
          0,
#endif
          std::uint32_t{sizeof(std::string)},
          std::uint32_t{sizeof(std::vector<std::string>)},
          std::uint32_t{sizeof(std::map<std::string, std::string>)},
          std::uint32_t{sizeof(domain::Messages)},
          std::uint32_t{sizeof(domain::BehaviourSetup)},
          std::uint32_t{alignof(core::Vec2)}};
}

/// What a program reads of a plug-in before it loads it: the file has it in an ELF note. Texts end
/// with a zero byte.
struct Descriptor {
  std::uint32_t abi = kAbi;
  std::array<char, 33> fingerprint{};  ///< of the headers that it was built with
  std::array<char, 32> clew_version{};
  std::array<char, 64> name{};
  std::array<char, 32> version{};
  Layout layout{};
};

/// The note, as ELF lays it out.
struct Note {
  std::uint32_t owner_size = 5;
  std::uint32_t size = sizeof(Descriptor);
  std::uint32_t type = 1;
  std::array<char, 8> owner{'c', 'l', 'e', 'w', 0, 0, 0, 0};
  Descriptor descriptor;
};

/// A text as an array of its own length that is filled up with zeros.
template <std::size_t Size, std::size_t Length>
constexpr std::array<char, Size> fixed_text(const char (&text)[Length]) {
  static_assert(Length <= Size, "a plug-in's name has at most 63 characters, its version 31");
  std::array<char, Size> fixed{};
  for (std::size_t i = 0; i < Length; ++i) fixed[i] = text[i];
  return fixed;
}

/// The note of a plug-in that is built with these headers.
template <std::size_t N, std::size_t V>
constexpr Note make_note(const char (&name)[N], const char (&version)[V]) {
  Note note;
  note.descriptor.fingerprint = fixed_text<33>(CLEW_PLUGIN_FINGERPRINT);
  note.descriptor.clew_version = fixed_text<32>(CLEW_PLUGIN_CLEW_VERSION);
  note.descriptor.name = fixed_text<64>(name);
  note.descriptor.version = fixed_text<32>(version);
  note.descriptor.layout = layout();
  return note;
}

/// The name of the function that a plug-in exports.
inline constexpr char kEntry[] = "clew_plugin_add";

}  // namespace clew::plugin
