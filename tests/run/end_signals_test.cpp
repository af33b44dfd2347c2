// SPDX-License-Identifier: Apache-2.0
#include "run/end_signals.hpp"

#include <gtest/gtest.h>
#include <poll.h>

#include <csignal>

namespace clew::bridge {
namespace {

TEST(EndSignals, AreReadInsteadOfEndingTheProcess) {
  EndSignals signals;
  EXPECT_EQ(signals.take(), 0);

  ::raise(SIGINT);

  pollfd descriptor{signals.descriptor(), POLLIN, 0};
  EXPECT_EQ(::poll(&descriptor, 1, 0), 1);
  EXPECT_EQ(signals.take(), SIGINT);
  EXPECT_EQ(signals.take(), 0);
}

TEST(EndSignals, OfChildrenOnlyWake) {
  EndSignals signals;

  ::raise(SIGCHLD);

  EXPECT_EQ(signals.take(), 0);
}

TEST(EndSignals, MayBeMadeOneInAnother) {
  EndSignals outer;
  {
    EndSignals inner;
    ::raise(SIGTERM);
    EXPECT_EQ(inner.take(), SIGTERM);
  }
  ::raise(SIGHUP);

  EXPECT_EQ(outer.take(), SIGHUP) << "what is blocked outside stays so";
}

}  // namespace
}  // namespace clew::bridge
