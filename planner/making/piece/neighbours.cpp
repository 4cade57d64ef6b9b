#include "planner/making/piece/neighbours.h"

#include <algorithm>
#include <cmath>
#include <tuple>

// A uniform grid for each direction of axes (Bentley and Friedman, "Data structures for range searching",
// 1979, "cells"). A shape stands in the cell of the middle of its ball, seen along the axis; a question looks
// at the cells that its reach and the largest ball together touch. Shapes much larger than a cell stand aside
// and are looked at in each question, so that one plate-wide face does not make every question reach over the
// whole plate.

namespace capstan::piece {
namespace {

using geometry::Vec3;
using model::FeatureShape;

constexpr double kOneDirection = 1.0 - 1e-12;  // cosine: shapes of one grid
constexpr double kParallel = 1.0 - 2e-6;       // cosine: grids that a question looks at
constexpr double kSame = 1e-6;                 // mm
constexpr double kLargeCells = 4.0;            // radius of a large shape, in cells; default, unsourced
constexpr double kMostCells = 1e9;             // in one direction: far within a long

/// Directions differ by no more than this, rad, where the cosine is at least `cosine`.
double tilt(double cosine) { return std::sqrt(2.0 * std::max(0.0, 1.0 - cosine)) + 3e-6; }

}  // namespace

Around around(const FeatureShape& s) {
  if (s.area.empty()) return {s.frame.origin, 0.0};
  const geometry::Box2 box = geometry::bounds(s.area);
  const geometry::Vec2 middle = 0.5 * (box.lo + box.hi);
  return {s.frame.to_parent({middle.x, middle.y, 0.0}), norm(box.hi - middle)};
}

long Neighbours::cell(double v) const {
  return static_cast<long>(std::clamp(std::floor(v / cell_mm_), -kMostCells, kMostCells));
}

Neighbours::Neighbours(const std::vector<FeatureShape>& shapes) {
  geometry::Box3 box;
  double widest = 0.0;
  for (const FeatureShape& s : shapes) {
    balls_.push_back(around(s));
    box.add(balls_.back().centre);
    widest = std::max(widest, balls_.back().radius_mm);
  }
  if (shapes.empty()) return;
  const double across = norm(box.hi - box.lo);
  span_mm_ = across + 2.0 * widest + kSame;
  cell_mm_ = std::max(across / std::sqrt(static_cast<double>(shapes.size())), 1e-3);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const geometry::Placement& f = shapes[i].frame;
    auto d = std::find_if(directions_.begin(), directions_.end(),
                          [&](const Direction& k) { return std::abs(dot(k.z, f.z)) >= kOneDirection; });
    if (d == directions_.end()) d = directions_.insert(d, {f.x, f.y, f.z});
    const Around& ball = balls_[i];
    const bool placed = std::isfinite(norm(ball.centre)) && std::isfinite(ball.radius_mm);
    if (!placed || ball.radius_mm > kLargeCells * cell_mm_) {
      d->large.push_back(i);
      continue;
    }
    d->radius_mm = std::max(d->radius_mm, ball.radius_mm);
    d->cells.push_back({cell(dot(ball.centre, d->y)), cell(dot(ball.centre, d->x)), i});
  }
  for (Direction& d : directions_)
    std::sort(d.cells.begin(), d.cells.end(), [](const Entry& a, const Entry& b) {
      return std::tie(a.row, a.column, a.shape) < std::tie(b.row, b.column, b.shape);
    });
}

std::vector<std::size_t> Neighbours::near(const Around& here, Vec3 axis, double reach_mm) const {
  std::vector<std::size_t> out;
  for (const Direction& d : directions_) {
    const double cosine = std::abs(dot(d.z, axis));
    if (cosine < kParallel) continue;
    // Seen along an axis that leans by so much, places move against each other by as much of their distance.
    const double lean = tilt(cosine);
    const auto take = [&](std::size_t i) {
      const Vec3 way = balls_[i].centre - here.centre;
      const double along = dot(way, axis);
      const double apart = std::sqrt(std::max(0.0, dot(way, way) - along * along));
      const double slack = lean * (norm(way) + balls_[i].radius_mm) + kSame;
      if (apart - balls_[i].radius_mm - here.radius_mm - slack <= reach_mm) out.push_back(i);
    };
    for (const std::size_t i : d.large) take(i);
    if (d.cells.empty()) continue;
    const double x = dot(here.centre, d.x), y = dot(here.centre, d.y);
    const double farthest = norm(here.centre - balls_.front().centre) + span_mm_;
    const double r = reach_mm + here.radius_mm + d.radius_mm + lean * (farthest + d.radius_mm) + kSame;
    const long last = std::min(cell(y + r), d.cells.back().row);
    const long left = cell(x - r), right = cell(x + r);
    for (long row = std::max(cell(y - r), d.cells.front().row); row <= last; ++row) {
      auto it =
          std::lower_bound(d.cells.begin(), d.cells.end(), std::tie(row, left),
                           [](const Entry& e, const auto& at) { return std::tie(e.row, e.column) < at; });
      if (it == d.cells.end()) break;
      row = it->row;  // rows without a shape are passed over
      if (row > last) break;
      for (; it != d.cells.end() && it->row == row && it->column <= right; ++it) take(it->shape);
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace capstan::piece
