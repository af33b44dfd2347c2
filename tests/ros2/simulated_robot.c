/* SPDX-License-Identifier: Apache-2.0 */
#include "simulated_robot.h"

#include <math.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#define PI 3.14159265358979323846
enum { kStep_ms = 5, kOdometryEvery = 4, kScanEvery = 10, kMostLag = 16 };

struct wall {
  double x0, y0, x1, y1;
};

struct robot {
  struct robot_message message;
  struct wall walls[kMostWalls];
  int wall_count;
  double told_v, told_w;
  int contacts, in_contact;
  unsigned commands, zeros;             /* zeros: of the newest commands, in a row */
  struct robot_message scans[kMostLag]; /* the newest, as a ring */
  unsigned scan_count;
  int scan_lag; /* scans that are measured between one and its publication */
  int scan_on, scan_frozen, odometry_on, loss_percent, input_open;
  long skew_s;
  char line[128];
  size_t line_length;
};

static double now_s(clockid_t clock) {
  struct timespec now;
  clock_gettime(clock, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static double distance_to_wall(const struct wall* wall, double x, double y) {
  const double dx = wall->x1 - wall->x0, dy = wall->y1 - wall->y0;
  double t = ((x - wall->x0) * dx + (y - wall->y0) * dy) / (dx * dx + dy * dy);
  t = t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
  return hypot(wall->x0 + t * dx - x, wall->y0 + t * dy - y);
}

static int is_free(const struct robot* robot, double x, double y) {
  for (int i = 0; i < robot->wall_count; ++i) {
    if (distance_to_wall(&robot->walls[i], x, y) < ROBOT_RADIUS_M) return 0;
  }
  return 1;
}

static double ray(const struct robot* robot, double x, double y, double angle) {
  const double cx = cos(angle), cy = sin(angle);
  double nearest = INFINITY;
  for (int i = 0; i < robot->wall_count; ++i) {
    const struct wall* wall = &robot->walls[i];
    const double dx = wall->x1 - wall->x0, dy = wall->y1 - wall->y0;
    const double cross = cx * dy - cy * dx;
    if (fabs(cross) < 1e-12) continue;
    const double along = ((wall->x0 - x) * dy - (wall->y0 - y) * dx) / cross;
    const double part = ((wall->x0 - x) * cy - (wall->y0 - y) * cx) / cross;
    if (along > 0.0 && part >= 0.0 && part <= 1.0 && along < nearest) nearest = along;
  }
  return nearest <= RANGE_MAX_M ? nearest : INFINITY;
}

/* As its motors do what they are told: at 2 m/s^2 and 6 rad/s^2. */
static double towards(double value, double told, double step) {
  return told > value + step ? value + step : told < value - step ? value - step : told;
}

static void move(struct robot* robot, double dt) {
  struct robot_message* m = &robot->message;
  m->v = towards(m->v, robot->told_v, 2.0 * dt);
  m->w = towards(m->w, robot->told_w, 6.0 * dt);
  m->heading = remainder(m->heading + m->w * dt, 2.0 * PI);
  const double x = m->x + m->v * dt * cos(m->heading);
  const double y = m->y + m->v * dt * sin(m->heading);
  if (is_free(robot, x, y)) {
    m->x = x;
    m->y = y;
    robot->in_contact = 0;
  } else {
    robot->contacts += robot->in_contact == 0;
    robot->in_contact = 1;
    m->v = 0.0;
  }
}

static void stamp(struct robot* robot) {
  struct timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  robot->message.sec = (int32_t)(now.tv_sec + robot->skew_s);
  robot->message.nanosec = (uint32_t)now.tv_nsec;
}

static void scan(struct robot* robot) {
  struct robot_message* m = &robot->message;
  const double x = m->x + LASER_AHEAD_M * cos(m->heading);
  const double y = m->y + LASER_AHEAD_M * sin(m->heading);
  for (int i = 0; i < kBeams; ++i) {
    m->ranges[i] = (float)ray(robot, x, y, m->heading - PI + i * 2.0 * PI / kBeams);
  }
}

static void tell_where(const struct robot* robot) {
  const struct robot_message* m = &robot->message;
  printf("where %.4f %.4f %.4f %.4f %.4f %d %u %u\n", m->x, m->y, m->heading, m->v, m->w,
         robot->contacts, robot->commands, robot->zeros);
  fflush(stdout);
}

static void obey(struct robot* robot, const char* line) {
  char word[16] = "", value[16] = "";
  const int words = sscanf(line, "%15s %15s", word, value);
  if (strcmp(word, "scan") == 0 && words == 2) {
    robot->scan_on = strcmp(value, "off") != 0;
    robot->scan_frozen = strcmp(value, "frozen") == 0;
  } else if (strcmp(word, "odom") == 0 && words == 2) {
    robot->odometry_on = strcmp(value, "off") != 0;
  } else if (strcmp(word, "skew") == 0 && words == 2) {
    robot->skew_s = atol(value);
  } else if (strcmp(word, "lag") == 0 && words == 2 && atoi(value) < kMostLag) {
    robot->scan_lag = atoi(value);
  } else if (strcmp(word, "loss") == 0 && words == 2) {
    robot->loss_percent = atoi(value);
  } else if (strcmp(word, "where") == 0) {
    tell_where(robot);
  } else {
    fprintf(stderr, "simulated robot: no such order: %s\n", line);
  }
}

static void read_orders(struct robot* robot) {
  struct pollfd input = {0, POLLIN, 0};
  while (robot->input_open && poll(&input, 1, 0) > 0) {
    char c = 0;
    if (read(0, &c, 1) != 1) {
      robot->input_open = 0;
    } else if (c == '\n' || robot->line_length + 1 == sizeof robot->line) {
      robot->line[robot->line_length] = '\0';
      robot->line_length = 0;
      obey(robot, robot->line);
    } else {
      robot->line[robot->line_length++] = c;
    }
  }
}

static void take_commands(struct robot* robot, const struct robot_wire* wire) {
  double v = 0.0, w = 0.0;
  while (wire->take_command(wire->self, &v, &w)) {
    ++robot->commands;
    robot->zeros = v == 0.0 && w == 0.0 ? robot->zeros + 1 : 0;
    if (v == robot->told_v && w == robot->told_w) continue;
    robot->told_v = v;
    robot->told_w = w;
    printf("command %.4f %.4f\n", v, w);
    fflush(stdout);
  }
}

static int is_lost(const struct robot* robot) { return rand() % 100 < robot->loss_percent; }

static void publish(struct robot* robot, const struct robot_wire* wire, long step) {
  if (step % kOdometryEvery == 0 && robot->odometry_on && !is_lost(robot)) {
    stamp(robot);
    wire->publish_odometry(wire->self, &robot->message);
  }
  if (step % kScanEvery != 0 || !robot->scan_on || is_lost(robot)) return;
  if (!robot->scan_frozen || robot->scan_count == 0) {
    stamp(robot);
    scan(robot);
    robot->scans[robot->scan_count++ % kMostLag] = robot->message;
  }
  const unsigned newest = robot->scan_count - 1, lag = (unsigned)robot->scan_lag;
  wire->publish_scan(wire->self, &robot->scans[(newest > lag ? newest - lag : 0) % kMostLag]);
}

int robot_arguments(int argc, char** argv, int* domain, const char** name_space) {
  if (argc < 6 || argc - 6 > kMostWalls) {
    fprintf(stderr, "usage: %s DOMAIN NAMESPACE X Y HEADING [X0,Y0,X1,Y1]... [no-mount]\n",
            argv[0]);
    return 2;
  }
  *domain = atoi(argv[1]);
  *name_space = argv[2];
  return 0;
}

static void name_frames(struct robot_message* message, const char* name_space) {
  const char* const slash = *name_space == '\0' ? "" : "/";
  snprintf(message->name_space, sizeof message->name_space, "%s", name_space);
  snprintf(message->odom_frame, sizeof message->odom_frame, "%s%sodom", name_space, slash);
  snprintf(message->base_frame, sizeof message->base_frame, "%s%sbase_link", name_space, slash);
  snprintf(message->laser_frame, sizeof message->laser_frame, "%s%slaser", name_space, slash);
}

int robot_main(int argc, char** argv, const struct robot_wire* wire) {
  static struct robot robot;
  robot.scan_on = robot.odometry_on = robot.input_open = 1;
  name_frames(&robot.message, argv[2]);
  robot.message.x = atof(argv[3]);
  robot.message.y = atof(argv[4]);
  robot.message.heading = atof(argv[5]);
  int has_mount = 1;
  for (int i = 6; i < argc; ++i) {
    if (strcmp(argv[i], "no-mount") == 0) {
      has_mount = 0;
      continue;
    }
    struct wall* wall = &robot.walls[robot.wall_count++];
    if (sscanf(argv[i], "%lf,%lf,%lf,%lf", &wall->x0, &wall->y0, &wall->x1, &wall->y1) != 4) {
      fprintf(stderr, "simulated robot: no wall: %s\n", argv[i]);
      return 2;
    }
  }
  stamp(&robot);
  if (has_mount) wire->publish_mount(wire->self, &robot.message);
  printf("ready\n");
  fflush(stdout);
  const double begin_s = now_s(CLOCK_MONOTONIC);
  /* A machine that is busy makes it late, not slow. */
  for (long step = 0; robot.input_open; ++step) {
    while (now_s(CLOCK_MONOTONIC) < begin_s + 1e-3 * kStep_ms * (double)step) usleep(500);
    read_orders(&robot);
    take_commands(&robot, wire);
    move(&robot, 1e-3 * kStep_ms);
    publish(&robot, wire, step);
  }
  take_commands(&robot, wire);
  tell_where(&robot);
  return 0;
}
