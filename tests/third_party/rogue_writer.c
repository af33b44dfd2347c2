/* SPDX-License-Identifier: Apache-2.0
 *
 * Writes into a run what is another's to write: the run must turn it away and go on as if nothing
 * had been.
 *
 *     rogue_writer scan --beside COMMAND...     scans of wrong sizes, with numbers that are none
 *     rogue_writer STAGE --beside COMMAND...    commands, in the name of that stage
 */
#define _POSIX_C_SOURCE 200809L
#include <dds/dds.h>
#include <math.h>

#define HISTORY 2000
#include "Command.h"
#include "Scan.h"
#include "beside.h"
#include "component.h"

#define TICKS HISTORY

static int write_scans(void) {
  double ranges[7];
  clew_msg_Scan scan;
  memset(&scan, 0, sizeof scan);
  scan.range_max_m = 1.5;
  scan.ranges_m._buffer = ranges;
  for (unsigned i = 0; i < 7; ++i) ranges[i] = i % 2 == 0 ? NAN : -1.0;
  const dds_entity_t writer =
      open_output(open_participant(), &clew_msg_Scan_desc, "scan", DDS_RELIABILITY_RELIABLE);
  for (unsigned tick = 0; tick < TICKS; ++tick) {
    scan.stamp.tick = tick;
    scan.ranges_m._length = tick % 8;
    scan.ranges_m._maximum = 7;
    if (dds_write(writer, &scan) < 0) return 0;
  }
  return 1;
}

/* The robot would go on the spot in circles. */
static int write_commands(const char* stage) {
  char user_data[256];
  clew_msg_Command command;
  memset(&command, 0, sizeof command);
  command.motion.turn_rad = 0.3;
  snprintf(user_data, sizeof user_data, "%sclew_stage=%s;", CLEW_IDL_USER_DATA, stage);
  const dds_entity_t participant = open_participant();
  const dds_entity_t topic =
      must(dds_create_topic(participant, &clew_msg_Command_desc, "command", NULL, NULL), "command");
  dds_qos_t* qos = endpoint_qos(DDS_RELIABILITY_RELIABLE);
  dds_qset_userdata(qos, user_data, strlen(user_data));
  const dds_entity_t writer = must(dds_create_writer(participant, topic, qos, NULL), "command");
  dds_delete_qos(qos);
  for (unsigned tick = 0; tick < TICKS; ++tick) {
    command.stamp.tick = tick;
    command.stamp.sequence_number = tick;
    if (dds_write(writer, &command) < 0) return 0;
  }
  return 1;
}

static int play(char** words) {
  return strcmp(words[1], "scan") == 0 ? write_scans() : write_commands(words[1]);
}

int main(int argc, char** argv) {
  const int beside = words_before_beside(argc, argv);
  if (beside != 2) {
    fprintf(stderr, "usage, in a run: rogue_writer scan|STAGE --beside COMMAND...\n");
    return 2;
  }
  return run_beside(argv + beside + 1, play, argv);
}
