#include "planner/making/step/path/equal_areas.h"

#include <cmath>
#include <string>
#include <utility>

#include "planner/ground/memo/remembered.h"
#include "planner/making/step/cut/question.h"
#include "planner/making/step/path/job_of.h"
#include "planner/model/plan/path/own_frame.h"

// Of two areas with one key all ways have the same paths, sections and feeds, each in its own frame, and so
// the same times but for rounding. The way that won for the first is made for the next, whole: measured,
// scheduled and held against the limits as any other. Only where its path and its time are those of the first
// the others are taken as lost, too; else all ways are tried. A memo has no part in this: with one or without
// the same ways are tried.

namespace capstan::step {

using geometry::Vec2;

namespace {

constexpr double kSameTime =
    1e-9;  ///< of a path's time: more than the rounding of equal paths at other places

/// A job as that of any area that is equal to it.
toolpath::PathJob placeless(toolpath::PathJob job) {
  job.step.clear();
  job.shape.name.clear();
  job.shape.feature = {};
  job.shape.member = 0;
  job.shape.made_of.clear();
  job.shape.frame.origin.x = job.shape.frame.origin.y = 0.0;
  job.feature_in_setup.origin.x = job.feature_in_setup.origin.y = 0.0;
  job.stock = {};  // of an area that is closed all round nothing is cut beyond
  return job;
}

}  // namespace

std::optional<memo::Key> key_of_area(const PlanSoFar& p, const draft::StepDraft& step,
                                     const model::Candidate* candidate, bool inwards,
                                     const std::optional<ConstantCut>& constant, const Means& means) {
  const bool alone = step.shapes.size() == 1 && p.setups[step.setup].holding.solids.empty();
  if (!alone || p.wishes.cases != nullptr || p.wishes.edits != nullptr) return std::nullopt;
  toolpath::PathJob job = job_of(p, step, step.shapes.front());
  means.progress.prepare(step, means.stocks.of(step.setup), job);
  if (job.shape.open || !job.avoid.loops.empty()) return std::nullopt;
  geometry::Box3 box;
  for (const geometry::Loop& loop : job.shape.area.loops) {
    for (const Vec2 at : loop) {
      box.add(job.feature_in_setup.to_parent({at.x, at.y, 0.0}));
    }
  }
  if (box.empty()) return std::nullopt;
  const auto part = means.stocks.part(step.setup, box, xy(job.feature_in_setup.origin), step.cutter);
  if (!part) return std::nullopt;
  std::optional<optimise::CutQuestion> other;
  if (constant) other = constant->question;
  const optimise::CutQuestion question = question_of(p, step, candidate, job);
  return memo::key_of(memo::Stage::kPath, std::string("equal areas"), placeless(std::move(job)), question,
                      step.proposed, inwards, other, *part);
}

const EqualAreas::Choice* EqualAreas::find(const memo::Key& area) const {
  const auto at = known_.find(area);
  return at == known_.end() ? nullptr : &at->second;
}

memo::Key EqualAreas::key_of_path(const MeasuredCut& cut) {
  return memo::key_of(memo::Stage::kPath, model::in_own_frame(*cut.path, model::own_origin(*cut.path)));
}

bool EqualAreas::same(const Choice& choice, const MeasuredCut& cut, std::optional<double> seconds) {
  return seconds && std::abs(*seconds - choice.seconds) <= kSameTime * choice.seconds &&
         key_of_path(cut) == choice.path;
}

}  // namespace capstan::step
