#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "planner/making/optimise/feeds/move_limits.h"

// Where moves are cut so that each piece may have its own feed.

namespace capstan::optimise {
namespace {

using namespace feed;
using model::CutterPath;
using model::MoveKind;

/// A cut has to save this much, s: it costs a block of program. Default, unsourced.
constexpr double kWorthS = 0.005;

/// By how much of its slope a piece may be steeper than its move, rounded to the program's digits: what the
/// check allows beyond a ramp's angle, rad.
constexpr double kSlopeToSpare = 1e-4;

/// A stretch of a move and its largest feed.
struct Piece {
  double end_mm = 0.0, length_mm = 0.0, feed = 0.0;
};

double lost_s(const Piece& a, const Piece& b) {
  const double low = std::min(a.feed, b.feed);
  return 60.0 * (a.length_mm * (1.0 / low - 1.0 / a.feed) + b.length_mm * (1.0 / low - 1.0 / b.feed));
}

void merge(std::vector<Piece>& p, std::size_t into) {
  p[into] = {p[into + 1].end_mm, p[into].length_mm + p[into + 1].length_mm,
             std::min(p[into].feed, p[into + 1].feed)};
  p.erase(p.begin() + static_cast<std::ptrdiff_t>(into) + 1);
}

/// Where a cut begins and ends is known to a length only: the slower of two neighbours may reach so far into
/// the faster one.
void give_way(std::vector<Piece>& p, double known_to_mm) {
  for (std::size_t i = 0; i + 1 < p.size(); ++i) {
    Piece& a = p[i];
    Piece& b = p[i + 1];
    const double shift =
        a.feed > b.feed ? -std::min(known_to_mm, a.length_mm) : std::min(known_to_mm, b.length_mm);
    a.length_mm += shift;
    a.end_mm += shift;
    b.length_mm -= shift;
  }
  constexpr double kNothingMm = 1e-9;
  const double end = p.empty() ? 0.0 : p.back().end_mm;
  std::erase_if(p, [](const Piece& x) { return x.length_mm <= kNothingMm; });
  if (!p.empty()) p.back().end_mm = end;
}

/// Takes from a faster neighbour what a piece lacks; the other way round it would be merged.
struct Growth {
  bool left = false, possible = false;
  double lacking_mm = 0.0, lost_s = 0.0;
};

Growth growth(const std::vector<Piece>& p, std::size_t i, bool left, double least_mm) {
  Growth out{.left = left};
  if (left ? i == 0 : i + 1 == p.size()) return out;
  const Piece& from = p[left ? i - 1 : i + 1];
  out.lacking_mm = least_mm - p[i].length_mm;
  out.possible = from.feed > p[i].feed && from.length_mm - out.lacking_mm >= least_mm;
  out.lost_s = 60.0 * out.lacking_mm * (1.0 / p[i].feed - 1.0 / from.feed);
  return out;
}

void grow(std::vector<Piece>& p, std::size_t i, const Growth& g, double least_mm) {
  p[i].length_mm = least_mm;
  if (g.left) {
    p[i - 1].length_mm -= g.lacking_mm;
    p[i - 1].end_mm -= g.lacking_mm;
  } else {
    p[i + 1].length_mm -= g.lacking_mm;
    p[i].end_mm += g.lacking_mm;
  }
}

/// Makes a piece long enough, as it costs least: a slow one reaches into a faster neighbour, or it is merged
/// with one, which then has the slower feed of both all along.
void lengthen(std::vector<Piece>& p, std::size_t i, double least_mm) {
  const bool left = i + 1 == p.size() || (i > 0 && lost_s(p[i - 1], p[i]) <= lost_s(p[i], p[i + 1]));
  const std::size_t into = left ? i - 1 : i;
  double cheapest_s = lost_s(p[into], p[into + 1]);
  Growth best;
  for (const bool side : {true, false}) {
    const Growth g = growth(p, i, side, least_mm);
    if (!g.possible || g.lost_s >= cheapest_s) continue;
    cheapest_s = g.lost_s;
    best = g;
  }
  if (best.possible) {
    grow(p, i, best, least_mm);
  } else {
    merge(p, into);
  }
}

/// Lengthens pieces that are too short, then merges those that would save too little time to need a block.
void join(std::vector<Piece>& p, double least_mm) {
  while (p.size() > 1) {
    std::size_t shortest = 0;
    for (std::size_t i = 1; i < p.size(); ++i) {
      if (p[i].length_mm < p[shortest].length_mm) shortest = i;
    }
    if (p[shortest].length_mm >= least_mm) break;
    lengthen(p, shortest, least_mm);
  }
  while (p.size() > 1) {
    std::size_t cheapest = 0;
    for (std::size_t i = 1; i + 1 < p.size(); ++i) {
      if (lost_s(p[i], p[i + 1]) < lost_s(p[cheapest], p[cheapest + 1])) cheapest = i;
    }
    if (lost_s(p[cheapest], p[cheapest + 1]) >= kWorthS) break;
    merge(p, cheapest);
  }
}

/// On a slope, each end between two pieces goes to a whole number of the program's digits from an end of the
/// move: rounded, a short piece would be steeper than its move, which may be as steep as the cutter bears.
/// What the move's own ends are rounded by stays in its longest piece. The slower of both pieces grows.
void end_on_digits(std::vector<Piece>& p, double drop_mm, double length_mm, double digit_mm) {
  if (drop_mm == 0.0 || p.size() < 2) return;
  const auto by_length = [](const Piece& a, const Piece& b) { return a.length_mm < b.length_mm; };
  const auto longest = static_cast<std::size_t>(std::max_element(p.begin(), p.end(), by_length) - p.begin());
  const double each =
      digit_mm * length_mm / std::abs(drop_mm);  // length of path in which the height changes by a digit
  for (std::size_t k = 0; k + 1 < p.size(); ++k) {
    const double shortest = std::min(p[k].length_mm, p[k + 1].length_mm);
    if (digit_mm <= kSlopeToSpare * shortest) continue;
    const double from = k < longest ? 0.0 : length_mm;
    const double digits = (p[k].end_mm - from) / each;
    const bool later = p[k].feed <= p[k + 1].feed;
    const double by = from + each * (later ? std::ceil(digits) : std::floor(digits)) - p[k].end_mm;
    if (!(std::abs(by) < 0.5 * shortest)) continue;  // all but level: a digit is far away
    p[k].end_mm += by;
    p[k].length_mm += by;
    p[k + 1].length_mm -= by;
  }
}

/// Stretches of one move, by the largest feeds of its samples; a stretch without a sample has the ceiling.
class Pieces {
 public:
  Pieces(const FeedQuestion& q, CutClasses& classes) : q_(q), classes_(classes) {}

