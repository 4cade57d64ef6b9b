#include "planner/pipeline/split.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace capstan::pipeline {
namespace {

/// Sections of nearly one area are cut at one feed: classes a factor of the square root of two apart.
constexpr double kClassesPerDoubling = 2.0;
/// No piece is shorter than this part of the diameter: more stops than gain. Default, unsourced.
constexpr double kLeastPiece = 0.2;

long class_of(double area_mm2) {
  if (!(area_mm2 > 1e-6)) return std::numeric_limits<long>::min();
  return std::lround(kClassesPerDoubling * std::log2(area_mm2));
}

/// Ends of the pieces of a move, mm from its start, the move's own end left out.
std::vector<double> ends_of_pieces(const model::SectionSeries& s, std::size_t first, std::size_t last,
                                   double length_mm, double least_mm) {
  std::vector<double> out;
  double from = 0.0;
  for (std::size_t i = first; i + 1 < last; ++i) {
    if (class_of(s.csa_mm2[i]) == class_of(s.csa_mm2[i + 1])) continue;
    const double at = s.at_mm[i];
    if (at - from < least_mm || length_mm - at < least_mm) continue;
    out.push_back(at);
    from = at;
  }
  return out;
}

template <class T>
void repeat(std::vector<T>& to, const std::vector<T>& from, std::size_t i, std::size_t times) {
  if (i < from.size()) to.insert(to.end(), times, from[i]);
}

}  // namespace

void split_uneven(double cutting_diameter_mm, model::CutterPath& path, model::SectionSeries& s,
                  optimise::FeedQuestion& q) {
  const double least = kLeastPiece * cutting_diameter_mm;
  model::CutterPath out;
  std::vector<double> feed, speed, dwell;
  std::size_t next = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    while (next < s.size() && s.move[next] < i) ++next;
    const std::size_t first = next;
    while (next < s.size() && s.move[next] == i) ++next;
    std::vector<double> ends;
    double length = 0.0;
    if (i > 0 && path.kind[i] == model::MoveKind::kLine) {
      length = std::hypot(path.x[i] - path.x[i - 1], path.y[i] - path.y[i - 1], path.z[i] - path.z[i - 1]);
      ends = ends_of_pieces(s, first, next, length, least);
    }
    std::size_t piece = 0;
    double from = 0.0;
    for (std::size_t k = first; k < next; ++k) {
      constexpr double kRounding = 1e-9;
      while (piece < ends.size() && s.at_mm[k] > ends[piece] + kRounding) from = ends[piece++];
      s.move[k] = static_cast<std::uint32_t>(out.size() + piece);
      s.at_mm[k] -= from;
    }
    for (const double at : ends) {
      const double t = at / length;
      out.x.push_back(path.x[i - 1] + t * (path.x[i] - path.x[i - 1]));
      out.y.push_back(path.y[i - 1] + t * (path.y[i] - path.y[i - 1]));
      out.z.push_back(path.z[i - 1] + t * (path.z[i] - path.z[i - 1]));
      out.cx.push_back(path.cx[i]);
      out.cy.push_back(path.cy[i]);
      out.kind.push_back(path.kind[i]);
      out.role.push_back(path.role[i]);
    }
    out.x.push_back(path.x[i]);
    out.y.push_back(path.y[i]);
    out.z.push_back(path.z[i]);
    out.cx.push_back(path.cx[i]);
    out.cy.push_back(path.cy[i]);
    out.kind.push_back(path.kind[i]);
    out.role.push_back(path.role[i]);
    repeat(feed, q.feed_factor, i, ends.size() + 1);
    repeat(speed, q.speed_factor, i, ends.size() + 1);
    if (i < q.dwell_s.size()) {
      dwell.insert(dwell.end(), ends.size(), 0.0);
      dwell.push_back(q.dwell_s[i]);
    }
  }
  path = std::move(out);
  q.feed_factor = std::move(feed);
  q.speed_factor = std::move(speed);
  q.dwell_s = std::move(dwell);
}

}  // namespace capstan::pipeline
