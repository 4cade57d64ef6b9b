#include "planner/making/workholding/hold.h"

#include <algorithm>
#include <array>

#include "planner/ground/base/file.h"
#include "planner/ground/base/nearest_names.h"
#include "planner/making/workholding/clear_of_fixtures.h"
#include "planner/making/workholding/place.h"
#include "planner/model/features/raw_piece.h"
#include "planner/model/features/setup_place.h"
#include "planner/model/nouns/placed_nouns.h"
#include "planner/model/plan/resources/setup_position.h"
#include "tooling/shop/data/tree.h"
#include "tooling/shop/fixtures/fixtures.h"

namespace capstan::workholding {
namespace {

using draft::SetupDraft;
using draft::StepDraft;
using geometry::Box3;
using geometry::Vec2;
using geometry::Vec3;
using model::Workholding;
using tooling::Fixture;
using tooling::HoldingWish;
using tooling::Side;

constexpr const char* kMark = "Workholding: ";  // begins the instruction that this stage writes

/// Stock at the start of a set-up: the raw piece less the faces that earlier set-ups cut off completely.
Box3 remaining(const std::vector<SetupDraft>& setups, const std::vector<StepDraft>& steps,
               std::size_t setup) {
  const SetupDraft& here = setups[setup];
  Box3 box = here.stock;
  for (const StepDraft& s : steps) {
    if (s.setup >= setup) continue;
    for (const auto& shape : s.shapes) {
      if (shape.kind != model::ShapeKind::kFace) continue;
      const auto frame = compose(here.workpiece, shape.frame);
      const Box3 raw = transformed(here.stock, inverse(frame));
      const auto all = geometry::rectangle(xy(raw.lo), xy(raw.hi));
      if (geometry::area(geometry::subtract(all, geometry::offset(shape.area, 0.01))) > 0.01) continue;
      const Vec3 at = frame.to_parent({0, 0, -shape.depth_mm});
      if (frame.z.z < -1.0 + 1e-9) box.lo.z = std::max(box.lo.z, at.z);
      if (frame.z.z > 1.0 - 1e-9) box.hi.z = std::min(box.hi.z, at.z);
      if (frame.z.x < -1.0 + 1e-9) box.lo.x = std::max(box.lo.x, at.x);
      if (frame.z.x > 1.0 - 1e-9) box.hi.x = std::min(box.hi.x, at.x);
      if (frame.z.y < -1.0 + 1e-9) box.lo.y = std::max(box.lo.y, at.y);
      if (frame.z.y > 1.0 - 1e-9) box.hi.y = std::min(box.hi.y, at.y);
    }
  }
  return box;
}

/// The whole instruction for the operator.
std::string instruction(const std::vector<SetupDraft>& setups, std::size_t i) {
  const SetupDraft& s = setups[i];
  std::string out =
      kMark + s.holding.description + ". Workpiece's " + model::axis_text(s.workpiece, {0, 0, 1}) + " up";
  for (const auto& solid : s.holding.solids) {
    if (solid.id != "vise.fixed_jaw") continue;
    const auto area = geometry::Region{{solid.outline}};
    const auto b = geometry::bounds(area);
    const Vec2 from = 0.5 * (xy(s.stock.lo) + xy(s.stock.hi));
    Vec3 d{0, 0, 0};
    if (b.lo.y >= from.y) d = {0, 1, 0};
    if (b.hi.y <= from.y) d = {0, -1, 0};
    if (b.lo.x >= from.x) d = {1, 0, 0};
    if (b.hi.x <= from.x) d = {-1, 0, 0};
    out += ", its " + model::axis_text(s.workpiece, d) + " face against the fixed jaw";
  }
  if (i > 0)
    out += "; " + model::turn_text(setups[i - 1].workpiece, s.workpiece) + " after the set-up before";
  return out + ". Work offset: " + s.holding.pickup_text + ".";
}

/// Several ways to hold a piece, the first that is out of the way of all cuts.
class Chooser {
 public:
  Chooser(const std::vector<SetupDraft>& setups, const std::vector<StepDraft>& steps, std::size_t setup,
          const std::vector<Fixture>& fixtures)
      : fixtures_(fixtures),
        piece_(remaining(setups, steps, setup)),
        cuts_(footprints(setups[setup], setup, steps)) {
    name_ = std::to_string(setup + 1);
  }

  std::optional<Workholding> run() {
    // Fixtures are tried in the order of the list. Soft jaws are cut to a piece, so they are used only on
    // request.
    for (const Fixture& f : fixtures_) {
      if (f.kind != tooling::FixtureKind::kVise) continue;
      if (auto h = vise(f.id)) return h;
    }
    for (const Fixture& f : fixtures_) {
      if (f.kind != tooling::FixtureKind::kPlate) continue;
      if (auto h = clamped(f.id)) return h;
    }
    return std::nullopt;
  }
  [[nodiscard]] const std::string& why_not() const { return why_not_; }

