/* SPDX-License-Identifier: Apache-2.0
 *
 * What every component on Cyclone DDS needs: endpoints that match those of a run, and the inputs of
 * one tick together.
 */
#ifndef CLEW_EXAMPLE_COMPONENT_H
#define CLEW_EXAMPLE_COMPONENT_H

#include <dds/dds.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "TickStamp.h"
#include "clew/idl_fingerprint.h"

/* Samples of a topic that are kept for readers that come late. */
#ifndef HISTORY
#define HISTORY 256
#endif

/* An input: a topic's reader and its newest sample. Every sample begins with its stamp. */
struct input {
  dds_entity_t reader;
  void* sample;
};

static inline dds_entity_t must(dds_entity_t entity, const char* what) {
  if (entity < 0) {
    fprintf(stderr, "%s: %s\n", what, dds_strretcode(-entity));
    exit(1);
  }
  return entity;
}

/* The participant of a run. CYCLONEDDS_URI, which the run sets, keeps it on 127.0.0.1. */
static inline dds_entity_t open_participant(void) {
  const char* domain = getenv("CLEW_DOMAIN_ID");
  if (domain == NULL) {
    fprintf(stderr, "CLEW_DOMAIN_ID is not set; 'clew run' sets it\n");
    exit(2);
  }
  return must(dds_create_participant((dds_domainid_t)atoi(domain), NULL, NULL), "participant");
}

/* RELIABLE, TRANSIENT_LOCAL, XCDR1, and the fingerprint of the IDL that it was built from. */
static inline dds_qos_t* endpoint_qos(dds_reliability_kind_t reliability) {
  const dds_data_representation_id_t xcdr1 = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, reliability, DDS_SECS(1));
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, HISTORY);
  dds_qset_durability_service(qos, 0, DDS_HISTORY_KEEP_LAST, HISTORY, DDS_LENGTH_UNLIMITED,
                              DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  dds_qset_data_representation(qos, 1, &xcdr1);
  dds_qset_userdata(qos, CLEW_IDL_USER_DATA, strlen(CLEW_IDL_USER_DATA));
  return qos;
}

/* `sample` is one of that type, made by its ..._alloc(). */
static inline struct input open_input(dds_entity_t participant, const dds_topic_descriptor_t* type,
                                      const char* name, void* sample) {
  dds_qos_t* qos = endpoint_qos(DDS_RELIABILITY_RELIABLE);
  const dds_entity_t topic = must(dds_create_topic(participant, type, name, NULL, NULL), name);
  const struct input input = {must(dds_create_reader(participant, topic, qos, NULL), name), sample};
  must(dds_set_status_mask(input.reader, DDS_DATA_AVAILABLE_STATUS), name);
  dds_delete_qos(qos);
  return input;
}

static inline dds_entity_t open_output(dds_entity_t participant, const dds_topic_descriptor_t* type,
                                       const char* name, dds_reliability_kind_t reliability) {
  dds_qos_t* qos = endpoint_qos(reliability);
  const dds_entity_t topic = must(dds_create_topic(participant, type, name, NULL, NULL), name);
  const dds_entity_t writer = must(dds_create_writer(participant, topic, qos, NULL), name);
  dds_delete_qos(qos);
  return writer;
}

/* Waits, for a second at most, until an input has something. */
static inline void wait_for(const struct input* input) {
  const dds_entity_t waitset =
      must(dds_create_waitset(dds_get_participant(input->reader)), "waitset");
  must(dds_waitset_attach(waitset, input->reader, 0), "waitset");
  must(dds_waitset_wait(waitset, NULL, 0, DDS_SECS(1)), "wait");
  must(dds_delete(waitset), "waitset");
}

/* Waits for the next sample of an input; those of a topic come in order, one a tick. */
static inline void take_next(const struct input* input) {
  for (;;) {
    void* sample = input->sample;
    dds_sample_info_t info;
    const dds_return_t taken = must(dds_take(input->reader, &sample, &info, 1, 1), "take");
    if (taken == 1 && info.valid_data) return;
    if (taken == 0) wait_for(input);
  }
}

static inline uint64_t tick_of(const struct input* input) {
  return ((const clew_msg_TickStamp*)input->sample)->tick;
}

/* The inputs of the next tick. A component that was started anew finds the last samples of each
 * topic, which need not begin with the same tick: older ones are passed over. */
static inline void take_tick(const struct input* inputs, int count) {
  uint64_t tick = 0;
  for (int i = 0; i < count; ++i) {
    take_next(&inputs[i]);
    if (tick_of(&inputs[i]) > tick) tick = tick_of(&inputs[i]);
  }
  for (int i = 0; i < count; ++i) {
    while (tick_of(&inputs[i]) < tick) take_next(&inputs[i]);
  }
}

#endif
