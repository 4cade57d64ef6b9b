#include "tests/door/app/programs.h"

namespace capstan::app {

const std::string& command_file() {
  static const std::string file = CAPSTAN_COMMAND;
  return file;
}

std::string command_quoted() { return "'" + command_file() + "'"; }

const std::string& parts_file() {
  static const std::string file = CAPSTAN_EVERYDAY_PARTS;
  return file;
}

std::string python_quoted() {
  return "CAPSTAN=" + command_quoted() + " PYTHONPATH='" CAPSTAN_PYTHON_PATH "' " CAPSTAN_PYTHON;
}

}  // namespace capstan::app
