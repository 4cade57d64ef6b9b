/* Binds what a plan leaves open with the tools that a machine has loaded, and prints the program.
 *
 *     late_bind PLAN MACHINE TOOL_TABLE DEADLINE_MS [next] [TOOL_STATE] > program.ngc
 *
 * TOOL_STATE is a file of what became of the tools since their table was written, e.g. "T3 broken".
 * With `next` workingstep by workingstep, each in its turn: a program of each. A control would cut one before
 * it asks for the next, and may change its tool table between two.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/capstan_late.h"

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

/* Prints the program of what was bound; code of the session. */
static capstan_late_code print_program(capstan_late* session) {
  const char* program = capstan_late_output(session, CAPSTAN_LATE_LINUXCNC, NULL);
  fprintf(stderr, "machining takes %.1f s\n", capstan_late_machining_seconds(session));
  if (program == NULL) return CAPSTAN_LATE_IMPOSSIBLE;
  fputs(program, stdout);
  return CAPSTAN_LATE_OK;
}

/* All workingsteps of a plan but the last, each bound and printed; the last one is bound. */
static capstan_late_code bind_each(capstan_late* session, const char* plan, size_t size,
                                   unsigned deadline_ms) {
  capstan_late_code code = capstan_late_take(session, plan, size);
  unsigned steps = 1; /* how many there are is known when the first is bound */
  for (unsigned step = 1; code == CAPSTAN_LATE_OK && step <= steps; ++step) {
    if (step > 1 && (code = print_program(session)) != CAPSTAN_LATE_OK) break;
    code = capstan_late_bind_next(session, NULL, 0, step, 1, deadline_ms);
    steps = capstan_late_steps(session);
    if (code == CAPSTAN_LATE_OK) fprintf(stderr, "workingstep %u of %u\n", step, steps);
  }
  return code;
}

int main(int argc, char** argv) {
  const int next = argc >= 6 && strcmp(argv[5], "next") == 0;
  const char* tool_state = argc == 6 + next ? argv[5 + next] : NULL;
  if (argc != 5 + next && tool_state == NULL) {
    fprintf(stderr, "usage: late_bind PLAN MACHINE TOOL_TABLE DEADLINE_MS [next] [TOOL_STATE]\n");
    return CAPSTAN_LATE_USAGE;
  }
  size_t size = 0, size_of_states = 0;
  char* plan = read_all(argv[1], &size);
  if (plan == NULL) {
    fprintf(stderr, "%s cannot be read\n", argv[1]);
    return CAPSTAN_LATE_UNREADABLE;
  }
  capstan_late* session = capstan_late_open(argv[2], argv[3]);
  capstan_late_code code = capstan_late_status(session);
  const unsigned deadline_ms = (unsigned)strtoul(argv[4], NULL, 10);
  if (code == CAPSTAN_LATE_OK && tool_state != NULL) {
    /* A control that has the states in memory needs no file. */
    char* states = read_all(tool_state, &size_of_states);
    if (states == NULL) {
      fprintf(stderr, "%s cannot be read\n", tool_state);
      code = CAPSTAN_LATE_UNREADABLE;
    } else {
      code = capstan_late_tool_state(session, states, size_of_states);
    }
    free(states);
  }
  if (code == CAPSTAN_LATE_OK)
    code = next ? bind_each(session, plan, size, deadline_ms)
                : capstan_late_bind(session, plan, size, deadline_ms);
  fputs(capstan_late_message(session), stderr);
  if (code == CAPSTAN_LATE_LATE) {
    /* The plan is there, but nobody waits for it any more: this control stands still and asks the operator.
     */
    fprintf(stderr, "bound too late: stay retracted and stopped (code %d)\n", (int)code);
  } else if (code == CAPSTAN_LATE_OK) {
    code = print_program(session);
  } else {
    fprintf(stderr, "not bound: retract and stop (code %d)\n", (int)code);
  }
  capstan_late_close(session);
  free(plan);
  return code;
}
