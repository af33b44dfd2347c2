/* SPDX-License-Identifier: Apache-2.0
 *
 * A publisher on a DDS domain that no run of Clew holds: twenty samples a second on `scan`, without
 * a word of whose they are, on `clock`, whose type is none of Clew's topics, and on `odd`, where
 * every other sample is no message of the type that its writer names. Plain C, Cyclone DDS, types
 * by idlc. Needs CLEW_DOMAIN_ID and CYCLONEDDS_URI in its environment; ends when it is
 * killed.
 */
#include <dds/dds.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "Scan.h"
#include "TickStamp.h"

static dds_entity_t must(dds_entity_t entity, const char* what) {
  if (entity < 0) {
    fprintf(stderr, "lone_writer: %s: %s\n", what, dds_strretcode(-entity));
    exit(1);
  }
  return entity;
}

static dds_entity_t open_writer(dds_entity_t participant, const dds_topic_descriptor_t* type,
                                const char* name) {
  const dds_data_representation_id_t xcdr1 = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_BEST_EFFORT, 0);
  dds_qset_data_representation(qos, 1, &xcdr1);
  const dds_entity_t topic = must(dds_create_topic(participant, type, name, NULL, NULL), name);
  const dds_entity_t writer = must(dds_create_writer(participant, topic, qos, NULL), name);
  dds_delete_qos(qos);
  return writer;
}

int main(void) {
  const char* domain = getenv("CLEW_DOMAIN_ID");
  if (domain == NULL) {
    fprintf(stderr, "lone_writer: CLEW_DOMAIN_ID is not set\n");
    return 2;
  }
  const dds_entity_t participant =
      must(dds_create_participant((dds_domainid_t)atoi(domain), NULL, NULL), "participant");
  const dds_entity_t scans = open_writer(participant, &clew_msg_Scan_desc, "scan");
  const dds_entity_t clocks = open_writer(participant, &clew_msg_TickStamp_desc, "clock");
  const dds_entity_t odd_scans = open_writer(participant, &clew_msg_Scan_desc, "odd");
  /* A second participant may say of other bytes that they are scans. */
  dds_topic_descriptor_t no_scan = clew_msg_TickStamp_desc;
  no_scan.m_typename = clew_msg_Scan_desc.m_typename;
  const dds_entity_t other =
      must(dds_create_participant((dds_domainid_t)atoi(domain), NULL, NULL), "participant");
  const dds_entity_t odd_stamps = open_writer(other, &no_scan, "odd");
  double ranges[3] = {0.5, 1.0, 1.25};
  clew_msg_Scan scan;
  memset(&scan, 0, sizeof scan);
  scan.range_max_m = 1.5;
  scan.ranges_m._buffer = ranges;
  scan.ranges_m._length = scan.ranges_m._maximum = 3;
  printf("writing\n");
  fflush(stdout);
  for (;;) {
    must(dds_write(scans, &scan), "scan");
    must(dds_write(clocks, &scan.stamp), "clock");
    must(dds_write(odd_scans, &scan), "odd");
    must(dds_write(odd_stamps, &scan.stamp), "odd");
    ++scan.stamp.tick;
    ++scan.stamp.sequence_number;
    dds_sleepfor(DDS_MSECS(50));
  }
}
