/* Binds a plan workingstep by workingstep, each when its turn comes, and prints the program of each.
 *
 *     late_next PLAN MACHINE TOOL_TABLE DEADLINE_MS > programs.ngc
 *
 * A control would cut each program before it asks for the next one, and may change the tool table between
 * two.
 */
#include <stdio.h>
#include <stdlib.h>

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

int main(int argc, char** argv) {
  if (argc != 5) {
    fprintf(stderr, "usage: late_next PLAN MACHINE TOOL_TABLE DEADLINE_MS\n");
    return CAPSTAN_LATE_USAGE;
  }
  size_t size = 0;
  char* plan = read_all(argv[1], &size);
  if (plan == NULL) {
    fprintf(stderr, "%s cannot be read\n", argv[1]);
    return CAPSTAN_LATE_UNREADABLE;
  }
  const unsigned deadline_ms = (unsigned)strtoul(argv[4], NULL, 10);
  capstan_late* session = capstan_late_open(argv[2], argv[3]);
  capstan_late_code code = capstan_late_status(session);
  if (code == CAPSTAN_LATE_OK) code = capstan_late_take(session, plan, size);
  unsigned step = 0, steps = 1; /* how many there are is known when the first is bound */
  while (code == CAPSTAN_LATE_OK && step < steps) {
    code = capstan_late_bind_next(session, NULL, 0, ++step, 1, deadline_ms);
    fputs(capstan_late_message(session), stderr);
    if (code != CAPSTAN_LATE_OK) break;
    steps = capstan_late_steps(session);
    const char* program = capstan_late_output(session, CAPSTAN_LATE_LINUXCNC, NULL);
    fprintf(stderr, "workingstep %u of %u: %.1f s\n", step, steps, capstan_late_machining_seconds(session));
    if (program != NULL) fputs(program, stdout);
    if (program == NULL) code = CAPSTAN_LATE_IMPOSSIBLE;
  }
  if (code != CAPSTAN_LATE_OK)
    fprintf(stderr, "not bound: stay retracted and stopped (code %d)\n", (int)code);
  capstan_late_close(session);
  free(plan);
  return code;
}
