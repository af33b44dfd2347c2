# SPDX-License-Identifier: Apache-2.0
# Writes OUTPUT, a C++ header with the text of TEXT_DIR/<type>.idl for each of TYPES.
set(content "// Generated from idl/.\n#pragma once\n\n#include <string_view>\n\nnamespace clew::idl {\n\n")
foreach(type IN LISTS TYPES)
  file(READ ${TEXT_DIR}/${type}.idl text)
  string(APPEND content "inline constexpr std::string_view k${type}Text = R\"idl(${text})idl\";\n\n")
endforeach()
string(APPEND content "}  // namespace clew::idl\n")
file(WRITE ${OUTPUT} "${content}")
