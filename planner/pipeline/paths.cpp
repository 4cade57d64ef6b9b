#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>

#include "planner/base/number.h"
#include "planner/exchange/iso14649/curves.h"
#include "planner/motion/time.h"
#include "planner/pipeline/grouped.h"
#include "planner/pipeline/holding.h"
#include "planner/pipeline/split.h"
#include "planner/pipeline/steps.h"
#include "planner/stock/turned.h"

// Step by step in order: depths, path, sections, feeds, with the stock carried on.

namespace capstan::pipeline {
namespace {

using model::Model;
using model::ShapeKind;

constexpr double kTolerableExcess =
    0.1;                         // of a limit, somewhere on a path: sections are known to a cell's width
constexpr double kWhole = 0.95;  // share of depth times width from which a section is a rectangle
constexpr double kCellsPerDiameter = 30.0;  // of the stock map, for the smallest cutter of the set-up
constexpr double kMaximumCells = 600e3;     // keeps a set-up's map near 7 MB

/// What is still left on a feature's walls and floor after the steps so far.
struct Left {
  double side_mm = 0.0, bottom_mm = 0.0;
};

/// A milling step done, for those after it that cut only what it could not reach.
struct Milled {
  model::TypeId operation = model::TypeId::kNone;
  double diameter_mm = 0.0, corner_radius_mm = 0.0, side_mm = 0.0, bottom_mm = 0.0;
};

bool is_end_mill(const model::Cutter& c) {
  return c.cutter_class == model::CutterClass::kEndmill ||
         c.cutter_class == model::CutterClass::kBullnoseEndmill;
}

/// The earlier step that reached all of the area but corners and narrow places, if this one has a smaller
/// cutter and leaves the same: then there is no more to do than the rest.
std::optional<toolpath::Cleared> cleared_by(const std::vector<Milled>& before, const toolpath::PathJob& job) {
  constexpr double kSame = 1e-6;
  std::optional<toolpath::Cleared> out;
  for (const Milled& b : before) {
    if (b.operation != job.operation || std::abs(b.side_mm - job.allowance_side_mm) > kSame ||
        b.bottom_mm > job.allowance_bottom_mm + kSame ||
        b.diameter_mm < job.cutter.cutting_diameter_mm + kSame)
      continue;
    if (!out || b.diameter_mm < out->diameter_mm)
      out = toolpath::Cleared{b.diameter_mm, b.corner_radius_mm, b.side_mm};
  }
  return out;
}

/// What one try at a step came to.
struct Made {
  toolpath::GeneratedPath path;
  optimise::CutQuestion question;
  optimise::CutAnswer answer;
  bool depth_open = false, width_open = false;
  std::optional<model::Reason> precedent;  ///< the case that speed and feed started from
};

void append(toolpath::GeneratedPath& to, const toolpath::GeneratedPath& from) {
  auto& p = to.path;
  const auto& q = from.path;
  for (std::size_t i = 0; i < q.size(); ++i) {
    p.x.push_back(q.x[i]);
    p.y.push_back(q.y[i]);
    p.z.push_back(q.z[i]);
    p.cx.push_back(q.cx[i]);
    p.cy.push_back(q.cy[i]);
    p.kind.push_back(i == 0 ? model::MoveKind::kRapid : q.kind[i]);
    p.role.push_back(i == 0 ? model::MoveRole::kLink : q.role[i]);
    to.feed_factor.push_back(from.feed_factor[i]);
    to.speed_factor.push_back(from.speed_factor[i]);
    to.dwell_s.push_back(from.dwell_s[i]);
  }
}

/// Area and height of the highest material over a feature, set-up frame.
double top_over(const stock::HeightMap& map, const toolpath::PathJob& job) {
  geometry::Box3 box;
  const auto b = geometry::bounds(job.shape.area);
  for (const geometry::Vec2 c :
       {b.lo, geometry::Vec2{b.hi.x, b.lo.y}, b.hi, geometry::Vec2{b.lo.x, b.hi.y}}) {
    box.add(job.feature_in_setup.to_parent({c.x, c.y, 0.0}));
  }
  const int x0 = std::max(0, static_cast<int>(std::floor((box.lo.x - map.origin.x) / map.cell_mm)));
  const int x1 = std::min(map.nx - 1, static_cast<int>(std::floor((box.hi.x - map.origin.x) / map.cell_mm)));
  const int y0 = std::max(0, static_cast<int>(std::floor((box.lo.y - map.origin.y) / map.cell_mm)));
  const int y1 = std::min(map.ny - 1, static_cast<int>(std::floor((box.hi.y - map.origin.y) / map.cell_mm)));
  float top = 0.0F;
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) top = std::max(top, map.at(x, y).top_mm);
  }
  return map.origin.z + static_cast<double>(top);
}

