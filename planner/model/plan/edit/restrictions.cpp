#include "planner/model/plan/edit/restrictions.h"

#include <algorithm>

#include "planner/ground/base/number.h"
#include "planner/ground/base/text.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/model/plan/edit/deciding.h"

namespace capstan::model {
namespace {

std::string with_unit(double v, EditOf of) {
  const std::string_view unit = unit_of(of);
  return trimmed(v, 4) + (unit.empty() ? "" : " " + std::string(unit));
}

double size_of(const Cutter& c, EditOf of) {
  return of == EditOf::kToolDiameter   ? c.cutting_diameter_mm
         : of == EditOf::kToolStickOut ? c.stick_out_mm
                                       : static_cast<double>(c.teeth);
}

/// Whether a tool is one that a value means: its name with * and ?, or T and its number.
bool means_tool(std::string_view value, const Cutter& c) {
  return names(value, c.id) || (c.pocket > 0 && value == "T" + std::to_string(c.pocket));
}

template <class Test>
std::optional<Barred> barred_by_name(const std::vector<Edit>& edits, const StepNames& step, EditOf of,
                                     Test&& means) {
  for (const Edit& e : edits) {
    if (e.kind == EditKind::kForbid && e.of == of && names(e.where, step) && means(e))
      return Barred{&e, words_of(e)};
  }
  return std::nullopt;
}

}  // namespace

bool names(std::string_view pattern, const StepNames& step) {
  if (pattern == "*") return true;
  return (!step.feature.empty() && names(pattern, step.feature)) ||
         (!step.step.empty() && names(pattern, step.step)) || (!step.id.empty() && names(pattern, step.id));
}

Reason reason_of(const Edit& e) { return {std::string(kByEdit), words_of(e), "the operator"}; }

std::optional<Barred> barred(const std::vector<Edit>& edits, const StepNames& step, const Cutter& cutter) {
  for (const Edit& e : edits) {
    if (!is_tool_limit(e) || !names(e.where, step)) continue;
    constexpr double kSame = 1e-6;  // mm
    const double size = size_of(cutter, e.of);
    if (e.at_least ? size >= e.number - kSame : size <= e.number + kSame) continue;
    return Barred{&e, words_of(e) + ": '" + cutter.id + "' has " + with_unit(size, e.of)};
  }
  return barred_by_name(edits, step, EditOf::kTool,
                        [&](const Edit& e) { return means_tool(e.value, cutter); });
}

const std::vector<Cutter>& allowed(const std::vector<Edit>& edits, const StepNames& step,
                                   const std::vector<Cutter>& all, const std::vector<CutterClass>& classes,
                                   std::vector<Cutter>& kept, std::vector<Rejected>& why) {
  const bool any = std::any_of(edits.begin(), edits.end(), [&](const Edit& e) {
    return (is_tool_limit(e) || (e.kind == EditKind::kForbid && e.of == EditOf::kTool)) &&
           names(e.where, step);
  });
  if (!any) return all;
  kept.clear();
  for (const Cutter& c : all) {
    auto no = barred(edits, step, c);
    if (!no) {
      kept.push_back(c);
    } else if (why.size() < kMostBarred &&
               std::find(classes.begin(), classes.end(), c.cutter_class) != classes.end()) {
      why.push_back({c.id, std::move(no->why)});
    }
  }
  return kept;
}

std::optional<Barred> barred_operation(const std::vector<Edit>& edits, const StepNames& step,
                                       TypeId operation) {
  const std::string kind = lower_text(noun_type(operation).keyword);
  return barred_by_name(edits, step, EditOf::kOperation,
                        [&](const Edit& e) { return names(lower_text(e.value), kind); });
}

std::optional<Barred> barred_strategy(const std::vector<Edit>& edits, const StepNames& step,
                                      std::string_view strategy) {
  if (strategy.empty()) return std::nullopt;
  return barred_by_name(edits, step, EditOf::kStrategy,
                        [&](const Edit& e) { return names(lower_text(e.value), strategy); });
}

std::string_view word_of(StrategyKind kind) {
  switch (kind) {
    case StrategyKind::kNone:
      return {};
    case StrategyKind::kBidirectional:
      return "bidirectional";
    case StrategyKind::kUnidirectional:
      return "unidirectional";
    case StrategyKind::kContourParallel:
      return "contour_parallel";
    case StrategyKind::kContourSpiral:
      return "contour_spiral";
    case StrategyKind::kContourBidirectional:
      return "contour_bidirectional";
    case StrategyKind::kCenterMilling:
      return "center_milling";
  }
  return {};
}

std::string EditLimits::words() const {
  std::string out;
  for (const std::string* s : {&feed_by, &speed_by}) {
    if (!s->empty()) out += (out.empty() ? "" : "; ") + *s;
  }
  return out;
}

EditLimits limits_of(const std::vector<Edit>& edits, const StepNames& step) {
  EditLimits out;
  const auto take = [&](const Edit& e, std::optional<double>& most, std::string& by) {
    if (most && *most <= e.number) return;
    most = e.number;
    by = words_of(e);
  };
  for (const Edit& e : edits) {
    if (e.kind != EditKind::kLimit || !names(e.where, step)) continue;
    if (e.of == EditOf::kFeed) take(e, out.feed_mm_min, out.feed_by);
    if (e.of == EditOf::kSpeed) take(e, out.speed_rpm, out.speed_by);
  }
  return out;
}

}  // namespace capstan::model
