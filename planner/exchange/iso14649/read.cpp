#include <algorithm>

#include "planner/exchange/exchange.h"
#include "planner/exchange/iso14649/deviations.h"
#include "planner/exchange/iso14649/reading.h"
#include "planner/exchange/iso14649/records.h"
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

using Marks = std::array<std::vector<bool>, model::kTypeCount>;

void mark_from(const model::Model& m, AnyRef root, Marks& seen) {
  std::vector<AnyRef> pending = {root};
  while (!pending.empty()) {
    const AnyRef at = pending.back();
    pending.pop_back();
    auto mark = seen[static_cast<std::size_t>(at.type)][at.index];
    if (mark) continue;
    mark = true;
    model::for_each_reference(m, at, [&](AnyRef to) { pending.push_back(to); });
  }
}

bool marked(const Marks& seen, AnyRef a) { return seen[static_cast<std::size_t>(a.type)][a.index]; }

Marks no_marks(const model::Model& m) {
  Marks out;
  for (std::size_t t = 1; t < model::kTypeCount; ++t) out[t].resize(m.count(static_cast<TypeId>(t)), false);
  return out;
}

// What the project does not reach and nothing else refers to, in file order; then, for circles, whatever
// is still left.
void keep_the_rest(Reading& r, Marks seen) {
  const auto& m = r.plan.model;
  Marks referred = no_marks(m);
  for (const AnyRef at : r.object_of) {
    if (marked(seen, at)) continue;
    model::for_each_reference(m, at, [&](AnyRef to) {
      if (to != at) referred[static_cast<std::size_t>(to.type)][to.index] = true;
    });
  }
  for (const bool only_unreferred : {true, false}) {
    for (const AnyRef at : r.object_of) {
      if (marked(seen, at) || (only_unreferred && marked(referred, at))) continue;
      r.plan.kept.push_back(at);
      mark_from(m, at, seen);
    }
  }
}

// A fault is an error where the project needs the object; without a project, nothing is needed.
void settle_doubts(Reading& r, const Marks& reached) {
  std::stable_sort(r.doubts.begin(), r.doubts.end(), [&](const auto& a, const auto& b) {
    return r.plan.model.origin(a.object).instance < r.plan.model.origin(b.object).instance;
  });
  for (auto& doubt : r.doubts) {
    if (!marked(reached, doubt.object)) {
      if (doubt.diagnostic.severity == Severity::kError)
        doubt.diagnostic.hint = "what does not fit is left out; the project does not need it";
      doubt.diagnostic.severity = Severity::kWarning;
    }
    r.reporter.about(r.plan.model, doubt.object, std::move(doubt.diagnostic));
  }
}

class Opening {
 public:
  explicit Opening(Reading& r) : r_(r) {}

  void run(const Marks& reached) {
    const auto& m = r_.plan.model;
    std::vector<AnyRef> technologies;
    for (const AnyRef at : r_.object_of) {
      if (!marked(reached, at)) continue;
      if (const auto* step = m.get<model::MachiningWorkingstep>(at);
          step != nullptr && !step->its_operation) {
        open(at, "its_operation", "is not given");
      }
      const auto* op = m.get<model::MachiningOperation>(at);
      if (op == nullptr) continue;
      tool(at, *op);
      if (!op->its_technology) open(at, "its_technology", "is not given");
      if (m.holds<model::MillingTechnology>(op->its_technology)) technologies.push_back(op->its_technology);
    }
    std::sort(technologies.begin(), technologies.end(),
              [&](AnyRef a, AnyRef b) { return m.origin(a).instance < m.origin(b).instance; });
    technologies.erase(std::unique(technologies.begin(), technologies.end()), technologies.end());
    for (const AnyRef t : technologies) technology(t);
  }

 private:
  void tool(AnyRef at, const model::MachiningOperation& op) {
    const auto& m = r_.plan.model;
    if (!op.its_tool) return open(at, "its_tool", "is not given");
    const auto* tool = m.get<model::CuttingTool>(op.its_tool);
    if (tool == nullptr) return;  // kept, or a probe
    const auto* body = m.get<model::MillingToolBody>(tool->its_tool_body);
    const auto* d = body == nullptr ? nullptr : m.get<model::MillingToolDimension>(body->dimension);
    if (d == nullptr || !d->diameter || !(*d->diameter > 0.0)) {
      open(at, "its_tool", "has no usable dimensions: a requirement and not a tool");
    }
  }

  void technology(AnyRef at) {
    const auto& t = r_.plan.model.at<model::MillingTechnology>(at);
    if (!t.feedrate && !t.feedrate_per_tooth) open(at, "feedrate", "is not given");
    if (!t.spindle && !t.cutspeed) open(at, "spindle", "is not given");
  }

  void open(AnyRef at, const char* attribute, const std::string& why) {
    r_.plan.ledger.reopen({at, attribute});
    r_.reporter.about(r_.plan.model, at,
                      {.code = "EXC-OPEN",
                       .severity = Severity::kNote,
                       .message = attribute_name(at, attribute) + " " + why + "; open"});
  }

  Reading& r_;
};

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
  check_meaning(reading);
  Marks reached = no_marks(plan.model);
  if (plan.project) mark_from(plan.model, plan.project, reached);
  settle_doubts(reading, reached);
  if (reporter.errors() == 0) {
    keep_the_rest(reading, reached);
    find_deviations(reading);
    Opening(reading).run(reached);
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
