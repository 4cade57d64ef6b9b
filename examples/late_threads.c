/* One session of late binding in two threads of a control: one binds, one shows what comes of it.
 *
 *     late_threads PLAN MACHINE TOOL_TABLE DEADLINE_MS [stop]
 *
 * A session serves one thread at a time: a lock of the control's own stands around it. While a bind runs, the
 * thread of the screen asks nothing of the session. It reads the progress that the bind reports, from memory
 * of the control's, and may call capstan_late_stop, which needs no lock. With `stop` it does so as soon as
 * the bind has begun, as an operator would; where all was checked by then, the program is given all the same.
 */
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/capstan_late.h"

/* What both threads see. `session_lock` is held around each call of the session but capstan_late_stop;
 * `lock` around what stands below it, for no longer than it takes to read. */
struct control {
  capstan_late* session;
  pthread_mutex_t session_lock;
  const char* plan;
  size_t size;
  unsigned deadline_ms;

  pthread_mutex_t lock;
  pthread_cond_t changed;
  char stage[64];
  double fraction;  /* of the stage */
  unsigned reports; /* of progress */
  int done;
  capstan_late_code code;
};

static void progress(const char* stage, double fraction, void* user) {
  struct control* c = user;
  pthread_mutex_lock(&c->lock);
  c->fraction = fraction;
  strncpy(c->stage, stage, sizeof c->stage - 1);
  ++c->reports;
  pthread_cond_signal(&c->changed);
  pthread_mutex_unlock(&c->lock);
}

static void* bind(void* of) {
  struct control* c = of;
  pthread_mutex_lock(&c->session_lock);
  const capstan_late_code code = capstan_late_bind(c->session, c->plan, c->size, c->deadline_ms);
  pthread_mutex_unlock(&c->session_lock);
  pthread_mutex_lock(&c->lock);
  c->done = 1;
  c->code = code;
  pthread_cond_signal(&c->changed);
  pthread_mutex_unlock(&c->lock);
  return NULL;
}

static char* read_all(const char* path, size_t* size) {
  FILE* file = fopen(path, "rb");
  if (file == NULL) return NULL;
  char* text = NULL;
  if (fseek(file, 0, SEEK_END) == 0) {
    const long length = ftell(file);
    if (length >= 0 && fseek(file, 0, SEEK_SET) == 0 && (text = malloc((size_t)length + 1)) != NULL) {
      *size = fread(text, 1, (size_t)length, file);
    }
  }
  fclose(file);
  return text;
}

int main(int argc, char** argv) {
  const int stops = argc == 6 && strcmp(argv[5], "stop") == 0;
  if (argc != 5 && !stops) {
    fprintf(stderr, "usage: late_threads PLAN MACHINE TOOL_TABLE DEADLINE_MS [stop]\n");
    return CAPSTAN_LATE_USAGE;
  }
  struct control c;
  memset(&c, 0, sizeof c);
  char* plan = read_all(argv[1], &c.size);
  if (plan == NULL) {
    fprintf(stderr, "%s cannot be read\n", argv[1]);
    return CAPSTAN_LATE_UNREADABLE;
  }
  c.plan = plan;
  c.deadline_ms = (unsigned)strtoul(argv[4], NULL, 10);
  c.session = capstan_late_open(argv[2], argv[3]);
  c.code = capstan_late_status(c.session);
  pthread_t binder;
  pthread_mutex_init(&c.session_lock, NULL);
  pthread_mutex_init(&c.lock, NULL);
  pthread_cond_init(&c.changed, NULL);
  if (c.code == CAPSTAN_LATE_OK) {
    capstan_late_on_progress(c.session, progress, &c);
    if (pthread_create(&binder, NULL, bind, &c) != 0) return CAPSTAN_LATE_FAULT;
    /* The thread of the screen. */
    unsigned shown = 0;
    pthread_mutex_lock(&c.lock);
    while (!c.done) {
      pthread_cond_wait(&c.changed, &c.lock);
      if (stops && shown == 0 && !c.done) capstan_late_stop(c.session);
      if (c.reports > shown) fprintf(stderr, "%s, %.0f %%\n", c.stage, 100.0 * c.fraction);
      shown = c.reports;
    }
    pthread_mutex_unlock(&c.lock);
    pthread_join(binder, NULL);
    if (c.code == CAPSTAN_LATE_OK) fprintf(stderr, "bound, %u reports of progress\n", c.reports);
  }
  pthread_mutex_lock(&c.session_lock);
  fputs(capstan_late_message(c.session), stderr);
  const char* program =
      c.code == CAPSTAN_LATE_OK ? capstan_late_output(c.session, CAPSTAN_LATE_LINUXCNC, NULL) : NULL;
  /* Bound, and nothing to run: as docs/late_binding.md says, a fault. */
  if (c.code == CAPSTAN_LATE_OK && program == NULL) c.code = CAPSTAN_LATE_FAULT;
  if (program != NULL)
    fputs(program, stdout);
  else if (c.code == CAPSTAN_LATE_LATE)
    printf("bound too late: stay retracted and stopped (code %d)\n", (int)c.code);
  else
    printf("retract and stop (code %d)\n", (int)c.code);
  pthread_mutex_unlock(&c.session_lock);
  capstan_late_close(c.session);
  free(plan);
  return (int)c.code;
}
