// What a check finds on a step depends on little of the plan: on the step itself, and on what stands where
// its tool goes. Both make a key, under which the findings are remembered with the cells that the step
// lowers, so that a plan of which one tool was changed is swept where that tool goes, and where others go
// after it.
//
// What stands somewhere is not compared cell by cell. A square of the area has a key, which is made anew from
// itself and the step's cuts whenever a step cuts within it; squares with one key were cut alike. A step's
// question holds the keys of the squares that its tool may come over, and its shank and holder where they
// come below the raw piece's top. Moves above the raw piece meet nothing. This errs on one side: what other
// cuts left alike is swept again.
//
// A program's step whose moves are the plan's, but for its decimals (as_planned.cpp), is that step: what was
// found of the plan's holds for it.
#include "planner/proof/verify/sweep/known/known_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "planner/ground/base/stopping.h"
#include "planner/ground/memo/packed.h"
#include "planner/ground/memo/remembered.h"
#include "planner/model/nouns/all.h"
#include "planner/proof/verify/copies/copies.h"
#include "planner/proof/verify/plan/plan_checks.h"
#include "planner/proof/verify/sweep/known/as_planned.h"
#include "planner/proof/verify/sweep/step_checks.h"

namespace capstan::verify {

using geometry::Vec2;
using memo::Key;
using memo::Stage;
using model::MoveKind;

namespace {

constexpr double kClearMm = 1.0;            ///< above the raw piece nothing is met
constexpr std::size_t kMostSaid = 1000;     ///< a step with more findings is swept again each time
constexpr std::size_t kMostCells = 500000;  ///< and one that lowers more cells

bool feeds(const Move& m) { return m.kind != MoveKind::kRapid && m.kind != MoveKind::kDwell; }

/// What a step's check found, and what its cuts left.
struct Known {
  std::vector<Findings::Reported> said;  ///< `move` is the place in StepMoves::moves
  std::vector<std::uint32_t> cells;
  std::vector<double> heights;
  bool cuts = false;
  double speed_share = 1.0;
};

/// The moves without their places in plan or program.
std::vector<Move> placeless(const StepMoves& step, bool all) {
  std::vector<Move> out;
  for (const Move& m : step.moves) {
    if (!all && !feeds(m)) continue;
    out.push_back(m);
    out.back().where = -1;
    if (all) continue;
    out.back().feed_mm_min = out.back().spindle_rpm = 0.0;  // how fast it was cut is not seen afterwards
    out.back().role_known = out.back().synchronised = false;
    out.back().role = {};
  }
  return out;
}

/// The cells that a step may lower.
struct Window {
  int x0 = 0, x1 = 0, y0 = 0, y1 = 0;
};
Window window_of(const StepMoves& step, const Grid& grid, double radius_mm) {
  geometry::Box3 box;
  for (const Move& m : step.moves) {
    if (!feeds(m)) continue;
    const geometry::Box3 b = box_of(m);
    box.add(b.lo);
    box.add(b.hi);
  }
  Window out;
  if (box.empty()) return out;
  const double r = radius_mm + 2.0 * grid.cell();
  std::tie(out.x0, out.x1) = grid.columns(box.lo.x - r, box.hi.x + r);
  std::tie(out.y0, out.y1) = grid.rows(box.lo.y - r, box.hi.y + r);
  return out;
}

/// What was lowered in the window since `before`, which holds its rows; more than kMostCells where it is
/// more.
void lowered(const Grid& grid, const Window& w, const std::vector<double>& before, Known& out) {
  std::size_t k = 0;
  for (int iy = w.y0; iy < w.y1; ++iy) {
    tick(16);
    if (out.cells.size() > kMostCells) return;  // it is not kept
    for (int ix = w.x0; ix < w.x1; ++ix, ++k) {
      const std::size_t i = grid.index(ix, iy);
      if (grid.stock[i] == before[k]) continue;
      out.cells.push_back(static_cast<std::uint32_t>(i));
      out.heights.push_back(grid.stock[i]);
    }
  }
}

void lower(Grid& grid, const Known& known) {
  const auto nx = static_cast<std::uint32_t>(grid.nx());
  for (std::size_t i = 0; i < known.cells.size();) {
    const std::uint32_t row = known.cells[i] / nx, begin = row * nx, first = known.cells[i];
    std::uint32_t last = first;
    for (; i < known.cells.size() && known.cells[i] - begin < nx; ++i) {
      last = known.cells[i];
      grid.stock[last] = known.heights[i];
    }
    grid.cut_cells(static_cast<int>(row), static_cast<int>(first - begin),
                   static_cast<int>(last - begin) + 1);
  }
}

/// Findings by the places of their moves in the step, and back.
std::optional<std::vector<Findings::Reported>> by_place(std::vector<Findings::Reported> said,
                                                        const StepMoves& step) {
  for (Findings::Reported& s : said) {
    if (s.move < 0) continue;
    const auto at =
        std::find_if(step.moves.begin(), step.moves.end(), [&](const Move& m) { return m.where == s.move; });
    if (at == step.moves.end()) return std::nullopt;
    s.move = at - step.moves.begin();
  }
  return said;
}
void to_moves(std::vector<Findings::Reported>& said, const StepMoves& step) {
  for (Findings::Reported& s : said)
    if (s.move >= 0) s.move = step.moves[static_cast<std::size_t>(s.move)].where;
}

bool sound(const Known& known, const StepMoves& step, const Grid& grid) {
  return known.cells.size() == known.heights.size() &&
         std::is_sorted(known.cells.begin(), known.cells.end()) &&
         (known.cells.empty() || known.cells.back() < grid.stock.size()) &&
         std::all_of(known.said.begin(), known.said.end(), [&](const Findings::Reported& s) {
           return s.move < static_cast<long>(step.moves.size());
         });
}

/// Takes what is known of a step instead of sweeping it.
void take(Known known, const StepMoves& step, SweptSetup setup, Findings& findings) {
  to_moves(known.said, step);
  findings.repeat(known.said, step.order + 1, step.id);
  lower(setup.grid, known);
  cut_before(setup.earlier, step);
}

}  // namespace

ToolReach::ToolReach(const model::Cutter& cutter, double cell_mm, double top_mm)
    : more_mm_(4.0 * cell_mm), radius_mm_(outline_of(cutter).radius_mm), top_mm_(top_mm) {
  for (const BodyPart& p : body_of(cutter)) wider_.push_back({p.from_mm, p.radius_mm});
  // As StepChecks::reach looks, also without a holder that is described.
  if (cutter.stick_out_mm > 0.0) wider_.push_back({cutter.stick_out_mm, 0.5 * cutter.holder_diameter_mm});
}

double ToolReach::of(double tip_mm) const {
  double r = radius_mm_;
  for (const Wider& w : wider_)
    if (tip_mm + w.from_mm < top_mm_) r = std::max(r, w.radius_mm);
  return r + more_mm_;
}

void CutSquares::begin(const Grid& grid, const Key& of_setup, bool carried) {
  of_setup_ = of_setup;
  lo_ = grid.centre(0, 0);
  const Vec2 size = grid.centre(grid.nx(), grid.ny()) - lo_;
  square_ = {size.x / kSquares, size.y / kSquares};
  keys_.assign(std::size_t{kSquares} * kSquares, Key{});
  if (!carried) return;
  const auto from = [](int square, int n) { return square * n / kSquares; };
  std::string bytes;
  for (int y = 0; y < kSquares; ++y) {
    for (int x = 0; x < kSquares; ++x) {
      bytes.clear();
      const int x0 = from(x, grid.nx()), x1 = from(x + 1, grid.nx());
      for (int iy = from(y, grid.ny()); iy < from(y + 1, grid.ny()); ++iy) {
        for (const std::vector<double>* heights : {&grid.stock, &grid.base})
          bytes.append(reinterpret_cast<const char*>(heights->data() + grid.index(x0, iy)),
                       static_cast<std::size_t>(x1 - x0) * sizeof(double));
      }
      keys_[static_cast<std::size_t>(y * kSquares + x)] = memo::key_of_bytes(Stage::kSweep, bytes);
    }
  }
}

template <class Reach>
std::vector<char> CutSquares::touched(const StepMoves& step, const Reach& reach, double top_mm,
                                      bool rapids) const {
  std::vector<char> out(keys_.size(), 0);
  const auto at = [](double v, double begin, double wide) {
    return static_cast<int>(std::clamp(std::floor((v - begin) / wide), 0.0, kSquares - 1.0));
  };
  std::array<int, 4> last = {-1, -1, -1, -1};
  for (const Move& m : step.moves) {
    if (m.kind == MoveKind::kDwell || (!rapids && !feeds(m))) continue;
    const geometry::Box3 box = box_of(m);
    if (box.lo.z >= top_mm) continue;
    const double reach_mm = reach(box.lo.z);
    // One square more: the cells of a square are counted from its corner, lengths from a cell's centre.
    const int x0 = std::max(0, at(box.lo.x - reach_mm, lo_.x, square_.x) - 1);
    const int x1 = std::min(kSquares - 1, at(box.hi.x + reach_mm, lo_.x, square_.x) + 1);
    const int y0 = std::max(0, at(box.lo.y - reach_mm, lo_.y, square_.y) - 1);
    const int y1 = std::min(kSquares - 1, at(box.hi.y + reach_mm, lo_.y, square_.y) + 1);
    const std::array<int, 4> now = {x0, x1, y0, y1};
    if (std::exchange(last, now) == now) continue;
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) out[static_cast<std::size_t>(y * kSquares + x)] = 1;
  }
  return out;
}

