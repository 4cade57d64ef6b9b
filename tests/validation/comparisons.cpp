#include "tests/validation/comparisons.h"

#include "tests/validation/studies.h"

namespace capstan::validation {
namespace {

Comparison skipped(const std::string& name, const std::string& why) { return {.name = name, .skipped = why}; }

void add_plate(const std::string& corpus, std::vector<Comparison>& out) {
  const auto skip = [&](const std::string& why) {
    out.push_back(skipped("nist-times", why));
    out.push_back(skipped("small-holes", why));
  };
  if (corpus.empty()) return skip("the corpus is absent");
  const std::string folder = corpus + "/measured/nist_plate";
  const auto plate = nist::read_plate(folder, CAPSTAN_SOURCE_DIR "/tests/validation/nist_plate.yaml");
  if (!plate) return skip(plate.error().message);
  const auto study = nist::study_times(*plate);
  if (!study) return skip(study.error().message);
  const auto measured = nist::read_measured(folder);
  if (!measured) return skip(measured.error().message);
  out.push_back(nist::compare_times(*plate, *study));
  out.push_back(small_holes(*plate, *study, *measured));
}

}  // namespace

std::vector<Comparison> all_comparisons(const std::string& corpus) {
  std::vector<Comparison> out;
  add_plate(corpus, out);
  out.push_back(wear(corpus));
  out.push_back(forces());
  out.push_back(kienzle());
  out.push_back(optima());
  out.push_back(lobes());
  out.push_back(sections());
  out.push_back(cycle_times(CAPSTAN_SOURCE_DIR "/docs/validation/cycle_times.csv"));
  return out;
}

}  // namespace capstan::validation
