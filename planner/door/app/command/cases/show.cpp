#include "casebase/record/fields.h"
#include "planner/door/app/command/cases/shared.h"
#include "planner/door/service/explain/values.h"
#include "planner/ground/base/number.h"

namespace capstan::app {

namespace {

using casebase::value;

/// A field's value for people, with its unit and, of an observed one, its origin.
std::string value_text(const casebase::Field& f, const casebase::Case& c) {
  const std::string unit = f.unit.empty() || f.unit == "1" ? std::string() : ' ' + std::string(f.unit);
  if (const auto* t = std::get_if<casebase::TextAt>(&f.at)) return value(*t, c);
  if (const auto* n = std::get_if<casebase::NumberAt>(&f.at)) return trimmed(value(*n, c), 6) + unit;
  if (const auto* i = std::get_if<casebase::CountAt>(&f.at)) return std::to_string(value(*i, c));
  if (const auto* w = std::get_if<casebase::WordAt>(&f.at)) return std::string(w->get(c));
  if (const auto* g = std::get_if<casebase::FigureAt>(&f.at))
    return figure_text(value(*g, c)) + unit + ", " + std::string(to_text(value(*g, c)->origin));
  const casebase::Series& series = value(std::get<casebase::SeriesAt>(f.at), c);
  return counted(series.samples.size(), "sample", "samples") + ", " +
         trimmed(series.samples.front().value, 6) + " to " + trimmed(series.samples.back().value, 6) + unit +
         " over " + trimmed(series.samples.back().t_s, 3) + " s, " + std::string(to_text(series.origin));
}

}  // namespace

int run_cases_show(Session& s) {
  const auto base = casebase::CaseBase::open(*s.options.inputs.cases, s.job);
  if (!base) return s.end(base.error(), kUnreadable);
  std::string out;
  std::vector<casebase::Case> cases;
  for (const std::string& word : s.options.words) {
    const auto id = base->find(word);
    if (!id) return s.end(id.error(), kUsage);
    auto c = base->get(*id);
    if (!c) return s.end(c.error(), kUnreadable);
    std::vector<std::vector<std::string>> rows = {{"id", c->id}};
    for (const casebase::Field& f : casebase::fields()) {
      if (!is_default(f, *c)) rows.push_back({std::string(f.name), value_text(f, *c)});
    }
    for (const auto& said : base->later_verdicts(*id)) {
      const std::string what =
          said.verdict ? "judged " + std::string(to_text(*said.verdict)) : std::string("removed");
      rows.push_back(
          {what, said.time_utc + (said.time_utc.empty() ? "" : " ") + "by " + said.by + ": " + said.reason});
    }
    out += (out.empty() ? "" : "\n") + service::table(rows, "");
    cases.push_back(*std::move(c));
  }
  return print(s.options.json ? cases_json(cases) : out) ? kDone : kImpossible;
}

}  // namespace capstan::app
