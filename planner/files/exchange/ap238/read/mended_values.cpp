#include "planner/files/exchange/ap238/read/mended_values.h"

#include "planner/files/exchange/common/ratio.h"
#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"

namespace capstan::exchange::ap238 {

using model::AnyRef;
using model::TypeId;

void mend_ratios(model::Plan& plan, Reporter& reporter) {
  model::Model& m = plan.model;
  for (std::size_t t = 1; t < model::kTypeCount; ++t) {
    const auto type = static_cast<TypeId>(t);
    for (const model::Attribute& a : model::noun_type(type).attributes) {
      if (a.unit != model::Unit::kRatio || a.storage != model::Storage::kReal || !a.in_iso14649) continue;
      for (const AnyRef at : m.all(type)) {
        auto& v = *static_cast<model::Real*>(a.at(m.object(at)));
        if (!v || !beyond_ratio(a.name, *v)) continue;
        const bool percent = is_percent(a.name, *v);
        const std::string given = shortest(*v);
        if (percent) v = *v / 100.0;
        reporter.about(
            m, at,
            {.code = "EXC-RATIO",
             .severity = Severity::kWarning,
             .message =
                 attribute_name(at, a.name) + ": " + given +
                 (percent ? " is taken as percent, that is " + shortest(*v)
                          : " is no ratio between 0 and 1, and may be percent or a length; kept as it is")});
      }
    }
  }
}

void doubt_placements(const model::Model& m, std::vector<Doubt>& doubts) {
  for (const AnyRef at : m.all(TypeId::kMachiningWorkingstep)) {
    const AnyRef feature = m.at<model::MachiningWorkingstep>(at).its_feature;
    const auto* f = m.get<model::Two5dManufacturingFeature>(feature);
    if (f == nullptr || m.holds<model::TransitionFeature>(feature)) continue;
    if (m.holds<model::Axis2Placement3d>(f->feature_placement)) continue;
    doubts.push_back({feature,
                      {.code = "EXC-REFERENCE",
                       .message = attribute_name(feature, "feature_placement") +
                                  " cannot be read: where the feature lies is not known",
                       .hint = "give it an AXIS2_PLACEMENT_3D named 'orientation'"},
                      "feature_placement"});
  }
}

}  // namespace capstan::exchange::ap238
