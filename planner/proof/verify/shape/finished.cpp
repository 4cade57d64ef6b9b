#include "planner/proof/verify/shape/finished.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "planner/ground/base/number.h"
#include "planner/ground/base/stopping.h"
#include "planner/model/nouns/all.h"
#include "planner/proof/verify/copies/copies.h"
#include "planner/proof/verify/plan/plan_checks.h"
#include "planner/proof/verify/program/program_checks.h"
#include "planner/proof/verify/program/readers.h"
#include "planner/proof/verify/shape/edges.h"
#include "planner/proof/verify/shape/lattice.h"
#include "planner/proof/verify/sweep/grid/grid.h"
#include "planner/proof/verify/sweep/grid/way.h"
#include "planner/proof/verify/sweep/target/target.h"
#include "planner/proof/verify/verify.h"

namespace capstan::verify {
namespace {

using geometry::Vec2;
using geometry::Vec3;

/// Places of a plane face that are looked at, at most. Default, unsourced.
constexpr std::size_t kPlaces = 8;
/// A point so near to the centre of a cell has its height, mm: rounding of placements.
constexpr double kAtCentreMm = 1e-6;
/// How far out or in a plane may lie so that it is still measured, mm, beyond the tolerance.
constexpr std::array<double, 6> kSearched = {0.1, 0.2, 0.4, 0.8, 1.6, kFarthestPlaneMm};
/// Places at sharp edges that are looked at, at most; so many times the tolerance within both faces. Default,
/// unsourced.
constexpr std::size_t kEdgePlaces = 2000;
constexpr double kInsideEdges = 2.5;
/// To which a plane's distance is measured, mm. Default, unsourced: what messages show.
constexpr double kMeasuredMm = 0.005;

bool cuts(const StepMoves& step) {
  return step.cutter != nullptr && std::isfinite(step.cutter->cutting_diameter_mm) &&
         step.cutter->cutting_diameter_mm > 0.0;
}
bool cuts(const Move& m) { return m.kind != model::MoveKind::kRapid && m.kind != model::MoveKind::kDwell; }

/// Asks of single places, workpiece frame, whether cutters came over them: exact.
class Swept {
 public:
  Swept(const model::Plan& plan, const std::vector<StepMoves>& steps) {
    for (const StepMoves& s : steps) {
      if (!cuts(s)) continue;
      Pass pass{workpiece_in(plan, s.setup), CutterOutline(outline_of(*s.cutter)), {}, {}};
      const double r = pass.outline.radius();
      for (const Move& m : s.moves) {
        if (!cuts(m)) continue;
        geometry::Box3 box = box_of(m);
        box.lo = box.lo - Vec3{r, r, 0.0};
        box.hi = box.hi + Vec3{r, r, 0.0};
        pass.all.add(box.lo);
        pass.all.add(box.hi);
        pass.moves.emplace_back(box, m);
      }
      if (!pass.moves.empty()) passes_.push_back(std::move(pass));
    }
  }
  [[nodiscard]] bool over(Vec3 at) const {
    return std::any_of(passes_.begin(), passes_.end(), [&](const Pass& pass) {
      const Vec3 p = pass.frame.to_parent(at);
      const auto beside = [&](const geometry::Box3& b) {
        return p.x < b.lo.x || p.x > b.hi.x || p.y < b.lo.y || p.y > b.hi.y || p.z < b.lo.z;
      };
      if (beside(pass.all)) return false;
      return std::any_of(pass.moves.begin(), pass.moves.end(), [&](const auto& m) {
        if (beside(m.first)) return false;
        Over over;
        return along_way(pass.outline, m.second,
                         [&](const auto& way) { return way.meets(xy(p), p.z, over) && over.z < p.z; });
      });
    });
  }