bool opens_outwards(const model::FeatureShape& s) {
  return s.kind == ShapeKind::kStep || s.kind == ShapeKind::kOutside;
}

using QuestionKey = std::tuple<std::string, int, double, double, double, double, double, double, double,
                               double, double, double, double, double, double, double, bool, bool>;

QuestionKey key_of(const optimise::CutQuestion& q) {
  constexpr double kUnset = -1.0;
  return {q.cutter.id,
          static_cast<int>(q.kind),
          q.vc_start_m_min,
          q.fz_start_mm,
          q.depth_mm,
          q.width_mm,
          q.pre_hole_mm,
          q.deflection_limit_mm,
          q.ap_mm.value_or(kUnset),
          q.ae_mm.value_or(kUnset),
          q.n_rpm.value_or(kUnset),
          q.feed_mm_min.value_or(kUnset),
          q.fz_mm.value_or(kUnset),
          q.engaged_diameter_mm,
          q.ap_most_mm,
          q.least_feed_ratio,
          q.slot,
          q.override_locked};
}

class PathMaker {
 public:
  explicit PathMaker(Work& w) : w_(w), maps_(w.setups.size()) {
    options_.solver = w.inputs.solver;
    options_.backends = w.inputs.backends;
    // Ipopt has no bound that weak spindles do not reach: it serves who asks for it.
    if (options_.solver == optimise::Solver::kNlopt) options_.backends.ipopt = nullptr;
    options_.starts = 2;
    options_.relative_tolerance = 1e-7;
  }

  Status run() {
    std::size_t done = 0;
    for (StepWork& step : w_.steps) {
      w_.job.progress("paths", static_cast<double>(done++) / static_cast<double>(w_.steps.size()));
      if (w_.job.stop_requested())
        return fail("PIP-STOPPED", "planning was stopped before every step had its path");
      if (auto ok = make(step); !ok) return ok;
    }
    return {};
  }

 private:
  Status make(StepWork& step) {
    if (has_given_path(w_, step) && !rigid_tap(step)) return explicit_path(step);
    if (!w_.plan.model.holds<model::MachiningOperation>(step.operation)) return {};
    if (step.shapes.empty()) {
      no_path(step, "the shape of its feature is not known");
      return {};
    }
    if (step.cutter.cutting_diameter_mm <= 0.0) return {};  // no cutter was found; said already
    rank_by_time(step);
    const std::size_t tries = std::max<std::size_t>(1, step.candidates.size());
    GroupedReasons why_not;
    for (std::size_t i = 0; i < tries; ++i) {
      const model::Candidate* candidate = i < step.candidates.size() ? &step.candidates[i] : nullptr;
      if (candidate != nullptr) step.cutter = candidate->cutter;
      auto made = attempt(step, candidate);
      if (!made) {
        why_not.add(step.cutter.id, made.error().message);
        step.rejected_tools.push_back({step.cutter.id, made.error().message});
        continue;
      }
      if (i > 0) take_cutter(step, *candidate);
      return finish(step, *std::move(made));
    }
    no_path(step, why_not.text());
    return {};
  }

