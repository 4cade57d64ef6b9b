// capstan_catalogue_times FOLDER [PART]: plans all cases of tests/sweep (with PART those whose name has it)
// and writes catalogue_times.csv into FOLDER. Rows that are there are kept and not planned again, so that a
// run which was broken off goes on: for a new record delete the file. Status 1 when a plan breaks what it
// promises.

#include <cstdio>
#include <string>
#include <vector>

#include "planner/ground/base/file.h"
#include "tests/validation/catalogue/record.h"

namespace sweep = capstan::testing::sweep;
namespace catalogue = capstan::validation::catalogue;

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    std::fputs("usage: capstan_catalogue_times FOLDER [PART]\n", stderr);
    return 2;
  }
  const std::string file = std::string(argv[1]) + "/catalogue_times.csv";
  const auto text = capstan::read_file(file);
  const std::vector<catalogue::Row> before = text ? catalogue::read(*text) : std::vector<catalogue::Row>{};
  std::vector<catalogue::Row> rows = before;
  sweep::Sweep all;
  int status = 0;
  for (const sweep::Case& c : sweep::all_cases()) {
    const std::string name = c.name();
    if (catalogue::row_for(before, c) || (argc == 3 && name.find(argv[2]) == std::string::npos)) continue;
    const sweep::Outcome o = all.plan(c);
    if (const std::string why = sweep::broken(c, o); !why.empty()) {
      std::fprintf(stderr, "%s: %s", name.c_str(), why.c_str());
      status = 1;
    }
    rows.push_back(catalogue::row_of(c, o));
    // In the order of the cases, whatever was there before.
    std::vector<catalogue::Row> ordered;
    for (const sweep::Case& each : sweep::all_cases())
      if (const auto row = catalogue::row_for(rows, each)) ordered.push_back(*row);
    if (!capstan::write_file(file, catalogue::written(ordered))) {
      std::fprintf(stderr, "cannot write %s\n", file.c_str());
      return 3;
    }
  }
  return status;
}