  std::vector<Piece> of(std::size_t move, std::size_t first, std::size_t last, double length,
                        double least_mm) {
    const double n = rpm_on(q_, move);
    const double least = classes_.loads(n).floor_mm_min();
    const double top = classes_.loads(n).ceiling_mm_min();
    std::vector<Piece> out;
    double from = 0.0;
    for (std::size_t k = first; k < last; ++k) {
      const CutSample& s = q_.samples[k];
      const double end = std::min(s.at_mm, length);
      const double begin = std::max(from, std::min(end, s.at_mm - s.step_mm));
      const double feed = s.ap_mm > 0.0 && !s.plunge
                              ? std::clamp(sample_feed(classes_, s, q_.cut, n).feed_mm_min, least, top)
                              : top;
      if (begin > from + kRounding) add(out, begin, from, top);
      if (end > begin + kRounding) {
        add(out, end, std::max(begin, from), feed);
      } else if (!out.empty()) {
        out.back().feed = std::min(out.back().feed, feed);  // a second rectangle of the same step
      }
      from = std::max(from, end);
    }
    if (length > from + kRounding) add(out, length, from, top);
    if (!out.empty()) out.back().end_mm = length;
    if (q_.known_to_mm > 0.0) give_way(out, q_.known_to_mm);
    return binned(out, least_mm, length);
  }

 private:
  static constexpr double kRounding = 1e-8;  ///< of lengths, of a path in its own frame, too

  /// Merges from the left until no piece is much shorter than the minimum, to bound the remaining work.
  static std::vector<Piece> binned(const std::vector<Piece>& p, double least_mm, double length) {
    constexpr std::size_t kFew = 64;
    if (p.size() <= kFew) return p;
    const double bin = std::max(0.125 * least_mm, length / 2000.0);
    std::vector<Piece> out;
    for (const Piece& x : p) {
      if (!out.empty() && out.back().length_mm < bin) {
        out.back() = {x.end_mm, out.back().length_mm + x.length_mm, std::min(out.back().feed, x.feed)};
      } else {
        out.push_back(x);
      }
    }
    return out;
  }

  /// Merges neighbours with nearly the same allowed feed from the start.
  void add(std::vector<Piece>& out, double end, double begin, double feed) const {
    constexpr double kAlike = 1.02;
    if (!out.empty() && out.back().feed <= kAlike * feed && feed <= kAlike * out.back().feed) {
      out.back() = {end, out.back().length_mm + end - begin, std::min(out.back().feed, feed)};
      return;
    }
    out.push_back({end, end - begin, feed});
  }

