// SPDX-License-Identifier: Apache-2.0
#include "run/allocations.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <thread>

namespace clew::bridge {
namespace {

TEST(Allocations, CountWhatThisThreadAllocates) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer has a new of its own";
#endif
  const std::uint64_t before = allocation_count();

  const auto one = std::make_unique<int>(1);
  const auto many = std::make_unique<int[]>(static_cast<std::size_t>(*one) * 100);
  EXPECT_NE(many, nullptr);

  EXPECT_EQ(allocation_count() - before, 2U);
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
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  EXPECT_EQ(in_thread, 1U);
#endif
}

}  // namespace
}  // namespace clew::bridge
