#include "tests/validation/comparisons.h"

#include "tests/validation/nist/plate_time.h"

namespace capstan::validation {
namespace {

Comparison skipped(const std::string& name, const std::string& why) { return {.name = name, .skipped = why}; }

void add_plate(const std::string& corpus, std::vector<Comparison>& out) {
  if (corpus.empty()) {
    out.push_back(skipped("nist-times", "the corpus is absent"));
    return;
  }
  const auto plate = nist::read_plate(corpus + "/measured/nist_plate",
                                      CAPSTAN_SOURCE_DIR "/tests/validation/nist_plate.yaml");
  if (!plate) {
    out.push_back(skipped("nist-times", plate.error().message));
    return;
  }
  const auto study = nist::study_times(*plate);
  out.push_back(study ? nist::compare_times(*plate, *study) : skipped("nist-times", study.error().message));
}

}  // namespace

std::vector<Comparison> all_comparisons(const std::string& corpus) {
  std::vector<Comparison> out;
  add_plate(corpus, out);
  return out;
}

}  // namespace capstan::validation
