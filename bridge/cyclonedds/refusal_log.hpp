// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace clew::bridge {

/// Lets Cyclone DDS say once a kind what it has against others, since strangers may try as often as
/// they like. It does not say at all that a participant is not allowed, which it does of Fast DDS's
/// in good runs, too, as long as these have not shown who they are.
void quieten_refusals();

}  // namespace clew::bridge
