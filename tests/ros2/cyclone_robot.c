/* SPDX-License-Identifier: Apache-2.0
 *
 * The simulated robot as a node on Cyclone DDS: types by idlc, the participant configured as
 * rmw_cyclonedds does with ROS_LOCALHOST_ONLY=1 (Humble). It takes geometry_msgs/Twist.
 */
#include <dds/dds.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ros_types.h"
#include "simulated_robot.h"

#define CONFIGURATION                         \
  "<CycloneDDS><Domain><General><Interfaces>" \
  "<NetworkInterface address=\"127.0.0.1\"/></Interfaces></General></Domain></CycloneDDS>"
#define PI 3.14159265358979323846

struct node {
  dds_entity_t participant, scan, odometry, mount, command;
};

static dds_entity_t must(dds_entity_t entity, const char* what) {
  if (entity < 0) {
    fprintf(stderr, "cyclone_robot: %s: %s\n", what, dds_strretcode(-entity));
    exit(1);
  }
  return entity;
}

static dds_qos_t* qos_of(int reliable, int transient_local, int depth) {
  const dds_data_representation_id_t xcdr1 = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
                       DDS_SECS(1));
  dds_qset_durability(qos,
                      transient_local ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, depth);
  dds_qset_data_representation(qos, 1, &xcdr1);
  return qos;
}

static dds_entity_t topic_of(const struct node* node, const dds_topic_descriptor_t* type,
                             const char* name) {
  return must(dds_create_topic(node->participant, type, name, NULL, NULL), name);
}

static dds_entity_t writer_of(const struct node* node, const dds_topic_descriptor_t* type,
                              const char* name, dds_qos_t* qos) {
  const dds_entity_t topic = topic_of(node, type, name);
  const dds_entity_t writer = must(dds_create_writer(node->participant, topic, qos, NULL), name);
  dds_delete_qos(qos);
  return writer;
}

static std_msgs_msg_dds__Header_ header_of(const struct robot_message* message, const char* frame) {
  const std_msgs_msg_dds__Header_ header = {{message->sec, message->nanosec}, (char*)frame};
  return header;
}

static void write_or_end(dds_entity_t writer, const void* sample) {
  must(dds_write(writer, sample), "write");
}

static void publish_scan(void* self, const struct robot_message* message) {
  float ranges[kBeams];
  memcpy(ranges, message->ranges, sizeof ranges);
  sensor_msgs_msg_dds__LaserScan_ sample;
  memset(&sample, 0, sizeof sample);
  sample.header = header_of(message, message->laser_frame);
  sample.angle_min = (float)-PI;
  sample.angle_max = (float)(PI - 2.0 * PI / kBeams);
  sample.angle_increment = (float)(2.0 * PI / kBeams);
  sample.scan_time = 0.05F;
  sample.range_min = 0.01F;
  sample.range_max = (float)RANGE_MAX_M;
  sample.ranges._buffer = ranges;
  sample.ranges._length = sample.ranges._maximum = kBeams;
  write_or_end(((struct node*)self)->scan, &sample);
}

static void publish_odometry(void* self, const struct robot_message* message) {
  nav_msgs_msg_dds__Odometry_ sample;
  memset(&sample, 0, sizeof sample);
  sample.header = header_of(message, message->odom_frame);
  sample.child_frame_id = (char*)message->base_frame;
  sample.pose.pose.position.x = message->x;
  sample.pose.pose.position.y = message->y;
  sample.pose.pose.orientation.z = sin(message->heading / 2.0);
  sample.pose.pose.orientation.w = cos(message->heading / 2.0);
  sample.twist.twist.linear.x = message->v;
  sample.twist.twist.angular.z = message->w;
  write_or_end(((struct node*)self)->odometry, &sample);
}

static void publish_mount(void* self, const struct robot_message* message) {
  geometry_msgs_msg_dds__TransformStamped_ transform;
  memset(&transform, 0, sizeof transform);
  transform.header = header_of(message, message->base_frame);
  transform.child_frame_id = (char*)message->laser_frame;
  transform.transform.translation.x = LASER_AHEAD_M;
  transform.transform.rotation.w = 1.0;
  tf2_msgs_msg_dds__TFMessage_ sample;
  memset(&sample, 0, sizeof sample);
  sample.transforms._buffer = &transform;
  sample.transforms._length = sample.transforms._maximum = 1;
  write_or_end(((struct node*)self)->mount, &sample);
}

static int take_command(void* self, double* v, double* w) {
  void* samples[1] = {NULL};
  dds_sample_info_t info;
  const dds_entity_t reader = ((struct node*)self)->command;
  while (dds_take(reader, samples, &info, 1, 1) == 1) {
    const geometry_msgs_msg_dds__Twist_* twist = samples[0];
    const int is_valid = info.valid_data;
    *v = twist->linear.x;
    *w = twist->angular.z;
    dds_return_loan(reader, samples, 1);
    if (is_valid) return 1;
  }
  return 0;
}

static void open_endpoints(struct node* node, const char* name_space) {
  char name[128];
  const char* const slash = *name_space == '\0' ? "" : "/";
  snprintf(name, sizeof name, "rt/%s%sscan", name_space, slash);
  node->scan = writer_of(node, &sensor_msgs_msg_dds__LaserScan__desc, name, qos_of(0, 0, 5));
  snprintf(name, sizeof name, "rt/%s%sodom", name_space, slash);
  node->odometry = writer_of(node, &nav_msgs_msg_dds__Odometry__desc, name, qos_of(1, 0, 10));
  node->mount =
      writer_of(node, &tf2_msgs_msg_dds__TFMessage__desc, "rt/tf_static", qos_of(1, 1, 1));
  snprintf(name, sizeof name, "rt/%s%scmd_vel", name_space, slash);
  const dds_entity_t topic = topic_of(node, &geometry_msgs_msg_dds__Twist__desc, name);
  dds_qos_t* qos = qos_of(1, 0, 10);
  node->command = must(dds_create_reader(node->participant, topic, qos, NULL), name);
  dds_delete_qos(qos);
}

int main(int argc, char** argv) {
  struct node node;
  int domain = 0;
  const char* name_space = NULL;
  const int wrong = robot_arguments(argc, argv, &domain, &name_space);
  if (wrong != 0) return wrong;
  must(dds_create_domain((dds_domainid_t)domain, CONFIGURATION), "domain");
  dds_qos_t* qos = dds_create_qos();
  dds_qset_userdata(qos, "enclave=/;", strlen("enclave=/;"));
  node.participant = must(dds_create_participant((dds_domainid_t)domain, qos, NULL), "participant");
  dds_delete_qos(qos);
  open_endpoints(&node, name_space);
  const struct robot_wire wire = {&node, publish_scan, publish_odometry, publish_mount,
                                  take_command};
  const int status = robot_main(argc, argv, &wire);
  dds_delete(DDS_CYCLONEDDS_HANDLE);
  return status;
}
