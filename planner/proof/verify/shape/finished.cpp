#include "planner/proof/verify/shape/finished.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "planner/ground/base/number.h"
#include "planner/ground/base/stopping.h"
#include "planner/proof/verify/copies/copies.h"
#include "planner/proof/verify/plan/plan_checks.h"
#include "planner/proof/verify/program/program_checks.h"
#include "planner/proof/verify/program/readers.h"
#include "planner/proof/verify/sweep/grid/grid.h"
#include "planner/proof/verify/sweep/grid/way.h"
#include "planner/proof/verify/sweep/target/target.h"

namespace capstan::verify {
namespace {

using geometry::Vec2;
using geometry::Vec3;

/// Points of the lattice, about. Default, unsourced: a compromise of time and resolution.
constexpr double kPoints = 250'000.0;
/// Places of a plane face that are looked at, at most. Default, unsourced.
constexpr std::size_t kPlaces = 8;
/// How far out or in a plane may lie so that it is still measured, mm.
constexpr std::array<double, 7> kSearched = {kShapeMm, 0.1, 0.2, 0.4, 0.8, 1.6, 3.2};

std::array<Vec3, 3> corners(const geometry::Mesh& mesh, std::size_t i) {
  const auto& [a, b, c] = mesh.triangles[i];
  return {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
}

/// How far a point is from a triangle.
double distance(Vec3 p, const std::array<Vec3, 3>& t) {
  // Source: Ericson, Real-Time Collision Detection (2005), 5.1.5.
  const Vec3 ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0];
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0.0 && d2 <= 0.0) return norm(ap);
  const Vec3 bp = p - t[1];
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0.0 && d4 <= d3) return norm(bp);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return norm(ap - (d1 / (d1 - d3)) * ab);
  const Vec3 cp = p - t[2];
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0.0 && d5 <= d6) return norm(cp);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return norm(ap - (d2 / (d2 - d6)) * ac);
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 >= d3 && d5 >= d6)
    return norm(bp - ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (t[2] - t[1]));
  const double all = va + vb + vc;
  return all == 0.0 ? norm(ap) : norm(ap - (vb / all) * ab - (vc / all) * ac);
}

/// How far a point is from the mesh, if that is less than `most`.
double distance(const geometry::Mesh& mesh, Vec3 p, double most) {
  double least = most;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto t = corners(mesh, i);
    bool far = false;
    for (double Vec3::*k : {&Vec3::x, &Vec3::y, &Vec3::z}) {
      far = far || std::min({t[0].*k, t[1].*k, t[2].*k}) - p.*k > least ||
            p.*k - std::max({t[0].*k, t[1].*k, t[2].*k}) > least;
    }
    if (!far) least = std::min(least, distance(p, t));
  }
  return least;
}