  std::optional<Workholding> vise(const std::string& id) {
    const Fixture* f = find_fixture(fixtures_, id);
    if (f == nullptr) return std::nullopt;
    auto parallels = f->parallels;
    std::stable_sort(parallels.begin(), parallels.end(), [](Vec2 a, Vec2 b) { return a.y < b.y; });
    for (const Side side : {Side::kPlusY, Side::kPlusX}) {
      for (const Vec2 p : parallels) {
        const double grip = f->height_mm - p.y;
        if (grip < kLeastGrip || grip > kUsualGrip * piece_.size().z) continue;
        HoldingWish wish = wish_of(id);
        wish.fixed_jaw = side;
        wish.parallel = p;
        if (auto h = tried(wish)) return h;
      }
    }
    return std::nullopt;
  }

  /// With the first kind of clamp that does.
  std::optional<Workholding> clamped(const std::string& plate) {
    for (const Fixture& f : fixtures_) {
      if (f.kind != tooling::FixtureKind::kStrapClamp && f.kind != tooling::FixtureKind::kToeClamp) continue;
      if (auto h = clamped(plate, f.id)) return h;
    }
    return std::nullopt;
  }

  /// Two clamps, one on each of two opposite sides.
  std::optional<Workholding> clamped(const std::string& plate, const std::string& clamp) {
    const Fixture* f = find_fixture(fixtures_, clamp);
    if (f == nullptr || find_fixture(fixtures_, plate) == nullptr) return std::nullopt;
    for (const bool across_x : {true, false}) {
      HoldingWish wish = wish_of(plate);
      for (const Side side :
           across_x ? std::array{Side::kMinusX, Side::kPlusX} : std::array{Side::kMinusY, Side::kPlusY}) {
        for (const double share : {0.5, 0.25, 0.75, 0.1, 0.9}) {
          HoldingWish trial = wish_of(plate);
          trial.clamps.push_back(clamp_at(*f, side, share, wish.clamps.size() + 1));
          if (!tried(trial)) continue;
          wish.clamps.push_back(trial.clamps.front());
          break;
        }
      }
      if (wish.clamps.size() < 2) continue;
      if (auto h = tried(wish)) return h;
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] tooling::ClampWish clamp_at(const Fixture& f, Side side, double share,
                                            std::size_t number) const {
    const Vec2 out = direction_of(side);
    const Vec2 lo = xy(piece_.lo), hi = xy(piece_.hi);
    const Vec2 size = hi - lo;
    const double reach = f.reach_mm;
    tooling::ClampWish c;
    c.clamp = f.id;
    c.name = "clamp " + std::to_string(number);
    c.from = side;
    if (out.x != 0.0) c.at = {out.x < 0 ? lo.x + reach : hi.x - reach, lo.y + share * size.y};
    if (out.y != 0.0) c.at = {lo.x + share * size.x, out.y < 0 ? lo.y + reach : hi.y - reach};
    return c;
  }

  [[nodiscard]] HoldingWish wish_of(const std::string& fixture) const {
    HoldingWish out;
    out.setup = name_;
    out.fixture = fixture;
    return out;
  }

  std::optional<Workholding> tried(const HoldingWish& wish) {
    auto h = place(wish, piece_, fixtures_);
    std::string why;
    if (!h) {
      why = h.error().message;
    } else if (const auto* solid = in_the_way(*h, cuts_)) {
      why = "'" + solid->id + "' of '" + wish.fixture + "' would be in the way of what is cut";
    } else {
      return *std::move(h);
    }
    if (why_not_.empty()) why_not_ = why;
    return std::nullopt;
  }

  const std::vector<Fixture>& fixtures_;
  Box3 piece_;
  std::vector<Footprint> cuts_;
  std::string name_, why_not_;
};

/// The set-ups of a plan and the steps in them.
struct Clampings {
  const model::Plan& plan;
  const std::vector<SetupDraft>& setups;
  const std::vector<StepDraft>& steps;
};

const HoldingWish* wish_for(const Clampings& c, std::size_t i, const std::vector<HoldingWish>& wishes) {
  const auto* setup = c.plan.model.get<model::Setup>(c.setups[i].setup);
  for (const HoldingWish& wish : wishes) {
    if (wish.setup == std::to_string(i + 1) || (setup != nullptr && setup->its_id.value_or("") == wish.setup))
      return &wish;
  }
  return nullptr;
}

/// Why a set-up has no place for fixtures, whose sides face the axes; empty: it has.
std::string lies_askew(const SetupDraft& s) {
  if (model::faces_axes(s.workpiece)) return {};
  return "the workpiece is " + model::turn_text({}, s.workpiece) +
         " in it, so that its sides face no axis, and fixtures are placed square to the axes only";
}

Result<std::vector<Workholding>> by_file(const Clampings& c, const tooling::HoldingFile& file, Job& job) {
  for (const HoldingWish& wish : file.setups) {
    bool used = false;
    for (std::size_t i = 0; i < c.setups.size(); ++i) used = used || wish_for(c, i, {wish}) != nullptr;
    if (used) continue;
    return fail({.code = "HOLD-SETUP",
                 .message = "there is no set-up '" + wish.setup + "'; the plan has " +
                            std::to_string(c.setups.size()),
                 .file = file.file,
                 .line = wish.line,
                 .hint = "set-ups are named by their number, from 1, or by their its_id"});
  }
  std::vector<Workholding> out(c.setups.size());
  for (std::size_t i = 0; i < c.setups.size(); ++i) {
    const HoldingWish* wish = wish_for(c, i, file.setups);
    if (wish == nullptr) {
      job.warn("PIP-HOLDING",
               "set-up " + std::to_string(i + 1) +
                   " is missing in the file of workholding: no fixture is checked there; add it");
      continue;
    }
    if (const std::string askew = lies_askew(c.setups[i]); !askew.empty())
      return fail({.code = "HOLD-ASKEW",
                   .message = "set-up '" + wish->setup + "': " + askew,
                   .file = file.file,
                   .line = wish->line,
                   .hint = "state it square in its set-up, or leave that set-up out of the file"});
    auto h = place(*wish, remaining(c.setups, c.steps, i), file.fixtures, file.file);
    if (!h) return tl::unexpected(h.error());
    out[i] = *std::move(h);
  }
  return out;
}

std::vector<Workholding> chosen(const Clampings& c, const std::vector<Fixture>& fixtures,
                                const std::string& id, Job& job) {
  std::vector<Workholding> out(c.setups.size());
  for (std::size_t i = 0; i < c.setups.size(); ++i) {
    if (const std::string askew = lies_askew(c.setups[i]); !askew.empty()) {
      job.warn("PIP-HOLDING", "set-up " + std::to_string(i + 1) + " is not held by '" + id + "': " + askew +
                                  "; no fixture is checked there");
      continue;
    }
    Chooser chooser(c.setups, c.steps, i, fixtures);
    std::optional<Workholding> h;
    if (id == "auto") {
      h = chooser.run();
    } else {
      const Fixture& f = *find_fixture(fixtures, id);
      if (f.kind == tooling::FixtureKind::kPlate) {
        h = chooser.clamped(id);
      } else {
        h = chooser.vise(id);
      }
    }
    if (!h) {
      job.warn("PIP-HOLDING", "set-up " + std::to_string(i + 1) + " is not held by '" + id +
                                  "': " + chooser.why_not() +
                                  "; no fixture is checked there, name another with --workholding");
      continue;
    }
    out[i] = *std::move(h);
  }
  return out;
}

/// As the fixture or the file says that is named; nothing where the file cannot be read now.
Result<std::optional<std::vector<Workholding>>> as_named(const Clampings& c, const Wish& wish, Job& job) {
  using Found = std::optional<std::vector<Workholding>>;
  const std::string& how = wish.how;
  auto fixtures = tooling::known_fixtures(wish.own, job);
  if (!fixtures) return tl::unexpected(fixtures.error());
  const Fixture* known = find_fixture(*fixtures, how);
  if (how == "auto" || (known != nullptr && known->kind != tooling::FixtureKind::kStrapClamp &&
                        known->kind != tooling::FixtureKind::kToeClamp)) {
    return Found(chosen(c, *fixtures, how, job));
  }
  if (known != nullptr)
    return fail("HOLD-KIND", "'" + how + "' is a clamp: it needs a plate or a vise under it");
  const auto text = read_file(how, tooling::kDataFileCap);
  if (!text && !wish.asked_now) {
    job.warn("PIP-HOLDING", "the plan was held by '" + how + "', which cannot be read now (" +
                                text.error().message + "); what holds the piece is not planned");
    return Found{};
  }
  if (!text && only_a_name(how))
    return fail(unknown_name("fixture", how, ids_of(*fixtures), tooling::kListFixtures));
  if (!text) {
    auto error = text.error();
    error.hint = "workholding is auto, none, the id of a fixture, or a file";
    return tl::unexpected(error);
  }
  auto file = tooling::read_holding(*text, how, job, wish.own);
  if (!file) return tl::unexpected(file.error());
  // A file of fixtures without set-ups leaves the choice open: its own fixtures are tried first.
  if (file->setups.empty()) return Found(chosen(c, file->fixtures, "auto", job));
  auto held = by_file(c, *file, job);
  if (!held) return tl::unexpected(held.error());
  return Found(*std::move(held));
}

}  // namespace

Result<Held> hold(const model::Plan& plan, const std::vector<SetupDraft>& setups,
                  const std::vector<StepDraft>& steps, const Wish& wish, Job& job) {
  Held out;
  out.holdings.resize(setups.size());
  // A plan that is bound again keeps its workholding, unless the caller asks for another.
  bool kept = false;
  for (std::size_t i = 0; i < setups.size() && !wish.asked_now; ++i) {
    for (const auto& [setup, holding] : wish.recorded) {
      if (setup != setups[i].setup || holding.solids.empty()) continue;
      out.holdings[i] = holding;
      kept = true;
    }
  }
  if (!kept && (wish.how.empty() || wish.how == "none")) {
    out.planned = false;
    out.note = {"workholding", "none", "not planned: nothing is known of what holds the piece"};
    return out;
  }
  if (!kept) {
    auto held = as_named({plan, setups, steps}, wish, job);
    if (!held) return tl::unexpected(held.error());
    out.planned = held->has_value();
    if (!out.planned) return out;
    out.holdings = **std::move(held);
  }
  for (std::size_t i = 0; i < setups.size(); ++i) {
    if (kept && out.holdings[i].solids.empty())
      job.warn("PIP-HOLDING", "set-up " + std::to_string(i + 1) +
                                  " has no workholding in the plan, others have: no fixture is checked "
                                  "there; --workholding plans all of them anew");
  }
  return out;
}

void write_nouns(model::Plan& plan, const std::vector<SetupDraft>& setups, std::size_t at,
                 const std::string& by) {
  model::Model& m = plan.model;
  const SetupDraft& s = setups[at];
  auto* setup = m.get<model::Setup>(s.setup);
  if (setup == nullptr) return;
  model::SetupInstruction told;
  told.description = instruction(setups, at);
  const auto instruction_ref = m.add(told);
  model::FixtureUsage usage;
  usage.its_id = s.holding.id;
  usage.description = s.holding.description;
  usage.mount_reference = model::add_placement_at(m, {0, 0, 0});
  usage.workpiece_reference = model::add_placement_at(m, s.holding.pickup);
  const auto usage_ref = m.add(usage);
  m.at<model::Setup>(s.setup).its_fixture_usage = usage_ref;
  // Of several workpieces in the set-up it holds the one that the project makes.
  const auto* held = model::piece_in_setup(m, s.setup, model::workpiece_of(m, plan.project));
  const auto& pieces = m.at<model::Setup>(s.setup).its_workpiece_setup.items;
  const auto at_piece = std::find_if(pieces.begin(), pieces.end(), [&](const auto& r) {
    return held != nullptr && m.get<model::WorkpieceSetup>(r) == held;
  });
  if (at_piece == pieces.end()) return;
  const model::Ref<model::WorkpieceSetup> piece(*at_piece);
  auto kept = m.at<model::WorkpieceSetup>(piece).its_instructions;
  std::erase_if(kept.items, [&](const auto& r) {
    const auto* old = m.get<model::SetupInstruction>(r);
    return old != nullptr && old->description.value_or("").starts_with(kMark);
  });
  kept.given = true;
  kept.push_back(instruction_ref);
  m.at<model::WorkpieceSetup>(piece).its_instructions = kept;
  const model::FixtureSolid* only = nullptr;
  std::size_t above = 0;
  for (const auto& solid : s.holding.solids) {
    if (solid.top_mm <= s.stock.lo.z + 1e-6) continue;
    ++above;
    only = &solid;
  }
  if (above == 1) {
    const auto b = geometry::bounds(geometry::Region{{only->outline}});
    model::Block block;
    block.name = only->id;
    block.position = model::add_placement_at(m, {b.lo.x, b.lo.y, only->bottom_mm});
    block.x = b.hi.x - b.lo.x;
    block.y = b.hi.y - b.lo.y;
    block.z = only->top_mm - only->bottom_mm;
    const auto ref = m.add(block);
    m.at<model::WorkpieceSetup>(piece).its_restricted_area = ref;
  }
  plan.ledger.bind(
      piece, "its_instructions", model::Binder::kRule,
      {"setup.holding", "held by '" + s.holding.id + "': " + s.holding.description,
       "workholding " + (by.empty() ? std::string("of the plan") : by) + "; sizes: " + s.holding.source});
}

}  // namespace capstan::workholding
