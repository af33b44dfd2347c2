/* SPDX-License-Identifier: Apache-2.0
 *
 * A sense component that knows nothing of Clew but its IDL, and sees nothing: for every state it
 * writes a scan of seven free cones, 15 degrees apart from 45 on the left. It takes the place of
 * `sense` in a graph:
 *
 *     sense: {exec: [./open_sense], behaviour: cones, range_m: 1.5}
 *
 *     open_sense [BEAMS]
 *
 * Another number of beams than 7 is a fault on purpose, for the tests.
 */
#include <dds/dds.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "Scan.h"
#include "State.h"
#include "clew/idl_fingerprint.h"

#define HISTORY 256
#define CONE_RAD 0.26179938779914941
#define RANGE_M 1.5
#define MAX_BEAMS 64

static dds_entity_t must(dds_entity_t entity, const char* what) {
  if (entity < 0) {
    fprintf(stderr, "open_sense: %s: %s\n", what, dds_strretcode(-entity));
    exit(1);
  }
  return entity;
}

static dds_qos_t* endpoint_qos(void) {
  const dds_data_representation_id_t xcdr1 = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, HISTORY);
  dds_qset_durability_service(qos, 0, DDS_HISTORY_KEEP_LAST, HISTORY, DDS_LENGTH_UNLIMITED,
                              DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  dds_qset_data_representation(qos, 1, &xcdr1);
  dds_qset_userdata(qos, CLEW_IDL_USER_DATA, strlen(CLEW_IDL_USER_DATA));
  return qos;
}

int main(int argc, char** argv) {
  const char* domain = getenv("CLEW_DOMAIN_ID");
  const long beams = argc > 1 ? atol(argv[1]) : 7;
  if (domain == NULL || beams < 0 || beams > MAX_BEAMS) {
    fprintf(stderr, "open_sense: needs CLEW_DOMAIN_ID, and at most %d beams\n", MAX_BEAMS);
    return 2;
  }
  const dds_entity_t participant =
      must(dds_create_participant((dds_domainid_t)atoi(domain), NULL, NULL), "participant");
  dds_qos_t* qos = endpoint_qos();
  const dds_entity_t states =
      must(dds_create_topic(participant, &clew_msg_State_desc, "state", NULL, NULL), "state");
  const dds_entity_t scans =
      must(dds_create_topic(participant, &clew_msg_Scan_desc, "scan", NULL, NULL), "scan");
  const dds_entity_t reader = must(dds_create_reader(participant, states, qos, NULL), "state");
  const dds_entity_t writer = must(dds_create_writer(participant, scans, qos, NULL), "scan");
  dds_delete_qos(qos);
  const dds_entity_t waitset = must(dds_create_waitset(participant), "waitset");
  must(dds_set_status_mask(reader, DDS_DATA_AVAILABLE_STATUS), "state");
  must(dds_waitset_attach(waitset, reader, 0), "state");

  double ranges_m[MAX_BEAMS];
  for (long i = 0; i < beams; ++i) ranges_m[i] = RANGE_M;
  clew_msg_Scan scan;
  memset(&scan, 0, sizeof scan);
  scan.bearing_first_rad = 3.0 * CONE_RAD;
  scan.bearing_step_rad = -CONE_RAD;
  scan.beam_width_rad = CONE_RAD;
  scan.range_max_m = RANGE_M;
  scan.ranges_m._buffer = ranges_m;
  scan.ranges_m._length = (uint32_t)beams;
  scan.ranges_m._maximum = MAX_BEAMS;

  clew_msg_State* state = clew_msg_State__alloc();
  for (;;) {
    void* sample = state;
    dds_sample_info_t info;
    const dds_return_t taken = dds_take(reader, &sample, &info, 1, 1);
    must(taken, "take");
    if (taken == 0) {
      must(dds_waitset_wait(waitset, NULL, 0, DDS_SECS(1)), "wait");
    } else if (info.valid_data) {
      scan.stamp = state->stamp;
      must(dds_write(writer, &scan), "write");
    }
  }
}
