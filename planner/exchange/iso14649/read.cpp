#include <algorithm>

#include "planner/exchange/exchange.h"
#include "planner/exchange/iso14649/deviations.h"
#include "planner/exchange/iso14649/reading.h"
#include "planner/exchange/iso14649/records.h"
#include "planner/exchange/opening.h"
#include "planner/model/nouns/all.h"
#include "planner/model/walk.h"

namespace capstan::exchange {

using model::AnyRef;
using model::TypeId;

namespace {

std::string text_or(const p21::Value& v) { return v.is(p21::Kind::kString) ? v.as_text() : std::string(); }

std::vector<std::string> texts_or(const p21::Value& v) {
  std::vector<std::string> out;
  if (v.is(p21::Kind::kString)) out.push_back(v.as_text());
  for (std::size_t i = 0; v.is(p21::Kind::kList) && i < v.size(); ++i) out.push_back(text_or(v[i]));
  return out;
}

p21::Value at_or_omitted(const p21::Value& list, std::size_t i) {
  return list.is(p21::Kind::kList) && i < list.size() ? list[i] : p21::Value{};
}

void read_header(Reading& r) {
  r.plan.file_name = r.file.name();
  if (const auto d = r.file.header("FILE_DESCRIPTION")) {
    const auto lines = texts_or(at_or_omitted(d->parameters(), 0));
    for (const std::string& line : lines) {
      if (!r.plan.header_description.empty()) r.plan.header_description += '\n';
      r.plan.header_description += line;
    }
  }
  if (const auto n = r.file.header("FILE_NAME")) {
    r.plan.header_time_stamp = text_or(at_or_omitted(n->parameters(), 1));
    r.plan.header_authors = texts_or(at_or_omitted(n->parameters(), 2));
    r.plan.header_organizations = texts_or(at_or_omitted(n->parameters(), 3));
  }
}

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

// What the project does not reach and nothing else refers to, in file order; then, for circles, whatever
// is still left.
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

Result<model::Plan> read_iso14649(const p21::File& file, Job& job) {
  model::Plan plan;
  Reporter reporter(job, file.name());
  Reading reading{
      .file = file, .plan = plan, .reporter = reporter, .object_of = {}, .draft = {}, .doubts = {}};
  read_header(reading);
  read_objects(reading);
  note_dialect(reading);
  find_project(reading);
  check_meaning(plan.model, reading.doubts);
  Marks reached(plan.model);
  if (plan.project) reached.set_from(plan.model, plan.project);
  settle_doubts(plan.model, reading.doubts, reached, reporter);
  if (reporter.errors() == 0) {
    keep_the_rest(reading, reached);
    find_deviations(reading);
    open_what_is_left_out(plan, reached, reporter);
    read_records(reading);
  }
  reporter.finish();
  if (reporter.errors() != 0) {
    return fail({.code = "EXC-ISO14649",
                 .message = std::to_string(reporter.errors()) + " fault" +
                            (reporter.errors() == 1 ? "" : "s") +
                            " in the plan; the first: " + reporter.first_error(),
                 .file = file.name()});
  }
  return plan;
}

}  // namespace capstan::exchange
