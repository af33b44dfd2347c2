/* SPDX-License-Identifier: Apache-2.0
 *
 * Somebody who clicks a goal in RViz, on Cyclone DDS: plain C, types by idlc, nothing of Clew. The
 * participant is configured as rmw_cyclonedds does with ROS_LOCALHOST_ONLY=1 (Humble).
 *
 *     cyclone_goal DOMAIN TOPIC FRAME
 *
 * Prints `ready` when somebody listens, and then publishes a goal for each line `X Y` of standard
 * input, until that is closed.
 */
#include <dds/dds.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ros_types.h"

#define CONFIGURATION                         \
  "<CycloneDDS><Domain><General><Interfaces>" \
  "<NetworkInterface address=\"127.0.0.1\"/></Interfaces></General></Domain></CycloneDDS>"

static dds_entity_t must(dds_entity_t entity, const char* what) {
  if (entity < 0) {
    fprintf(stderr, "cyclone_goal: %s: %s\n", what, dds_strretcode(-entity));
    exit(1);
  }
  return entity;
}

int main(int argc, char** argv) {
  if (argc != 4) {
    fprintf(stderr, "usage: cyclone_goal DOMAIN TOPIC FRAME\n");
    return 2;
  }
  const dds_domainid_t domain = (dds_domainid_t)atoi(argv[1]);
  must(dds_create_domain(domain, CONFIGURATION), "domain");
  const dds_entity_t participant = must(dds_create_participant(domain, NULL, NULL), "participant");
  const dds_entity_t topic = must(
      dds_create_topic(participant, &geometry_msgs_msg_dds__PoseStamped__desc, argv[2], NULL, NULL),
      "topic");
  const dds_data_representation_id_t xcdr1 = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 10);
  dds_qset_data_representation(qos, 1, &xcdr1);
  const dds_entity_t writer = must(dds_create_writer(participant, topic, qos, NULL), "writer");
  dds_delete_qos(qos);
  dds_publication_matched_status_t matched;
  do {
    dds_sleepfor(DDS_MSECS(10));
    must(dds_get_publication_matched_status(writer, &matched), "status");
  } while (matched.current_count == 0);
  printf("ready\n");
  fflush(stdout);
  char line[128];
  while (fgets(line, sizeof line, stdin) != NULL) {
    geometry_msgs_msg_dds__PoseStamped_ goal;
    memset(&goal, 0, sizeof goal);
    goal.header.frame_id = argv[3];
    goal.pose.orientation.w = 1.0;
    if (sscanf(line, "%lf %lf", &goal.pose.position.x, &goal.pose.position.y) != 2) continue;
    must(dds_write(writer, &goal), "write");
  }
  dds_delete(DDS_CYCLONEDDS_HANDLE);
  return 0;
}
