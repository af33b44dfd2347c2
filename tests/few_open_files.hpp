// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <vector>

namespace clew {

/// While it is there, this process may open `more` files beside those that it has open.
class FewOpenFiles {
 public:
  /// So many more may be opened. Others may hold numbers between those that are free.
  explicit FewOpenFiles(rlim_t more) {
    EXPECT_EQ(::getrlimit(RLIMIT_NOFILE, &before_), 0);
    std::vector<int> next;
    while (next.size() <= more) next.push_back(::open("/dev/null", O_RDONLY | O_CLOEXEC));
    limit_ = {static_cast<rlim_t>(next.back()), before_.rlim_max};
    for (const int number : next) ::close(number);
    EXPECT_EQ(::setrlimit(RLIMIT_NOFILE, &limit_), 0);
  }
  ~FewOpenFiles() { EXPECT_EQ(::setrlimit(RLIMIT_NOFILE, &before_), 0); }
  FewOpenFiles(const FewOpenFiles&) = delete;
  FewOpenFiles& operator=(const FewOpenFiles&) = delete;

  rlim_t limit() const { return limit_.rlim_cur; }

 private:
  rlimit before_{};
  rlimit limit_{};
};

}  // namespace clew