 private:
  struct Pass {
    geometry::Placement frame;
    CutterOutline outline;
    geometry::Box3 all;
    std::vector<std::pair<geometry::Box3, Move>> moves;
  };
  std::vector<Pass> passes_;
};

/// What threads cut beside their cores, which a CAD model draws as plain cylinders: workpiece frame. What
/// other steps cut there is none of it.
class Threads {
 public:
  Threads(const model::Plan& plan, const std::vector<StepMoves>& steps) : others_(plan, {}) {
    const PartShapes part = shapes_of_part(plan);
    std::vector<StepMoves> others;
    for (const StepMoves& s : steps) {
      const PartShapes::Entry* of = nullptr;
      if (s.planned != nullptr) {
        const auto* ws = plan.model.get<model::MachiningWorkingstep>(s.planned->step);
        of = ws != nullptr ? part.find(ws->its_feature) : nullptr;
      }
      bool threads = false;
      for (const volumes::Form& f : of != nullptr ? of->shapes : std::vector<volumes::Form>{}) {
        const volumes::Bore* bore = f.kind == model::ShapeKind::kThread ? f.bore() : nullptr;
        if (bore == nullptr || !(bore->thread_major_mm > 0.0)) continue;
        threads = true;
        // Its crests lie beyond the basic size by its zone and what the mill bends, which is
        // CHK-THREAD-WIDTH's.
        all_.push_back(
            {f.frame(), 0.5 * (bore->thread_major_mm + bore->thread_pitch_mm) + kShapeMm, f.depth_mm()});
      }
      if (!threads) others.push_back(s);
    }
    if (!all_.empty()) others_ = Swept(plan, others);
  }
  [[nodiscard]] bool hold(Vec3 at) const {
    return std::any_of(all_.begin(), all_.end(),
                       [&](const One& t) {
                         const Vec3 p = t.frame.to_local(at);
                         return p.z <= kShapeMm && p.z >= -t.depth_mm && norm(xy(p)) <= t.radius_mm;
                       }) &&
           !others_.over(at);
  }

 private:
  struct One {
    geometry::Placement frame;
    double radius_mm = 0.0, depth_mm = 0.0;
  };
  std::vector<One> all_;
  Swept others_;
};

/// The points of drilled bottoms, workpiece frame. An angle has no tolerance: what a blunter drill leaves
/// there is CHK-LEFT-POINT's to tell.
class Points {
 public:
  explicit Points(const model::Plan& plan) {
    for (const PartShapes::Entry& e : shapes_of_part(plan).entries) {
      for (const volumes::Form& f : e.shapes) {
        const volumes::Bore* bore = f.kind == model::ShapeKind::kHole ? f.bore() : nullptr;
        const bool cone = bore != nullptr && bore->bottom == volumes::Bore::Bottom::kCone;
        if (cone && f.tip_mm > 0.0 && !(bore->blunt_mm > 0.0))
          all_.push_back({f.frame(), bore->bottom_radius_mm, f.depth_mm(), f.tip_mm});
      }
    }
  }
  [[nodiscard]] bool hold(Vec3 at) const {
    return std::any_of(all_.begin(), all_.end(), [&](const One& b) {
      const Vec3 p = b.frame.to_local(at);
      return p.z <= -b.depth_mm && p.z >= -b.depth_mm - b.tip_mm && norm(xy(p)) <= b.radius_mm;
    });
  }

