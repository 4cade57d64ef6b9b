#include <string>

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
    table.rows.push_back({r.of->name, kind_of(*r.of), whole(r.edits), whole(r.same), whole(r.found),
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

}  // namespace capstan::validation
