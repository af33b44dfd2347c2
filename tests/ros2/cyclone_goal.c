/* SPDX-License-Identifier: Apache-2.0
 *
 * Somebody who clicks a goal in RViz, on Cyclone DDS: plain C, types by idlc, nothing of Clew. The
 * participant is configured as rmw_cyclonedds does with ROS_LOCALHOST_ONLY=1 (Humble).
 *
 *     cyclone_goal DOMAIN TOPIC FRAME [path]
 *
 * Prints `ready` when somebody listens, and then publishes a goal for each line `X Y` of standard
 * input, until that is closed. With path it publishes a path for each line `X Y X Y ...`, whose
 * poses name no frame of their own.
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

enum { kMostPoses = 16 };

/* A path along the numbers of a line. */
static void publish_path(dds_entity_t writer, char* frame, const char* line) {
  static geometry_msgs_msg_dds__PoseStamped_ poses[kMostPoses];
  nav_msgs_msg_dds__Path_ path;
  memset(&path, 0, sizeof path);
  memset(poses, 0, sizeof poses);
  int used = 0;
  unsigned count = 0;
  double x = 0.0, y = 0.0;
  for (; count < kMostPoses && sscanf(line, "%lf %lf%n", &x, &y, &used) == 2; line += used) {
    poses[count].header.frame_id = "";
    poses[count].pose.position.x = x;
    poses[count].pose.position.y = y;
    poses[count].pose.orientation.w = 1.0;
    ++count;
  }
  path.header.frame_id = frame;
  path.poses._buffer = poses;
  path.poses._length = path.poses._maximum = count;
  must(dds_write(writer, &path), "write");
}

static void publish_goal(dds_entity_t writer, char* frame, const char* line) {
  geometry_msgs_msg_dds__PoseStamped_ goal;
  memset(&goal, 0, sizeof goal);
  goal.header.frame_id = frame;
  goal.pose.orientation.w = 1.0;
  if (sscanf(line, "%lf %lf", &goal.pose.position.x, &goal.pose.position.y) != 2) return;
  must(dds_write(writer, &goal), "write");
}

int main(int argc, char** argv) {
  const int is_path = argc == 5 && strcmp(argv[4], "path") == 0;
  if (argc != 4 && !is_path) {
    fprintf(stderr, "usage: cyclone_goal DOMAIN TOPIC FRAME [path]\n");
    return 2;
  }
  const dds_domainid_t domain = (dds_domainid_t)atoi(argv[1]);
  must(dds_create_domain(domain, CONFIGURATION), "domain");
  const dds_entity_t participant = must(dds_create_participant(domain, NULL, NULL), "participant");
  const dds_topic_descriptor_t* const type =
      is_path ? &nav_msgs_msg_dds__Path__desc : &geometry_msgs_msg_dds__PoseStamped__desc;
  const dds_entity_t topic =
      must(dds_create_topic(participant, type, argv[2], NULL, NULL), "topic");
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
    (is_path ? publish_path : publish_goal)(writer, argv[3], line);
  }
  dds_delete(DDS_CYCLONEDDS_HANDLE);
  return 0;
}
