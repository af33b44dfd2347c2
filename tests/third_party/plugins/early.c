/* SPDX-License-Identifier: Apache-2.0 */
/* A library whose code runs as soon as it is loaded: it leaves a file that tells so. */
#include <stdio.h>
#include <stdlib.h>

__attribute__((constructor)) static void run_early(void) {
  const char* const path = getenv("CLEW_EARLY_FILE");
  FILE* const file = path == NULL ? NULL : fopen(path, "w");
  if (file != NULL) fclose(file);
}
