// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "core/check.hpp"

namespace clew::core {

/// What is wrong with an input, and where: one sentence that says what was found and what is
/// allowed. Lines and columns count from 1; 0 means that there is none.
struct Error {
  std::string message;
  std::string file = {};
  int line = 0;
  int column = 0;

  /// `file:line:column: message`, leaving out what is unknown; it steers no terminal.
  std::string text() const;
};

/// A value, or the reason why the input did not give one. It is asked by `ok()` alone: a Result
/// converts to no bool, so that nobody takes the value of a Result<bool> for its success.
template <typename T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::move(value)) {}      // NOLINT(google-explicit-constructor)
  Result(Error error) : content_(std::move(error)) {}  // NOLINT(google-explicit-constructor)

  bool ok() const { return content_.index() == 0; }

  const T& value() const& {
    CLEW_CHECK(ok(), error().text());
    return std::get<0>(content_);
  }
  T& value() & {
    CLEW_CHECK(ok(), error().text());
    return std::get<0>(content_);
  }
  // By value, so that `for (auto& x : *read())` does not loop over what is gone.
  T value() && {
    CLEW_CHECK(ok(), error().text());
    return std::get<0>(std::move(content_));
  }
  const T& operator*() const& { return value(); }
  T& operator*() & { return value(); }
  T operator*() && { return std::move(*this).value(); }
  const T* operator->() const { return &value(); }
  T* operator->() { return &value(); }

  const Error& error() const {
    CLEW_CHECK(!ok(), "a result that is no error");
    return std::get<1>(content_);
  }

 private:
  std::variant<T, Error> content_;
};

/// Success without a value, or an Error.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)) {}  // NOLINT(google-explicit-constructor)

  bool ok() const { return !error_.has_value(); }
  const Error& error() const {
    CLEW_CHECK(!ok(), "a result that is no error");
    return *error_;
  }

 private:
  std::optional<Error> error_;
};

}  // namespace clew::core

/// Leaves the function with the error of `expression`, a Result, if it has one.
#define CLEW_RETURN_IF_ERROR(expression)                      \
  do {                                                        \
    if (auto clew_result = (expression); !clew_result.ok()) { \
      return clew_result.error();                             \
    }                                                         \
  } while (false)
