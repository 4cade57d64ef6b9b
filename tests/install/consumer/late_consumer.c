#include <capstan/capstan_late.h>
#include <stdio.h>

/* Prints the code of a session that no machine serves. */
int main(void) {
  capstan_late* session = capstan_late_open("no such machine", "no such table");
  printf("%d\n", (int)capstan_late_status(session));
  capstan_late_close(session);
  return 0;
}
