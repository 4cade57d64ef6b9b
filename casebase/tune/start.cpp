#include "casebase/tune/start.h"

#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "casebase/recall/advice.h"
#include "casebase/tune/advise.h"
#include "casebase/tune/from_case.h"

namespace capstan::casebase::tune {
namespace {

/// Share of the depth or width asked from which on a cut counts as deep and as wide: within a fiftieth, as
/// settings do (`same_setting`).
constexpr double kAsMuch = 0.98;

/// A cut of unknown depth or width is not as deep or as wide as one that is asked.
bool as_much(double cut, double asked) { return !(asked > 0.0) || cut >= kAsMuch * asked; }

}  // namespace

std::optional<ProvenStart> proven_start(std::span<const Neighbour> near,
                                        std::span<const casebase::Evidence> told, const Question& question,
                                        const Values& asked, const Values& than) {
  if (!(asked.vc_m_min > 0.0) || !(asked.fz_mm > 0.0)) return std::nullopt;
  PlannedStep step;
  step.step.asked = question;
  step.step.bound.vc_m_min = asked.vc_m_min;
  step.step.bound.fz_mm = asked.fz_mm;
  step.hard = [](const Setting&) { return 0.0; };  // they are held by the search that starts from here
  std::vector<Evidence> heard;
  std::set<std::string> observed;
  for (std::size_t i = 0; i < near.size(); ++i) {
    const casebase::Evidence& e = told[i];
    if (e.origin == Origin::kSimulated || !(e.cut.vc_m_min > 0.0) || !(e.cut.fz_mm > 0.0)) continue;
    if (!e.told.empty() && !observed.insert(e.told).second) continue;
    const bool bad = e.verdict == Verdict::kBad;
    if (!bad && !e.raises) continue;
    if (!bad && !(as_much(e.cut.ap_mm, asked.ap_mm) && as_much(e.cut.ae_mm, asked.ae_mm))) continue;
    // A cut of no named edge is no repeat on another one, and two edges of one tool share its spindle and its
    // day.
    const std::string& tool = near[i].found.from.tool_instance;
    if (!bad && tool.empty()) continue;
    Evidence one = evidence_of(near[i].found, step);
    one.edge = tool;
    one.at = {std::log(e.cut.vc_m_min / asked.vc_m_min), std::log(e.cut.fz_mm / asked.fz_mm)};
    one.source = e.run;
    one.day.reset();
    heard.push_back(std::move(one));
  }
  if (heard.empty()) return std::nullopt;
  Handbook handbook = handbook_of(step);
  handbook.most_vc = handbook.most_fz = kCaseReach;
  const auto found = proven(heard, handbook, {});
  if (!found) return std::nullopt;
  const ProvenStart out{.vc_m_min = asked.vc_m_min * std::exp(found->at.ln_vc),
                        .fz_mm = asked.fz_mm * std::exp(found->at.ln_fz),
                        .repeats = found->repeats,
                        .probability = found->probability};
  if (!(out.vc_m_min * out.fz_mm > than.vc_m_min * than.fz_mm)) return std::nullopt;
  return out;
}

}  // namespace capstan::casebase::tune
