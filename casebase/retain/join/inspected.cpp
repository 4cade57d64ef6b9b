#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include "casebase/retain/join/join.h"
#include "casebase/retain/join/told.h"
#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/unit_factors.h"

namespace capstan::casebase::retain {
namespace {

/// Nominals within this share are one: drawings in inches are rounded. Default, unsourced.
constexpr double kSameNominal = 1e-3;

bool same(double a, double b) { return std::abs(a - b) <= kSameNominal * std::max(std::abs(a), std::abs(b)); }

/// A size this many times its nominal, or as small a part of it, is a slip of the decimal point or of the
/// unit: half of the least of these, a factor of 10, by logarithms.
constexpr double kSlip = 3.1623;

/// What was measured of one workingstep.
struct Values {
  std::vector<const Inspected*> sizes, depths;
  std::vector<double> places, roughnesses_um;
  bool judged = false, beyond = false;
  void judge_by(const Inspected& row);
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
          const LogFrom& from, Job& job, Severity severity = Severity::kNote, const std::string& hint = {}) {
  if (rows.empty()) return;
  Diagnostic d =
      left_out(from, rows.front()->line, "of part '" + from.part + "' " + why + ": " + names_of(rows), step);
  d.file = from.inspection;
  d.severity = severity;
  d.hint = hint;
  job.report(std::move(d));
}

double off_of(const Inspected& row) { return row.has_nominal ? row.value_mm - row.nominal_mm : row.value_mm; }
bool is_beyond(const Inspected& row) {
  const double deviation = off_of(row);
  return row.toleranced && (deviation < row.lower_mm || deviation > row.upper_mm);
}

void Values::judge_by(const Inspected& row) {
  if (!row.toleranced) return;
  judged = true;
  beyond = beyond || is_beyond(row);
}

/// What a step asks for of a kind of size, all in mm. 0: it states none.
struct AskedSizes {
  double diameter = 0.0, width = 0.0, depth = 0.0;
  double zone = 0.0;         ///< width of the tolerance zone; 0: not known
  double middle_over = 0.0;  ///< middle of that zone less the asked size; 0: not known, or symmetrical

