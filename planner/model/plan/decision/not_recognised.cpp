#include "planner/model/plan/decision/not_recognised.h"

#include <utility>

#include "planner/model/plan/decision/has_reason.h"

namespace capstan::model {

void set_not_recognised(Plan& plan, AnyRef feature, std::string why) {
  plan.ledger.bind(feature, "its_operations", Binder::kRule,
                   {std::string(kNotRecognised), std::move(why), "the shape of the part"});
}

std::map<AnyRef, std::string> not_recognised(const Plan& plan) {
  std::map<AnyRef, std::string> out;
  if (!has_reason(plan.ledger, kNotRecognised)) return out;
  for (const auto& [key, decision] : plan.ledger.entries()) {
    const Reason& why = plan.ledger.reason(decision.reason);
    if (why.id == kNotRecognised) out.emplace(key.object, why.text);
  }
  return out;
}

}  // namespace capstan::model
