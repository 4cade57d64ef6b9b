#include <algorithm>
#include <string>
#include <vector>

#include "tests/mutation/plans/plan_study.h"
#include "tests/mutation/study.h"
#include "tests/support/rs274.h"
#include "tests/validation/studies.h"

namespace capstan::validation {

using mutation::Kind;
using mutation::Row;

namespace {

std::string kind_of(const mutation::Class& c) {
  switch (c.kind) {
    case Kind::kDangerous:
      return c.in_any_program ? "dangerous in any program" : "dangerous";
    case Kind::kDifferent:
      return "different";
    case Kind::kBenign:
      return "benign";
    case Kind::kUnknown:
      break;
  }
  return "by LinuxCNC's interpreter";
}

std::string whole(int n) { return std::to_string(n); }

}  // namespace

Comparison edits() {
  Comparison out{.name = "edits"};
  if (!testing::rs274_available()) {
    out.skipped = "LinuxCNC's interpreter rs274 is absent";
    return out;
  }
  mutation::Options options;
  options.edits = 4;
  Table table{{"class", "kind", "edits", "of them the same to the machine", "found with the plan",
               "found alone", "dangerous missed", "other changes missed", "benign blamed"},
              {}};
  Row sum;
  for (const Row& r : mutation::study(options)) {
    table.rows.push_back({r.of.name, kind_of(r.of), whole(r.edits), whole(r.same), whole(r.found),
                          whole(r.found_alone), whole(r.dangerous_missed), whole(r.different_missed),
                          whole(r.benign_blamed)});
    sum.edits += r.edits;
    sum.same += r.same;
    sum.found += r.found;
    sum.found_alone += r.found_alone;
    sum.dangerous_missed += r.dangerous_missed;
    sum.different_missed += r.different_missed;
    sum.benign_blamed += r.benign_blamed;
  }
  table.rows.push_back({"all", "", whole(sum.edits), whole(sum.same), whole(sum.found),
                        whole(sum.found_alone), whole(sum.dangerous_missed), whole(sum.different_missed),
                        whole(sum.benign_blamed)});
  out.text = markdown(table);
  out.headline = whole(sum.edits) + " edits in " + whole(static_cast<int>(mutation::classes().size())) +
                 " classes: dangerous ones missed " + whole(sum.dangerous_missed) +
                 ", other changes missed " + whole(sum.different_missed) + ", benign ones blamed " +
                 whole(sum.benign_blamed);
  return out;
}

namespace {

/// Rows of one part ("JSON, machine"), or of one edit ("times ten"), summed up.
class Sums {
 public:
  explicit Sums(const char* title) : title_(title) {}
  void add(const std::string& name, const mutation::PlanRow& r) {
    auto it = std::find_if(rows_.begin(), rows_.end(), [&](const auto& s) { return s.name == name; });
    if (it == rows_.end()) it = rows_.insert(rows_.end(), {.name = name});
    it->edits += r.edits;
    it->refused += r.refused;
    it->found += r.found;
    it->found_by_values += r.found_by_values;
    it->found_with_program += r.found_with_program;
    it->missed += r.missed;
    it->blamed += r.blamed;
  }
  [[nodiscard]] std::string text() const {
    Table t{{title_, "edits", "refused on reading", "found", "missed", "benign blamed"}, {}};
    for (const auto& r : rows_)
      t.rows.push_back(
          {r.name, whole(r.edits), whole(r.refused), whole(r.found), whole(r.missed), whole(r.blamed)});
    return markdown(t);
  }

 private:
  const char* title_;
  std::vector<mutation::PlanRow> rows_;
};

}  // namespace

Comparison plan_edits() {
  Comparison out{.name = "plan-edits"};
  mutation::PlanOptions options;
  options.edits = 2;
  options.planned = false;
  options.by_values = true;
  Sums parts("part"), kinds("edit");
  mutation::PlanRow sum, json;
  int classes = 0;
  for (const auto& r : mutation::study_plans(options)) {
    ++classes;
    const std::size_t colon = r.name.find(": ");
    parts.add(r.name.substr(0, colon), r);
    kinds.add(r.name.substr(colon + 2), r);
    for (auto* s : {&sum, &json}) {
      if (s == &json && (r.name.rfind("JSON", 0) != 0 || r.kind == Kind::kBenign)) continue;
      s->edits += r.edits;
      s->found_by_values += r.found_by_values;
      s->found_with_program += r.found_with_program;
      s->missed += r.missed;
      s->blamed += r.blamed;
    }
  }
  out.text = parts.text() + "\n" + kinds.text() + "\nOf " + whole(json.edits) + " edits of values in JSON " +
             whole(json.found_by_values) + " are found without the hashes of the parts, and " +
             whole(json.found_with_program) + " of the others with the program that was written before.\n";
  out.headline = whole(sum.edits) + " edits in " + whole(classes) + " classes: missed " + whole(sum.missed) +
                 ", benign ones blamed " + whole(sum.blamed);
  return out;
}

}  // namespace capstan::validation
