/* SPDX-License-Identifier: Apache-2.0
 *
 * The decision of a simple controller: turn toward the target, step as far as the cones show free.
 */
#ifndef CLEW_EXAMPLE_STRAIGHT_H
#define CLEW_EXAMPLE_STRAIGHT_H

#include <math.h>
#include <string.h>

#include "Command.h"
#include "Odometry.h"
#include "Scan.h"

#define STEP_M 0.1
#define MAX_TURN_RAD 0.16
#define MARGIN_M 0.02
#define PI 3.14159265358979323846

static inline double free_ahead(const clew_msg_Scan* scan, double turn_rad) {
  double least = scan->range_max_m;
  for (uint32_t i = 0; i < scan->ranges_m._length; ++i) {
    const double bearing = scan->bearing_first_rad + i * scan->bearing_step_rad;
    if (fabs(bearing - turn_rad) <= scan->beam_width_rad * 1.5 &&
        scan->ranges_m._buffer[i] < least) {
      least = scan->ranges_m._buffer[i];
    }
  }
  return least - MARGIN_M;
}

static inline void decide(const clew_msg_Odometry* odometry, const clew_msg_Scan* scan,
                          double target_x_m, double target_y_m, clew_msg_Command* command) {
  const clew_msg_Pose2* pose = &odometry->pose_odom_robot;
  double turn = atan2(target_y_m - pose->y_m, target_x_m - pose->x_m) - pose->heading_rad;
  while (turn > PI) turn -= 2.0 * PI;
  while (turn <= -PI) turn += 2.0 * PI;
  if (turn > MAX_TURN_RAD) turn = MAX_TURN_RAD;
  if (turn < -MAX_TURN_RAD) turn = -MAX_TURN_RAD;
  const double clear = free_ahead(scan, turn);
  memset(command, 0, sizeof *command);
  command->stamp = odometry->stamp;
  command->motion.kind = clew_msg_COMMAND_TURN_AND_STEP;
  command->motion.turn_rad = turn;
  command->motion.step_m = clear < 0.0 ? 0.0 : (clear < STEP_M ? clear : STEP_M);
}

#endif
