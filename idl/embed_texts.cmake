# SPDX-License-Identifier: Apache-2.0
# Writes OUTPUT, a C++ header with the text of TEXT_DIR/<type>.idl for each of TYPES.
set(content "// Generated from idl/.\n#pragma once\n\n#include <string_view>\n\nnamespace clew::idl {\n\n")
string(APPEND content "struct TypeText {\n  std::string_view name;\n  std::string_view text;\n};\n\n")
string(APPEND content "inline constexpr TypeText kTypeTexts[] = {\n")
foreach(type IN LISTS TYPES)
  file(READ ${TEXT_DIR}/${type}.idl text)
  string(APPEND content "    {\"${type}\", R\"idl(${text})idl\"},\n")
endforeach()
string(APPEND content "};\n\n}  // namespace clew::idl\n")
file(WRITE ${OUTPUT} "${content}")
