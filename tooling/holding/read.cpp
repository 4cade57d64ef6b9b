#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "planner/ground/base/nearest_names.h"
#include "planner/ground/base/number.h"
#include "planner/model/plan/ranges.h"
#include "tooling/catalogue/data.h"
#include "tooling/catalogue/tree.h"
#include "tooling/holding/holding.h"

namespace capstan::tooling {
namespace {

constexpr std::array<std::pair<std::string_view, FixtureKind>, 5> kKinds = {
    {{"vise", FixtureKind::kVise},
     {"soft_jaws", FixtureKind::kSoftJaws},
     {"plate", FixtureKind::kPlate},
     {"strap_clamp", FixtureKind::kStrapClamp},
     {"toe_clamp", FixtureKind::kToeClamp}}};
constexpr std::array<std::pair<std::string_view, Side>, 4> kSides = {
    {{"-x", Side::kMinusX}, {"+x", Side::kPlusX}, {"-y", Side::kMinusY}, {"+y", Side::kPlusY}}};

bool clamps(FixtureKind k) { return k == FixtureKind::kStrapClamp || k == FixtureKind::kToeClamp; }

std::string in_mm(const model::Range& range) { return to_text(range) + " mm"; }

/// A fault where the value is none that the quantity can have.
void within(Fields& f, std::string_view key, double v, const model::Range& range, const char* unit = " mm") {
  if (!range.holds(v))
    f.fault("DATA-RANGE", std::string(key) + " is " + model::value_text(v), key, f.line_of(key),
            to_text(range) + unit);
}

/// A pair of numbers, [8, 30].
std::optional<geometry::Vec2> pair_of(Fields& f, std::string_view key, const Node& n) {
  std::array<double, 2> v{};
  bool good = n.kind == Node::Kind::kList && n.items.size() == 2;
  for (std::size_t i = 0; good && i < 2; ++i) {
    const auto number = n.items[i].kind == Node::Kind::kScalar ? parse_double(n.items[i].text) : std::nullopt;
    good = number.has_value();
    if (!good) break;
    if (!model::range::kFixtureAtMm.holds(*number)) {
      f.fault("DATA-RANGE", std::string(key) + " has " + model::value_text(*number), key, n.line,
              in_mm(model::range::kFixtureAtMm));
      return std::nullopt;
    }
    v[i] = *number;
  }
  if (!good) {
    f.fault("DATA-TYPE", std::string(key) + " is not a pair of numbers", key, n.line, "[8, 30]");
    return std::nullopt;
  }
  return geometry::Vec2{v[0], v[1]};
}

double positive(Fields& f, std::string_view key) {
  const std::size_t before = f.fault_count();
  const double v = f.number(key);
  if (f.fault_count() == before) within(f, key, v, model::range::kFixtureMm);
  return v;
}

Side side_of(Fields& f, std::string_view key, const std::string& text) {
  for (const auto& [name, side] : kSides) {
    if (text == name) return side;
  }
  f.fault("DATA-VALUE", std::string(key) + " '" + text + "' is no side", key, f.line_of(key),
          "-x, +x, -y or +y");
  return Side::kMinusX;
}

Fixture fixture_of(Fields f) {
  Fixture out;
  out.id = f.text("id");
  out.description = f.text_or("description", out.id);
  const std::string kind = f.text("kind");
  const auto known =
      std::find_if(kKinds.begin(), kKinds.end(), [&](const auto& k) { return k.first == kind; });
  if (known == kKinds.end()) {
    f.fault("DATA-VALUE", "kind '" + kind + "' is not known", "kind", f.line_of("kind"),
            "vise, soft_jaws, plate, strap_clamp or toe_clamp");
    return out;
  }
  out.kind = known->second;
  out.width_mm = positive(f, "width");
  out.length_mm = positive(f, "length");
  out.height_mm = positive(f, "height");
  if (out.kind == FixtureKind::kVise || out.kind == FixtureKind::kSoftJaws) {
    out.thickness_mm = positive(f, "thickness");
    out.opening_mm = positive(f, "opening");
    out.bed_mm = positive(f, "bed");
  }
  if (out.kind == FixtureKind::kSoftJaws) {
    out.step_mm = positive(f, "step");
    out.ledge_mm = positive(f, "ledge");
    out.parallels.push_back({out.ledge_mm, out.height_mm - out.step_mm});
  }
  if (out.kind == FixtureKind::kVise) {
    if (const Node* list = f.child("parallels", true)) {
      for (const Node& n : list->items) {
        if (const auto p = pair_of(f, "parallels", n)) out.parallels.push_back(*p);
      }
    }
  }
  if (out.kind == FixtureKind::kPlate) out.support_mm = positive(f, "support");
  if (out.kind == FixtureKind::kStrapClamp) {
    out.reach_mm = positive(f, "reach");
    out.stud_mm = positive(f, "stud");
    out.stud_height_mm = positive(f, "stud_height");
  }
  const std::size_t before = f.fault_count();
  out.holding_force_n = f.number_or("holding_force_n", 0.0);
  if (f.fault_count() == before)
    within(f, "holding_force_n", out.holding_force_n, model::range::kHoldingForceN, " N; 0 for not known");
  f.finish();
  out.source = f.source().empty() ? "not stated" : f.source();
  return out;
}

std::vector<Fixture> fixtures_of(Fields& top, bool required) {
  std::vector<Fixture> out;
  const Node* list = top.child("fixtures", required);
  if (list == nullptr) return out;
  std::set<std::string> seen;
  for (std::size_t i = 0; i < list->items.size(); ++i) {
    Fixture f = fixture_of(top.below("fixtures[" + std::to_string(i) + "]", list->items[i]));
    if (!seen.insert(f.id).second)
      top.fault("HOLD-TWICE", "fixture '" + f.id + "' is given twice", "fixtures", list->items[i].line);
    out.push_back(std::move(f));
  }
  return out;
}

/// A name that neither this file nor the library has.
void no_fixture(Fields& f, const char* key, const std::string& name, const std::vector<Fixture>& fixtures) {
  const Diagnostic d = unknown_name(key, name, ids_of(fixtures), kListFixtures);
  f.fault(d.code, d.message, key, f.line_of(key), "a fixture of this file or of the library; " + d.hint);
}

ClampWish clamp_of(Fields f, std::size_t number, const std::vector<Fixture>& fixtures) {
  ClampWish out;
  out.line = f.line();
  out.clamp = f.text("clamp");
  out.name = f.text_or("name", "clamp " + std::to_string(number));
  out.from = side_of(f, "from", f.text("from"));
  out.bottom = f.optional_number("bottom");
  if (out.bottom) within(f, "bottom", *out.bottom, model::range::kFixtureAtMm);
  if (const Node* at = f.child("at", true)) {
    if (const auto p = pair_of(f, "at", *at)) out.at = *p;
  }
  f.finish();
  const Fixture* known = find_fixture(fixtures, out.clamp);
  if (known == nullptr && !out.clamp.empty()) {
    no_fixture(f, "clamp", out.clamp, fixtures);
  } else if (known != nullptr && !clamps(known->kind)) {
    f.fault("HOLD-KIND", "'" + out.clamp + "' is no clamp", "clamp", f.line_of("clamp"));
  }
  return out;
}

HoldingWish wish_of(Fields f, const std::vector<Fixture>& fixtures) {
  HoldingWish out;
  out.line = f.line();
  out.setup = f.text("setup");
  out.fixture = f.text("fixture");
  if (f.has("fixed_jaw")) out.fixed_jaw = side_of(f, "fixed_jaw", f.text("fixed_jaw"));
  out.offset_mm = f.number_or("offset", 0.0);
  within(f, "offset", out.offset_mm, model::range::kFixtureAtMm);
  const std::size_t before = f.fault_count();
  out.clearance_mm = f.number_or("clearance", out.clearance_mm);
  if (f.fault_count() == before) within(f, "clearance", out.clearance_mm, model::range::kClearanceMm);
  if (const Node* p = f.child("parallel", false)) {
    out.parallel = pair_of(f, "parallel", *p);
    if (out.parallel && !(out.parallel->x > 0.0 && out.parallel->y > 0.0))
      f.fault("DATA-RANGE", "a parallel needs a width and a height above zero", "parallel", p->line);
  }
  const Fixture* known = find_fixture(fixtures, out.fixture);
  if (known == nullptr && !out.fixture.empty()) {
    no_fixture(f, "fixture", out.fixture, fixtures);
  } else if (known != nullptr && clamps(known->kind)) {
    f.fault("HOLD-KIND", "'" + out.fixture + "' is a clamp: it needs a plate or a vise under it", "fixture",
            f.line_of("fixture"));
  }
  if (const Node* list = f.child("clamps", false)) {
    for (std::size_t i = 0; i < list->items.size(); ++i) {
      out.clamps.push_back(
          clamp_of(f.below("clamps[" + std::to_string(i) + "]", list->items[i]), i + 1, fixtures));
    }
  }
  f.finish();
  return out;
}

Result<std::vector<Fixture>> read_fixtures(std::string_view text, const std::string& file, Job& job) {
  auto root = parse_tree(text, file);
  if (!root) return tl::unexpected(root.error());
  std::vector<Diagnostic> faults;
  Fields top(*root, file, "", "", faults);
  (void)top.optional_integer("capstan_fixtures");
  auto out = fixtures_of(top, true);
  top.finish();
  if (auto error = tell(std::move(faults), job)) return tl::unexpected(*error);
  return out;
}

}  // namespace

std::string_view to_text(Side s) {
  for (const auto& [name, side] : kSides) {
    if (side == s) return name;
  }
  return "";
}

geometry::Vec2 direction_of(Side s) {
  switch (s) {
    case Side::kMinusX:
      return {-1.0, 0.0};
    case Side::kPlusX:
      return {1.0, 0.0};
    case Side::kMinusY:
      return {0.0, -1.0};
    case Side::kPlusY:
      return {0.0, 1.0};
  }
  return {};
}

std::vector<std::string> ids_of(const std::vector<Fixture>& fixtures) {
  std::vector<std::string> out;
  for (const Fixture& f : fixtures) out.push_back(f.id);
  return out;
}

const Fixture* find_fixture(const std::vector<Fixture>& fixtures, std::string_view id) {
  for (const Fixture& f : fixtures) {
    if (f.id == id) return &f;
  }
  return nullptr;
}

Result<std::vector<Fixture>> shipped_fixtures(Job& job) {
  return read_fixtures(shipped_text("fixtures.yaml"), "fixtures.yaml", job);
}

Result<HoldingFile> read_holding(std::string_view text, const std::string& file, Job& job) {
  auto root = parse_tree(text, file);
  if (!root) return tl::unexpected(root.error());
  auto shipped = shipped_fixtures(job);
  if (!shipped) return tl::unexpected(shipped.error());
  std::vector<Diagnostic> faults;
  HoldingFile out;
  out.file = file;
  Fields top(*root, file, "", "", faults);
  const auto version = top.optional_integer("capstan_workholding");
  if (!version || *version != 1)
    top.fault("DATA-VERSION", "this is no file of workholding", "capstan_workholding", 1,
              "capstan_workholding: 1");
  if (const std::string unit = top.text("unit"); unit != "mm" && !unit.empty())
    top.fault("DATA-UNIT", "the unit '" + unit + "' is not known", "unit", top.line_of("unit"), "mm");
  out.fixtures = fixtures_of(top, false);
  const bool own = !out.fixtures.empty();
  for (Fixture& f : *shipped) {
    if (find_fixture(out.fixtures, f.id) == nullptr) out.fixtures.push_back(std::move(f));
  }
  if (const Node* list = top.child("setups", !own)) {
    std::set<std::string> seen;
    for (std::size_t i = 0; i < list->items.size(); ++i) {
      out.setups.push_back(
          wish_of(top.below("setups[" + std::to_string(i) + "]", list->items[i]), out.fixtures));
      if (!seen.insert(out.setups.back().setup).second)
        top.fault("HOLD-TWICE", "set-up '" + out.setups.back().setup + "' is given twice", "setups",
                  list->items[i].line);
    }
  }
  top.finish();
  if (auto error = tell(std::move(faults), job)) return tl::unexpected(*error);
  return out;
}

}  // namespace capstan::tooling
