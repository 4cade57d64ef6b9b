#include "planner/door/app/command/run.h"
#include "planner/door/app/large_pages.h"

int main(int argc, char** argv) {
  capstan::app::ask_for_large_pages();
  return capstan::app::run(argc, argv);
}
