#include <algorithm>

#include "planner/files/exchange/common/file_sections.h"
#include "planner/files/exchange/common/open_decisions.h"
#include "planner/files/exchange/iso14649/deviations.h"
#include "planner/files/exchange/iso14649/iso14649.h"
#include "planner/files/exchange/iso14649/reading.h"
#include "planner/files/exchange/iso14649/records.h"
#include "planner/files/exchange/records/records.h"
#include "planner/files/exchange/records/seal.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"

namespace capstan::exchange {

using model::AnyRef;
using model::TypeId;

namespace {

void find_project(Reading& r) {
  const auto projects = r.plan.model.all(TypeId::kProject);
  if (projects.empty()) {
    r.reporter.report({.code = "EXC-NO-PROJECT",
                       .severity = Severity::kWarning,
                       .message = "the file holds no PROJECT: there is nothing to carry out"});
    return;
  }
  r.plan.project = model::Ref<model::Project>(projects.front());
  for (std::size_t i = 1; i < projects.size(); ++i) {
    r.reporter.about(r.plan.model, projects[i],
                     {.code = "EXC-PROJECTS",
                      .severity = Severity::kWarning,
                      .message = "a second PROJECT; kept, and not planned"});
  }
}

// Keeps objects that the project does not reach and no other object refers to, in file order; then, for
// circles, all that are still left.
void keep_the_rest(Reading& r, Marks seen) {
  const auto& m = r.plan.model;
  Marks referred(m);
  for (const AnyRef at : r.object_of) {
    if (seen.has(at)) continue;
    model::for_each_reference(m, at, [&](AnyRef to) {
      if (to != at) referred.set(to);
    });
  }
  for (const bool only_unreferred : {true, false}) {
    for (const AnyRef at : r.object_of) {
      if (seen.has(at) || (only_unreferred && referred.has(at))) continue;
      r.plan.kept.push_back(at);
      seen.set_from(m, at);
    }
  }
}

void note_dialect(Reading& r) {
  if (r.draft.empty()) return;
  std::string seen;
  for (const std::string& d : r.draft) seen += (seen.empty() ? "" : ", ") + d;
  r.reporter.report({.code = "EXC-DIALECT",
                     .severity = Severity::kNote,
                     .message = "the file is at the level of the 2001 draft (" + seen +
                                "); it is written back at the published level"});
}

}  // namespace

Result<model::Plan> read_iso14649(const p21::File& file, Job& job, bool strict) {
  model::Plan plan;
  Reporter reporter(job, file.name());
  Reading reading{
      .file = file, .plan = plan, .reporter = reporter, .object_of = {}, .draft = {}, .doubts = {}};
  const SealState seal = seal_of(file, reporter);
  reading.sealed = seal.holds;
  read_header(file, plan);
  read_objects(reading);
  if (!reading.sealed) note_dialect(reading);  // Capstan's own way of writing
  find_project(reading);
  check_nouns(plan.model, reading.doubts);
  Marks reached(plan.model);
  if (plan.project) reached.set_from(plan.model, plan.project);
  settle_doubts(plan, reading.doubts, reached, strict, reporter);
  if (reporter.errors() == 0) {
    keep_the_rest(reading, reached);
    keep_sections(
        file, model::KeptSchema::kIso14649, [&](std::uint64_t id) { return reading.find(id); }, plan,
        reporter);
    if (!reading.sealed) find_deviations(reading);  // what is odd in a plan, its ledger says
    open_what_is_left_out(plan, reached, reporter);
    read_records(reading);
    settle_written(file, seal, "the file's header", plan, reporter);
  }
  reporter.finish();
  if (reporter.errors() != 0) return fail(reporter.failure("EXC-ISO14649"));
  return plan;
}

}  // namespace capstan::exchange
