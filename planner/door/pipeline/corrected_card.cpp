#include "planner/door/pipeline/corrected_card.h"

#include <algorithm>
#include <utility>

#include "casebase/casebase.h"
#include "casebase/tune/card.h"
#include "planner/physics/mechanics/force/force_law.h"

namespace capstan::pipeline {
namespace {

namespace tune = casebase::tune;

/// Cases that are heard: reading one takes some 10 us, and the scatter of some thousand is known well enough.
/// Default, unsourced.
constexpr std::size_t kMostHeard = 3000;

void take(const tune::CardCorrection& c, model::WorkMaterial& card) {
  const std::string source = c.words();
  if (c.model == tune::CardModel::kForce) {
    auto set = mechanics::corrected_set(
        card, c.substrate, {.factor = c.factor, .spread = c.spread, .chip_mm = c.chip_mm, .source = source});
    card.mechanistic.insert(card.mechanistic.begin(), std::move(set));
    return;
  }
  model::ToolLifeLaw law = c.law;
  law.source = source;
  card.life.insert(card.life.begin(), std::move(law));
}

}  // namespace

CorrectedCard corrected_card(const casebase::CaseBase& cases, const model::WorkMaterial& card,
                             const std::string& machine_id) {
  CorrectedCard out{.of = card.id, .card = card, .rows = {}, .told = {}};
  const auto heard = cases.measured_in(casebase::material_group_of(card), machine_id, kMostHeard);
  const auto spread_of = [&](model::Substrate s) { return mechanics::force_margin(card, s).spread; };
  for (const tune::CardCorrection& c : tune::card_corrections(heard, card, spread_of)) {
    if (c.taken()) {
      take(c, out.card);
      out.rows.push_back({"model", c.words(), "measured cases"});
      out.told.push_back({.code = "CASE-MODEL", .severity = Severity::kNote, .message = c.words()});
    } else {
      out.told.push_back({.code = "CASE-MODEL",
                          .severity = c.edges < tune::kLeastEdges ? Severity::kNote : Severity::kWarning,
                          .message = "not taken, for it is " + c.why_not + ": " + c.words()});
    }
  }
  return out;
}

}  // namespace capstan::pipeline
