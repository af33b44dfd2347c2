/* SPDX-License-Identifier: Apache-2.0
 *
 * A drive that knows nothing of Clew but its IDL: a point on an empty plane that turns and steps as
 * it is told, from (1, 1) ahead along x. It takes the place of `drive` in a graph:
 *
 *     drive: {exec: [./line_drive], behaviour: turn_then_step}
 *
 *     line_drive [TARGET_X_M]     4 by default; within 0.2 m of (TARGET_X_M, 1) it has arrived
 *
 * It judges the outcome, and knows of no last tick.
 */
#include "Odometry.h"
#include "State.h"
#include "Target.h"
#include "component.h"
#include "straight.h"

static double wrapped(double angle) {
  while (angle > PI) angle -= 2.0 * PI;
  while (angle <= -PI) angle += 2.0 * PI;
  return angle;
}

int main(int argc, char** argv) {
  const double target_x_m = argc > 1 ? atof(argv[1]) : 4.0;
  const char* tick_s = getenv("CLEW_TICK_S");
  if (tick_s == NULL) return 2;
  const dds_entity_t participant = open_participant();
  clew_msg_Command* command = clew_msg_Command__alloc();
  const struct input input = open_input(participant, &clew_msg_Command_desc, "command", command);
  const dds_reliability_kind_t reliable = DDS_RELIABILITY_RELIABLE;
  const dds_entity_t states = open_output(participant, &clew_msg_State_desc, "state", reliable);
  const dds_entity_t targets = open_output(participant, &clew_msg_Target_desc, "target", reliable);
  const dds_entity_t odometries =
      open_output(participant, &clew_msg_Odometry_desc, "odometry", reliable);
  clew_msg_State state;
  clew_msg_Odometry odometry;
  clew_msg_Target target = {{0, 0.0, 0}, target_x_m, 1.0, 0.2, false, 0.0, 0.0, 1, 1};
  memset(&state, 0, sizeof state);
  memset(&odometry, 0, sizeof odometry);
  clew_msg_Pose2 pose = {1.0, 1.0, 0.0};
  for (uint64_t tick = 0;; ++tick) {
    const clew_msg_TickStamp stamp = {tick, (double)tick * atof(tick_s), tick};
    const double distance_m = hypot(target.x_m - pose.x_m, target.y_m - pose.y_m);
    state.stamp = odometry.stamp = target.stamp = stamp;
    state.pose_world_robot = odometry.pose_odom_robot = pose;
    odometry.travel_m = state.path_length_m;
    state.outcome =
        distance_m <= target.radius_m ? clew_msg_OUTCOME_REACHED : clew_msg_OUTCOME_RUNNING;
    must(dds_write(states, &state), "state");
    must(dds_write(targets, &target), "target");
    must(dds_write(odometries, &odometry), "odometry");
    while (state.outcome != clew_msg_OUTCOME_RUNNING) dds_sleepfor(DDS_SECS(1));
    take_tick(&input, 1);
    pose.heading_rad = wrapped(pose.heading_rad + command->motion.turn_rad);
    pose.x_m += command->motion.step_m * cos(pose.heading_rad);
    pose.y_m += command->motion.step_m * sin(pose.heading_rad);
    state.path_length_m += fabs(command->motion.step_m);
  }
}
