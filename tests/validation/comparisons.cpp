#include "tests/validation/comparisons.h"

#include <algorithm>
#include <utility>

#include "tests/support/corpus.h"
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
  const auto plate =
      nist::read_plate(folder, capstan::testing::source_dir() + "/tests/validation/nist_plate.yaml");
  if (!plate) return skip(plate.error().message);
  const auto study = nist::study_times(*plate);
  if (!study) return skip(study.error().message);
  const auto measured = nist::read_measured(folder);
  if (!measured) return skip(measured.error().message);
  out.push_back(nist::compare_times(*plate, *study));
  out.push_back(small_holes(*plate, *study, *measured));
}

/// The headlines of all, for the head of the document.
Comparison summary(const std::vector<Comparison>& all) {
  const std::pair<const char*, const char*> titles[] = {
      {"nist-times", "1. NIST plate: time per tool"},
      {"small-holes", "2. NIST plate: small bores"},
      {"wear", "3. NASA milling: tool life"},
      {"forces", "4. Forces"},
      {"kienzle", "5. Kienzle's law"},
      {"optima", "6. Published optimisation problems"},
      {"lobes", "7. Stability lobes"},
      {"sections", "8. Cross sections"},
      {"cycle-times", "9. Cycle times on a simulated machine"},
      {"edits", "10. Edited programs"},
      {"plan-edits", "11. Edited plans"},
      {"productivity", "12. Productivity"},
      {"catalogue-times", "13. Times against a catalogue's"},
      {"freecad", "14. Roughing against FreeCAD's paths"},
      {"tuning", "15. Tuning in simulated shops"},
      {"plates", "16. NIST plates as cases"},
      {"bind-times", "17. Late binding: times"},
      {"recognition", "18. From a CAD file to a plan"}};
  Comparison out{.name = "summary"};
  Table rows{{"comparison", "figure"}, {}};
  for (const auto& [name, title] : titles) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Comparison& c) { return c.name == name; });
    if (found == all.end() || !found->skipped.empty()) {
      out.skipped = std::string("for ") + name + " is";
      return out;
    }
    rows.rows.push_back({title, found->headline});
  }
  out.text = markdown(rows);
  return out;
}

}  // namespace

std::vector<Comparison> all_comparisons(const std::string& corpus, Extent extent) {
  std::vector<Comparison> out;
  add_plate(corpus, out);
  out.push_back(wear(corpus));
  out.push_back(forces());
  out.push_back(power());
  out.push_back(slots());
  out.push_back(kienzle());
  out.push_back(optima());
  out.push_back(lobes());
  out.push_back(sections());
  out.push_back(cycle_times(capstan::testing::source_dir() + "/docs/validation/cycle_times.csv"));
  out.push_back(edits());
  out.push_back(plan_edits());
  out.push_back(productivity(corpus));
  out.push_back(catalogue_times(
      capstan::testing::source_dir() + "/docs/validation/catalogue_times.csv", extent));
  out.push_back(freecad(capstan::testing::source_dir() + "/docs/validation/freecad.csv", extent));
  out.push_back(tuning(extent));
  out.push_back(plates(corpus));
  out.push_back(bind_times(capstan::testing::source_dir() + "/docs/validation/bind_times.csv"));
  out.push_back(recognition(corpus, capstan::testing::source_dir() + "/docs/validation/cad_plans.csv"));
  if (extent == Extent::kWhole) out.push_back(summary(out));
  return out;
}

}  // namespace capstan::validation
