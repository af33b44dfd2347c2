/* SPDX-License-Identifier: Apache-2.0
 *
 * A stranger in a run: `PROGRAM ... --beside COMMAND...` becomes COMMAND, a component of the run,
 * once a copy of itself is on the wire. The copy dies with it. Meant for
 * `clew run --prefix sense='PROGRAM ... --beside'`.
 */
#ifndef CLEW_TEST_BESIDE_H
#define CLEW_TEST_BESIDE_H

#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/types.h>
#include <unistd.h>

/* The words before `--beside`, the program's own name included; 0 if it is used in another way. */
static inline int words_before_beside(int argc, char** argv) {
  for (int i = 1; i + 1 < argc; ++i) {
    if (strcmp(argv[i], "--beside") == 0) return i;
  }
  return 0;
}

/* Forks a copy that plays the stranger: it gets on the wire, and returns whether it could. Does not
 * return but in the copy's place on failure. */
static inline int run_beside(char** command, int (*play)(char** words), char** words) {
  int ready[2];
  if (pipe(ready) != 0) return 1;
  if (fork() == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (!play(words) || write(ready[1], "", 1) != 1) return 1;
    for (;;) pause();
  }
  char byte;
  close(ready[1]);
  if (read(ready[0], &byte, 1) != 1) return 1;
  close(ready[0]);
  execvp(command[0], command);
  perror(command[0]);
  return 1;
}

#endif
