// SPDX-License-Identifier: Apache-2.0
#include "core/result.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <type_traits>
#include <vector>

namespace clew::core {
namespace {

Result<int> half(int number) {
  if (number % 2 != 0) return Error{std::to_string(number) + " is odd", "numbers.yaml", 3, 5};
  return number / 2;
}

Result<void> check_even(int number) {
  CLEW_RETURN_IF_ERROR(half(number));
  return {};
}

TEST(Error, NamesThePlaceAsFarAsItIsKnown) {
  EXPECT_EQ((Error{"wrong", "a.yaml", 3, 5}).text(), "a.yaml:3:5: wrong");
  EXPECT_EQ((Error{"wrong", "a.yaml", 3, 0}).text(), "a.yaml:3: wrong");
  EXPECT_EQ((Error{"wrong", "a.yaml"}).text(), "a.yaml: wrong");
  EXPECT_EQ((Error{"wrong", ""}).text(), "wrong");
}

// Success is asked by ok() alone, all over the house: the compiler holds it.
static_assert(!std::is_constructible_v<bool, Result<bool>>);
static_assert(!std::is_constructible_v<bool, Result<void>>);

TEST(Result, HoldsAValue) {
  const Result<int> result = half(8);

  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result.value(), 4);
  EXPECT_EQ(*result, 4);
}

TEST(Result, HoldsAnError) {
  const Result<int> result = half(7);

  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().text(), "numbers.yaml:3:5: 7 is odd");
}

TEST(Result, CarriesWhatCannotBeCopied) {
  Result<std::unique_ptr<int>> result = std::make_unique<int>(3);

  const std::unique_ptr<int> taken = std::move(result).value();

  EXPECT_EQ(*taken, 3);
}

TEST(Result, OfATemporaryOutlivesItInALoop) {
  const auto read = [] { return Result<std::vector<int>>(std::vector<int>{1, 2, 3}); };
  int sum = 0;

  for (const int item : *read()) sum += item;

  EXPECT_EQ(sum, 6);
}

TEST(Result, WithoutAValueIsSuccessOrAnError) {
  EXPECT_TRUE(check_even(2).ok());
  EXPECT_EQ(check_even(3).error().text(), "numbers.yaml:3:5: 3 is odd");
}

TEST(ResultDeathTest, ReadingTheValueOfAnErrorPrintsIt) {
  const Result<int> result = half(7);

  EXPECT_DEATH(static_cast<void>(result.value()), "numbers.yaml:3:5: 7 is odd");
}

TEST(ResultDeathTest, ReadingTheErrorOfAValueAborts) {
  const Result<int> with_value = 4;
  const Result<void> success;

  EXPECT_DEATH(static_cast<void>(with_value.error()), "a result that is no error");
  EXPECT_DEATH(static_cast<void>(success.error()), "a result that is no error");
}

TEST(CheckDeathTest, PrintsTheConditionAndTheValues) {
  const int beams = 7;

  EXPECT_DEATH(
      CLEW_CHECK(beams == 8, std::to_string(beams) + " beams"),
      "clew: internal error at .*result_test.cpp:[0-9]+: beams == 8 does not hold: 7 beams");
}

TEST(Check, BuildsItsTextOnlyOnFailure) {
  int built = 0;
  const auto text = [&] {
    ++built;
    return std::string("text");
  };

  CLEW_CHECK(true, text());

  EXPECT_EQ(built, 0);
}

}  // namespace
}  // namespace clew::core