  /// Roughing: of the cutters that fit, the one that takes the volume away soonest, tool change included.
  void rank_by_time(StepWork& step) {
    if (step.candidates.size() < 2 || step.shapes.empty()) return;
    const Model& m = w_.plan.model;
    if (!m.holds<model::PlaneMilling>(step.operation) && !m.holds<model::SideRoughMilling>(step.operation) &&
        !m.holds<model::BottomAndSideRoughMilling>(step.operation)) {
      return;
    }
    const std::string first = step.candidates.front().cutter.id;
    constexpr std::size_t kCompared = 5;
    const std::size_t n = std::min(kCompared, step.candidates.size());
    std::vector<std::pair<double, std::size_t>> times;
    for (std::size_t i = 0; i < n; ++i) {
      StepWork trial = step;
      trial.cutter = step.candidates[i].cutter;
      auto job = job_of(w_, trial, step.shapes.front());
      prepare(trial, job);
      const auto q = question_of(w_, trial, &step.candidates[i], job);
      const auto a = cut(q);
      double t = 1e12 * static_cast<double>(i + 1);
      if (a && a->feasible) {
        const double volume = geometry::area(job.shape.area) * q.depth_mm;
        t = volume / (a->ap_mm * a->ae_mm * a->feed_mm_min) * 60.0;
        const bool used = std::find(w_.used_cutters.begin(), w_.used_cutters.end(), trial.cutter.id) !=
                          w_.used_cutters.end();
        if (!used) t += w_.plan.machine.tool_change_s;
      }
      times.emplace_back(t, i);
    }
    const double of_first = times.front().first;
    std::stable_sort(times.begin(), times.end());
    std::vector<model::Candidate> sorted;
    for (const auto& [t, i] : times) sorted.push_back(step.candidates[i]);
    for (std::size_t i = n; i < step.candidates.size(); ++i) sorted.push_back(step.candidates[i]);
    step.candidates = std::move(sorted);
    if (step.candidates.front().cutter.id == first) return;
    step.cutter = step.candidates.front().cutter;
    step.rejected_tools.push_back(
        {first,
         "fits, but takes " +
             (of_first < 1e11 ? trimmed(of_first, 1) + " s" : std::string("too long, or breaks a limit,")) +
             " against " + trimmed(times.front().first, 1) + " s of " + step.cutter.id});
    take_cutter(step, step.candidates.front());
  }

  /// A cutter further down the list does what the first could not.
  void take_cutter(StepWork& step, const model::Candidate& c) {
    std::erase_if(step.rejected_tools, [&](const auto& r) { return r.what == c.cutter.id; });
    w_.plan.model.get<model::MachiningOperation>(step.operation)->its_tool = tool_noun(w_, c.cutter);
    w_.plan.ledger.bind(step.operation, "its_tool", model::Binder::kToolSelection, c.why,
                        {{step.step, "its_operation"}}, step.rejected_tools);
  }

  Result<Made> attempt(const StepWork& step, const model::Candidate* candidate) {
    Made out;
    bool first = true;
    for (const auto& shape : step.shapes) {
      auto job = job_of(w_, step, shape);
      prepare(step, job);
      if (first) {
        out.question = question_of(w_, step, candidate, job);
        if (step.open_technology) out.precedent = start_from_case(w_, step, shape, out.question);
        auto answer = cut(out.question);
        if (!answer) return tl::unexpected(answer.error());
        out.answer = *std::move(answer);
        out.depth_open = !out.question.ap_mm.has_value();
        // A finishing pass takes what is left on the wall; across a floor it steps as its path chooses.
        out.width_open = !out.question.ae_mm.has_value() && out.question.kind == optimise::CutKind::kRough;
        if (step.open_technology && !out.answer.feasible && out.question.ap_mm && !step.proposed) {
          if (auto ok = lower_depth(step, out); !ok) return tl::unexpected(ok.error());
        }
        if (step.open_technology && !out.answer.feasible) {
          std::string limits;
          for (const auto& v : out.answer.violated) limits += (limits.empty() ? "" : ", ") + v;
          return fail("PIP-INFEASIBLE", "no cut keeps every limit: " + limits);
        }
      }
      if (out.depth_open) job.axial_depth_mm = out.answer.ap_mm;
      if (out.width_open && out.answer.ae_mm > 0.0) job.radial_depth_mm = out.answer.ae_mm;
      if (out.question.ae_mm) job.radial_depth_mm = *out.question.ae_mm;
      const bool freeform = w_.plan.model.holds<model::FreeformOperation>(step.operation);
      auto path = kept_clear(w_, step, job, [&](const toolpath::PathJob& j) {
        return freeform ? freeform_path(w_, step, j, out.answer, map_of(step.setup))
                        : toolpath::generate(j, w_.job);
      });
      if (!path) return tl::unexpected(path.error());
      if (first) {
        out.path = *std::move(path);
      } else {
        append(out.path, *path);
      }
      first = false;
    }
    return out;
  }

