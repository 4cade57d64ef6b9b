#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include "casebase/retain/join/join.h"
#include "casebase/retain/join/told.h"
#include "planner/ground/base/number.h"

namespace capstan::casebase::retain {
namespace {

/// Nominals within this share are one: drawings in inches are rounded. Default, unsourced.
constexpr double kSameNominal = 1e-3;

bool same(double a, double b) { return std::abs(a - b) <= kSameNominal * std::max(std::abs(a), std::abs(b)); }

/// What was measured of one workingstep.
struct Values {
  std::vector<const Inspected*> sizes, depths;
  std::vector<double> places, roughnesses_um;
  bool judged = false, beyond = false;
};

/// Their mean, and their spread as standard deviation.
Figure mean_of(const std::vector<double>& values) {
  double mean = 0.0, square = 0.0;
  for (const double x : values) mean += x / static_cast<double>(values.size());
  for (const double x : values) square += (x - mean) * (x - mean);
  const double spread = values.size() < 2 ? 0.0 : std::sqrt(square / static_cast<double>(values.size() - 1));
  return {mean, spread, Origin::kMeasured};
}

/// "DIAMETER5 (line 3), FLATNESS1 (Flatness, line 7)", cut off.
std::string names_of(const std::vector<const Inspected*>& rows) {
  std::string out;
  for (const Inspected* row : rows) {
    out += (out.empty() ? "" : ", ") + printable(row->characteristic) + " (" +
           (row->type.empty() ? "" : printable(row->type) + ", ") + "line " + std::to_string(row->line) + ")";
    if (out.size() > 2 * kLongestText) return out.substr(0, 2 * kLongestText) + " ...";
  }
  return out;
}

void tell(const std::vector<const Inspected*>& rows, const std::string& why, const std::string& step,
          const LogFrom& from, Job& job) {
  if (rows.empty()) return;
  Diagnostic d =
      left_out(from, rows.front()->line, "of part '" + from.part + "' " + why + ": " + names_of(rows), step);
  d.file = from.inspection;
  job.report(std::move(d));
}

/// The deviation of those of one nominal; where they are of several, of the one that the step asks for.
/// Others are told. Nothing where it asks for none of them.
std::optional<Figure> deviation_of(const std::vector<const Inspected*>& rows,
                                   std::initializer_list<double> asked, const std::string& step,
                                   const LogFrom& from, Job& job) {
  if (rows.empty()) return std::nullopt;
  double nominal = rows.front()->nominal_mm;
  const auto of = [&](const Inspected* row) { return same(row->nominal_mm, nominal); };
  if (!std::all_of(rows.begin(), rows.end(), of)) {
    const auto wanted = std::find_if(asked.begin(), asked.end(), [&](double mm) {
      return mm > 0.0 && std::any_of(rows.begin(), rows.end(),
                                     [&](const Inspected* r) { return same(r->nominal_mm, mm); });
    });
    nominal = wanted == asked.end() ? -1.0 : *wanted;
  }
  std::vector<double> deviations;
  std::vector<const Inspected*> others;
  for (const Inspected* row : rows) {
    if (of(row))
      deviations.push_back(row->value_mm - row->nominal_mm);
    else
      others.push_back(row);
  }
  tell(others, "are of several nominals in one step, and not of what it asks for", step, from, job);
  if (deviations.empty()) return std::nullopt;
  return mean_of(deviations);
}

double off_of(const Inspected& row) { return row.has_nominal ? row.value_mm - row.nominal_mm : row.value_mm; }
bool is_beyond(const Inspected& row) {
  const double deviation = off_of(row);
  return row.toleranced && (deviation < row.lower_mm || deviation > row.upper_mm);
}

void take(const Inspected& row, Values& to) {
  if (row.kind == Measures::kRoughness) {
    to.roughnesses_um.push_back(row.ra_um);
    if (!row.ra_most) return;
    to.judged = true;
    to.beyond = to.beyond || row.ra_um > *row.ra_most;
    return;
  }
  if (row.kind == Measures::kPlace)
    to.places.push_back(std::abs(off_of(row)));  // a distance
  else
    (row.kind == Measures::kDepth ? to.depths : to.sizes).push_back(&row);
  if (!row.toleranced) return;
  to.judged = true;
  to.beyond = to.beyond || is_beyond(row);
}

}  // namespace

void add_inspection(std::span<const Inspected> rows, std::span<const Step> steps, const LogFrom& from,
                    std::vector<Case>& cases, Job& job) {
  std::map<std::string_view, const std::string*> step_of;
  for (const Step& s : steps) {
    if (!s.is_for(from.part)) continue;
    for (const std::string& name : s.characteristics) step_of.emplace(name, &s.id);
  }
  std::map<std::string, Values> of;
  std::vector<const Inspected*> nobodys, unkept;
  for (const Inspected& row : rows) {
    if (row.part != from.part) continue;
    const auto named = step_of.find(row.characteristic);
    const std::string step =
        named != step_of.end() ? *named->second : row.characteristic.substr(0, row.characteristic.find('/'));
    const bool known = std::any_of(cases.begin(), cases.end(),
                                   [&](const Case& c) { return c.from.workingstep == printable(step); });
    const bool deviates = row.kind == Measures::kSize || row.kind == Measures::kDepth;
    if (!known) {
      nobodys.push_back(&row);
    } else if (row.kind == Measures::kOther || (deviates && !row.has_nominal)) {
      unkept.push_back(&row);
      if (row.kind == Measures::kOther && is_beyond(row)) of[printable(step)].beyond = true;
    } else {
      take(row, of[printable(step)]);
    }
  }
  tell(nobodys, "no case of this log is about", {}, from, job);
  tell(unkept, "a case keeps nothing of these (no size, depth, place or Ra, or without a nominal)", {}, from,
       job);
  for (Case& c : cases) {
    const auto at = of.find(c.from.workingstep);
    if (at == of.end()) continue;
    Values& v = at->second;
    const std::string& step = c.from.workingstep;
    c.observed.size_deviation_mm =
        deviation_of(v.sizes, {c.asked.diameter_mm, c.asked.width_mm}, step, from, job);
    c.observed.depth_deviation_mm = deviation_of(v.depths, {c.asked.depth_mm}, step, from, job);
    if (!v.places.empty()) c.observed.position_deviation_mm = mean_of(v.places);
    if (!v.roughnesses_um.empty()) {
      // The roughest place decides whether a surface is as it was asked for.
      c.observed.surface_ra_um = mean_of(v.roughnesses_um);
      c.observed.surface_ra_um->value = *std::max_element(v.roughnesses_um.begin(), v.roughnesses_um.end());
      if (c.asked.asked_ra_um > 0.0) {
        v.judged = true;
        v.beyond = v.beyond || c.observed.surface_ra_um->value > c.asked.asked_ra_um;
      }
    }
    if (v.beyond) c.observed.verdict = Verdict::kBad;
    if (v.judged && !v.beyond && c.observed.verdict == Verdict::kUnknown) c.observed.verdict = Verdict::kGood;
    c.id = id_of(c);
  }
}

}  // namespace capstan::casebase::retain
