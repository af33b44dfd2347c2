/* SPDX-License-Identifier: Apache-2.0
 *
 * Reads what a run's sense writes, as no component does: the run must not care.
 *
 *     rogue_reader persistent --beside COMMAND...    asks for more durability than there is
 *     rogue_reader never-takes --beside COMMAND...   has room for eight samples, and takes none
 */
#define _POSIX_C_SOURCE 200809L
#include <dds/dds.h>

#include "Scan.h"
#include "beside.h"
#include "component.h"

static int play(char** words) {
  const dds_entity_t participant = open_participant();
  const dds_entity_t topic =
      must(dds_create_topic(participant, &clew_msg_Scan_desc, "scan", NULL, NULL), "scan");
  dds_qos_t* qos = endpoint_qos(DDS_RELIABILITY_RELIABLE);
  if (strcmp(words[1], "persistent") == 0) {
    dds_qset_durability(qos, DDS_DURABILITY_PERSISTENT);
  } else {
    dds_qset_history(qos, DDS_HISTORY_KEEP_ALL, DDS_LENGTH_UNLIMITED);
    dds_qset_resource_limits(qos, 8, 1, 8);
  }
  must(dds_create_reader(participant, topic, qos, NULL), "reader");
  dds_delete_qos(qos);
  return 1;
}

int main(int argc, char** argv) {
  const int beside = words_before_beside(argc, argv);
  if (beside != 2) {
    fprintf(stderr, "usage, in a run: rogue_reader persistent|never-takes --beside COMMAND...\n");
    return 2;
  }
  return run_beside(argv + beside + 1, play, argv);
}