struct Lattice {
  Vec3 lo;
  double step_mm = 0.0;
  std::array<int, 3> n{};
  std::vector<char> asked, gone;  ///< per point: in the shape; removed
  [[nodiscard]] std::size_t index(int i, int j, int k) const {
    return (static_cast<std::size_t>(i) * static_cast<std::size_t>(n[1]) + static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(n[2]) +
           static_cast<std::size_t>(k);
  }
  [[nodiscard]] Vec3 at(int i, int j, int k) const { return lo + step_mm * Vec3{i + 0.5, j + 0.5, k + 0.5}; }
  [[nodiscard]] geometry::Box3 box() const {
    return {lo, lo + step_mm * Vec3{static_cast<double>(n[0]), static_cast<double>(n[1]),
                                    static_cast<double>(n[2])}};
  }
};

Lattice lattice_over(const geometry::Box3& raw) {
  Lattice out;
  const Vec3 size = raw.size();
  out.step_mm = std::cbrt(size.x * size.y * size.z / kPoints);
  const std::array<double, 3> sizes{size.x, size.y, size.z};
  for (std::size_t k = 0; k < 3; ++k) out.n[k] = std::max(1, static_cast<int>(sizes[k] / out.step_mm));
  const Vec3 covered = out.box().size();
  out.lo = raw.lo + 0.5 * (size - covered);
  const std::size_t all = static_cast<std::size_t>(out.n[0]) * static_cast<std::size_t>(out.n[1]) *
                          static_cast<std::size_t>(out.n[2]);
  out.asked.assign(all, 0);
  out.gone.assign(all, 0);
  return out;
}

/// Marks the points in the shape: those above which more of its surfaces look up than down.
void mark_asked(const geometry::Mesh& mesh, Lattice& lattice) {
  std::vector<std::vector<std::pair<double, int>>> columns(static_cast<std::size_t>(lattice.n[0]) *
                                                           static_cast<std::size_t>(lattice.n[1]));
  // Columns stand a little beside the points, off edges that lie on round numbers.
  const Vec2 aside{1.3e-5, 0.7e-5};
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto t = corners(mesh, i);
    const double area = cross(xy(t[1] - t[0]), xy(t[2] - t[0]));
    if (area == 0.0) continue;
    const auto range = [&](double a, double b, double c, double from, int n) {
      const double lo = (std::min({a, b, c}) - from) / lattice.step_mm - 1.0;
      const double hi = (std::max({a, b, c}) - from) / lattice.step_mm + 1.0;
      return std::pair(std::max(0, static_cast<int>(lo)), std::min(n - 1, static_cast<int>(hi)));
    };
    const auto [i0, i1] = range(t[0].x, t[1].x, t[2].x, lattice.lo.x, lattice.n[0]);
    const auto [j0, j1] = range(t[0].y, t[1].y, t[2].y, lattice.lo.y, lattice.n[1]);
    for (int x = i0; x <= i1; ++x) {
      for (int y = j0; y <= j1; ++y) {
        const Vec2 p = xy(lattice.at(x, y, 0)) + aside;
        const double a = cross(xy(t[2] - t[1]), p - xy(t[1])) / area;
        const double b = cross(xy(t[0] - t[2]), p - xy(t[2])) / area;
        const double c = 1.0 - a - b;
        if (a < 0.0 || b < 0.0 || c < 0.0) continue;
        columns[static_cast<std::size_t>(x * lattice.n[1] + y)].emplace_back(
            a * t[0].z + b * t[1].z + c * t[2].z, area > 0.0 ? 1 : -1);
      }
    }
  }
  for (int x = 0; x < lattice.n[0]; ++x) {
    for (int y = 0; y < lattice.n[1]; ++y) {
      for (int z = 0; z < lattice.n[2]; ++z) {
        int above = 0;
        for (const auto& [h, up] : columns[static_cast<std::size_t>(x * lattice.n[1] + y)])
          above += h > lattice.at(x, y, z).z ? up : 0;
        lattice.asked[lattice.index(x, y, z)] = above > 0 ? 1 : 0;
      }
    }
  }
}

bool cuts(const StepMoves& step) {
  return step.cutter != nullptr && std::isfinite(step.cutter->cutting_diameter_mm) &&
         step.cutter->cutting_diameter_mm > 0.0;
}
bool cuts(const Move& m) { return m.kind != model::MoveKind::kRapid && m.kind != model::MoveKind::kDwell; }

/// Marks the points that cutters came over.
void mark_gone(const model::Plan& plan, const std::vector<StepMoves>& steps, Lattice& lattice) {
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
          const Vec3 p = frame.to_parent(lattice.at(x, y, z));
          const int ix = static_cast<int>(std::floor((p.x - lo.x) / grid.cell()));
          const int iy = static_cast<int>(std::floor((p.y - lo.y) / grid.cell()));
          if (ix < 0 || iy < 0 || ix >= grid.nx() || iy >= grid.ny()) continue;
          const double height = grid.stock[grid.index(ix, iy)];
          if (height < full && p.z > height) lattice.gone[lattice.index(x, y, z)] = 1;
        }
      }
    }
  }
}

/// Asks of single places whether cutters came over them: exact.
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
                         [&](const auto& way) { return way.meets(xy(p), p.z, over); });
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