Key CutSquares::near(const StepMoves& step, const ToolReach& reach) const {
  const std::vector<char> of = touched(
      step, [&](double tip_mm) { return reach.of(tip_mm); }, reach.top_mm(), true);
  std::string bytes;
  memo::pack(bytes, of_setup_);
  for (std::size_t i = 0; i < of.size(); ++i) {
    if (of[i] == 0) continue;
    memo::pack(bytes, static_cast<std::uint64_t>(i));
    memo::pack(bytes, keys_[i]);
  }
  return memo::key_of_bytes(Stage::kSweep, bytes);
}

void CutSquares::cut(const StepMoves& step, double reach_mm, double top_mm, const Key& what) {
  const std::vector<char> of = touched(
      step, [&](double) { return reach_mm; }, top_mm, false);
  for (std::size_t i = 0; i < of.size(); ++i)
    if (of[i] != 0) keys_[i] = memo::key_of(Stage::kSweep, keys_[i], what);
}

KnownSteps::KnownSteps(const model::Plan& plan, const ReadPart& part, memo::Memo* memo)
    : plan_(plan), memo_(part.known_by ? memo : nullptr), of_plan_(part.known_by.value_or(Key{})) {}

Key KnownSteps::key_of_setup(const Target& target, const Grid& grid) const {
  std::string bytes;
  memo::pack(bytes, of_plan_);
  target.describe(bytes);
  memo::pack(bytes, grid.nx());
  memo::pack(bytes, grid.ny());
  memo::pack(bytes, grid.cell());
  return memo::key_of_bytes(Stage::kSweep, bytes);
}