  const FeedQuestion& q_;
  CutClasses& classes_;
};

void push(CutterPath& out, const CutterPath& path, std::size_t i, geometry::Vec3 p) {
  out.x.push_back(p.x);
  out.y.push_back(p.y);
  out.z.push_back(p.z);
  out.cx.push_back(path.cx[i]);
  out.cy.push_back(path.cy[i]);
  out.kind.push_back(path.kind[i]);
  out.role.push_back(path.role[i]);
}

template <class T>
void repeat(std::vector<T>& to, const std::vector<T>& from, std::size_t i, std::size_t times) {
  if (i < from.size()) to.insert(to.end(), times, from[i]);
}

/// Renumbers a move's part of a series of positions; `move` and `at` are its columns.
template <class Move, class At>
void renumber(std::size_t first, std::size_t last, const std::vector<Piece>& pieces, std::size_t base,
              Move move, At at) {
  constexpr double kRounding = 1e-8;
  std::size_t piece = 0;
  double from = 0.0;
  for (std::size_t k = first; k < last; ++k) {
    while (piece + 1 < pieces.size() && at(k) > pieces[piece].end_mm + kRounding)
      from = pieces[piece++].end_mm;
    move(k) = static_cast<std::uint32_t>(base + piece);
    at(k) -= from;
  }
}

bool may_be_cut(const FeedQuestion& q, const CutterPath& path, std::size_t i) {
  using model::MoveRole;
  return q.adapt && is_milling(q.cut.kind) && i > 0 && path.kind[i] != MoveKind::kRapid &&
         path.kind[i] != MoveKind::kDwell && path.role[i] != MoveRole::kPlunge;
}

}  // namespace

CutterPath in_pieces(const CutterPath& path, const std::vector<PieceEnd>& pieces) {
  CutterPath out;
  for (const PieceEnd& e : pieces)
    push(out, path, e.move, e.share < 1.0 ? model::point_on_move(path, e.move, e.share) : path.point(e.move));
  return out;
}

std::vector<PieceEnd> split_moves(FeedQuestion& q, CutterPath& path, model::SectionSeries* s,
                                  KnownFeeds* known) {
  const double least = kLeastPiece * q.cut.cutter.cutting_diameter_mm;
  CutClasses classes(q, known);
  Pieces pieces_of(q, classes);
  std::vector<PieceEnd> out;
  std::vector<double> feed;
  std::vector<double> speed;
  std::vector<double> dwell;
  std::vector<CutSample> samples = q.samples;  // the pieces are still asked of the old ones
  std::size_t next = 0;
  std::size_t next_section = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    while (next < samples.size() && q.samples[next].move < i) ++next;
    const std::size_t first = next;
    while (next < samples.size() && q.samples[next].move == i) ++next;
    const double length = i > 0 ? model::move_length(path, i) : 0.0;
    std::vector<Piece> pieces;
    if (may_be_cut(q, path, i) && first < next && length > least) {
      pieces = pieces_of.of(i, first, next, length, least);
      join(pieces, least);
      end_on_digits(pieces, path.z[i] - path.z[i - 1], length,
                    std::pow(10.0, -q.cut.machine.control.decimals));
    }
    if (pieces.empty()) pieces.push_back({length, length, 0.0});
    renumber(
        first, next, pieces, out.size(), [&](std::size_t k) -> std::uint32_t& { return samples[k].move; },
        [&](std::size_t k) -> double& { return samples[k].at_mm; });
    if (s != nullptr) {
      while (next_section < s->size() && s->move[next_section] < i) ++next_section;
      const std::size_t from = next_section;
      while (next_section < s->size() && s->move[next_section] == i) ++next_section;
      renumber(
          from, next_section, pieces, out.size(), [&](std::size_t k) -> std::uint32_t& { return s->move[k]; },
          [&](std::size_t k) -> double& { return s->at_mm[k]; });
    }
    for (std::size_t k = 0; k + 1 < pieces.size(); ++k)
      out.push_back({static_cast<std::uint32_t>(i), pieces[k].end_mm / length});
    out.push_back({static_cast<std::uint32_t>(i), 1.0});
    repeat(feed, q.feed_factor, i, pieces.size());
    repeat(speed, q.speed_factor, i, pieces.size());
    if (i < q.dwell_s.size()) {
      dwell.insert(dwell.end(), pieces.size() - 1, 0.0);
      dwell.push_back(q.dwell_s[i]);
    }
  }
  path = in_pieces(path, out);
  q.samples = std::move(samples);
  q.feed_factor = std::move(feed);
  q.speed_factor = std::move(speed);
  q.dwell_s = std::move(dwell);
  return out;
}

}  // namespace capstan::optimise
