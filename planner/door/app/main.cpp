#include "planner/door/app/command/run.h"

int main(int argc, char** argv) { return capstan::app::run(argc, argv); }
