// SPDX-License-Identifier: Apache-2.0
#include "core/shared_library.hpp"

#include <gtest/gtest.h>

#include <string>

namespace clew::core {
namespace {

TEST(SharedLibrary, FindsAFunctionOfALibraryThatIsThere) {
  const auto library = SharedLibrary::load("libm.so.6");
  ASSERT_TRUE(library.ok()) << library.error().text();

  const auto floor = library->function<double(double)>("floor");

  ASSERT_TRUE(floor.ok()) << floor.error().text();
  EXPECT_EQ((*floor)(2.5), 2.0);
}

TEST(SharedLibrary, NamesTheLibraryThatIsNotThere) {
  const auto library = SharedLibrary::load("libclew-nothing.so");

  ASSERT_FALSE(library.ok());
  EXPECT_EQ(library.error().text(),
            "cannot be loaded: libclew-nothing.so: cannot open shared object file: No such file or "
            "directory");
}

TEST(SharedLibrary, NamesTheFunctionThatTheLibraryLacks) {
  const auto library = SharedLibrary::load("libm.so.6");
  ASSERT_TRUE(library.ok()) << library.error().text();

  const auto nothing = library->function<void()>("clew_nothing");

  ASSERT_FALSE(nothing.ok());
  EXPECT_NE(nothing.error().text().find("clew_nothing"), std::string::npos);
}

}  // namespace
}  // namespace clew::core
