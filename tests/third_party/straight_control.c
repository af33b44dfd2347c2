/* SPDX-License-Identifier: Apache-2.0
 *
 * A control component that knows nothing of Clew but its IDL: plain C, Cyclone DDS, code generated
 * by idlc. It takes the place of `control` in a graph:
 *
 *     control: {exec: [./straight_control]}
 *
 * The run hands over CLEW_DOMAIN_ID and CYCLONEDDS_URI. For every tick it reads one odometry, one
 * scan and one guidance (or target), and writes one command with the same tick: turn toward the
 * target, step as far as the cones show free.
 *
 *     straight_control [--without-guidance] [--nan-at TICK] [--best-effort] [--crash-at TICK]
 *                      [--skip TICK] [--write-as target|state]
 *
 * All but the first misbehave on purpose, for the tests. --write-as gives the topic `command`
 * samples of another size, those of Target (shorter) or of State (longer), under the name of
 * Command's type.
 */
#include <dds/dds.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "Command.h"
#include "Guidance.h"
#include "Odometry.h"
#include "Scan.h"
#include "State.h"
#include "Target.h"
#include "clew/idl_fingerprint.h"

#define HISTORY 256
#define STEP_M 0.1
#define MAX_TURN_RAD 0.16
#define MARGIN_M 0.02
#define PI 3.14159265358979323846

struct options {
  int without_guidance;
  int best_effort;
  long nan_at;
  long crash_at;
  long skip;
  const char* write_as;
};

/* A sample of any of the types that it may write; each begins with its stamp. */
union output {
  clew_msg_Command command;
  clew_msg_State state;
  clew_msg_Target target;
};

static struct options read_options(int argc, char** argv) {
  struct options options = {0, 0, -1, -1, -1, ""};
  for (int i = 1; i < argc; ++i) {
    if (strcmp(argv[i], "--without-guidance") == 0) options.without_guidance = 1;
    if (strcmp(argv[i], "--best-effort") == 0) options.best_effort = 1;
    if (strcmp(argv[i], "--nan-at") == 0 && i + 1 < argc) options.nan_at = atol(argv[++i]);
    if (strcmp(argv[i], "--crash-at") == 0 && i + 1 < argc) options.crash_at = atol(argv[++i]);
    if (strcmp(argv[i], "--skip") == 0 && i + 1 < argc) options.skip = atol(argv[++i]);
    if (strcmp(argv[i], "--write-as") == 0 && i + 1 < argc) options.write_as = argv[++i];
  }
  return options;
}

static dds_entity_t must(dds_entity_t entity, const char* what) {
  if (entity < 0) {
    fprintf(stderr, "straight_control: %s: %s\n", what, dds_strretcode(-entity));
    exit(1);
  }
  return entity;
}

/* RELIABLE, TRANSIENT_LOCAL, KEEP_LAST, XCDR1, and the fingerprint of the IDL it was built from. */
static dds_qos_t* endpoint_qos(int best_effort) {
  const dds_data_representation_id_t xcdr1 = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, best_effort ? DDS_RELIABILITY_BEST_EFFORT : DDS_RELIABILITY_RELIABLE,
                       DDS_SECS(1));
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, HISTORY);
  dds_qset_durability_service(qos, 0, DDS_HISTORY_KEEP_LAST, HISTORY, DDS_LENGTH_UNLIMITED,
                              DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  dds_qset_data_representation(qos, 1, &xcdr1);
  dds_qset_userdata(qos, CLEW_IDL_USER_DATA, strlen(CLEW_IDL_USER_DATA));
  return qos;
}

static dds_entity_t open_reader(dds_entity_t participant, const dds_topic_descriptor_t* type,
                                const char* name, const dds_qos_t* qos, dds_entity_t waitset) {
  const dds_entity_t topic = must(dds_create_topic(participant, type, name, NULL, NULL), name);
  const dds_entity_t reader = must(dds_create_reader(participant, topic, qos, NULL), name);
  must(dds_set_status_mask(reader, DDS_DATA_AVAILABLE_STATUS), name);
  must(dds_waitset_attach(waitset, reader, 0), name);
  return reader;
}

