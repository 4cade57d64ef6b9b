#include "planner/making/toolpath/freeform/finish/pass_writer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include "planner/making/toolpath/freeform/task.h"

namespace capstan::toolpath::freeform {
namespace {

using geometry::Vec2;
using geometry::Vec3;
using model::MoveRole;

constexpr double kNeighbour = 1.5;  ///< of the spacing, to a neighbouring pass
constexpr double kDetour = 3.0;     ///< of the straight way, that a link may climb; default, unsourced
constexpr double kEntryMm = 20.0;   ///< what lifting and coming down count; default, unsourced

constexpr double kSameMm = 1e-6;  ///< places no farther apart are one: the rounding of sums

double way(const Run& run) {
  double sum = 0.0;
  for (std::size_t i = 1; i < run.size(); ++i) sum += norm(run[i] - run[i - 1]);
  return sum;
}

bool is_closed(const Run& run) { return run.size() > 2 && run.front() == run.back(); }

/// The lowest height of the tip at which a cutter, grown all round by the clearance, is clear of the stock.
double clear_of(const stock::HeightMap& map, Vec2 p, double radius_mm, double clearance_mm) {
  const double reach = radius_mm + clearance_mm, slack = 0.71 * map.cell_mm;
  const auto first = [&](double at, double origin) {
    return std::max(0, static_cast<int>(std::floor((at - reach - origin) / map.cell_mm)));
  };
  const auto last = [&](double at, double origin, int n) {
    return std::min(n - 1, static_cast<int>(std::ceil((at + reach - origin) / map.cell_mm)));
  };
  double out = map.origin.z;
  for (int iy = first(p.y, map.origin.y); iy <= last(p.y, map.origin.y, map.ny); ++iy) {
    for (int ix = first(p.x, map.origin.x); ix <= last(p.x, map.origin.x, map.nx); ++ix) {
      const double d = std::max(0.0, norm(Vec2{map.x_of(ix), map.y_of(iy)} - p) - slack);
      if (d > reach) continue;
      out = std::max(out, map.origin.z + static_cast<double>(map.at(ix, iy).top_mm) - radius_mm +
                              std::sqrt(reach * reach - d * d));
    }
  }
  return out;
}

/// Which ways wait for which, numbered from level to level.
struct Order {
  std::vector<std::size_t> first;               ///< by level: number of its first way
  std::vector<std::vector<std::size_t>> left;   ///< by level: ways that are not cut
  std::vector<std::vector<std::size_t>> below;  ///< by way: those that wait for it
  std::vector<std::size_t> above;               ///< by way: how many it waits for
};

/// A way waits for those above it within `reach_mm`, looked for in cells of that size: of each cell and its
/// neighbours the lowest above it, which wait for those above them in turn.
Order order_of(const std::vector<Level>& levels, double reach_mm) {
  using Cell = std::pair<std::int64_t, std::int64_t>;
  struct Lowest {
    std::size_t level = 0;
    std::vector<std::size_t> ways;
  };
  std::map<Cell, Lowest> lowest;
  Order out;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    out.first.push_back(out.above.size());
    out.left.emplace_back();
    std::vector<std::pair<Cell, std::size_t>> taken;
    for (const Run& run : levels[k].runs) {
      const std::size_t id = out.above.size();
      std::set<Cell> cells;
      for (std::size_t i = 0; i < run.size(); ++i) {
        const Vec2 a = xy(run[i == 0 ? 0 : i - 1]), b = xy(run[i]);
        const int n = std::max(1, static_cast<int>(std::ceil(2.0 * norm(b - a) / reach_mm)));
        for (int m = 1; m <= n; ++m) {
          const Vec2 p = a + (static_cast<double>(m) / n) * (b - a);
          cells.emplace(static_cast<std::int64_t>(std::floor(p.x / reach_mm)),
                        static_cast<std::int64_t>(std::floor(p.y / reach_mm)));
        }
      }
      std::set<std::size_t> upper;
      for (const Cell& c : cells) {
        taken.emplace_back(c, id);
        for (int dx = -1; dx <= 1; ++dx) {
          for (int dy = -1; dy <= 1; ++dy) {
            const auto found = lowest.find({c.first + dx, c.second + dy});
            if (found != lowest.end()) upper.insert(found->second.ways.begin(), found->second.ways.end());
          }
        }
      }
      out.left.back().push_back(id);
      out.above.push_back(upper.size());
      out.below.emplace_back();
      for (const std::size_t u : upper) out.below[u].push_back(id);
    }
    for (const auto& [cell, id] : taken) {
      Lowest& here = lowest[cell];
      if (here.level != k) here = {k, {}};
      here.ways.push_back(id);
    }
  }
  return out;
}

/// Whether two straight pieces meet.
bool cross_each_other(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const auto side = [](Vec2 from, Vec2 to, Vec2 p) {
    return (to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x);
  };
  return side(a, b, c) * side(a, b, d) <= 0.0 && side(c, d, a) * side(c, d, b) <= 0.0 &&
         std::max(a.x, b.x) >= std::min(c.x, d.x) && std::max(c.x, d.x) >= std::min(a.x, b.x) &&
         std::max(a.y, b.y) >= std::min(c.y, d.y) && std::max(c.y, d.y) >= std::min(a.y, b.y);
}

/// What is to be avoided, grown by the radius: passes keep out of a little more (kept_out), and links between
/// their ends may pass its corners.
geometry::Region avoided(const FreeformJob& task, double radius_mm) {
  if (task.avoid.empty()) return {};
  constexpr double kArcMm = 0.001;
  return geometry::offset(task.avoid, radius_mm,
                          std::min(kArcMm, kProbedShare * kProbedShare / 16.0 * radius_mm));
}

}  // namespace

