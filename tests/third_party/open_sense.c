/* SPDX-License-Identifier: Apache-2.0
 *
 * A sense component that knows nothing of Clew but its IDL, and sees nothing: for every state it
 * writes a scan of seven free cones, 15 degrees apart from 45 on the left. It takes the place of
 * `sense` in a graph:
 *
 *     sense: {exec: [./open_sense], behaviour: cones, range_m: 1.5}
 *
 *     open_sense [BEAMS [RANGE_M]]
 *
 * Another number of beams than 7 is a fault on purpose, for the tests, and so are readings of
 * RANGE_M that never change.
 */
#include "Scan.h"
#include "State.h"
#include "component.h"

#define CONE_RAD 0.26179938779914941
#define RANGE_M 1.5
#define MAX_BEAMS 64

int main(int argc, char** argv) {
  const long beams = argc > 1 ? atol(argv[1]) : 7;
  if (beams < 0 || beams > MAX_BEAMS) {
    fprintf(stderr, "open_sense: at most %d beams\n", MAX_BEAMS);
    return 2;
  }
  const dds_entity_t participant = open_participant();
  clew_msg_State* state = clew_msg_State__alloc();
  const struct input input = open_input(participant, &clew_msg_State_desc, "state", state);
  const dds_entity_t writer =
      open_output(participant, &clew_msg_Scan_desc, "scan", DDS_RELIABILITY_RELIABLE);

  double ranges_m[MAX_BEAMS];
  for (long i = 0; i < beams; ++i) ranges_m[i] = argc > 2 ? atof(argv[2]) : RANGE_M;
  clew_msg_Scan scan;
  memset(&scan, 0, sizeof scan);
  scan.bearing_first_rad = 3.0 * CONE_RAD;
  scan.bearing_step_rad = -CONE_RAD;
  scan.beam_width_rad = CONE_RAD;
  scan.range_max_m = RANGE_M;
  scan.ranges_m._buffer = ranges_m;
  scan.ranges_m._length = (uint32_t)beams;
  scan.ranges_m._maximum = MAX_BEAMS;
  for (;;) {
    take_tick(&input, 1);
    scan.stamp = state->stamp;
    must(dds_write(writer, &scan), "write");
  }
}