  /// Those that a row may be about; none where nothing of it is stated.
  [[nodiscard]] std::vector<double> of(const Inspected& row) const {
    std::vector<double> out;
    const auto may_be = [&](double mm) {
      if (mm > 0.0) out.push_back(mm);
    };
    if (row.stated == StatedSize::kUnstated) return out;
    if (row.kind == Measures::kDepth) {
      may_be(depth);
      return out;
    }
    if (row.stated != StatedSize::kWidth) may_be(diameter);
    if (row.stated != StatedSize::kDiameter) may_be(width);
    return out;
  }
};

AskedSizes sizes_of(const Case& c) {
  const double middle =
      c.asked.tolerance_mm > 0.0 && c.bound.aimed_over_mm ? c.bound.aimed_over_mm->value : 0.0;
  return {c.asked.diameter_mm, c.asked.width_mm, 0.0, c.asked.tolerance_mm, middle};
}
AskedSizes depth_of(const Case& c) { return {.depth = c.asked.depth_mm}; }

/// Whether a row's nominal is the middle of the zone that its limits make.
bool states_the_middle(const Inspected& row) {
  return row.toleranced &&
         std::abs(row.upper_mm + row.lower_mm) <= kSameNominal * (row.upper_mm - row.lower_mm);
}

/// Whether a row of another nominal is of this size all the same: one in the zone around it, as the middle of
/// that is, or one whose own limits hold it.
bool in_the_zone(const Inspected& row, double asked, const AskedSizes& sizes) {
  if (same(row.nominal_mm, asked + sizes.middle_over)) return true;
  const double off = row.nominal_mm - asked;
  return std::abs(off) <= sizes.zone || (row.toleranced && row.lower_mm <= -off + kSameNominal * asked &&
                                         -off <= row.upper_mm + kSameNominal * asked);
}

/// Actual less asked size. A nominal that was rounded, as one of inches is, stays what the value is held
/// against.
double off_asked(const Inspected& row, double asked, const AskedSizes& sizes) {
  const double off = row.nominal_mm - asked;
  if (states_the_middle(row) && std::abs(off - sizes.middle_over) < std::abs(off))
    return row.value_mm - row.nominal_mm + sizes.middle_over;
  return same(row.nominal_mm, asked) ? row.value_mm - row.nominal_mm : row.value_mm - asked;
}

bool slipped(const Inspected& row) {
  const double nominal = std::abs(row.nominal_mm), value = std::abs(row.value_mm);
  return nominal > 0.0 && (value > kSlip * nominal || kSlip * value < nominal);
}

/// "0.315, asked 8 mm" of the first of them.
std::string nominals_of(const std::vector<const Inspected*>& rows, const AskedSizes& sizes) {
  if (rows.empty()) return {};
  std::string asked;
  for (const double mm : sizes.of(*rows.front())) asked += (asked.empty() ? "" : " or ") + trimmed(mm, 4);
  return "nominal " + trimmed(rows.front()->nominal_mm, 4) + " mm, asked " + asked + " mm";
}

/// What to do about rows whose nominal the step does not ask for.
std::string hint_for(const std::vector<const Inspected*>& rows, const AskedSizes& sizes) {
  for (const Inspected* row : rows) {
    for (const double mm : sizes.of(*row)) {
      if (same(row->nominal_mm * kMmPerInch, mm)) {
        return "the nominal is the asked size in inches: say so by a column 'unit', or by --unit inch; "
               "import "
               "the log again, and remove the cases without";
      }
    }
  }
  return "give the step's own characteristic, in mm or with its unit; a length or a height is told by its "
         "type";
}

/// The deviation of those rows that are of what the step asks for; where that is not known, of those of one
/// nominal. Others are told, and a slip of the pen. Nothing where none is left.
std::optional<Figure> deviation_of(std::vector<const Inspected*> rows, const AskedSizes& sizes, Values& v,
                                   const std::string& step, const LogFrom& from, Job& job) {
  const auto move_if = [&](std::vector<const Inspected*>& to, const auto& is) {
    for (const Inspected* row : rows) {
      if (is(*row)) to.push_back(row);
    }
    std::erase_if(rows, [&](const Inspected* row) { return is(*row); });
  };
  std::vector<const Inspected*> wrong;
  move_if(wrong, slipped);
  tell(wrong,
       "differ from their nominal by more than a factor of " + trimmed(kSlip, 2) + ", so no size is kept",
       step, from, job, Severity::kWarning, "is the decimal point or the unit of value and nominal right?");

  // The size that the step asks for, by the rows that name it.
  double asked = 0.0;
  const auto is_of = [&](double mm, const auto& fits) {
    return mm > 0.0 && std::any_of(rows.begin(), rows.end(), [&](const Inspected* row) {
             const auto may_be = sizes.of(*row);
             return std::find(may_be.begin(), may_be.end(), mm) != may_be.end() && fits(*row, mm);
           });
  };
  const auto exact = [](const Inspected& row, double mm) { return same(row.nominal_mm, mm); };
  const auto near = [&](const Inspected& row, double mm) { return in_the_zone(row, mm, sizes); };
  for (const double mm : {sizes.diameter, sizes.width, sizes.depth}) {
    if (asked == 0.0 && is_of(mm, exact)) asked = mm;
  }
  const bool rounded = asked > 0.0;
  for (const double mm : {sizes.diameter, sizes.width, sizes.depth}) {
    if (asked == 0.0 && is_of(mm, near)) asked = mm;
  }
  std::vector<const Inspected*> taken;
  if (asked > 0.0) {
    move_if(taken, [&](const Inspected& row) { return rounded ? exact(row, asked) : near(row, asked); });
  } else {
    std::vector<const Inspected*> not_asked;
    move_if(not_asked, [&](const Inspected& row) { return !sizes.of(row).empty(); });
    tell(not_asked,
         "are of another size than the step asks for (" + nominals_of(not_asked, sizes) +
             "), so none is kept and none is judged good by them",
         step, from, job, Severity::kWarning, hint_for(not_asked, sizes));
    wrong.insert(wrong.end(), not_asked.begin(), not_asked.end());
    if (!rows.empty()) {
      const double nominal = rows.front()->nominal_mm;
      const auto of = [&](const Inspected* row) { return same(row->nominal_mm, nominal); };
      if (std::all_of(rows.begin(), rows.end(), of)) taken = std::exchange(rows, {});
    }
  }
  tell(rows, "are of several nominals in one step, and not of what it asks for", step, from, job);
  for (const Inspected* row : wrong) v.beyond = v.beyond || is_beyond(*row);
  for (const auto* kept : {&taken, &rows}) {
    for (const Inspected* row : *kept) v.judge_by(*row);
  }
  if (taken.empty()) return std::nullopt;
  std::vector<double> deviations;
  for (const Inspected* row : taken)
    deviations.push_back(asked > 0.0 ? off_asked(*row, asked, sizes) : off_of(*row));
  return mean_of(deviations);
}

void take(const Inspected& row, Values& to) {
  if (row.kind == Measures::kRoughness) {
    to.roughnesses_um.push_back(row.ra_um);
    if (!row.ra_most) return;
    to.judged = true;
    to.beyond = to.beyond || row.ra_um > *row.ra_most;
    return;
  }
  if (row.kind == Measures::kPlace) {
    to.places.push_back(std::abs(off_of(row)));  // a distance
    to.judge_by(row);
    return;
  }
  // These are judged once it is known which of them are of the step.
  (row.kind == Measures::kDepth ? to.depths : to.sizes).push_back(&row);
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
    c.observed.size_deviation_mm = deviation_of(v.sizes, sizes_of(c), v, step, from, job);
    c.observed.depth_deviation_mm = deviation_of(v.depths, depth_of(c), v, step, from, job);
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