/* Command's type, or another one under its name. */
static dds_topic_descriptor_t output_type(const char* write_as) {
  const dds_topic_descriptor_t* type = &clew_msg_Command_desc;
  if (strcmp(write_as, "target") == 0) type = &clew_msg_Target_desc;
  if (strcmp(write_as, "state") == 0) type = &clew_msg_State_desc;
  dds_topic_descriptor_t named = *type;
  named.m_typename = clew_msg_Command_desc.m_typename;
  return named;
}

/* Waits for the next sample of a reader; samples of a topic come in order, one a tick. */
static void take_next(dds_entity_t waitset, dds_entity_t reader, void* sample) {
  dds_sample_info_t info;
  for (;;) {
    const dds_return_t taken = dds_take(reader, &sample, &info, 1, 1);
    must(taken, "take");
    if (taken == 1 && info.valid_data) return;
    if (taken == 0) must(dds_waitset_wait(waitset, NULL, 0, DDS_SECS(1)), "wait");
  }
}

static double free_ahead(const clew_msg_Scan* scan, double turn_rad) {
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

static void decide(const clew_msg_Odometry* odometry, const clew_msg_Scan* scan, double target_x_m,
                   double target_y_m, clew_msg_Command* command) {
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

int main(int argc, char** argv) {
  const struct options options = read_options(argc, argv);
  const char* domain = getenv("CLEW_DOMAIN_ID");
  if (domain == NULL) {
    fprintf(stderr, "straight_control: CLEW_DOMAIN_ID is not set; 'clew run' sets it\n");
    return 2;
  }
  const dds_entity_t participant =
      must(dds_create_participant((dds_domainid_t)atoi(domain), NULL, NULL), "participant");
  const dds_entity_t waitset = must(dds_create_waitset(participant), "waitset");
  dds_qos_t* qos = endpoint_qos(0);
  const dds_entity_t odometry_reader =
      open_reader(participant, &clew_msg_Odometry_desc, "odometry", qos, waitset);
  const dds_entity_t scan_reader =
      open_reader(participant, &clew_msg_Scan_desc, "scan", qos, waitset);
  const dds_entity_t goal_reader =
      options.without_guidance
          ? open_reader(participant, &clew_msg_Target_desc, "target", qos, waitset)
          : open_reader(participant, &clew_msg_Guidance_desc, "guidance", qos, waitset);
  dds_qos_t* writer_qos = endpoint_qos(options.best_effort);
  const dds_topic_descriptor_t type = output_type(options.write_as);
  const dds_entity_t topic =
      must(dds_create_topic(participant, &type, "command", NULL, NULL), "command");
  const dds_entity_t writer =
      must(dds_create_writer(participant, topic, writer_qos, NULL), "command");
  dds_delete_qos(qos);
  dds_delete_qos(writer_qos);

  clew_msg_Odometry* odometry = clew_msg_Odometry__alloc();
  clew_msg_Scan* scan = clew_msg_Scan__alloc();
  clew_msg_Guidance* guidance = clew_msg_Guidance__alloc();
  clew_msg_Target* target = clew_msg_Target__alloc();
  for (;;) {
    union output output;
    memset(&output, 0, sizeof output);
    take_next(waitset, odometry_reader, odometry);
    take_next(waitset, scan_reader, scan);
    if (options.without_guidance) {
      take_next(waitset, goal_reader, target);
      decide(odometry, scan, target->x_m, target->y_m, &output.command);
    } else {
      take_next(waitset, goal_reader, guidance);
      decide(odometry, scan, guidance->target_x_m, guidance->target_y_m, &output.command);
    }
    const long tick = (long)odometry->stamp.tick;
    if (tick == options.nan_at) output.command.motion.step_m = NAN;
    if (tick == options.crash_at) abort();
    if (tick == options.skip) continue;
    must(dds_write(writer, &output), "write");
  }
}
