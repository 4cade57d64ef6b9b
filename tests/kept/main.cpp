// capstan_kept [--smoke | --take] TABLE COMMAND EXAMPLES: measures what is kept fast against the table, or
// writes the table anew. --smoke counts the instructions of the small rows only, so that no other work on the
// machine changes the verdict. Status 0: as fast as it says; 1: slower; 2: wrong usage; 3: no table, or the
// work failed; 77: nothing of the table can be judged here. capstan_kept --piece NAME FILE: does one piece of
// work (rows.h).

#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "planner/ground/base/file.h"
#include "tests/kept/rows.h"
#include "tests/support/corpus.h"

namespace {

using namespace capstan;  // a program of its own

constexpr std::size_t kRepeats = 5;
constexpr int kNotJudged = 77;  // ctest's status of a test that is skipped

int failed(const Diagnostic& why) {
  std::fprintf(stderr, "kept: %s\n", to_text(why).c_str());
  return 3;
}

int taken(const std::string& file, const std::vector<kept::Row>& rows) {
  const kept::Table table{kept::processor(), kept::counter(),
                          kept::measured(rows, {2 * kRepeats + 1, !kept::counter().empty()})};
  if (const auto ok = write_file(file, kept::write(table)); !ok) return failed(ok.error());
  std::fputs(kept::write(table).c_str(), stdout);
  return 0;
}

int checked(bool smoke, const std::string& file, const std::vector<kept::Row>& rows) {
  const auto text = read_file(file);
  if (!text) return failed(text.error());
  auto table = kept::read(*text, file);
  if (!table) return failed(table.error());
  kept::Table own{kept::processor(), kept::counter(), {}};
  const bool counted = !own.counter.empty() && own.counter == table->counter;
  const bool timed = !smoke && own.processor == table->processor;
  if (!counted)
    std::printf("kept: instructions are not judged: the table has those of '%s', here counts '%s'\n",
                table->counter.c_str(), own.counter.c_str());
  if (!timed && !smoke)
    std::printf("kept: times are not judged: the table was taken on '%s', this is '%s'\n",
                table->processor.c_str(), own.processor.c_str());
  if (!counted && !timed) return kNotJudged;
  const std::vector<std::string> wrong =
      kept::check(rows, table->costs, {timed ? kRepeats : 0, counted}, own.costs);
  std::fputs(kept::write(own).c_str(), stdout);
  for (const std::string& row : kept::not_judged(own.costs, table->costs))
    std::printf("kept: %s: not judged, for the table has nothing that was measured here\n", row.c_str());
  for (const std::string& w : wrong) std::fprintf(stderr, "kept: %s\n", w.c_str());
  return wrong.empty() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  const std::string first = words.empty() ? "" : words.front();
  const bool smoke = first == "--smoke", take = first == "--take";
  const std::size_t names = smoke || take ? 1 : 0;
  if (words.size() != names + 3) {
    std::fputs("usage: capstan_kept [--smoke | --take] TABLE COMMAND EXAMPLES\n", stderr);
    return 2;
  }
  try {
    if (first == "--piece") {
      kept::piece(words[1], words[2]);
      return 0;
    }
    const capstan::testing::ScratchFolder scratch;
    const auto rows = kept::rows(words[names + 1], std::filesystem::canonical(argv[0]).string(),
                                 words[names + 2], scratch.path(), smoke);
    return take ? taken(words[names], rows) : checked(smoke, words[names], rows);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "kept: %s\n", e.what());
    return 3;
  }
}