  /// A given depth at which no feed keeps the limits is cut in thinner levels; said, never silent.
  Status lower_depth(const StepWork& step, Made& out) {
    auto q = out.question;
    q.ap_most_mm = *q.ap_mm;
    q.ap_mm.reset();
    auto answer = cut(q);
    if (!answer) return tl::unexpected(answer.error());
    if (!answer->feasible) return {};
    w_.job.warn("PIP-CHANGED", "step '" + name_of(step) + "': the given depth of " +
                                   trimmed(q.ap_most_mm, 3) + " mm per level breaks " +
                                   out.answer.violated.front() + "; cut " + trimmed(answer->ap_mm, 3) +
                                   " mm deep instead");
    out.question = q;
    out.answer = *std::move(answer);
    out.depth_open = true;
    return {};
  }

  void prepare(const StepWork& step, toolpath::PathJob& job) {
    const SetupWork& setup = w_.setups[step.setup];
    shape_from_mesh(w_, step, job);
    aim_at_the_middle(job.shape);
    if (opens_outwards(job.shape)) {
      const auto outline = transformed(setup.stock, inverse(job.feature_in_setup));
      const auto raw = geometry::rectangle(geometry::xy(outline.lo), geometry::xy(outline.hi));
      job.shape.area = geometry::intersect(job.shape.area, raw);
    }
    stock::HeightMap& map = map_of(step.setup);
    const double top = job.feature_in_setup.origin.z;
    const double bottom = top - job.shape.depth_mm;
    const double material = top_over(map, job);
    // Nothing there at all: the file's own top is as good as any (and the path runs in air).
    job.start_z_mm = material > bottom ? material : top;
    if (job.shape.kind == ShapeKind::kHole || job.shape.kind == ShapeKind::kThread ||
        job.shape.kind == ShapeKind::kChamfer) {
      job.start_z_mm = std::max(job.start_z_mm, top);
    }
    const auto hole = holes_.find({step.feature, job.shape.member});
    if (hole != holes_.end() && !job.previous_diameter_mm) job.previous_diameter_mm = hole->second;
    const auto it = left_.find({step.feature, job.shape.member});
    if (it != left_.end()) {
      job.left_on_side_mm = it->second.side_mm;
      job.left_on_bottom_mm = it->second.bottom_mm;
    }
    take_rest(step, job);
  }

  /// Whether the step cuts what an earlier one left, and whether a later one will do so after it. A step that
  /// rules proposed says so itself; of one that was read, its nouns tell.
  void take_rest(const StepWork& step, toolpath::PathJob& job) const {
    const bool area = job.shape.kind == ShapeKind::kPocket || job.shape.kind == ShapeKind::kSlot;
    if (!area || !is_end_mill(job.cutter)) return;
    if (step.proposed) {
      const auto after = [&](const StepWork& s) {
        return s.feature == step.feature && s.proposal.rest_of_diameter_mm > 0.0 &&
               s.operation.type == step.operation.type;
      };
      job.rest_follows =
          step.proposal.rest_of_diameter_mm == 0.0 && std::any_of(w_.steps.begin(), w_.steps.end(), after);
      if (step.proposal.rest_of_diameter_mm == 0.0) return;
    }
    const auto it = milled_.find({step.feature, job.shape.member});
    if (it != milled_.end()) job.cleared_by = cleared_by(it->second, job);
  }

  Result<optimise::CutAnswer> cut(const optimise::CutQuestion& q) {
    const auto key = key_of(q);
    if (const auto it = answers_.find(key); it != answers_.end()) return it->second;
    auto a = optimise::cut(q, options_, w_.job);
    if (a) answers_.emplace(key, *a);
    return a;
  }

