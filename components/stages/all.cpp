// SPDX-License-Identifier: Apache-2.0
#include "stages/all.hpp"

#include "classify/stage.hpp"
#include "control/stage.hpp"
#include "drive/stage.hpp"
#include "plan/stage.hpp"
#include "recover/stage.hpp"
#include "sense/stage.hpp"

namespace clew::stages {

const std::vector<runtime::StageInfo>& all() {
  static const std::vector<runtime::StageInfo> stages = {sense::stage(),   classify::stage(),
                                                         plan::stage(),    recover::stage(),
                                                         control::stage(), drive::stage()};
  return stages;
}

}  // namespace clew::stages
