// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace clew::domain {

/// What somebody changes in a run that goes on. It holds from the beginning of a tick on.
struct Intervention {
  std::uint64_t tick = 0;
  std::uint64_t fed_from = 0;  ///< the first tick whose inputs a new behaviour was fed
  /// `STAGE.PART=NAME[,NAME...]`, `STAGE[.PART][.NAME].PARAM=VALUE` or `goal=X,Y[,RADIUS]`; all of
  /// them at once.
  std::vector<std::string> changes;
  /// `pause`, `step`, `resume`, `pace`: change only when ticks begin. Empty with `changes`.
  std::string order;
  /// Data files that the changes name and the run did not have, named as in a runtime::Bundle.
  std::map<std::string, std::string> files;
};

template <typename V>
void visit_fields(V& v, Intervention& i) {
  v(i.tick, i.fed_from, i.changes, i.order, i.files);
}

}  // namespace clew::domain
