// SPDX-License-Identifier: Apache-2.0
// Preloaded, it sets the wall clock of the programs that it is preloaded into, while they run: by
// as many seconds as the file named by CLEW_CLOCK_OFFSET begins with, a `long`. As with the kernel,
// a wait until a time of that clock takes longer when the clock is set back meanwhile.
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

// For those whom it is preloaded into.
#pragma GCC visibility push(default)

enum { kLook_ns = 2000000, kSecond_ns = 1000000000 };

static const volatile long* offset_s;

__attribute__((constructor)) static void open_offset(void) {
  const char* name = getenv("CLEW_CLOCK_OFFSET");
  const int file = name == NULL ? -1 : open(name, O_RDONLY | O_CLOEXEC);
  if (file < 0) abort();
  void* page = mmap(NULL, sizeof(long), PROT_READ, MAP_SHARED, file, 0);
  if (page == MAP_FAILED) abort();
  offset_s = page;
  close(file);
}

int clock_gettime(clockid_t clock, struct timespec* now) {
  const int result = (int)syscall(SYS_clock_gettime, clock, now);
  if (result == 0 && clock == CLOCK_REALTIME && offset_s != NULL) now->tv_sec += *offset_s;
  return result;
}

static int is_over(const struct timespec* until) {
  struct timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  return now.tv_sec > until->tv_sec ||
         (now.tv_sec == until->tv_sec && now.tv_nsec >= until->tv_nsec);
}

// Looks at the clock every two milliseconds. Times of the monotonic clock are smaller by decades.
int pthread_cond_timedwait(pthread_cond_t* condition, pthread_mutex_t* mutex,
                           const struct timespec* until) {
  struct timespec look;
  clock_gettime(CLOCK_MONOTONIC, &look);
  if (until->tv_sec / 2 < look.tv_sec) {
    return pthread_cond_clockwait(condition, mutex, CLOCK_MONOTONIC, until);
  }
  while (!is_over(until)) {
    clock_gettime(CLOCK_MONOTONIC, &look);
    look.tv_nsec += kLook_ns;
    look.tv_sec += look.tv_nsec / kSecond_ns;
    look.tv_nsec %= kSecond_ns;
    const int result = pthread_cond_clockwait(condition, mutex, CLOCK_MONOTONIC, &look);
    if (result != ETIMEDOUT) return result;
  }
  return ETIMEDOUT;
}
