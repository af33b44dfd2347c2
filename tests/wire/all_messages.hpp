// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include "domain/topics.hpp"

namespace clew::bridge {

template <typename Tuple>
struct TestTypes;
template <typename... Message>
struct TestTypes<std::tuple<Message...>> {
  using Type = testing::Types<Message...>;
};

/// For suites that have every test once for each message.
using AllMessages = TestTypes<domain::Messages>::Type;

}  // namespace clew::bridge
