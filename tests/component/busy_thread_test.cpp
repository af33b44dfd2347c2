// SPDX-License-Identifier: Apache-2.0
#include "component/busy_thread.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <future>
#include <thread>
#include <utility>

namespace clew::bridge {
namespace {

/// Another thread that begins to work, and does so until it is told to end.
class Worker {
 public:
  Worker(BusyThread& busy, std::function<void(std::future<void>& end)> work)
      : thread_([this, &busy, work = std::move(work)] {
          std::future<void> end = end_.get_future();
          busy.begin();
          begun_.set_value();
          work(end);
          busy.end();
        }) {
    begun_.get_future().wait();
  }
  void end() {
    end_.set_value();
    thread_.join();
  }

 private:
  std::promise<void> begun_;
  std::promise<void> end_;
  std::thread thread_;
};

TEST(BusyThread, IsNobodyAtFirst) {
  const BusyThread busy;

  EXPECT_FALSE(busy.is_busy());
  EXPECT_EQ(busy.processor_ns(), 0u);
}

TEST(BusyThread, TellsThatWorkGetsOn) {
  BusyThread busy;
  Worker worker(busy, [](std::future<void>& end) {
    while (end.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
    }
  });

  EXPECT_TRUE(busy.is_busy());
  const std::uint64_t before = busy.processor_ns();
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (busy.processor_ns() == before && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::yield();
  }
  EXPECT_NE(busy.processor_ns(), before);

  worker.end();
  EXPECT_FALSE(busy.is_busy());
  EXPECT_EQ(busy.processor_ns(), 0u);
}

TEST(BusyThread, TellsThatWorkIsStuckWhateverOtherThreadsDo) {
  constexpr int kLooks = 100'000;  // of the thread that looks, which uses the processor meanwhile
  BusyThread busy;
  Worker worker(busy, [](std::future<void>& end) { end.wait(); });

  int alike = 0;
  std::uint64_t before = busy.processor_ns();
  for (int look = 0; look < 100 * kLooks && alike < kLooks; ++look) {
    const std::uint64_t now = busy.processor_ns();
    alike = now == before ? alike + 1 : 0;
    before = now;
  }

  EXPECT_EQ(alike, kLooks);
  EXPECT_TRUE(busy.is_busy());
  worker.end();
}

TEST(BusyThread, MayBeAskedOfAThreadThatHasEnded) {
  BusyThread busy;
  std::thread([&] { busy.begin(); }).join();

  EXPECT_TRUE(busy.is_busy());
  EXPECT_EQ(busy.processor_ns(), 0u);
}

}  // namespace
}  // namespace clew::bridge