  Status finish(StepWork& step, Made made) {
    record_cut(w_, step, made.answer, made.depth_open, made.width_open, made.precedent);
    for (const auto& shape : step.shapes) {
      const auto job = job_of(w_, step, shape);
      if (w_.plan.model.holds<model::Two5dMillingOperation>(step.operation)) {
        left_[{step.feature, shape.member}] = {job.allowance_side_mm, job.allowance_bottom_mm};
        if (is_end_mill(step.cutter)) {
          milled_[{step.feature, shape.member}].push_back({job.operation, step.cutter.cutting_diameter_mm,
                                                           step.cutter.corner_radius_mm,
                                                           job.allowance_side_mm, job.allowance_bottom_mm});
        }
      }
      const bool bores = w_.plan.model.holds<model::DrillingTypeOperation>(step.operation) &&
                         !w_.plan.model.holds<model::CenterDrilling>(step.operation) &&
                         !w_.plan.model.holds<model::CounterSinking>(step.operation);
      // A pilot or a mark that ends far above the bottom is no hole for the next tool to go through.
      const bool deep = job.cutting_depth_mm.value_or(shape.depth_mm) >= 0.5 * shape.depth_mm;
      if (bores && deep) holes_[{step.feature, shape.member}] = step.cutter.cutting_diameter_mm;
    }
    const auto given = given_technology(w_.plan.model, step.operation, step.cutter);
    optimise::FeedQuestion fq;
    fq.cut = made.question;
    fq.n_rpm = given.rpm.value_or(made.answer.n_rpm);
    fq.feed_mm_min = given.feed_mm_min.value_or(made.answer.feed_mm_min);
    fq.adapt = step.open_technology || feed_was_planned(step);
    fq.feed_factor = std::move(made.path.feed_factor);
    fq.speed_factor = std::move(made.path.speed_factor);
    fq.dwell_s = std::move(made.path.dwell_s);
    auto path = std::make_shared<model::CutterPath>(std::move(made.path.path));
    model::StepResult r = result_of(step);
    r.axial_depth_mm = made.answer.ap_mm;
    r.radial_depth_mm = made.answer.ae_mm;
    r.active = made.answer.active;
    if (auto ok = measure(step, *path, r, fq); !ok) return ok;
    const auto feeds = optimise::feeds(fq, *path);
    if (step.open_technology && feeds.worst_excess > kTolerableExcess) {
      w_.job.warn("PIP-EXCESS", "step '" + name_of(step) +
                                    "': somewhere along the path a limit is exceeded by " +
                                    trimmed(100.0 * feeds.worst_excess, 1) + " % even at the least feed");
    }
    r.schedule = std::make_shared<const model::FeedSchedule>(feeds.schedule);
    r.loads = feeds.peak;
    r.path = path;
    const Deviation deviation = deviation_of(w_, step, job_of(w_, step, step.shapes.front()));
    r.path_deviation_mm = r.contour_tolerance_mm = deviation.mm;
    record_path(w_, step, path, deviation.why);
    return keep(step, std::move(r), fq);
  }

  /// Whether the feed is one that planning bound before: then it is the most, and each move has its own.
  bool feed_was_planned(const StepWork& step) const {
    const auto* op = w_.plan.model.get<model::MachiningOperation>(step.operation);
    if (op == nullptr || !op->its_technology.set()) return false;
    const auto* d = w_.plan.ledger.find(op->its_technology, "feedrate");
    return d != nullptr && !d->pinned && d->binder != model::Binder::kGiven &&
           d->binder != model::Binder::kOperator;
  }

  // A given path is moves at feed; without a compensation chuck that breaks the tap, so the thread is planned
  // as a synchronised cycle.
  bool rigid_tap(const StepWork& step) {
    const auto* tapping = w_.plan.model.get<model::Tapping>(step.operation);
    if (tapping == nullptr || tapping->compensation_chuck.value_or(false)) return false;
    w_.job.warn("PIP-CHANGED",
                "step '" + name_of(step) +
                    "': the given toolpath of the tap is moves without synchronisation; planned as rigid "
                    "tapping instead");
    return true;
  }

