/* SPDX-License-Identifier: Apache-2.0
 *
 * A control component that knows nothing of Clew but its IDL: plain C, Cyclone DDS, code generated
 * by idlc. It takes the place of `control` in a graph with recover:
 *
 *     control: {exec: [./my_control]}
 *
 * For every tick it reads one odometry, one scan and one guidance, and writes one command with the
 * same stamp. A motion that recover asks for goes before its own.
 */
#include "Guidance.h"
#include "component.h"
#include "straight.h"

int main(void) {
  const dds_entity_t participant = open_participant();
  clew_msg_Odometry* odometry = clew_msg_Odometry__alloc();
  clew_msg_Scan* scan = clew_msg_Scan__alloc();
  clew_msg_Guidance* guidance = clew_msg_Guidance__alloc();
  const struct input inputs[] = {
      open_input(participant, &clew_msg_Odometry_desc, "odometry", odometry),
      open_input(participant, &clew_msg_Scan_desc, "scan", scan),
      open_input(participant, &clew_msg_Guidance_desc, "guidance", guidance)};
  const dds_entity_t writer =
      open_output(participant, &clew_msg_Command_desc, "command", DDS_RELIABILITY_RELIABLE);
  for (;;) {
    clew_msg_Command command;
    take_tick(inputs, 3);
    decide(odometry, scan, guidance->target_x_m, guidance->target_y_m, &command);
    if (guidance->has_override) command.motion = guidance->override_motion;
    must(dds_write(writer, &command), "write");
  }
}
