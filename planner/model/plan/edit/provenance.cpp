#include "planner/model/plan/edit/provenance.h"

#include <algorithm>
#include <string_view>

namespace capstan::model {
namespace {

constexpr std::string_view kEdit = "edit";

}  // namespace

Provenance provenance_of(const Edit& e) {
  return {std::string(kEdit), std::string(to_text(e.kind)) + " " + text_of(e), e.from};
}

bool is_edit(const Provenance& p) { return p.what == kEdit; }

std::vector<Edit> edits_of(const Plan& plan) {
  std::vector<Edit> out;
  for (const Provenance& p : plan.provenance) {
    if (!is_edit(p)) continue;
    for (const EditKind kind : kEditKinds) {
      const std::string word = std::string(to_text(kind)) + " ";
      if (!p.value.starts_with(word)) continue;
      if (auto e = parse_edit(kind, std::string_view(p.value).substr(word.size()), p.source))
        out.push_back(*e);
    }
  }
  return out;
}

bool edits_are_all(const std::vector<Provenance>& inputs) {
  return std::any_of(inputs.begin(), inputs.end(), [](const Provenance& p) { return p.what == kEditsFile; });
}

}  // namespace capstan::model