PassWriter::PassWriter(const FreeformJob& task, const DropCutter& drop, const MillEnd& cutter,
                       double spacing_mm, const Job& job)
    : task_(task),
      job_(job),
      avoid_(avoided(task, cutter.radius())),
      follow_(follower_of(task, drop, cutter)),
      spacing_mm_(spacing_mm),
      reach_mm_(kNeighbour * spacing_mm) {}

void PassWriter::keep(const FreeformJob& task) { follow_.allowance_mm = task.allowance_mm; }

void PassWriter::link_within(double reach_mm) {
  reach_mm_ = std::max(reach_mm_, reach_mm);
  near_ = true;
}

void PassWriter::add(const Run& run) {
  if (path_.size() == 0) {
    path_.start(up(run.front()));
    enter(run.front());
  } else if (!slide_to(run.front())) {
    path_.line(up(here()), MoveRole::kRetract);
    path_.rapid(up(run.front()));
    enter(run.front());
  }
  for (std::size_t i = 1; i < run.size(); ++i) cut_to(run[i]);
}

void PassWriter::cut_to(Vec3 p) {
  if (norm(p - here()) > kSameMm) path_.line(p, MoveRole::kCut);
}

void PassWriter::enter(Vec3 p) {
  const double radius = follow_.cutter.radius();
  const bool ball = near_ && task_.stock != nullptr && follow_.cutter.ball_mm() == radius;
  const double top = task_.stock ? stock::max_height(*task_.stock, xy(p), radius) : task_.top_z_mm;
  double z = std::max(p.z, top) + task_.clearance_mm;
  if (ball)
    z = std::min(
        z, std::max(p.z + task_.clearance_mm, clear_of(*task_.stock, xy(p), radius, task_.clearance_mm)));
  z = std::min(task_.security_z_mm, z);
  if (z < task_.security_z_mm) path_.rapid({p.x, p.y, z}, MoveRole::kApproach);
  path_.line(p, MoveRole::kPlunge);
}

/// Along the surface to a neighbouring pass; false where that is no short way.
bool PassWriter::slide_to(Vec3 to) {
  const Vec3 from = here();
  const double reach = norm(xy(to) - xy(from));
  if (!task_.to_and_fro || reach > reach_mm_) return false;
  if (meets_what_is_avoided(xy(from), xy(to))) return false;
  const auto pieces = follow_.over(xy(from), xy(to));
  if (pieces.size() != 1) return false;
  const Run& piece = pieces.front();
  if (xy(piece.front()) != xy(from) || norm(xy(piece.back()) - xy(to)) > 1e-9) return false;
  if (way(piece) > kDetour * (near_ ? std::max(reach, spacing_mm_) : reach)) return false;
  for (std::size_t i = 1; i < piece.size(); ++i) {
    if (norm(piece[i] - to) > kSameMm) cut_to(piece[i]);
  }
  cut_to(to);
  return true;
}

