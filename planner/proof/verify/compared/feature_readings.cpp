#include "planner/proof/verify/compared/feature_readings.h"

#include <map>
#include <optional>

#include "planner/ground/base/stopping.h"
#include "planner/ground/memo/remembered.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/order/step_ids.h"
#include "planner/proof/verify/compared/compare.h"

namespace capstan::verify {

namespace {

constexpr memo::Stage kMeaning = memo::Stage::kPart;  ///< of what is remembered of the part

std::string name_of(const model::Model& m, model::AnyRef f) {
  const auto* named = m.get<model::ManufacturingFeature>(f);
  const std::string id = named != nullptr ? named->its_id.value_or("") : "";
  return id.empty() ? std::string(model::noun_type(f.type).keyword) : id;
}

std::string place(geometry::Vec3 p) { return "X" + plain(p.x) + " Y" + plain(p.y) + " Z" + plain(p.z); }

}  // namespace

void check_meaning(const model::Plan& plan, Findings& findings, bool cut_only, memo::Memo* known) {
  std::set<model::AnyRef> cut;
  for (const model::StepResult& s : plan.steps)
    if (const auto* ws = plan.model.get<model::MachiningWorkingstep>(s.step)) cut.insert(ws->its_feature);
  check_meaning(plan, planners_readings(plan.model, cut_only ? &cut : nullptr), findings, known);
}

void check_meaning(const model::Plan& plan, const std::vector<PlannersReading>& planner, Findings& findings,
                   memo::Memo* known) {
  const volumes::Source source = volumes::source_of(plan.model, plan.stock.box);
  const std::set<model::AnyRef> pieces = volumes::parts_of_others(plan.model);
  const std::vector<std::string> ids = model::step_ids(plan);
  std::map<model::AnyRef, std::size_t> first;  // step of a feature
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    if (const auto* ws = plan.model.get<model::MachiningWorkingstep>(plan.steps[i].step))
      first.emplace(ws->its_feature, i);
  }
  for (const PlannersReading& e : planner) {
    if (e.shapes.empty()) continue;
    poll();
    const auto at = first.find(e.feature);
    const std::size_t order = at == first.end() ? 0 : at->second + 1;
    const std::string step = at == first.end() ? std::string() : ids[at->second];
    // A part of another feature is compared with that one, unless it is cut on its own.
    if (order == 0 && pieces.contains(e.feature)) continue;
    const volumes::Reading own = volumes::read(source, e.feature);
    const Findings::Where where{order, step, -1};
    const std::string name = name_of(plan.model, e.feature);
    if (!own.unread.empty()) {
      if (order > 0)
        findings.unproved(
            Severity::kNote, 38, "CHK-NOT-JUDGED", where,
            "feature " + name +
                ": the check's own reading does not read its shape, so that walls, floor and what is left of "
                "it are not judged: " +
                own.unread);
      continue;
    }
    std::optional<memo::Key> agree;
    if (known != nullptr) {
      agree = memo::key_of(kMeaning, own, e.shapes, plan.stock.box);
      if (known->find(kMeaning, *agree) != nullptr) continue;
    }
    const auto d = volumes::disagreement(own, e.shapes, plan.stock.box);
    if (!d && agree) known->keep(kMeaning, *agree, "agree");
    if (!d) continue;
    const std::string text = d->what.empty()
                                 ? "feature " + name + " is read in two ways: at " + place(d->at) +
                                       " of the workpiece the file's text " +
                                       (d->removed ? "removes material (" : "leaves material (") + d->own +
                                       "), and the planner's reading " +
                                       (d->removed ? "leaves it (" : "removes it (") + d->theirs + ")"
                                 : "feature " + name + " is read in two ways: " + d->what;
    const std::string act =
        "; do not cut it: compare both with the drawing, state the feature otherwise or leave it out, and "
        "report it";
    if (order > 0) {
      findings.error(38, "CHK-MEANING", where, text + act, 1.0);
    } else {
      findings.warn(38, "CHK-MEANING", where, text + "; no step cuts it: compare both with the drawing", 1.0);
    }
  }
}

}  // namespace capstan::verify
