// capstan_validation FOLDER [DOCUMENT...]: computes every comparison, writes the data of the plots into
// FOLDER and renews the tables of each document that has a place for them. Status 1 when something had to be
// skipped.

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "planner/ground/base/file.h"
#include "tests/support/corpus.h"
#include "tests/validation/comparisons.h"

using capstan::validation::Comparison;

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fputs("usage: capstan_validation FOLDER [DOCUMENT...]\n", stderr);
    return 2;
  }
  const std::string folder = argv[1];
  std::vector<std::string> documents;
  for (int i = 2; i < argc; ++i) {
    auto text = capstan::read_file(argv[i]);
    if (!text) {
      std::fprintf(stderr, "%s\n", text.error().message.c_str());
      return 3;
    }
    documents.push_back(*std::move(text));
  }
  int status = 0;
  for (const Comparison& c : capstan::validation::all_comparisons(capstan::testing::corpus_folder(),
                                                                  capstan::validation::Extent::kWhole)) {
    if (!c.skipped.empty()) {
      std::fprintf(stderr, "validation: %s is skipped: %s\n", c.name.c_str(), c.skipped.c_str());
      status = 1;
      continue;
    }
    if (documents.empty()) std::printf("%s\n%s\n", c.name.c_str(), c.text.c_str());
    for (const auto& [name, content] : c.data) {
      if (!capstan::write_file(folder + "/" + name, content)) status = 3;
    }
    bool placed = documents.empty();
    for (std::string& document : documents) {
      std::string now = capstan::validation::renewed(document, c);
      if (now.empty()) continue;
      document = std::move(now);
      placed = true;
    }
    if (!placed) {
      std::fprintf(stderr, "validation: no document has a place for %s\n", c.name.c_str());
      status = 3;
    }
  }
  for (std::size_t i = 0; i < documents.size(); ++i) {
    if (!capstan::write_file(argv[i + 2], documents[i])) status = 3;
  }
  return status;
}
