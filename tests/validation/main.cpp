// capstan_validation FOLDER [DOCUMENT]: computes every comparison, writes the data of the plots into FOLDER
// and renews the tables of the document. Status 1 when something had to be skipped.

#include <cstdio>
#include <string>

#include "planner/ground/base/file.h"
#include "tests/support/corpus.h"
#include "tests/validation/comparisons.h"

using capstan::validation::Comparison;

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fputs("usage: capstan_validation FOLDER [DOCUMENT]\n", stderr);
    return 2;
  }
  const std::string folder = argv[1];
  std::string document;
  if (argc > 2) {
    const auto text = capstan::read_file(argv[2]);
    if (!text) {
      std::fprintf(stderr, "%s\n", text.error().message.c_str());
      return 3;
    }
    document = *text;
  }
  int status = 0;
  for (const Comparison& c : capstan::validation::all_comparisons(capstan::testing::corpus_folder())) {
    if (!c.skipped.empty()) {
      std::fprintf(stderr, "validation: %s is skipped: %s\n", c.name.c_str(), c.skipped.c_str());
      status = 1;
      continue;
    }
    if (argc <= 2) std::printf("%s\n%s\n", c.name.c_str(), c.text.c_str());
    for (const auto& [name, content] : c.data) {
      if (!capstan::write_file(folder + "/" + name, content)) status = 3;
    }
    if (document.empty()) continue;
    const std::string now = capstan::validation::renewed(document, c);
    if (now.empty()) {
      std::fprintf(stderr, "validation: the document has no place for %s\n", c.name.c_str());
      status = 3;
    } else {
      document = now;
    }
  }
  if (!document.empty() && !capstan::write_file(argv[2], document)) status = 3;
  return status;
}
