/* SPDX-License-Identifier: Apache-2.0
 *
 * What a node of ROS 2 on Cyclone DDS would see of its domain: plain C, types by idlc, nothing of
 * Clew. The participant is configured as rmw_cyclonedds does with ROS_LOCALHOST_ONLY=1 (Humble).
 *
 *     cyclone_listener DOMAIN
 *
 * Prints a line for each writer that it discovers and each sample that it receives, the bytes in
 * hexadecimal, until standard input is closed:
 *     endpoint TOPIC TYPE GUID RELIABILITY DURABILITY USER_DATA
 *     sample TOPIC BYTES
 */
#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ros_types.h"

#define CONFIGURATION                         \
  "<CycloneDDS><Domain><General><Interfaces>" \
  "<NetworkInterface address=\"127.0.0.1\"/></Interfaces></General></Domain></CycloneDDS>"

struct topic {
  const char* name;
  const dds_topic_descriptor_t* type;
  int reliable;
  int transient_local;
};

/* As ros2 topic echo, RViz, tf2 and rmw_dds_common subscribe. */
static const struct topic topics[] = {
    {"rt/clock", &rosgraph_msgs_msg_dds__Clock__desc, 0, 0},
    {"rt/r1/scan", &sensor_msgs_msg_dds__LaserScan__desc, 0, 0},
    {"rt/r1/odom", &nav_msgs_msg_dds__Odometry__desc, 1, 0},
    {"rt/tf", &tf2_msgs_msg_dds__TFMessage__desc, 1, 0},
    {"rt/tf_static", &tf2_msgs_msg_dds__TFMessage__desc, 1, 1},
    {"rt/r1/chart", &nav_msgs_msg_dds__OccupancyGrid__desc, 1, 1},
    {"rt/r1/map_seen", &nav_msgs_msg_dds__OccupancyGrid__desc, 1, 1},
    {"rt/r1/plan", &nav_msgs_msg_dds__Path__desc, 1, 0},
    {"rt/r1/goal_pose", &geometry_msgs_msg_dds__PoseStamped__desc, 1, 1},
    {"rt/diagnostics", &diagnostic_msgs_msg_dds__DiagnosticArray__desc, 1, 0},
    {"rt/rosout", &rcl_interfaces_msg_dds__Log__desc, 1, 1},
    {"rt/r1/markers", &visualization_msgs_msg_dds__MarkerArray__desc, 1, 1},
    {"ros_discovery_info", &rmw_dds_common_msg_dds__ParticipantEntitiesInfo__desc, 1, 1}};
#define TOPICS (sizeof topics / sizeof topics[0])

static dds_entity_t must(dds_entity_t entity, const char* what) {
  if (entity < 0) {
    fprintf(stderr, "cyclone_listener: %s: %s\n", what, dds_strretcode(-entity));
    exit(1);
  }
  return entity;
}

static dds_entity_t open_reader(dds_entity_t participant, const struct topic* topic) {
  const dds_data_representation_id_t xcdr1 = DDS_DATA_REPRESENTATION_XCDR1;
  const dds_entity_t handle =
      must(dds_create_topic(participant, topic->type, topic->name, NULL, NULL), "topic");
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(
      qos, topic->reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, DDS_SECS(1));
  dds_qset_durability(
      qos, topic->transient_local ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1000);
  dds_qset_data_representation(qos, 1, &xcdr1);
  const dds_entity_t reader = must(dds_create_reader(participant, handle, qos, NULL), "reader");
  dds_delete_qos(qos);
  return reader;
}

static void print_hexadecimal(const unsigned char* bytes, size_t size) {
  for (size_t i = 0; i < size; ++i) printf("%02x", bytes[i]);
}

static void print_samples(dds_entity_t reader, const char* topic) {
  struct ddsi_serdata* samples[16];
  dds_sample_info_t infos[16];
  int count = 0;
  while ((count = dds_takecdr(reader, samples, 16, infos, DDS_ANY_STATE)) > 0) {
    for (int i = 0; i < count; ++i) {
      if (infos[i].valid_data) {
        const uint32_t size = ddsi_serdata_size(samples[i]);
        unsigned char* bytes = malloc(size);
        ddsi_serdata_to_ser(samples[i], 0, size, bytes);
        printf("sample %s ", topic);
        print_hexadecimal(bytes, size);
        printf("\n");
        free(bytes);
      }
      ddsi_serdata_unref(samples[i]);
    }
  }
}

static void print_endpoint(const dds_builtintopic_endpoint_t* endpoint) {
  dds_reliability_kind_t reliability = DDS_RELIABILITY_BEST_EFFORT;
  dds_durability_kind_t durability = DDS_DURABILITY_VOLATILE;
  dds_duration_t blocking = 0;
  void* data = NULL;
  size_t size = 0;
  dds_qget_reliability(endpoint->qos, &reliability, &blocking);
  dds_qget_durability(endpoint->qos, &durability);
  dds_qget_userdata(endpoint->qos, &data, &size);
  printf("endpoint %s %s ", endpoint->topic_name, endpoint->type_name);
  print_hexadecimal(endpoint->key.v, sizeof endpoint->key.v);
  printf(" %s %s %.*s\n", reliability == DDS_RELIABILITY_RELIABLE ? "reliable" : "best_effort",
         durability == DDS_DURABILITY_TRANSIENT_LOCAL ? "transient_local" : "volatile", (int)size,
         data == NULL ? "" : (const char*)data);
  dds_free(data);
}

static void print_endpoints(dds_entity_t reader) {
  void* samples[16] = {NULL};
  dds_sample_info_t infos[16];
  int count = 0;
  while ((count = dds_take(reader, samples, infos, 16, 16)) > 0) {
    for (int i = 0; i < count; ++i) {
      if (infos[i].valid_data && infos[i].instance_state == DDS_IST_ALIVE) {
        print_endpoint((const dds_builtintopic_endpoint_t*)samples[i]);
      }
    }
    dds_return_loan(reader, samples, count);
  }
}

int main(int argc, char** argv) {
  if (argc != 2) {
    fprintf(stderr, "usage: cyclone_listener DOMAIN\n");
    return 2;
  }
  const dds_domainid_t domain = (dds_domainid_t)atoi(argv[1]);
  must(dds_create_domain(domain, CONFIGURATION), "domain");
  dds_qos_t* qos = dds_create_qos();
  dds_qset_userdata(qos, "enclave=/;", strlen("enclave=/;"));
  const dds_entity_t participant = must(dds_create_participant(domain, qos, NULL), "participant");
  dds_delete_qos(qos);
  const dds_entity_t endpoints = must(
      dds_create_reader(participant, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, NULL, NULL), "writers");
  dds_entity_t readers[TOPICS];
  for (size_t i = 0; i < TOPICS; ++i) readers[i] = open_reader(participant, &topics[i]);
  printf("ready\n");
  struct pollfd input = {0, POLLIN, 0};
  while (poll(&input, 1, 5) == 0) {
    print_endpoints(endpoints);
    for (size_t i = 0; i < TOPICS; ++i) print_samples(readers[i], topics[i].name);
    fflush(stdout);
  }
  return 0;
}
