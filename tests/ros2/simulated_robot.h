/* SPDX-License-Identifier: Apache-2.0
 *
 * A robot of ROS 2 as its users have one: a disc between walls, with a laser all around, that moves
 * as it was last told and publishes what it sees. It has no watchdog of its own: whoever tells it
 * nothing more lets it drive on. Plain C, nothing of Clew; what publishes and listens is one DDS or
 * another.
 *
 *     PROGRAM DOMAIN NAMESPACE X Y HEADING [X0,Y0,X1,Y1]... [no-mount]
 *
 * Its pose is that of its odometry; then come walls. With no-mount it never says where its laser
 * is. Lines on standard input, until it is closed:
 *
 *  - `scan on|off|frozen`: frozen is the same scan again and again
 *  - `lag N`: scans are published N scans late, with the stamp of when they were measured
 *  - `odom on|off`
 *  - `skew SECONDS`: its clock is wrong by so much
 *  - `loss PERCENT`: so many of its samples are lost
 *  - `where`: is answered with a line as at the end
 *
 * Lines on standard output:
 *
 *  - `ready`
 *  - `command V W`: whenever what it is told changes
 *  - `where X Y HEADING V W CONTACTS COMMANDS ZEROS`: the last counts the newest commands, in a
 * row, that are to stand still
 */
#ifndef CLEW_TESTS_SIMULATED_ROBOT_H
#define CLEW_TESTS_SIMULATED_ROBOT_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { kBeams = 360, kMostWalls = 64 };
#define ROBOT_RADIUS_M 0.15
#define LASER_AHEAD_M 0.05
#define RANGE_MAX_M 4.0

struct robot_message {
  int32_t sec;
  uint32_t nanosec;
  char name_space[64];
  char odom_frame[80];
  char base_frame[80];
  char laser_frame[80];
  double x, y, heading, v, w;
  float ranges[kBeams]; /* from -pi, counter-clockwise */
};

/* What a DDS does for it. */
struct robot_wire {
  void* self;
  void (*publish_scan)(void* self, const struct robot_message* message);
  void (*publish_odometry)(void* self, const struct robot_message* message);
  /* Where the laser is, once. */
  void (*publish_mount)(void* self, const struct robot_message* message);
  /* The next command that has come; 0 if there is none. */
  int (*take_command)(void* self, double* v, double* w);
};

/* Runs the robot that the arguments describe until standard input is closed; returns the exit
 * status. */
int robot_main(int argc, char** argv, const struct robot_wire* wire);
/* The arguments that a DDS needs: 2 with a message if there are not enough. */
int robot_arguments(int argc, char** argv, int* domain, const char** name_space);

#ifdef __cplusplus
}
#endif
#endif
