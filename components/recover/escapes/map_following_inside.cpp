// SPDX-License-Identifier: Apache-2.0
#include "domain/words.hpp"
#include "recover/escapes/cut_proof.hpp"
#include "recover/escapes/map_following.hpp"

namespace clew::recover {

void MapFollowing::tell(const Situation& situation, domain::Inside& inside) const {
  const core::Vec2 place = situation.pose().position();
  const double still_s = static_cast<double>(situation.tick - state_.progress_tick) * tick_s_;
  inside.values.flag("path_exists", path_.exists());
  inside.values.bound("ended_last_at", state_.ended_at_m, "m");
  inside.values.number("without_progress", still_s, "s");
  inside.values.number("patience", parameters_.patience_s, "s");
  inside.values.number("refused_places", static_cast<double>(path_.refused_odom().size()));
  if (path_.exists()) {
    const double length_m = path_.length_m(place);
    const double rise_m = path_.rise_m(place, situation.target_odom);
    inside.values.number("path_length", length_m, "m");
    inside.values.number("path_rise", rise_m, "m");
    inside.values.number("leaves_below_rise", parameters_.leave_rise_m, "m");
    for (const core::Vec2& corner : path_.corners_odom()) {
      domain::InsideGroup& item = inside.values.item("path");
      item.number("x", corner.x(), "m");
      item.number("y", corner.y(), "m");
    }
    inside.picture.layers.push_back(
        {"known path", domain::PictureLayer::Kind::kWay, {}, path_.corners_odom()});
    inside.say("The known path is " + domain::say_metres(length_m) + " long with " +
               domain::say_count(path_.corners_odom().size(), "corner") +
               ", and leads away from the target by " + domain::say_metres(rise_m) +
               " before it leads there.");
  } else {
    inside.say("What was seen closes every way.");
  }
  inside.picture.layers.push_back(
      {"places that were refused", domain::PictureLayer::Kind::kPoints, {}, path_.refused_odom()});
  proof_.tell(situation, inside);
}

void CutProof::tell(const Situation& situation, domain::Inside& inside) const {
  domain::InsideGroup& proof = inside.values.group("proof_that_nothing_leads_there");
  proof.flag("cut", state_.cut);
  proof.flag("last_look", state_.last_look);
  proof.number("needed", proof_s_, "s");
  if (!state_.cut) return;
  const double stood_s = static_cast<double>(situation.tick - state_.since_tick) * tick_s_;
  proof.number("stood_for", stood_s, "s");
  inside.say("Every way has been cut for " + domain::say_seconds(stood_s) + "; after " +
             domain::say_seconds(proof_s_) + " and one look more the target is unreachable.");
}

}  // namespace clew::recover
