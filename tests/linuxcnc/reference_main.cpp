#include <iostream>

#include "planner/base/file.h"
#include "planner/base/number.h"
#include "tests/linuxcnc/reference.h"

/// Writes the tables of the reference pocket into a folder. Status: 0 written, 77 LinuxCNC is absent, 1
/// otherwise.
int main(int argc, char** argv) {
  using namespace capstan;
  if (argc != 2) {
    std::cerr << "usage: linuxcnc_reference FOLDER\n";
    return 2;
  }
  const linuxcnc::Reference r = linuxcnc::reference();
  if (!r.failed().empty()) {
    std::cerr << r.failed() << "\n";
    return 1;
  }
  if (!r.absent().empty()) {
    std::cerr << r.absent() << "\n";
    return 77;
  }
  for (const auto& [name, content] : linuxcnc::tables(r)) {
    if (!write_file(std::string(argv[1]) + "/" + name, content)) return 1;
  }
  std::cout << r.scheduled.time.table << r.constant.time.table << "scheduled / constant "
            << fixed(r.ratio(), 3) << ", scheduled / one feed for all " << fixed(r.ratio_to_one_feed(), 3)
            << "\n";
  return 0;
}
