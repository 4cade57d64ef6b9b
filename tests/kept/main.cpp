// capstan_kept [--smoke] [--take] TABLE COMMAND EXAMPLES: measures what is kept fast against the table of
// ratios, or writes the table anew. Status 0: as fast as it says; 1: slower; 2: wrong usage; 3: no table, or
// the work failed; 77: the table is of another processor.

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "tests/kept/rows.h"
#include "tests/support/corpus.h"

namespace {

using namespace capstan;  // a program of its own

constexpr std::size_t kRepeats = 5, kSmokeRepeats = 3;
constexpr int kNotJudged = 77;  // ctest's status of a test that is skipped

int run(bool smoke, bool take, const std::string& table_file, const std::vector<kept::Row>& rows) {
  if (!kept::instructions_can_be_counted())
    std::puts(
        "kept: instructions cannot be counted on this machine (perf_event_open); CPU times are compared");
  std::vector<kept::Cost> costs;
  std::vector<std::string> wrong;
  if (take) {
    costs = kept::measured(rows, 2 * kRepeats + 1);
    if (const auto ok = write_file(table_file, kept::write(costs)); !ok) {
      std::fprintf(stderr, "kept: %s\n", to_text(ok.error()).c_str());
      return 3;
    }
  } else {
    const auto text = read_file(table_file);
    const auto table =
        text ? kept::read(*text, table_file) : Result<std::vector<kept::Cost>>(tl::unexpected(text.error()));
    if (!table) {
      std::fprintf(stderr, "kept: %s\n", to_text(table.error()).c_str());
      return 3;
    }
    const std::string own = kept::processor(), theirs = kept::processor_of(*text);
    if (own != theirs) {
      std::printf(
          "kept: not judged: the table was taken on another processor (%s, this is %s); `./dev bench --take` "
          "makes "
          "one for this\n",
          theirs.c_str(), own.c_str());
      std::fputs(kept::write(kept::measured(rows, smoke ? kSmokeRepeats : kRepeats)).c_str(), stdout);
      return kNotJudged;
    }
    wrong = kept::check(rows, *table, smoke ? kSmokeRepeats : kRepeats, costs);
  }
  std::fputs(kept::write(costs).c_str(), stdout);
  for (const std::string& w : wrong) std::fprintf(stderr, "kept: %s\n", w.c_str());
  return wrong.empty() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  bool smoke = false, take = false;
  std::vector<std::string> names;
  for (int i = 1; i < argc; ++i) {
    const std::string a = argv[i];
    if (a == "--smoke") {
      smoke = true;
    } else if (a == "--take") {
      take = true;
    } else {
      names.push_back(a);
    }
  }
  if (names.size() != 3 || (smoke && take)) {
    std::fputs("usage: capstan_kept [--smoke | --take] TABLE COMMAND EXAMPLES\n", stderr);
    return 2;
  }
  try {
    const capstan::testing::ScratchFolder scratch;
    return run(smoke, take, names[0], kept::rows(names[1], names[2], scratch.path(), smoke));
  } catch (const std::exception& e) {
    std::fprintf(stderr, "kept: %s\n", e.what());
    return 3;
  }
}