void compare_planes(const model::Plan& plan, const std::vector<StepMoves>& steps, const AskedShape& shape,
                    ShapeDifference& out) {
  const Swept swept(plan, steps);
  const auto gone = [&](Vec3 p) { return !holds(plan.stock.box, p) || swept.over(p); };
  for (const AskedShape::Plane& plane : shape.planes) {
    poll();
    double high = 0.0;
    double low = 0.0;
    for (const auto& [at, normal] : places_of(shape.mesh, plane)) {
      for (const double d : kSearched) {
        if (gone(at + d * normal)) break;
        high = std::max(high, d);
      }
      for (const double d : kSearched) {
        if (!gone(at - d * normal)) break;
        low = std::max(low, d);
      }
    }
    ++out.planes;
    if (high > 0.0) out.high.push_back(plane.name);
    if (low > 0.0) out.low.push_back(plane.name);
    out.worst_plane_mm = std::max({out.worst_plane_mm, high, low});
  }
}

std::string at_words(Vec3 p) {
  return "(" + trimmed(p.x, 2) + ", " + trimmed(p.y, 2) + ", " + trimmed(p.z, 2) + ")";
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
  Lattice lattice = lattice_over(plan.stock.box);
  out.step_mm = lattice.step_mm;
  mark_asked(shape.mesh, lattice);
  mark_gone(plan, steps, lattice);
  const double each = std::pow(lattice.step_mm, 3.0);
  const double most = norm(plan.stock.box.size());
  std::size_t common = 0, either = 0;
  for (int x = 0; x < lattice.n[0]; ++x) {
    for (int y = 0; y < lattice.n[1]; ++y) {
      for (int z = 0; z < lattice.n[2]; ++z) {
        const std::size_t i = lattice.index(x, y, z);
        const bool asked = lattice.asked[i] != 0;
        const bool there = lattice.gone[i] == 0;
        out.asked_mm3 += asked ? 0.0 : each;
        out.removed_mm3 += there ? 0.0 : each;
        common += asked && there ? 1U : 0U;
        either += asked || there ? 1U : 0U;
        if (asked == there) continue;
        poll();
        const Vec3 at = lattice.at(x, y, z);
        const double d = distance(shape.mesh, at, most);
        if (d < kShapeMm) continue;
        (there ? out.left_mm3 : out.gouged_mm3) += each;
        double& deepest = there ? out.deepest_left_mm : out.deepest_gouge_mm;
        if (d <= deepest) continue;
        deepest = d;
        (there ? out.left_at : out.gouge_at) = at;
      }
    }
  }
  out.overlap = either == 0 ? 0.0 : static_cast<double>(common) / static_cast<double>(either);
  compare_planes(plan, steps, shape, out);
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
                    counted(d.planes, "plane face", "plane faces") + " within " + trimmed(kShapeMm, 2) +
                    " mm");
  if (d.gouged_mm3 > 0.0 || !d.low.empty()) {
    findings.error(11, "CHK-SHAPE-GOUGE", whole,
                   "about " + trimmed(d.gouged_mm3, 2) + " mm3 of the part in " + of +
                       " are cut away, up to " +
                       trimmed(std::max(d.deepest_gouge_mm, d.low.empty() ? 0.0 : d.worst_plane_mm), 2) +
                       " mm deep" + (d.gouged_mm3 > 0.0 ? " at " + at_words(d.gouge_at) : std::string()) +
                       (d.low.empty() ? std::string() : "; plane faces cut into: " + names(d.low)) +
                       "; leave out the feature that cuts there");
  }
  if (d.left_mm3 > 0.0 || !d.high.empty()) {
    findings.warn(36, "CHK-SHAPE-LEFT", whole,
                  "about " + trimmed(d.left_mm3, 2) + " mm3 of " + trimmed(d.asked_mm3, 1) +
                      " stay beside the part in " + of + ", up to " +
                      trimmed(std::max(d.deepest_left_mm, d.high.empty() ? 0.0 : d.worst_plane_mm), 2) +
                      " mm thick" + (d.left_mm3 > 0.0 ? ", at " + at_words(d.left_at) : std::string()) +
                      (d.high.empty() ? std::string() : "; plane faces not reached: " + names(d.high)));
  }
  return findings.take();
}

}  // namespace capstan::verify
