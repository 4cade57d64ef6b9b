#include "tests/validation/catalogue/record.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"
#include "tests/validation/report.h"

namespace capstan::validation::catalogue {
namespace {

using testing::sweep::Case;

constexpr const char* kHead =
    "machine,feature,material,plan_s,catalogue_s,features_not_made,clearing,broken,"
    "first_reason\n";
constexpr std::size_t kColumns = 9;
constexpr double kRounding = 0.1;  // s, of what stands in the record

double tenths(double s) { return std::round(10.0 * s) / 10.0; }

/// Without what would end a cell.
std::string beginning(const std::string& reason) {
  constexpr std::size_t kMost = 240;
  std::string out = reason.substr(0, kMost);
  std::replace(out.begin(), out.end(), ',', ';');
  std::replace(out.begin(), out.end(), '\n', ' ');
  return out;
}

/// Which way of clearing won where rings and constant engagement were both tried.
std::string clearing_of(const model::Plan& plan) {
  bool rings = false, constant = false;
  for (const model::StepResult& s : plan.steps) {
    const auto* ws = plan.model.get<model::MachiningWorkingstep>(s.step);
    const auto* chosen =
        ws == nullptr ? nullptr : plan.ledger.find(ws->its_operation, "its_machining_strategy");
    if (chosen == nullptr) continue;
    const bool taken = plan.ledger.reason(chosen->reason).id == "path.constant_engagement";
    constant |= taken;
    rings |= !taken && std::any_of(chosen->rejected.begin(), chosen->rejected.end(),
                                   [](const auto& r) { return r.what.starts_with("constant engagement "); });
  }
  if (rings && constant) return "both";
  return constant ? "constant engagement" : rings ? "rings" : "";
}

}  // namespace

Row row_of(const Case& c, const testing::sweep::Outcome& o) {
  const auto& unplanned = o.made.plan.unplanned;
  Row out{testing::sweep::kMachines[c.machine],
          testing::sweep::features().at(c.feature).name,
          testing::sweep::kMaterials[c.material].name,
          0.0,
          tenths(o.catalogue_s),
          o.failed.empty() ? unplanned.size() : 1,
          o.failed.empty() ? clearing_of(o.made.plan) : "",
          o.failed.empty() ? beginning(testing::sweep::broken(c, o)) : "",
          beginning(!o.failed.empty()   ? o.failed
                    : unplanned.empty() ? ""
                                        : unplanned.front().reason)};
  if (out.whole()) out.plan_s = tenths(o.plan_s);
  return out;
}

std::optional<Row> row_for(const std::vector<Row>& record, const Case& c) {
  for (const Row& r : record) {
    if (r.machine == testing::sweep::kMachines[c.machine] &&
        r.feature == testing::sweep::features().at(c.feature).name &&
        r.material == testing::sweep::kMaterials[c.material].name)
      return r;
  }
  return std::nullopt;
}

std::string written(const std::vector<Row>& rows) {
  std::string out = kHead;
  for (const Row& r : rows)
    out += r.machine + "," + r.feature + "," + r.material + "," + fixed(r.plan_s, 1) + "," +
           fixed(r.catalogue_s, 1) + "," + std::to_string(r.not_made) + "," + r.clearing + "," + r.broken +
           "," + r.refused + "\n";
  return out;
}

std::vector<Row> read(const std::string& text) {
  std::vector<Row> out;
  const auto rows = cells_of(text);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto& cells = rows[i];
    const auto number = [&](std::size_t k) {
      const auto value = k < cells.size() ? parse_double(cells[k]) : std::nullopt;
      if (cells.size() != kColumns || !value || !(*value >= 0.0))
        throw std::runtime_error("catalogue_times.csv, line " + std::to_string(i + 1) + ": " +
                                 std::to_string(kColumns) +
                                 " cells are expected, numbers from 0 on in the "
                                 "fourth to sixth; plan its cases anew (capstan_catalogue_times)");
      return *value;
    };
    const double plan_s = number(3), catalogue_s = number(4), not_made = number(5);
    out.push_back({cells[0], cells[1], cells[2], plan_s, catalogue_s, static_cast<std::size_t>(not_made),
                   cells[6], cells[7], cells[8]});
  }
  return out;
}

std::string apart(const Row& recorded, const Row& now) {
  const auto differs = [](double a, double b) { return std::abs(a - b) > kRounding * (1.0 + 1e-9); };
  std::string out;
  const auto say = [&](const std::string& what, double was, double is) {
    out += (out.empty() ? "" : ", ") + what + " " + fixed(is, 1) + ", recorded " + fixed(was, 1);
  };
  if (differs(recorded.plan_s, now.plan_s)) say("plan, s", recorded.plan_s, now.plan_s);
  if (differs(recorded.catalogue_s, now.catalogue_s))
    say("catalogue, s", recorded.catalogue_s, now.catalogue_s);
  const auto say_word = [&](const std::string& what, const std::string& was, const std::string& is) {
    if (was != is) out += (out.empty() ? "" : ", ") + what + " '" + is + "', recorded '" + was + "'";
  };
  say_word("clearing", recorded.clearing, now.clearing);
  say_word("broken", recorded.broken, now.broken);
  if (recorded.not_made != now.not_made)
    say("features not made", static_cast<double>(recorded.not_made), static_cast<double>(now.not_made));
  return out;
}

}  // namespace capstan::validation::catalogue
