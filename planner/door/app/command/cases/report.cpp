#include "casebase/report/summary.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "casebase/report/picture.h"
#include "casebase/tune/edges.h"
#include "planner/door/app/command/cases/shared.h"
#include "planner/door/service/explain/values.h"
#include "planner/door/service/outputs.h"
#include "planner/ground/base/number.h"

// `capstan cases report`: tables of what was observed, and where prediction and observation part.

namespace capstan::app {
namespace {

namespace report = casebase::report;
namespace tune = casebase::tune;
using service::table;
using Rows = std::vector<std::vector<std::string>>;

std::string spread_text(const report::Spread& s, int decimals) {
  if (s.count == 0) return "-";
  return trimmed(s.mean, decimals) + (s.count > 1 ? " +- " + trimmed(s.std_dev, decimals) : std::string());
}

std::string tables_of(std::string_view by, const std::vector<report::Group>& groups) {
  Rows rows = {{"by " + std::string(by), "cases", "good", "bad"}};
  for (const report::Group& g : groups)
    rows.push_back({g.name, std::to_string(g.cases.size()), std::to_string(g.good), std::to_string(g.bad)});
  for (std::size_t i = 0; i < report::kColumns.size(); ++i) {
    const report::Column& c = report::kColumns[i];
    const bool measured = std::any_of(groups.begin(), groups.end(),
                                      [&](const report::Group& g) { return g.figures[i].count > 0; });
    if (!c.always && !measured) continue;
    rows.front().push_back(std::string(c.name) + " " + std::string(c.unit));
    for (std::size_t k = 0; k < groups.size(); ++k)
      rows[k + 1].push_back(spread_text(groups[k].figures[i], c.decimals));
  }
  return table(rows, "") + "\n";
}

std::string partings_text(const std::vector<report::Group>& steps) {
  Rows rows = {{"workingstep", "quantity", "cases", "observed/predicted", "spread", "so"}};
  for (const report::Group& g : steps) {
    for (const report::Parting& p : report::partings_of(g.cases)) {
      rows.push_back({g.name, std::string(p.quantity->name), std::to_string(p.count), trimmed(p.ratio, 3),
                      p.count > 1 ? "x/ " + trimmed(std::exp(p.ln_std_dev), 3) : std::string("-"),
                      p.apart        ? "apart: " + std::string(p.quantity->model)
                      : p.count == 1 ? std::string("one case proves nothing")
                                     : std::string("as predicted, within chance")});
    }
  }
  return rows.size() == 1 ? std::string("no case was both predicted and observed\n") : table(rows, "");
}

constexpr double kZ90 = 1.6449;  // of the normal distribution, both sides

std::string state_of(const tune::EdgeUse& e) {
  if (e.broken) return "broken";
  if (!(e.used > 0.0)) return "life not known";
  if (e.worn_out() > 0.5) return "worn out";
  return e.worn_out() >= tune::kNearItsEnd ? "near its end" : "-";
}

// Edges and what is left of them: expected, and 90 of 100 edges within.
std::string edges_text(const std::vector<tune::EdgeUse>& edges) {
  if (edges.empty()) return {};
  Rows rows = {{"edge", "tool", "cuts", "cut min", "of its life", "worn out", "left min", "of 100 edges 90",
                "VB mm", "so"}};
  for (const tune::EdgeUse& e : edges) {
    const bool known = e.used > 0.0;
    std::string wear = "-";
    for (const tune::EdgePoint& p : e.history) {
      if (p.wear_mm) wear = trimmed(*p.wear_mm, 3);
    }
    rows.push_back({e.edge, e.tool + " D" + trimmed(e.diameter_mm, 3),
                    std::to_string(e.history.size()) +
                        (e.unknown > 0 ? " (" + std::to_string(e.unknown) + " not counted)" : ""),
                    trimmed(e.cut_min, 1), known ? trimmed(100.0 * e.used, 0) + " %" : "-",
                    known ? trimmed(100.0 * e.worn_out(), 0) + " %" : "-",
                    known ? trimmed(e.left_min(), 1) : "-",
                    known ? trimmed(e.left_min(-kZ90), 1) + " to " + trimmed(e.left_min(kZ90), 1) : "-", wear,
                    state_of(e)});
  }
  return table(rows, "") + "\n";
}

std::string edges_json(const std::vector<tune::EdgeUse>& edges) {
  std::string out = "[";
  for (const tune::EdgeUse& e : edges) {
    out += std::string(&e == edges.data() ? "\n" : ",\n") + "{\"edge\": " + json_text(e.edge) +
           ", \"tool\": " + json_text(e.tool) + ", \"diameter_mm\": " + shortest(e.diameter_mm) +
           ", \"material\": " + json_text(e.material) + ", \"cut_min\": " + shortest(e.cut_min) +
           ", \"life_used\": " + shortest(e.used) + ", \"ln_std_dev\": " + shortest(e.ln_std_dev) +
           ", \"worn_out\": " + shortest(e.worn_out()) + ", \"left_min\": " + shortest(e.left_min()) +
           ", \"left_90_min\": [" + shortest(e.left_min(-kZ90)) + ", " + shortest(e.left_min(kZ90)) +
           "], \"not_counted\": " + std::to_string(e.unknown) + ", \"history\": [";
    for (const tune::EdgePoint& p : e.history) {
      out += std::string(&p == e.history.data() ? "" : ", ") + "{\"cut_min\": " + shortest(p.cut_min) +
             ", \"life_used\": " + shortest(p.used) +
             (p.wear_mm ? ", \"wear_mm\": " + shortest(*p.wear_mm) : std::string()) + "}";
    }
    out += "]}";
  }
  return out + "]";
}

std::string json_number(const report::Spread& s) {
  return "{\"count\": " + std::to_string(s.count) + ", \"mean\": " + shortest(s.mean) +
         ", \"std_dev\": " + shortest(s.std_dev) + ", \"low\": " + shortest(s.low) +
         ", \"high\": " + shortest(s.high) + "}";
}

std::string groups_json(const std::vector<report::Group>& groups) {
  std::string out = "[";
  for (const report::Group& g : groups) {
    out += std::string(&g == groups.data() ? "\n" : ",\n") + "{\"name\": " + json_text(g.name) +
           ", \"cases\": " + std::to_string(g.cases.size()) + ", \"good\": " + std::to_string(g.good) +
           ", \"bad\": " + std::to_string(g.bad);
    for (std::size_t i = 0; i < report::kColumns.size(); ++i)
      out += ", \"" + std::string(report::kColumns[i].key) + "\": " + json_number(g.figures[i]);
    out += ", \"partings\": [";
    bool first = true;
    for (const report::Parting& p : report::partings_of(g.cases)) {
      out += std::string(std::exchange(first, false) ? "" : ", ") +
             "{\"quantity\": " + json_text(p.quantity->name) +
             ", \"model\": " + json_text(p.quantity->model) + ", \"count\": " + std::to_string(p.count) +
             ", \"ratio\": " + shortest(p.ratio) + ", \"ln_std_dev\": " + shortest(p.ln_std_dev) +
             ", \"apart\": " + (p.apart ? "true" : "false") + "}";
    }
    out += "]}";
  }
  return out + "]";
}

}  // namespace

int run_cases_report(Session& s) {
  if (auto ok = are_pictures(s.options.outputs); !ok) return s.end(ok.error(), kUsage);
  const auto base = casebase::CaseBase::open(*s.options.inputs.cases, s.job);
  if (!base) return s.end(base.error(), kUnreadable);
  std::vector<casebase::Case> cases = base->cases();
  report_faults(s, *base);
  // What a planner computed was not observed.
  std::erase_if(cases, [&](const casebase::Case& c) {
    return c.origin == casebase::Origin::kSimulated || !wanted(c, s.options.words);
  });
  const auto steps = report::grouped(cases, report::By::kWorkingstep);
  const auto tools = report::grouped(cases, report::By::kTool);
  const auto features = report::grouped(cases, report::By::kFeature);
  const auto edges = tune::edges_of(cases);
  std::vector<service::Output> pictures;
  for (const std::string& file : s.options.outputs) {
    const std::string title = "Observed: " + counted(cases.size(), "case", "cases") + " of " +
                              casebase::name_of(*s.options.inputs.cases);
    pictures.push_back({.path = file, .bytes = report::picture_of(title, steps, tools, features)});
  }
  if (auto drawn = service::write_all(pictures, s.job); !drawn) return s.end(drawn.error(), kImpossible);
  s.summary = counted(cases.size(), "observed case", "observed cases") + " of " +
              counted(base->size(), "case", "cases");
  if (s.options.json) {
    return print("{\"workingsteps\": " + groups_json(steps) + ",\n\"tools\": " + groups_json(tools) +
                 ",\n\"features\": " + groups_json(features) + ",\n\"edges\": " + edges_json(edges) + "}\n")
               ? kDone
               : kImpossible;
  }
  if (cases.empty()) return print("no observed case\n") ? kDone : kImpossible;
  return print(tables_of("workingstep", steps) + tables_of("tool", tools) + tables_of("feature", features) +
               edges_text(edges) + partings_text(steps))
             ? kDone
             : kImpossible;
}

}  // namespace capstan::app
