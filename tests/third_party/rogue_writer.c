/* SPDX-License-Identifier: Apache-2.0
 *
 * Writes scans into a run that has its own sense: scans of wrong sizes, with numbers that are none,
 * for the first ticks. For the tests: the run must turn them away and go on as if nothing had been.
 *
 *     rogue_writer --beside COMMAND...     becomes COMMAND once a copy of itself writes
 *
 * Meant for `clew run --prefix sense='rogue_writer --beside'`.
 */
#define _POSIX_C_SOURCE 200809L
#include <dds/dds.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/types.h>
#include <unistd.h>

#define HISTORY 2000
#include "Scan.h"
#include "component.h"

#define TICKS HISTORY

static void write_nonsense(dds_entity_t writer) {
  double ranges[7];
  clew_msg_Scan scan;
  memset(&scan, 0, sizeof scan);
  scan.range_max_m = 1.5;
  scan.ranges_m._buffer = ranges;
  for (unsigned i = 0; i < 7; ++i) ranges[i] = i % 2 == 0 ? NAN : -1.0;
  for (unsigned tick = 0; tick < TICKS; ++tick) {
    scan.stamp.tick = tick;
    scan.ranges_m._length = tick % 8;
    scan.ranges_m._maximum = 7;
    if (dds_write(writer, &scan) < 0) return;
  }
}

int main(int argc, char** argv) {
  const char* domain = getenv("CLEW_DOMAIN_ID");
  int ready[2];
  if (argc < 3 || strcmp(argv[1], "--beside") != 0 || domain == NULL || pipe(ready) != 0) {
    fprintf(stderr, "usage, in a run: rogue_writer --beside COMMAND...\n");
    return 2;
  }
  const pid_t child = fork();
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const dds_entity_t writer =
        open_output(open_participant(), &clew_msg_Scan_desc, "scan", DDS_RELIABILITY_RELIABLE);
    write_nonsense(writer);
    if (writer < 0 || write(ready[1], "", 1) != 1) return 1;
    for (;;) pause();
  }
  char byte;
  if (read(ready[0], &byte, 1) != 1) return 1;
  close(ready[0]);
  close(ready[1]);
  execvp(argv[2], argv + 2);
  perror(argv[2]);
  return 1;
}
