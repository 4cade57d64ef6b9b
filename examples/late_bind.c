/* Binds what a plan leaves open with the tools that a machine has loaded, and prints the program.
 *
 *     late_bind PLAN MACHINE TOOL_TABLE DEADLINE_MS > program.ngc
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
    fprintf(stderr, "usage: late_bind PLAN MACHINE TOOL_TABLE DEADLINE_MS\n");
    return CAPSTAN_LATE_USAGE;
  }
  size_t size = 0;
  char* plan = read_all(argv[1], &size);
  if (plan == NULL) {
    fprintf(stderr, "%s cannot be read\n", argv[1]);
    return CAPSTAN_LATE_UNREADABLE;
  }
  capstan_late* session = capstan_late_open(argv[2], argv[3]);
  capstan_late_code code = capstan_late_status(session);
  if (code == CAPSTAN_LATE_OK)
    code = capstan_late_bind(session, plan, size, (unsigned)strtoul(argv[4], NULL, 10));
  fputs(capstan_late_message(session), stderr);
  if (code == CAPSTAN_LATE_LATE) {
    /* The plan is there, but nobody waits for it any more: this control stands still and asks the operator.
     */
    fprintf(stderr, "bound too late: stay retracted and stopped (code %d)\n", (int)code);
  } else if (code == CAPSTAN_LATE_OK) {
    const char* program = capstan_late_output(session, CAPSTAN_LATE_LINUXCNC, NULL);
    fprintf(stderr, "machining takes %.1f s\n", capstan_late_machining_seconds(session));
    if (program != NULL) fputs(program, stdout);
    if (program == NULL) code = CAPSTAN_LATE_IMPOSSIBLE;
  } else {
    fprintf(stderr, "not bound: retract and stop (code %d)\n", (int)code);
  }
  capstan_late_close(session);
  free(plan);
  return code;
}
