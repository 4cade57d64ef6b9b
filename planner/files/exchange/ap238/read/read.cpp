#include "planner/files/exchange/ap238/ap238.h"
#include "planner/files/exchange/ap238/paths/helix.h"
#include "planner/files/exchange/ap238/paths/paths.h"
#include "planner/files/exchange/ap238/read/mended_values.h"
#include "planner/files/exchange/ap238/read/reader.h"
#include "planner/files/exchange/ap238/records.h"
#include "planner/files/exchange/common/file_sections.h"
#include "planner/files/exchange/common/open_decisions.h"
#include "planner/files/exchange/records/records.h"
#include "planner/files/exchange/records/seal.h"
#include "planner/files/exchange/toolpaths/via.h"
#include "planner/files/p21/read/parse.h"
#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"

namespace capstan::exchange {

Result<model::Plan> read_ap238(const p21::File& file, Job& job, bool strict) {
  model::Plan plan;
  read_header(file, plan);
  Reporter reporter(job, file.name());
  p21::check_references(file, job);
  const ap238::Graph graph(file, express::Dictionary::ap238());
  ap238::Reader reader(graph, ap238::Mapping::instance(), plan, strict, reporter);
  ap238::Records records(reader);
  reader.run();
  for (const auto& [at, uncertainty_mm] : reader.uncertainties_mm()) {
    const auto n = curves::degenerate_via_points(plan.model, model::Ref<model::Polyline>(at), uncertainty_mm);
    if (n == 0) continue;
    reporter.report(
        {.code = "EXC-VIA",
         .severity = Severity::kWarning,
         .message = std::to_string(n) + " via points lie within the " + trimmed(uncertainty_mm, 6) +
                    " mm that the file states as uncertainty from a neighbour: lines are taken there",
         .line = plan.model.origin(at).line,
         .instance = plan.model.origin(at).instance});
  }
  ap238::mend_ratios(plan, reporter);
  ap238::drop_stated_frames(plan);
  ap238::via_points_to_helices(plan);
  if (!plan.project) {
    reporter.report({.code = "EXC-NO-PROJECT",
                     .severity = Severity::kWarning,
                     .message = "the file holds no machining project: there is nothing to carry out"});
  }
  std::vector<Doubt> doubts = std::move(reader.doubts());
  check_nouns(plan.model, doubts);
  ap238::doubt_placements(plan.model, doubts);
  Marks reached(plan.model);
  if (plan.project) reached.set_from(plan.model, plan.project);
  settle_doubts(plan, doubts, reached, strict, reporter);
  if (reporter.errors() == 0) {
    open_what_is_left_out(plan, reached, reporter);
    const SealState seal = seal_of(file, reporter);
    records.restore(seal.holds);
    settle_written(file, seal, "the file's records", plan, reporter);
  }
  reporter.finish();
  if (reporter.errors() != 0) return fail(reporter.failure("EXC-AP238"));
  return plan;
}

}  // namespace capstan::exchange