 private:
  struct One {
    geometry::Placement frame;
    double radius_mm = 0.0, depth_mm = 0.0, tip_mm = 0.0;
  };
  std::vector<One> all_;
};

/// Whether cutters came over a place, by the heights about it; nothing where they do not agree.
std::optional<bool> by_heights(const Grid& grid, Vec2 lo, double full, Vec3 p) {
  const int ix = static_cast<int>(std::floor((p.x - lo.x) / grid.cell()));
  const int iy = static_cast<int>(std::floor((p.y - lo.y) / grid.cell()));
  if (ix < 0 || iy < 0 || ix >= grid.nx() || iy >= grid.ny()) return false;
  const auto cut = [&](int x, int y) {
    const double height = grid.stock[grid.index(x, y)];
    return height < full && p.z > height;
  };
  const bool here = cut(ix, iy);
  if (norm(xy(p) - grid.centre(ix, iy)) < kAtCentreMm) return here;
  for (int x = std::max(0, ix - 1); x <= std::min(grid.nx() - 1, ix + 1); ++x) {
    for (int y = std::max(0, iy - 1); y <= std::min(grid.ny() - 1, iy + 1); ++y) {
      if (cut(x, y) != here) return std::nullopt;
    }
  }
  return here;
}

/// Marks the points that cutters came over.
void mark_gone(const model::Plan& plan, const std::vector<StepMoves>& steps, const Swept& swept,
               Lattice& lattice) {
  std::vector<geometry::Placement> frames;
  for (const StepMoves& s : steps) {
    const auto frame = workpiece_in(plan, s.setup);
    if (std::find(frames.begin(), frames.end(), frame) == frames.end()) frames.push_back(frame);
  }
  for (const geometry::Placement& frame : frames) {
    const geometry::Box3 box = geometry::transformed(lattice.box(), frame);
    Grid grid(xy(box.lo), xy(box.hi), lattice.step_mm, 4 * kMaximumCells);
    const double full = box.hi.z + lattice.step_mm;
    grid.stock.assign(static_cast<std::size_t>(grid.nx()) * static_cast<std::size_t>(grid.ny()), full);
    grid.base.assign(grid.stock.size(), box.lo.z - lattice.step_mm);
    grid.part.assign(grid.stock.size(), Grid::kNothing);
    grid.find_top();
    for (const StepMoves& s : steps) {
      if (!cuts(s) || !(workpiece_in(plan, s.setup) == frame)) continue;
      const CutterOutline outline(outline_of(*s.cutter));
      for (const Move& m : s.moves) {
        poll();
        if (cuts(m)) (void)cut(grid, m, outline, {});
      }
    }
    const Vec2 lo = xy(box.lo);
    for (int x = 0; x < lattice.n[0]; ++x) {
      for (int y = 0; y < lattice.n[1]; ++y) {
        for (int z = 0; z < lattice.n[2]; ++z) {
          char& gone = lattice.gone[lattice.index(x, y, z)];
          if (gone != 0) continue;
          const Vec3 at = lattice.at(x, y, z);
          const auto cut_there = by_heights(grid, lo, full, frame.to_parent(at));
          gone = cut_there.value_or(false) || (!cut_there && swept.over(at)) ? 1 : 0;
        }
      }
    }
  }
}

bool holds(const geometry::Box3& b, Vec3 p) {
  return p.x > b.lo.x && p.x < b.hi.x && p.y > b.lo.y && p.y < b.hi.y && p.z > b.lo.z && p.z < b.hi.z;
}

/// Places of a plane: the middles of its largest triangles.
std::vector<std::pair<Vec3, Vec3>> places_of(const geometry::Mesh& mesh, const AskedShape::Plane& plane) {
  struct Sized {
    double area;
    Vec3 at, normal;
  };
  std::vector<Sized> all;
  for (const std::uint32_t i : plane.triangles) {
    const auto t = corners(mesh, i);
    const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
    if (norm(n) > 0.0) all.push_back({norm(n), (1.0 / 3.0) * (t[0] + t[1] + t[2]), normalised(n)});
  }
  std::stable_sort(all.begin(), all.end(), [](const Sized& a, const Sized& b) { return a.area > b.area; });
  if (all.size() > kPlaces) all.resize(kPlaces);
  std::vector<std::pair<Vec3, Vec3>> out;
  for (const Sized& s : all) out.emplace_back(s.at, s.normal);
  return out;
}

/// How far off a plane lies to one side of a place: 0 within the tolerance, kFarthestPlaneMm where it is
/// that or more. `wrong(d)`: what is at that distance is not as asked.
template <class Wrong>
double off_by(double tolerance_mm, const Wrong& wrong) {
  if (!wrong(tolerance_mm)) return 0.0;
  double off = tolerance_mm;
  for (const double d : kSearched) {
    if (d <= off) continue;
    if (wrong(d)) {
      off = d;
      continue;
    }
    double right = d;
    while (right - off > kMeasuredMm) {
      const double middle = 0.5 * (off + right);
      (wrong(middle) ? off : right) = middle;
    }
    break;
  }
  return off;
}

void compare_planes(const model::Plan& plan, const Swept& swept, const Threads& threads,
                    const AskedShape& shape, ShapeDifference& out) {
  const auto gone = [&](Vec3 p) { return !holds(plan.stock.box, p) || swept.over(p); };
  for (const AskedShape::Plane& plane : shape.planes) {
    poll();
    double high = 0.0;
    double low = 0.0;
    for (const auto& place : places_of(shape.mesh, plane)) {
      const Vec3 at = place.first;
      const Vec3 normal = place.second;
      high = std::max(high, off_by(out.tolerance_mm, [&](double d) { return !gone(at + d * normal); }));
      low = std::max(low, off_by(out.tolerance_mm, [&](double d) {
                       return gone(at - d * normal) && !threads.hold(at - d * normal);
                     }));
    }
    ++out.planes;
    if (high > 0.0) out.high.push_back(plane.name);
    if (low > 0.0) out.low.push_back(plane.name);
    out.worst_high_mm = std::max(out.worst_high_mm, high);
    out.worst_low_mm = std::max(out.worst_low_mm, low);
  }
}

/// What breaks edges on purpose, where no chamfer of the part is its feature: `--edges`, and cones at mouths
/// of holes.
bool breaks_edges_alone(const model::Plan& plan, const StepMoves& s) {
  if (s.cutter == nullptr || !breaks_edges(s.cutter->cutter_class) || s.planned == nullptr) return false;
  const auto* ws = plan.model.get<model::MachiningWorkingstep>(s.planned->step);
  return ws == nullptr || !plan.model.holds<model::TransitionFeature>(ws->its_feature);
}

void compare_edges(const model::Plan& plan, const std::vector<StepMoves>& steps, const Threads& threads,
                   const AskedShape& shape, ShapeDifference& out) {
  std::vector<StepMoves> others;
  for (const StepMoves& s : steps) {
    if (!breaks_edges_alone(plan, s)) others.push_back(s);
  }
  const Swept swept(plan, others);
  for (const Vec3 at : inside_sharp_edges(shape.mesh, kInsideEdges * out.tolerance_mm, kEdgePlaces)) {
    poll();
    if (!holds(plan.stock.box, at) || !swept.over(at) || threads.hold(at)) continue;
    if (out.edges_cut++ == 0) out.edge_at = at;
  }
}

std::string at_words(Vec3 p) {
  return "(" + trimmed(p.x, 2) + ", " + trimmed(p.y, 2) + ", " + trimmed(p.z, 2) + ")";
}

/// "0.12 mm"; "3.2 mm or more" where a plane was not measured farther.
std::string off_words(double of_points_mm, double of_planes_mm) {
  const bool more = of_planes_mm >= kFarthestPlaneMm && of_points_mm <= of_planes_mm;
  return trimmed(std::max(of_points_mm, of_planes_mm), 2) + (more ? " mm or more" : " mm");
}

std::string names(const std::vector<std::string>& all) {
  constexpr std::size_t kMost = 6;
  std::string out;
  for (std::size_t i = 0; i < all.size() && i < kMost; ++i) out += (i == 0 ? "" : " ") + all[i];
  if (all.size() > kMost) out += " and " + std::to_string(all.size() - kMost) + " more";
  return out;
}

}  // namespace

ShapeDifference compare_with_shape(const model::Plan& plan, const std::vector<StepMoves>& steps,
                                   const AskedShape& shape) {
  ShapeDifference out;
  if (plan.stock.box.empty()) return out;
  out.tolerance_mm = kShapeMm + shape.chord_mm;
  Lattice lattice = lattice_over(plan.stock.box);
  out.step_mm = lattice.step_mm;
  const Swept swept(plan, steps);
  const Threads threads(plan, steps);
  const Points points(plan);
  mark_asked(shape.mesh, lattice);
  mark_gone(plan, steps, swept, lattice);
  const Surface surface(shape.mesh, lattice, out.tolerance_mm);
  const double each = std::pow(lattice.step_mm, 3.0);
  const double most = norm(plan.stock.box.size());
  Deepest left(shape.mesh, most), gouged(shape.mesh, most);
  std::size_t common = 0, either = 0;
  for (int x = 0; x < lattice.n[0]; ++x) {
    for (int y = 0; y < lattice.n[1]; ++y) {
      for (int z = 0; z < lattice.n[2]; ++z) {
        const std::size_t i = lattice.index(x, y, z);
        const bool asked = lattice.asked[i] != 0;
        const Vec3 at = lattice.at(x, y, z);
        bool there = lattice.gone[i] == 0;
        bool counts = false;
        if (asked && !there && threads.hold(at)) there = true;
        if (asked != there && !surface.near(x, y, z)) {
          poll();
          there = !swept.over(at);
          counts = asked != there;
        }
        out.asked_mm3 += asked ? 0.0 : each;
        out.removed_mm3 += there ? 0.0 : each;
        common += asked && there ? 1U : 0U;
        either += asked || there ? 1U : 0U;
        if (!counts || (there && points.hold(at))) continue;
        (there ? out.left_mm3 : out.gouged_mm3) += each;
        (there ? left : gouged).look_at(at);
      }
    }
  }
  out.deepest_left_mm = left.deepest_mm();
  out.left_at = left.at();
  out.deepest_gouge_mm = gouged.deepest_mm();
  out.gouge_at = gouged.at();
  out.overlap = either == 0 ? 0.0 : static_cast<double>(common) / static_cast<double>(either);
  compare_planes(plan, swept, threads, shape, out);
  compare_edges(plan, steps, threads, shape, out);
  return out;
}

std::vector<model::Finding> check_shape(const ProgramText& text, const model::Plan& plan,
                                        const AskedShape& shape) {
  Findings findings;
  Findings unsaid;  // what else is wrong with the paths or the text is said by the other checks
  std::vector<StepMoves> steps;
  if (text.text.empty()) {
    steps = moves_of(plan, unsaid);
  } else {
    const DialectReader* reader = reader_of(plan.machine.control.dialect);
    if (reader == nullptr) return {};
    const Program program = reader->program(text.text, plan.machine);
    steps = moves_of(make_case(*reader, program, &plan, plan.machine, plan.cutters));
    // What a probe does takes nothing off.
    std::erase_if(steps, [](const StepMoves& s) {
      return s.cutter != nullptr && s.cutter->cutter_class == model::CutterClass::kTouchProbe;
    });
  }
  const ShapeDifference d = compare_with_shape(plan, steps, shape);
  const Findings::Where whole{Findings::kWhole, "", -1};
  const std::string of = shape.file.empty() ? "the CAD shape" : shape.file;
  const std::size_t off = d.high.size() + d.low.size();
  findings.note(36, "CHK-SHAPE", whole,
                "finished part against " + of + ": " + trimmed(d.removed_mm3, 1) + " of " +
                    trimmed(d.asked_mm3, 1) + " mm3 removed, " + trimmed(100.0 * d.overlap, 2) +
                    " % overlap, on points " + trimmed(d.step_mm, 2) + " mm apart; " +
                    std::to_string(d.planes - std::min(off, d.planes)) + " of " +
                    counted(d.planes, "plane face", "plane faces") + " within " + trimmed(d.tolerance_mm, 2) +
                    " mm");
  if (d.gouged_mm3 > 0.0 || !d.low.empty() || d.edges_cut > 0) {
    findings.error(
        11, "CHK-SHAPE-GOUGE", whole,
        "about " + trimmed(d.gouged_mm3, 2) + " mm3 of the part in " + of + " are cut away, up to " +
            off_words(d.deepest_gouge_mm, d.worst_low_mm) + " deep" +
            (d.gouged_mm3 > 0.0 ? " at " + at_words(d.gouge_at) : std::string()) +
            (d.low.empty() ? std::string() : "; plane faces cut into: " + names(d.low)) +
            (d.edges_cut == 0 ? std::string()
                              : "; sharp edges cut off at " + counted(d.edges_cut, "place", "places") +
                                    ", at " + at_words(d.edge_at)) +
            "; leave out the feature that cuts there");
  }
  if (d.left_mm3 > 0.0 || !d.high.empty()) {
    findings.warn(36, d.high.empty() ? "CHK-SHAPE-LEFT" : std::string(kFacesLeft), whole,
                  "about " + trimmed(d.left_mm3, 2) + " mm3 of " + trimmed(d.asked_mm3, 1) +
                      " stay beside the part in " + of + ", up to " +
                      off_words(d.deepest_left_mm, d.worst_high_mm) + " thick" +
                      (d.left_mm3 > 0.0 ? ", at " + at_words(d.left_at) : std::string()) +
                      (d.high.empty() ? std::string() : "; plane faces not reached: " + names(d.high)));
  }
  return findings.take();
}

}  // namespace capstan::verify