  Status explicit_path(StepWork& step) {
    auto given = exchange::path_of_step(w_.plan, step.step, {}, w_.job);
    if (!given) {
      w_.job.report(given.error());
      no_path(step, given.error().message);
      return {};
    }
    if (given->path.size() == 0) return {};
    if (const auto touch = touch_of(given->path, step.cutter, w_.setups[step.setup].holding)) {
      no_path(step, "the given path is not kept: " + touch->text);
      return {};
    }
    model::StepResult r = result_of(step);
    optimise::FeedQuestion fq;
    fq.adapt = false;
    fq.cut.cutter = step.cutter;
    fq.cut.machine = w_.plan.machine;
    fq.cut.material = w_.plan.material;
    auto path = std::make_shared<model::CutterPath>(std::move(given->path));
    if (step.cutter.cutting_diameter_mm > 0.0) {
      if (auto ok = measure(step, *path, r, fq); !ok) return ok;
    }
    r.path = path;
    r.schedule = std::make_shared<const model::FeedSchedule>(std::move(given->schedule));
    for (std::size_t i = 0; i < path->size(); ++i) {
      r.feed_mm_min = std::max(r.feed_mm_min, r.schedule->feed_mm_min[i]);
      if (std::abs(r.schedule->spindle_rpm[i]) > std::abs(r.spindle_rpm))
        r.spindle_rpm = r.schedule->spindle_rpm[i];
    }
    return keep(step, std::move(r), fq);
  }

  /// Sections along the path, for feeds: where those may be chosen, straight moves are cut where they change.
  Status measure(const StepWork& step, model::CutterPath& path, model::StepResult& r,
                 optimise::FeedQuestion& fq) {
    auto m = engagement::measure(path, step.cutter, map_of(step.setup));
    if (!m) {
      w_.job.warn(m.error().code, "step '" + name_of(step) + "' is not measured: " + m.error().message);
      return {};
    }
    if (m->rapid_removed_mm3 > 1e-3) {
      w_.job.warn("PIP-RAPID", "step '" + name_of(step) + "': rapid moves touch " +
                                   trimmed(m->rapid_removed_mm3, 3) + " mm3 of material");
    }
    auto& s = m->sections;
    const bool mills = fq.cut.kind == optimise::CutKind::kRough || fq.cut.kind == optimise::CutKind::kFinish;
    if (fq.adapt && mills) split_uneven(step.cutter.cutting_diameter_mm, path, s, fq);
    for (std::size_t i = 0; i < s.size(); ++i) {
      const engagement::Engagement& e = m->engagement[i];
      // A section that is no rectangle (a wall and a floor at once) counts as two of its area: as deep, and
      // as wide.
      const double ap = e.ap_mm;
      const double ae = e.ae_mm;
      const bool whole = e.plunge || !(ap > 0.0 && ae > 0.0) || e.csa_mm2 >= kWhole * ap * ae;
      // On an arc about a corner the edge goes farther than the centre, and removes more than depth times
      // width.
      const double swept = ap > 0.0 ? e.csa_mm2 / ap : ae;
      optimise::CutSample sample{.move = s.move[i],
                                 .ap_mm = ap,
                                 .ae_mm = whole && !e.plunge ? std::max(ae, swept)
                                          : whole            ? ae
                                                             : swept,
                                 .plunge = e.plunge,
                                 .at_mm = s.at_mm[i],
                                 .step_mm = e.step_mm,
                                 .entry_rad = e.entry_rad,
                                 .exit_rad = e.exit_rad,
                                 .csa_mm2 = e.csa_mm2};
      fq.samples.push_back(sample);
      if (whole) continue;
      sample.ap_mm = e.csa_mm2 / ae;
      sample.ae_mm = ae;
      fq.samples.push_back(sample);
    }
    r.sections = std::make_shared<const model::SectionSeries>(std::move(m->sections));
    return {};
  }

  Status keep(const StepWork& step, model::StepResult r, const optimise::FeedQuestion& fq) {
    if (r.feed_mm_min == 0.0) r.feed_mm_min = fq.feed_mm_min;
    if (r.spindle_rpm == 0.0) r.spindle_rpm = fq.n_rpm;
    const double d = step.cutter.cutting_diameter_mm;
    r.vc_m_min = 3.14159265358979323846 * d * std::abs(r.spindle_rpm) / 1000.0;
    if (r.spindle_rpm != 0.0)
      r.fz_mm = r.feed_mm_min / (std::abs(r.spindle_rpm) * std::max(1, step.cutter.teeth));
    const auto t = motion::time_of(*r.path, *r.schedule, w_.plan.machine);
    if (t) {
      r.cutting_s = t->cutting_s + t->dwell_s;
      r.rapid_s = t->rapid_s;
      tell_slow(step, r);
    } else {
      w_.job.warn(t.error().code, "step '" + name_of(step) + "' has no time: " + t.error().message);
    }
    w_.plan.steps.push_back(std::move(r));
    return {};
  }

