#include "planner/making/toolpath/freeform/finish/pass_writer.h"

#include <algorithm>
#include <cmath>

namespace capstan::toolpath::freeform {
namespace {

using geometry::Vec2;
using geometry::Vec3;
using model::MoveRole;

constexpr double kNeighbour = 1.5;  ///< of the spacing, to a neighbouring pass
constexpr double kDetour = 3.0;     ///< of the straight way, that a link may climb; default, unsourced
constexpr double kEntryMm = 20.0;   ///< what lifting and coming down count; default, unsourced

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

}  // namespace

PassWriter::PassWriter(const FreeformJob& task, const DropCutter& drop, const MillEnd& cutter,
                       double spacing_mm)
    : task_(task), spacing_mm_(spacing_mm), reach_mm_(kNeighbour * spacing_mm) {
  follow_ = {.drop = &drop,
             .cutter = cutter,
             .allowance_mm = task.allowance_mm,
             .tolerance_mm = task.tolerance_mm,
             .bottom_z_mm = task.bottom_z_mm,
             .beside_is_free = task.beside_is_free};
}

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
  for (std::size_t i = 1; i < run.size(); ++i) path_.line(run[i], MoveRole::kCut);
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
  const auto pieces = follow_.over(xy(from), xy(to));
  if (pieces.size() != 1) return false;
  const Run& piece = pieces.front();
  if (xy(piece.front()) != xy(from) || norm(xy(piece.back()) - xy(to)) > 1e-9) return false;
  if (way(piece) > kDetour * (near_ ? std::max(reach, spacing_mm_) : reach)) return false;
  for (std::size_t i = 1; i < piece.size(); ++i) path_.line(piece[i], MoveRole::kCut);
  path_.line(to, MoveRole::kCut);
  return true;
}

void PassWriter::add_nearest_first(const std::vector<Piece>& pieces, Vec2 v_axis) {
  std::vector<bool> done(pieces.size());
  std::size_t first = 0;
  while (first < pieces.size()) {
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
  std::size_t level = 0;  // none above it has a way left
  while (true) {
    while (level < levels.size() && levels[level].runs.empty()) ++level;
    if (level == levels.size()) return;
    // Down from the highest that is left, as far as ways follow each other.
    Vec2 at = path_.size() > 0 ? xy(here()) : xy(levels[level].runs.front().front());
    for (std::size_t k = level; k < levels.size(); ++k) {
      auto& runs = levels[k].runs;
      std::size_t best = runs.size(), point = 0;
      bool back = false;
      double least = k == level ? 1e300 : reach_mm_;
      for (std::size_t i = 0; i < runs.size(); ++i) {
        const bool closed = is_closed(runs[i]);
        for (std::size_t j = 0; j < runs[i].size(); ++j) {
          const bool end = j + 1 == runs[i].size();
          if (!closed && j > 0 && !(end && task_.to_and_fro)) continue;
          const double d = norm(xy(runs[i][j]) - at);
          if (d >= least) continue;
          least = d;
          best = i;
          point = closed ? j : 0;
          back = !closed && j > 0;
        }
      }
      if (best == runs.size()) {
        if (runs.empty()) continue;
        break;
      }
      Run run = std::move(runs[best]);
      runs.erase(runs.begin() + static_cast<std::ptrdiff_t>(best));
      if (back) std::reverse(run.begin(), run.end());
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