void KnownSteps::remember(Target& target, const Grid& grid) const {
  if (memo_ != nullptr) target.remember(*memo_, key_of_setup(target, grid));
}

void KnownSteps::begin(SweptSetup setup, bool carried) const {
  if (memo_ == nullptr) return;
  setup.squares.begin(setup.grid, key_of_setup(setup.target, setup.grid), carried);
}

const Key& KnownSteps::key_of_cutter(const model::Cutter& cutter) const {
  const auto [at, is_new] = of_cutters_.try_emplace(&cutter);
  if (is_new) at->second = memo::key_of(Stage::kSweep, cutter);
  return at->second;
}

/// All that StepChecks asks: who adds a question there adds it here.
Key KnownSteps::key_of(const StepMoves& step, const SweptSetup& setup, bool begun) const {
  std::string bytes;
  memo::pack(bytes, placeless(step, true));
  poll();
  memo::pack(bytes, key_of_cutter(*step.cutter));
  memo::pack(bytes, begun);
  memo::pack(bytes, step.planned != nullptr);
  if (step.planned != nullptr) {
    const model::StepResult& r = *step.planned;
    memo::pack(bytes, r.fz_mm);
    memo::pack(bytes, r.axial_depth_mm);
    memo::pack(bytes, r.radial_depth_mm);
    memo::pack(bytes, r.loads);
    memo::pack(bytes, workpiece_in(plan_, r.setup));
    const auto* ws = plan_.model.get<model::MachiningWorkingstep>(r.step);
    memo::pack(bytes, ws != nullptr);
    if (ws != nullptr) {
      memo::pack(bytes, ws->its_feature.type);
      memo::pack(bytes, ws->its_feature.index);
      memo::pack(bytes, ws->its_operation.type);
      memo::pack(bytes, plan_.model.get<model::Two5dMillingOperation>(ws->its_operation) != nullptr);
      memo::pack(bytes, chose_ramp(plan_, *ws));
      memo::pack(bytes, chose_feed(plan_, *ws));
    }
  }
  const ToolReach reach(*step.cutter, setup.grid.cell(), setup.target.stock().hi.z + kClearMm);
  memo::pack(bytes, setup.squares.near(step, reach));
  memo::pack(bytes, setup.grid.top());  // where nothing stands so high, less is looked at
  return memo::key_of_bytes(Stage::kSweep, bytes);
}

void KnownSteps::leave(const StepMoves& step, SweptSetup setup) const {
  // A head under an overhang leaves what is above it: its size counts.
  const model::Cutter& c = *step.cutter;
  const geometry::CutterProfile profile = outline_of(c);
  setup.squares.cut(step, profile.radius_mm + 2.0 * setup.grid.cell(), setup.target.stock().hi.z + kClearMm,
                    memo::key_of(Stage::kSweep, placeless(step, false), profile, c.cutter_class,
                                 c.cutting_width_mm, c.maximum_depth_of_cut_mm));
}