  /// Hours of cutting are worth another tool: said with what holds the step back.
  void tell_slow(const StepWork& step, const model::StepResult& r) {
    constexpr double kSlowS = 4.0 * 3600.0;  // default, unsourced
    if (!step.open_technology || r.cutting_s < kSlowS) return;
    std::string limits;
    for (const auto& a : r.active) limits += (limits.empty() ? "" : ", ") + a.name;
    w_.job.warn("PIP-SLOW", "step '" + name_of(step) + "' cuts " + trimmed(r.cutting_s / 3600.0, 1) +
                                " h with " + step.cutter.id + " (" +
                                trimmed(step.cutter.cutting_diameter_mm, 3) + " mm, " +
                                trimmed(step.cutter.stick_out_mm, 1) + " mm out), held back by " +
                                (limits.empty() ? "given values" : limits) +
                                "; a larger or shorter cutter would be quicker");
  }

  model::StepResult result_of(const StepWork& step) const {
    model::StepResult r;
    r.step = step.step;
    r.setup = step.setup;
    r.cutter_id = step.cutter.id;
    const auto* op = w_.plan.model.get<model::MachiningOperation>(step.operation);
    if (op != nullptr) {
      if (const auto* f = w_.plan.model.get<model::MillingMachineFunctions>(op->its_machine_functions)) {
        r.flood = f->coolant.value_or(false);
        r.mist = f->mist.value_or(false);
        r.through = f->through_spindle_coolant.value_or(false);
      }
    }
    return r;
  }

  std::string name_of(const StepWork& step) const {
    const auto* e = w_.plan.model.get<model::Executable>(step.step);
    return e != nullptr ? e->its_id.value_or("") : "";
  }

  void no_path(const StepWork& step, const std::string& why) {
    w_.plan.unplanned.push_back({step.feature, "step '" + name_of(step) + "': " + why});
    w_.job.report({.code = "PIP-NO-PATH",
                   .severity = Severity::kError,
                   .message = "step '" + name_of(step) + "' has no path: " + why,
                   .file = w_.plan.file_name,
                   .instance = w_.plan.model.origin(step.step).instance});
  }

  stock::HeightMap& map_of(std::size_t setup) {
    auto& map = maps_[setup];
    if (!map) {
      double smallest = 1e300;
      for (const StepWork& s : w_.steps) {
        if (s.setup == setup && s.cutter.cutting_diameter_mm > 0.0) {
          smallest = std::min(smallest, s.cutter.cutting_diameter_mm);
        }
      }
      if (smallest > 1e200) smallest = 10.0;
      const auto& box = w_.setups[setup].stock;
      const double cell = stock::cell_for(smallest, box, kCellsPerDiameter, kMaximumCells);
      const bool upright = std::abs(w_.setups[setup].workpiece.z.z) > 1.0 - 1e-9;
      const auto& round = w_.plan.stock.cylinder_radius_mm;
      map = round && upright ? stock::from_cylinder(box, *round, cell) : stock::from_box(box, cell);
    }
    if (setup != last_setup_) {
      // Another clamping: what the others took away is gone here, too.
      last_setup_ = setup;
      for (std::size_t i = 0; i < maps_.size(); ++i) {
        if (i != setup && maps_[i])
          stock::take_over(*map, w_.setups[setup].workpiece, *maps_[i], w_.setups[i].workpiece);
      }
    }
    return *map;
  }

  Work& w_;
  std::size_t last_setup_ = static_cast<std::size_t>(-1);
  std::vector<std::optional<stock::HeightMap>> maps_;
  std::map<std::pair<AnyRef, int>, Left> left_;
  std::map<std::pair<AnyRef, int>, std::vector<Milled>> milled_;
  std::map<std::pair<AnyRef, int>, double> holes_;  ///< diameter made so far, mm
  std::map<QuestionKey, optimise::CutAnswer> answers_;
  optimise::Options options_;
};

}  // namespace

Status make_paths(Work& w) { return PathMaker(w).run(); }

}  // namespace capstan::pipeline
