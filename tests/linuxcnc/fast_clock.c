/* Preloaded into LinuxCNC's real-time process: a sleep until a moment ends CAPSTAN_CLOCK_RATE times sooner,
   counted from the first such sleep of its thread. Motion still counts one servo period a turn, so that what
   it does is the same, only earlier. */
#define _GNU_SOURCE
#include <stdlib.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

static double rate(void) {
  static double known = 0.0;
  if (known <= 0.0) {
    const char* text = getenv("CAPSTAN_CLOCK_RATE");
    known = text != NULL ? atof(text) : 1.0;
    if (!(known >= 1.0)) known = 1.0;
  }
  return known;
}

/* Stands in for the C library's, so it is seen from outside whatever the build hides. */
__attribute__((visibility("default"))) int clock_nanosleep(clockid_t clock, int flags,
                                                           const struct timespec* until,
                                                           struct timespec* left) {
  static __thread struct timespec first;
  static __thread int begun = 0;
  struct timespec moment = *until;
  if ((flags & TIMER_ABSTIME) != 0) {
    if (!begun) {
      first = moment;
      begun = 1;
    }
    const double after =
        ((double)(moment.tv_sec - first.tv_sec) + 1e-9 * (double)(moment.tv_nsec - first.tv_nsec)) / rate();
    const double nanoseconds = (double)first.tv_nsec + 1e9 * (after - (double)(long)after);
    moment.tv_sec = first.tv_sec + (long)after;
    moment.tv_nsec = (long)nanoseconds;
    while (moment.tv_nsec >= 1000000000L) {
      moment.tv_nsec -= 1000000000L;
      ++moment.tv_sec;
    }
  }
  /* The kernel tells its errors by the result, as this function does. */
  return syscall(SYS_clock_nanosleep, clock, flags, &moment, left) == 0 ? 0 : 4 /* EINTR */;
}