bool PassWriter::meets_what_is_avoided(Vec2 a, Vec2 b) const {
  if (avoid_.empty()) return false;
  if (geometry::contains(avoid_, a) || geometry::contains(avoid_, b)) return true;
  for (const geometry::Loop& loop : avoid_.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      if (cross_each_other(a, b, loop[i], loop[(i + 1) % loop.size()])) return true;
    }
  }
  return false;
}

void PassWriter::add_nearest_first(const std::vector<Piece>& pieces, Vec2 v_axis) {
  std::vector<bool> done(pieces.size());
  std::size_t first = 0;
  while (first < pieces.size() && !job_.stop_requested()) {
    if (done[first]) {
      ++first;
      continue;
    }
    std::size_t next = first;
    bool back = false;
    double least = reach_mm_;
    const Vec2 at = path_.size() > 0 ? xy(here()) : Vec2{1e300, 1e300};
    for (std::size_t i = first; i < pieces.size(); ++i) {
      // In order of v: farther on none is nearer.
      if (pieces[i].v > dot(at, v_axis) + least && i > first) break;
      if (done[i]) continue;
      for (const bool end : {false, true}) {
        if (end && !task_.to_and_fro) continue;
        const double d = norm(xy(end ? pieces[i].run.back() : pieces[i].run.front()) - at);
        if (d >= least) continue;
        least = d;
        next = i;
        back = end;
      }
    }
    done[next] = true;
    Run run = pieces[next].run;
    if (back) std::reverse(run.begin(), run.end());
    add(run);
  }
}

void PassWriter::add_levels(std::vector<Level> levels) {
  Order order = order_of(levels, reach_mm_);
  std::size_t level = 0;  // none above it has a way left
  while (!job_.stop_requested()) {
    while (level < levels.size() && order.left[level].empty()) ++level;
    if (level == levels.size()) return;
    // Down from the highest that is left, as far as ways follow each other.
    Vec2 at = path_.size() > 0 ? xy(here()) : xy(levels[level].runs.front().front());
    for (std::size_t k = level; k < levels.size() && !job_.stop_requested(); ++k) {
      std::vector<std::size_t>& left = order.left[k];
      if (left.empty()) continue;
      std::size_t best = left.size(), point = 0;
      double least = k == level ? 1e300 : reach_mm_;
      for (std::size_t i = 0; i < left.size(); ++i) {
        if (order.above[left[i]] > 0) continue;
        const Run& run = levels[k].runs[left[i] - order.first[k]];
        // A closed one begins anywhere, an open one where it begins: the other way it would not climb.
        const std::size_t ends = is_closed(run) ? run.size() : 1;
        for (std::size_t j = 0; j < ends; ++j) {
          const double d = norm(xy(run[j]) - at);
          if (d >= least) continue;
          least = d;
          best = i;
          point = j;
        }
      }
      if (best == left.size()) break;
      const std::size_t id = left[best];
      Run run = std::move(levels[k].runs[id - order.first[k]]);
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
      for (const std::size_t lower : order.below[id]) --order.above[lower];
      if (point > 0) {
        run.pop_back();
        std::rotate(run.begin(), run.begin() + static_cast<std::ptrdiff_t>(point % run.size()), run.end());
        run.push_back(run.front());
      }
      add(run);
      at = xy(run.back());
    }
  }
}

model::CutterPath PassWriter::finished() {
  path_.line(up(here()), MoveRole::kRetract);
  return std::move(path_);
}

double PassWriter::way_mm() const {
  double sum = 0.0;
  for (std::size_t i = 1; i < path_.size(); ++i) {
    if (path_.kind[i] != model::MoveKind::kRapid) sum += model::move_length(path_, i);
    if (path_.role[i] == MoveRole::kPlunge) sum += kEntryMm;
  }
  return sum;
}

}  // namespace capstan::toolpath::freeform