void KnownSteps::sweep_rapids(const StepMoves& step, std::size_t from, std::size_t to, SweptSetup setup,
                              Findings& findings) const {
  if (from == to) return;
  StepMoves some{step.order, step.id, step.planned, step.cutter, step.setup, {}};
  some.moves.assign(step.moves.begin() + static_cast<std::ptrdiff_t>(from),
                    step.moves.begin() + static_cast<std::ptrdiff_t>(to));
  Findings apart;
  std::vector<Findings::Reported> said;
  {
    const Findings::Recording recording(apart, said);
    StepChecks(plan_, some, setup.grid, setup.target, setup.earlier, apart).run();
  }
  // What is said of the step as a whole was said with its plan's moves.
  std::erase_if(said, [](const Findings::Reported& s) { return s.move < 0; });
  findings.repeat(said, step.order + 1, step.id);
}

std::optional<SweptStep> KnownSteps::sweep_as_planned(const StepMoves& step, SweptSetup setup, bool begun,
                                                      Findings& findings) const {
  const model::Cutter& c = *step.cutter;
  // Of a ring of teeth it counts what stood before it came, also for its last way up.
  if (step.planned == nullptr || step.feed_rounding_mm_min == 0.0 || mills_threads(c.cutter_class) ||
      under_overhangs(c.cutter_class))
    return std::nullopt;
  auto planned = moves_of_step(plan_, *step.planned, step.order, step.id);
  if (!planned) return std::nullopt;
  const auto same = as_planned(step, planned->moves);
  if (!same) return std::nullopt;
  planned->cutter = step.cutter;
  planned->setup = step.setup;
  const auto bytes = memo_->find(Stage::kSweep, key_of(*planned, setup, begun));
  if (!bytes) return std::nullopt;
  auto known = memo::unpacked<Known>(*bytes);
  if (!known || !sound(*known, *planned, setup.grid)) return std::nullopt;
  for (std::size_t i = 0; i < planned->moves.size(); ++i) planned->moves[i].where = same->where[i];
  sweep_rapids(step, 0, same->first, setup, findings);
  // The plan comes to its first point in its own way, the program in another, which is looked at.
  std::erase_if(known->said, [](const Findings::Reported& s) { return s.move == 0; });
  const SweptStep out{known->cuts, known->speed_share};
  take(*std::move(known), *planned, setup, findings);
  leave(*planned, setup);
  sweep_rapids(step, same->last, step.moves.size(), setup, findings);
  return out;
}

SweptStep KnownSteps::sweep(const StepMoves& step, SweptSetup setup, bool begun, Findings& findings) const {
  const auto anew = [&] {
    StepChecks checks(plan_, step, setup.grid, setup.target, setup.earlier, findings);
    checks.run();
    checks.nothing(begun);
    return SweptStep{checks.cuts(), checks.speed_share()};
  };
  if (memo_ == nullptr) return anew();
  if (const auto planned = sweep_as_planned(step, setup, begun, findings)) return *planned;
  const Key key = key_of(step, setup, begun);
  poll();
  SweptStep out;
  std::optional<Known> known;
  if (const auto bytes = memo_->find(Stage::kSweep, key)) known = memo::unpacked<Known>(*bytes);
  if (known && sound(*known, step, setup.grid)) {
    out = {known->cuts, known->speed_share};
    take(*std::move(known), step, setup, findings);
  } else {
    const Window w = window_of(step, setup.grid, outline_of(*step.cutter).radius_mm);
    std::vector<double> before;
    before.reserve(static_cast<std::size_t>(std::max(0, w.x1 - w.x0)) *
                   static_cast<std::size_t>(std::max(0, w.y1 - w.y0)));
    for (int iy = w.y0; iy < w.y1; ++iy) {
      tick(16);
      const auto row = setup.grid.stock.begin() + static_cast<std::ptrdiff_t>(setup.grid.index(0, iy));
      before.insert(before.end(), row + w.x0, row + w.x1);
    }
    std::vector<Findings::Reported> said;
    {
      const Findings::Recording recording(findings, said);
      out = anew();
    }
    poll();
    Known made{{}, {}, {}, out.cuts, out.speed_share};
    lowered(setup.grid, w, before, made);
    poll();
    auto placed = by_place(std::move(said), step);
    if (placed && placed->size() <= kMostSaid && made.cells.size() <= kMostCells) {
      made.said = *std::move(placed);
      std::string bytes;
      bytes.reserve(memo::packed_size(made));
      memo::pack(bytes, made);
      poll();
      memo_->keep(Stage::kSweep, key, std::move(bytes));
    }
  }
  leave(step, setup);
  return out;
}

}  // namespace capstan::verify
