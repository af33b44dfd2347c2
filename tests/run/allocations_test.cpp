// SPDX-License-Identifier: Apache-2.0
#include "run/allocations.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <thread>

namespace clew::bridge {
namespace {

TEST(Allocations, CountWhatThisThreadAllocates) {
#ifdef CLEW_SANITIZER_HAS_NEW
  GTEST_SKIP() << "a sanitizer has a new of its own";
#endif
  const std::uint64_t before = allocation_count();

  const auto one = std::make_unique<int>(1);
  const auto many = std::make_unique<int[]>(static_cast<std::size_t>(*one) * 100);
  EXPECT_NE(many, nullptr);

  EXPECT_EQ(allocation_count() - before, 2U);
}

TEST(Allocations, OfAGreaterAlignmentDoNotCount) {
  struct alignas(64) Wide {
    int value = 0;
  };
  const std::uint64_t before = allocation_count();

  const auto wide = std::make_unique<Wide>();

  EXPECT_EQ(wide->value, 0);
  EXPECT_EQ(allocation_count(), before);
}

TEST(Allocations, OfOtherThreadsAreTheirs) {
  std::unique_ptr<int> made;
  std::uint64_t in_thread = 0;
  std::uint64_t before = 0;
  std::thread thread([&] {
    before = allocation_count();
    made = std::make_unique<int>(1);
    in_thread = allocation_count() - before;
  });
  const std::uint64_t here = allocation_count();
  thread.join();

  EXPECT_EQ(allocation_count(), here);
#ifndef CLEW_SANITIZER_HAS_NEW
  EXPECT_EQ(in_thread, 1U);
#endif
}

}  // namespace
}  // namespace clew::bridge
