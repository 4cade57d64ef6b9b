#include <algorithm>
#include <set>

#include "tests/removal/random_part.h"

// What a plan of a drawn part owes.

namespace capstan::testing::removal {
namespace {

// The names of the features that a plan says it does not make.
std::vector<std::string> unplanned(const std::string& json) {
  std::vector<std::string> out;
  const auto begin = json.find("\"unplanned\":[");
  if (begin == std::string::npos) return out;
  const auto end = json.find("\"provenance\":", begin);
  const std::string key = "{\"feature\":\"";
  for (auto at = json.find(key, begin); at < end; at = json.find(key, at + 1)) {
    const auto from = at + key.size();
    const std::string id = json.substr(from, json.find('"', from) - from);
    const auto object = json.find("\"" + id + "\",\"@instance\"");
    const std::string name = "\"its_id\":\"";
    const auto named = json.find(name, object);
    if (object == std::string::npos || named == std::string::npos) continue;
    out.push_back(
        json.substr(named + name.size(), json.find('"', named + name.size()) - named - name.size()));
  }
  return out;
}

}  // namespace

Share planned_share(const RandomPart& random, const Outcome& o) {
  std::set<std::string> all, out;
  for (const Space& s : random.features) all.insert(s.name);
  if (!o.written()) return {0, all.size()};
  for (const std::string& name : unplanned(o.plan.json)) out.insert(name);
  Share share{0, all.size()};
  for (const std::string& name : all) share.planned += out.count(name) == 0 ? 1 : 0;
  return share;
}

std::string broken_promise(const RandomPart& random, const Outcome& o) {
  const auto says_why = [&] {
    if (o.plan.unplanned > 0) return true;
    return std::any_of(o.plan.diagnostics.begin(), o.plan.diagnostics.end(),
                       [](const PlanMessage& m) { return m.severity == "error"; }) ||
           std::any_of(o.plan.findings.begin(), o.plan.findings.end(),
                       [](const PlanMessage& m) { return m.severity == "error"; });
  };
  if (!o.written()) return says_why() ? "" : "no program, and nothing says why";
  std::string out;
  for (const PlanMessage& f : o.plan.findings) {
    if (f.severity == "error") out += "the program has an error finding: " + f.text + "\n";
  }
  Verdict v = o.verdict;
  const std::vector<std::string> names = unplanned(o.plan.json);
  if (names.size() != o.plan.unplanned) out += "not every unplanned feature is named in the plan\n";
  const auto excused = [&](const Point& p) {
    return std::any_of(random.features.begin(), random.features.end(), [&](const Space& s) {
      return std::find(names.begin(), names.end(), s.name) != names.end() && p.x >= s.around.lo.x &&
             p.x <= s.around.hi.x && p.y >= s.around.lo.y && p.y <= s.around.hi.y;
    });
  };
  std::vector<std::string> left;
  for (std::size_t i = 0; i < v.left.size(); ++i) {
    if (i < v.left_at.size() && excused(v.left_at[i])) continue;
    left.push_back(v.left[i]);
  }
  v.left = std::move(left);
  return v.agrees() ? out : out + v.text();
}

}  // namespace capstan::testing::removal
