/* SPDX-License-Identifier: Apache-2.0
 *
 * Reads one topic and writes what it receives to a file, sample by sample: four bytes of length,
 * the lowest first, then the serialised sample with its encapsulation. Plain C, Cyclone DDS, types
 * by idlc.
 *
 *     byte_reader TOPIC FILE [--leave-after SAMPLES]
 *
 * Needs CLEW_DOMAIN_ID and CYCLONEDDS_URI in its environment. Ends when the writer has gone.
 */
#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "Command.h"
#include "Event.h"
#include "Guidance.h"
#include "Landmark.h"
#include "Odometry.h"
#include "Scan.h"
#include "State.h"
#include "Target.h"
#include "clew/idl_fingerprint.h"

#define HISTORY 256

struct type_of_topic {
  const char* topic;
  const dds_topic_descriptor_t* type;
};

static dds_entity_t must(dds_entity_t entity, const char* what) {
  if (entity < 0) {
    fprintf(stderr, "byte_reader: %s: %s\n", what, dds_strretcode(-entity));
    exit(1);
  }
  return entity;
}

static const dds_topic_descriptor_t* find_type(const char* topic) {
  const struct type_of_topic types[] = {
      {"command", &clew_msg_Command_desc},   {"event", &clew_msg_Event_desc},
      {"guidance", &clew_msg_Guidance_desc}, {"landmark", &clew_msg_Landmark_desc},
      {"odometry", &clew_msg_Odometry_desc}, {"scan", &clew_msg_Scan_desc},
      {"state", &clew_msg_State_desc},       {"target", &clew_msg_Target_desc}};
  for (size_t i = 0; i < sizeof types / sizeof types[0]; ++i) {
    if (strcmp(types[i].topic, topic) == 0) return types[i].type;
  }
  fprintf(stderr, "byte_reader: no topic %s\n", topic);
  exit(2);
}

static dds_entity_t open_reader(const char* topic_name) {
  const dds_data_representation_id_t xcdr1 = DDS_DATA_REPRESENTATION_XCDR1;
  const char* domain = getenv("CLEW_DOMAIN_ID");
  if (domain == NULL) {
    fprintf(stderr, "byte_reader: CLEW_DOMAIN_ID is not set\n");
    exit(2);
  }
  const dds_entity_t participant =
      must(dds_create_participant((dds_domainid_t)atoi(domain), NULL, NULL), "participant");
  const dds_entity_t topic =
      must(dds_create_topic(participant, find_type(topic_name), topic_name, NULL, NULL), "topic");
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(qos, DDS_HISTORY_KEEP_ALL, DDS_LENGTH_UNLIMITED);
  dds_qset_resource_limits(qos, HISTORY, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  dds_qset_data_representation(qos, 1, &xcdr1);
  dds_qset_userdata(qos, CLEW_IDL_USER_DATA, strlen(CLEW_IDL_USER_DATA));
  const dds_entity_t reader = must(dds_create_reader(participant, topic, qos, NULL), "reader");
  dds_delete_qos(qos);
  return reader;
}

static void write_sample(FILE* file, struct ddsi_serdata* sample) {
  const uint32_t size = ddsi_serdata_size(sample);
  const unsigned char length[4] = {(unsigned char)size, (unsigned char)(size >> 8),
                                   (unsigned char)(size >> 16), (unsigned char)(size >> 24)};
  unsigned char* bytes = malloc(size);
  ddsi_serdata_to_ser(sample, 0, size, bytes);
  if (fwrite(length, 1, 4, file) != 4 || fwrite(bytes, 1, size, file) != size) exit(1);
  free(bytes);
}

/* Whether a writer is there, or has been and has gone. */
static int writer_has_gone(dds_entity_t reader) {
  dds_subscription_matched_status_t status;
  must(dds_get_subscription_matched_status(reader, &status), "status");
  return status.total_count > 0 && status.current_count == 0;
}

int main(int argc, char** argv) {
  if (argc < 3) {
    fprintf(stderr, "usage: byte_reader TOPIC FILE [--leave-after SAMPLES]\n");
    return 2;
  }
  const int leaves = argc == 5 && strcmp(argv[3], "--leave-after") == 0;
  long left = leaves ? atol(argv[4]) : -1;
  FILE* file = fopen(argv[2], "wb");
  if (file == NULL) return 1;
  const dds_entity_t reader = open_reader(argv[1]);
  while (left != 0) {
    /* Asked before the last look for samples: a writer that has gone writes nothing more. */
    const int gone = writer_has_gone(reader);
    struct ddsi_serdata* sample = NULL;
    dds_sample_info_t info;
    const dds_return_t taken = must(dds_takecdr(reader, &sample, 1, &info, DDS_ANY_STATE), "take");
    if (taken == 0 && gone) break;
    if (taken == 0) {
      dds_sleepfor(DDS_MSECS(1));
      continue;
    }
    if (info.valid_data) {
      write_sample(file, sample);
      if (left > 0) --left;
    }
    ddsi_serdata_unref(sample);
  }
  fclose(file);
  dds_delete(dds_get_participant(reader));
  return 0;
}
