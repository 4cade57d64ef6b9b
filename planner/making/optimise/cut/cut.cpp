#include "planner/making/optimise/cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "planner/ground/base/number.h"
#include "planner/making/optimise/cut/cost.h"
#include "planner/making/optimise/cut/law/law.h"
#include "planner/making/optimise/cut/limits.h"
#include "planner/making/optimise/cut/search.h"
#include "planner/making/optimise/cut/stability.h"
#include "planner/model/plan/cutter/ramp.h"
#include "planner/model/plan/decision/condemned.h"
#include "planner/physics/mechanics/constants.h"

// The cut of a step. Depths are whole numbers of equal levels: the fewest that are allowed, then more, as
// long as they get better. At one depth the search (search.h) runs over speed, feed and width of cut. Limits
// with corners cut its range into pieces that are smooth inside; each piece is solved, and the best solution
// counts. Where the machine states its modes, slower speeds are tried one by one until a lobe is deep enough.
// The answer is rounded to what is programmed and measured anew. Each limit that holds it is eased by a
// tenth, to say what that would save.

namespace capstan::optimise {
namespace {

using model::Limit;
using std::numbers::pi;

/// Points that one search may evaluate, whatever the job's budget: a smooth one needs a tenth of them.
constexpr std::uint32_t kPointsPerSearch = 400;
/// By how much a limit may seem exceeded after rounding.
constexpr double kRounding = 1e-6;
/// More levels than this are a mistake of the question.
constexpr int kMostLevels = 1000000;

double floor_to(double v, double step) { return std::floor(v / step + 1e-9) * step; }

double feed_step(double feed_mm_min) { return feed_mm_min >= 20.0 ? 1.0 : 0.1; }

double round_feed(double feed_mm_min) {
  const double step = feed_step(feed_mm_min);
  return rounded(floor_to(feed_mm_min, step), step < 1.0 ? 1 : 0);
}

/// A solved search: the point before rounding, and what held it.
struct Solved {
  CutPoint point;
  std::vector<Variable> box;  ///< the piece it was found in
  Solution solution;
};

/// A limit that the cut breaks, in words.
std::string broken(std::string_view name, double value, double limit, std::string_view unit) {
  model::ExceededLimit l;
  l.name = name;
  l.value = value;
  l.limit = limit;
  l.unit = unit;
  return model::text_of(l);
}

/// Faults of the given values that make a cut impossible to compute.
std::vector<std::string> not_a_cut(const CutQuestion& q) {
  struct Given {
    const char* name;
    const std::optional<double>& value;
    double least, most;
  };
  // Far outside of anything that turns or moves.
  const Given given[] = {{"speed", q.n_rpm, 1e-3, 1e7},
                         {"feed", q.feed_mm_min, 1e-3, 1e7},
                         {"feed per tooth", q.fz_mm, 1e-7, 1e3},
                         {"axial depth", q.ap_mm, 1e-6, 1e5},
                         {"radial depth", q.ae_mm, 1e-6, 1e5}};
  std::vector<std::string> out;
  for (const Given& g : given) {
    if (!g.value || (*g.value >= g.least && *g.value <= g.most)) continue;
    out.push_back(std::string(g.name) + " " +
                  (std::isfinite(*g.value) ? shortest(*g.value) : std::string("that is no number")) +
                  " is out of range");
  }
  return out;
}

void measure_answer(const CutQuestion& q, CutAnswer& a) {
  a.fz_mm = a.feed_mm_min / (a.n_rpm * teeth_of(q));
  a.vc_m_min = pi * speed_diameter_mm(q) * a.n_rpm / 1000.0;
  const auto loads = loads_of(q, a.ap_mm, a.ae_mm, a.n_rpm, a.feed_mm_min);
  a.loads = loads.value_or(model::StepLoads{});
  a.violated.clear();
  a.feasible = loads.has_value();
  if (!loads) a.violated.emplace_back("the cut lies outside the range of the force formulas");
  const Measures m = measures(q, a.loads, a.ap_mm, a.n_rpm, a.feed_mm_min);
  const bool torque = short_of_torque(q, a.n_rpm);
  for (const model::LimitRow& r : model::kLimitRows) {
    const Measure& one = m[r.value];
    if (!one.stated() || one.value <= one.limit * (1.0 + kRounding)) continue;
    if (r.value == (torque ? Limit::kSpindlePower : Limit::kSpindleTorque)) continue;  // its other name
    a.feasible = false;
    a.violated.push_back(broken(r.name, one.value, one.limit, r.unit));
  }
  const bool chosen = !q.feed_mm_min && !q.fz_mm;
  const double least = least_fz(q) / ease_of(q, "feed_per_tooth_least");
  const double step = feed_step(a.feed_mm_min) / (a.n_rpm * teeth_of(q));
  if (chosen && a.fz_mm + step < least * (1.0 - kRounding)) {
    a.feasible = false;
    a.violated.push_back(broken("feed_per_tooth_least", least, a.fz_mm, "mm"));
  }
}

/// The largest excess of a limit that a lower feed keeps.
double excess_by_feed(const CutQuestion& q, const CutAnswer& a) {
  const Measures m = measures(q, a.loads, a.ap_mm, a.n_rpm, a.feed_mm_min);
  double worst = 0.0;
  for (const model::LimitRow& r : model::kLimitRows) {
    if (r.eased) worst = std::max(worst, m[r.value].excess());
  }
  return worst;
}

/// Rounds a point to what is programmed, and measures it.
CutAnswer answer_at(const CutQuestion& q, const CutPoint& p) {
  CutAnswer a;
  a.ap_mm = p.ap_mm;
  a.ae_mm = q.ae_mm || q.kind == CutKind::kFinish ? p.ae_mm : rounded(floor_to(p.ae_mm, 0.001), 3);
  a.n_rpm = q.n_rpm ? *q.n_rpm : std::max(floor_to(p.n_rpm, 1.0), std::ceil(speeds(q).lo));
  a.feed_mm_min = q.feed_mm_min ? *q.feed_mm_min : p.feed_mm_min / p.n_rpm * a.n_rpm;
  const bool free_feed = !q.feed_mm_min && !feeds_by_pitch(q);
  if (free_feed) a.feed_mm_min = round_feed(a.feed_mm_min);
  measure_answer(q, a);
  // A limit may be lower at the rounded speed than at the one that was solved for.
  constexpr int kMostRepairs = 6;
  constexpr double kLittle = 0.02;
  for (int i = 0; i < kMostRepairs && free_feed && !a.feasible; ++i) {
    const double excess = excess_by_feed(q, a);
    if (!(excess > kRounding && excess < kLittle)) break;
    a.feed_mm_min = round_feed(a.feed_mm_min * (1.0 - 1.5 * excess));
    measure_answer(q, a);
  }
  a.life_min = edge_life_min(q, {a.ap_mm, a.ae_mm, a.n_rpm, a.feed_mm_min});
  if (std::isfinite(a.life_min)) a.loads.tool_life_min = a.life_min;
  return a;
}

bool better(const Solution& a, const Solution& b) {
  if (a.feasible != b.feasible) return a.feasible;
  return a.feasible ? a.objective < b.objective : a.max_violation < b.max_violation;
}

/// The best solution over the pieces between the corners; nothing if no piece contains a feasible cut.
Result<std::optional<Solved>> best_of(const Search& search, Options options, Job& job,
                                      const std::optional<CutPoint>& start = {}) {
  const std::uint32_t budget =
      options.evaluation_budget != 0 ? options.evaluation_budget : job.evaluation_budget;
  options.evaluation_budget = std::min(budget, kPointsPerSearch);
  std::optional<Solved> best;
  for (const auto& piece : search.pieces()) {
    if (search.hopeless(piece)) continue;
    auto s = solve(search.problem(piece, start), options, job);
    if (!s && s.error().code == "OPT-MODEL") continue;  // no point of it has a value
    if (!s) return tl::unexpected(s.error());
    if (!best || better(*s, best->solution)) best = Solved{search.at(s->x), piece, *std::move(s)};
  }
  return best;
}

/// The cut under a question whose limit `name` is `factor` times as large, from where it is now.
std::optional<CutPoint> eased(const CutQuestion& q, const Solved& now, const std::string& name, double factor,
                              const Options& options, Job& job) {
  CutQuestion more = q;
  more.eased = {name, factor};
  const Search search(more, now.point.ap_mm);
  Options one = options;
  one.starts = 1;
  const auto solved = best_of(search, one, job, now.point);
  if (!solved || !*solved || !(*solved)->solution.feasible) return std::nullopt;
  return (*solved)->point;
}

struct Held {
  model::ActiveConstraint limit;
  bool at_corner = false;  ///< the multiplier is that of one side of a corner
};

std::vector<Held> held_by(const CutQuestion& q, const Solved& s, const CutAnswer& a, const Search& search) {
  const Measures m = measures(q, a.loads, a.ap_mm, a.n_rpm, a.feed_mm_min);
  std::vector<Held> out;
  bool corner = false;
  for (const ActiveLimit& l : s.solution.active) {
    model::ActiveConstraint c;
    if (l.kind == ActiveLimit::Kind::kConstraint) {
      const auto* at = std::find_if(model::kLimitRows.begin(), model::kLimitRows.end(),
                                    [&](const model::LimitRow& k) { return l.name == k.name; });
      const bool torque = at->value == Limit::kSpindlePower && short_of_torque(q, a.n_rpm);
      const model::LimitRow& told = torque ? row_of(Limit::kSpindleTorque) : *at;
      const Measure& one = m[told.value];
      if (!one.stated()) continue;
      c.name = told.name;
      c.unit = told.unit;
      c.value = one.value;
      c.limit = one.limit;
      if (at->at_rpm) c.at_rpm = a.n_rpm;
      c.shadow_price = 0.01 * l.multiplier;
    } else {
      const auto bound = search.bound(l.name, l.kind == ActiveLimit::Kind::kUpperBound, l.value);
      if (!bound) {
        corner = corner || l.multiplier > 0.0;
        continue;
      }
      c.name = bound->name;
      c.unit = bound->unit;
      c.value = c.limit = bound->value;
      c.shadow_price = 0.01 * l.multiplier * l.value;
    }
    out.push_back({std::move(c), false});
  }
  for (Held& h : out) h.at_corner = corner;
  return out;
}

/// Sets the limits that hold the cut, with the gain of easing each.
void take_active(const CutQuestion& q, const Solved& s, const Options& options, Job& job, CutAnswer& a) {
  const Search search(q, s.point.ap_mm);
  constexpr double kOnePercent = 1.01;
  constexpr double kTenth = 1.1;
  for (Held& h : held_by(q, s, a, search)) {
    if (h.at_corner && q.eased.name.empty()) {
      const auto one = eased(q, s, h.limit.name, kOnePercent, options, job);
      const double saved = one ? 1.0 - objective_of(q, *one) / objective_of(q, s.point) : 0.0;
      h.limit.shadow_price = std::max(0.0, saved);
    }
    double tenth = 0.0;
    if (h.limit.shadow_price > 0.0 && q.eased.name.empty()) {
      if (const auto more = eased(q, s, h.limit.name, kTenth, options, job))
        tenth = 1.0 - time_of(q, *more) / time_of(q, s.point);
    }
    a.active.push_back(std::move(h.limit));
    a.saved_by_tenth.push_back(tenth);
  }
}

/// The answer when nothing can be cut: what comes nearest, with what it violates.
CutAnswer nearest(const CutQuestion& q, const Search& search) {
  std::optional<CutAnswer> best;
  double least = 0.0;
  for (const auto& piece : search.pieces()) {
    for (const CutPoint& p : search.gentlest(piece)) {
      CutAnswer a = answer_at(q, p);
      const double excess = worst_excess(q, a.loads, a.n_rpm);
      const bool better_one =
          !best || (a.feasible && !best->feasible) || (a.feasible == best->feasible && excess < least);
      if (!better_one) continue;
      best = std::move(a);
      least = excess;
    }
  }
  best->method = "least";
  return *std::move(best);
}

struct Level {
  CutAnswer answer;
  std::optional<Solved> solved;
};

Result<Level> solve_level(const CutQuestion& q, double ap_mm, const Options& options, Job& job) {
  const Search search(q, ap_mm);
  if (search.fixed()) {
    Level out{answer_at(q, search.at({})), std::nullopt};
    out.answer.method = "given";
    return out;
  }
  auto solved = best_of(search, options, job);
  if (!solved) return tl::unexpected(solved.error());
  if (!*solved) return Level{nearest(q, search), std::nullopt};
  Level out{answer_at(q, (*solved)->point), std::nullopt};
  out.answer.method = (*solved)->solution.method;
  out.solved = *std::move(solved);
  return out;
}

/// A level without chatter, if the machine states modes: at the speed found, else at the next slower speed
/// whose lobe is deep enough. Lobes have corners everywhere, so speeds are tried one by one.
Result<Level> quiet_level(const CutQuestion& q, double ap_mm, const Options& options, Job& job) {
  auto level = solve_level(q, ap_mm, options, job);
  if (!level || !level->answer.feasible || !has_modes(q)) return level;
  const auto limit = [&](const CutAnswer& a) {
    return stable_depth(q, a.ae_mm, a.fz_mm, a.n_rpm).value_or(0.0) * ease_of(q, "stable_depth");
  };
  const double allowed = limit(level->answer);
  if (level->answer.ap_mm <= allowed) return level;
  constexpr int kMostTries = 4;  // a slower cut may take wider or thicker chips, and chatter again
  CutQuestion slower = q;
  double from = level->answer.n_rpm;
  for (int i = 0; i < kMostTries && !q.n_rpm; ++i) {
    const auto n =
        quiet_speed(q, ap_mm / ease_of(q, "stable_depth"), level->answer.ae_mm, level->answer.fz_mm, from);
    if (!n) break;
    slower.n_rpm = *n;
    auto other = solve_level(slower, ap_mm, options, job);
    if (!other) return other;
    const double stable = limit(other->answer);
    if (other->answer.feasible && other->answer.ap_mm <= stable) {
      model::ActiveConstraint c;
      c.name = "stable_depth";
      c.unit = "mm";
      c.value = other->answer.ap_mm;
      c.limit = stable;
      c.at_rpm = other->answer.n_rpm;
      other->answer.active = {c};
      other->answer.saved_by_tenth = {0.0};
      other->solved.reset();  // its prices are those of a given speed
      return other;
    }
    from = 0.98 * *n;
  }
  level->answer.feasible = false;
  level->answer.violated.push_back(broken("stable_depth", level->answer.ap_mm, allowed, "mm") + " at " +
                                   trimmed(level->answer.n_rpm, 0) + " 1/min");
  return level;
}

/// Whole levels: the fewest that are allowed and some more; the best of them.
Result<Level> best_level(const CutQuestion& q, const Options& options, Job& job) {
  if (!is_milling(q.kind)) return solve_level(q, 0.0, options, job);
  const double depth = q.depth_mm > 0.0 && std::isfinite(q.depth_mm) ? q.depth_mm : q.ap_mm.value_or(0.1);
  const auto levels_of = [&](double level) {
    const double n = std::ceil(depth / level - 1e-9);
    return n < 1.0 ? 1 : n < kMostLevels ? static_cast<int>(n) : kMostLevels;
  };
  if (q.ap_mm) {
    auto level = quiet_level(q, std::min(*q.ap_mm, depth), options, job);
    if (level) level->answer.levels = levels_of(*q.ap_mm);
    return level;
  }
  // Thinner levels than this are not tried, whatever the edge; default, unsourced.
  constexpr double kThinnestMm = 0.05;
  const bool hss = q.cutter.substrate == model::Substrate::kHss;
  const double thinnest = std::max(
      kThinnestMm, mechanics::least_depth_mm(q.cutter.cutting_diameter_mm, hss, q.material.iso_group));
  constexpr int kMostTries = 24;
  std::optional<Level> best;
  double least = 0.0;
  const auto improves = [&](int levels) -> Result<bool> {
    auto level = quiet_level(q, depth / levels, options, job);
    if (!level) return tl::unexpected(level.error());
    CutAnswer& a = level->answer;
    a.levels = levels;
    if (levels > 1 && depth / levels < thinnest) {
      a.feasible = false;
      a.violated.push_back(broken("level_depth_least", thinnest, depth / levels, "mm") +
                           ", or the edge smears");
    }
    const double objective = objective_of(q, {a.ap_mm, a.ae_mm, a.n_rpm, a.feed_mm_min});
    const bool better_one = !best || (a.feasible && !best->answer.feasible) ||
                            (a.feasible == best->answer.feasible && objective < least * (1.0 - 1e-6));
    if (!better_one) return false;
    best = *std::move(level);
    least = objective;
    return true;
  };
  const int fewest = levels_of(deepest_level(q));
  std::set<int> tried;
  for (int levels = fewest; static_cast<int>(tried.size()) < kMostTries;
       levels = std::max(levels + 1, static_cast<int>(1.3 * levels))) {
    if (levels > kMostLevels || (best && depth / levels < thinnest)) break;
    // Thinner levels only lower what could be removed at most; but a deep slot is cut slower.
    const Search search(q, depth / levels);
    const bool slower = q.slot && depth / levels > kFullFeedSlotRatio * q.cutter.cutting_diameter_mm;
    if (best && best->answer.feasible && !slower && objective_without_edges(q, search.fastest()) >= least)
      break;
    const auto better_one = improves(levels);
    if (!better_one) return tl::unexpected(better_one.error());
    tried.insert(levels);
  }
  // Between the numbers tried: from the best one by one, as long as it gets better.
  for (const int step : {-1, 1}) {
    for (int levels = best->answer.levels + step; best->answer.feasible && levels >= fewest; levels += step) {
      if (static_cast<int>(tried.size()) >= 2 * kMostTries || !tried.insert(levels).second) break;
      const auto better_one = improves(levels);
      if (!better_one) return tl::unexpected(better_one.error());
      if (!*better_one) break;
    }
  }
  return *std::move(best);
}

/// Widths of cut that are tried where the engagement is constant, over the diameter: those at which the speed
/// is tabled (mechanics/life/arc_speed.h), and what lies between them where it changes most.
constexpr std::array<double, 9> kWidths = {0.05, 0.075, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5};

/// The question with the width at which a cut of constant engagement is best.
Result<CutQuestion> with_best_width(const CutQuestion& q, const Options& options, Job& job) {
  std::optional<CutQuestion> best;
  bool feasible = false;
  double least = 0.0;
  const bool hard = model::cuts_hard_steel(q.cutter, q.material);
  for (const double share : kWidths) {
    if (hard && share > model::kHardCut.narrow_width) break;
    CutQuestion one = q;
    one.ae_mm = rounded(share * q.cutter.cutting_diameter_mm, 3);
    if (best && q.width_mm > 0.0 && *one.ae_mm > q.width_mm) break;
    const auto level = best_level(one, options, job);
    if (!level) return tl::unexpected(level.error());
    const CutAnswer& a = level->answer;
    const double objective = objective_of(one, {a.ap_mm, a.ae_mm, a.n_rpm, a.feed_mm_min});
    if (best && !(a.feasible && !feasible) && !(a.feasible == feasible && objective < least)) continue;
    best = std::move(one);
    feasible = a.feasible;
    least = objective;
  }
  return *std::move(best);
}

Result<CutAnswer> answer(const CutQuestion& question, const Options& options, Job& job) {
  CutQuestion q = question;
  if (q.constant_engagement && q.kind == CutKind::kRough && !q.ae_mm) {
    auto one = with_best_width(q, options, job);
    if (!one) return tl::unexpected(one.error());
    q = *std::move(one);
  }
  auto level = best_level(q, options, job);
  if (!level) return tl::unexpected(level.error());
  CutAnswer a = std::move(level->answer);
  if (level->solved && level->solved->solution.feasible && a.feasible)
    take_active(q, *level->solved, options, job, a);
  return a;
}

}  // namespace

Result<CutAnswer> cut(const CutQuestion& q, const Options& options, Job& job) {
  const auto within = [](double v, double least, double most) { return v >= least && v <= most; };
  // Far outside of any tool and material.
  if (!within(q.cutter.cutting_diameter_mm, 1e-3, 1e4) || !within(q.material.kc11_n_mm2, 1e-3, 1e6)) {
    return fail("OPT-QUESTION", "a cut needs a cutter with a diameter and a material with a specific force");
  }
  if (auto wrong = not_a_cut(q); !wrong.empty()) {
    CutAnswer a;
    a.method = "given";
    a.violated = std::move(wrong);
    return a;
  }
  const bool needs_start = !(q.n_rpm && (q.feed_mm_min || q.fz_mm));
  const bool has_speed = within(q.vc_start_m_min, 1e-6, 1e6);
  const bool has_feed = within(q.fz_start_mm, 1e-7, 1e3);
  if (needs_start && !(has_speed && (has_feed || feeds_by_pitch(q)))) {
    return fail("OPT-QUESTION", "no start values of speed and feed are known for cutter " + q.cutter.id);
  }
  auto a = answer(q, options, job);
  const bool asks_least = !q.feed_mm_min && !q.fz_mm && least_fz(q) > 0.0 && !least_fz_stated(q);
  if (!a || a->feasible || !asks_least) return a;
  // A least feed that the maker did not state gives way before the cut does.
  CutQuestion lower = q;
  lower.cutter.fz_min_mm = 0.0;
  auto b = answer(lower, options, job);
  if (!b || !b->feasible) return a;
  return b;
}

}  // namespace capstan::optimise
