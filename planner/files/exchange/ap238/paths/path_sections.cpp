#include "planner/files/exchange/ap238/paths/path_sections.h"

#include <algorithm>
#include <cmath>

namespace capstan::exchange::ap238 {
namespace {

constexpr double kSamePlace = 2e-6;  // mm; a plan keeps places to 1e-6 (engagement/kept_digits.h)
constexpr double kSameStep = 2e-4;   // of a step: a plan keeps five digits of volume and area
constexpr double kNear = 0.02, kOffsetNear = 0.05;

struct Knot {
  double at_mm = 0.0;
  SectionNumbers v{};
};

/// How far a knot is from the line between two others, in tolerances.
double off(const Knot& a, const Knot& k, const Knot& b, const SectionNumbers& tolerance) {
  const double t = b.at_mm > a.at_mm ? (k.at_mm - a.at_mm) / (b.at_mm - a.at_mm) : 0.0;
  double out = 0.0;
  for (std::size_t d = 0; d < k.v.size(); ++d) {
    const double line = a.v[d] + t * (b.v[d] - a.v[d]);
    if (tolerance[d] > 0.0) out = std::max(out, std::abs(k.v[d] - line) / tolerance[d]);
  }
  return out;
}

/// Which knots have to stay so that lines between them keep to the tolerance (Ramer 1972, Douglas & Peucker
/// 1973).
std::vector<bool> kept(const std::vector<Knot>& k, const SectionNumbers& tolerance) {
  std::vector<bool> out(k.size(), false);
  out.front() = out.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open = {{0, k.size() - 1}};
  while (!open.empty()) {
    const auto [a, b] = open.back();
    open.pop_back();
    double worst = 1.0;
    std::size_t at = a;
    for (std::size_t i = a + 1; i < b; ++i) {
      const double d = off(k[a], k[i], k[b], tolerance);
      if (d > worst) {
        worst = d;
        at = i;
      }
    }
    if (at == a) continue;
    out[at] = true;
    open.emplace_back(a, at);
    open.emplace_back(at, b);
  }
  return out;
}

}  // namespace

PathSections::PathSections(const model::SectionSeries* s, std::size_t moves) : s_(s) {
  for (std::size_t i = 0; s_ != nullptr && i < s_->size(); ++i) {
    order_.push_back(i);
    const SectionNumbers v = numbers(i);
    const double deep = v[0], wide = v[1], area = v[4];
    const SectionNumbers near = {kNear * deep, kNear * wide,       kOffsetNear * wide, kOffsetNear * deep,
                                 kNear * area, kOffsetNear * wide, kOffsetNear * deep};
    for (std::size_t d = 0; d < near.size(); ++d) tolerance_[d] = std::max(tolerance_[d], near[d]);
  }
  std::stable_sort(order_.begin(), order_.end(), [this](std::size_t a, std::size_t b) {
    return std::pair(s_->move[a], s_->at_mm[a]) < std::pair(s_->move[b], s_->at_mm[b]);
  });
  // A wrong file may name moves that the path does not have.
  for (std::size_t k = 0; k < order_.size(); ++k)
    begins_.resize(std::min<std::size_t>(s_->move[order_[k]], moves) + 1, k);
}

SectionNumbers PathSections::numbers(std::size_t i) const {
  return {s_->ad_max_mm[i], s_->rd_max_mm[i],   s_->x_max_ofs_mm[i], s_->y_max_ofs_mm[i],
          s_->csa_mm2[i],   s_->x_cg_ofs_mm[i], s_->y_cg_ofs_mm[i]};
}

// A sample is at the end of its step, whose length is its volume over its area.
double PathSections::step_mm(std::size_t i) const {
  return s_->csa_mm2[i] > 0.0 ? s_->removed_mm3[i] / s_->csa_mm2[i] : 0.0;
}

SectionNumbers PathSections::at(std::size_t move, double at_mm) const {
  const auto place = [this](std::size_t k) { return order_.begin() + static_cast<std::ptrdiff_t>(k); };
  const auto end = place(begin_of(move + 1));
  const auto it = std::lower_bound(place(begin_of(move)), end, at_mm - kSamePlace,
                                   [this](std::size_t i, double v) { return s_->at_mm[i] < v; });
  if (it == end) return {};
  const bool here = at_mm >= s_->at_mm[*it] - step_mm(*it) * (1.0 + kSameStep) - kSamePlace;
  return here ? numbers(*it) : SectionNumbers{};
}

std::vector<std::pair<double, SectionNumbers>> PathSections::inside(std::size_t move,
                                                                    double length_mm) const {
  std::vector<std::pair<double, SectionNumbers>> out;
  auto it = order_.begin() + static_cast<std::ptrdiff_t>(begin_of(move));
  const auto is_of = [&](auto k) { return k != order_.end() && s_->move[*k] == move; };
  // Air before a cut is known up to where the cut begins.
  const auto begins_after = [&](std::size_t i, double at_mm) {
    const double end = s_->at_mm[i], begin = end - step_mm(i);
    return begin > at_mm + (1e-6 * length_mm + kSameStep * (end - begin) + kSamePlace);
  };
  const auto ends_between = [&](std::size_t i, double at_mm) {
    return s_->at_mm[i] > at_mm + kSamePlace && s_->at_mm[i] < length_mm - kSamePlace;
  };
  // Most moves have no section, or one from their start to their end.
  if (!is_of(it)) return out;
  if (!is_of(it + 1) && !begins_after(*it, 0.0) && !ends_between(*it, 0.0)) return out;
  std::vector<Knot> knots = {{0.0, at(move, 0.0)}};
  for (; is_of(it); ++it) {
    if (begins_after(*it, knots.back().at_mm)) knots.push_back({s_->at_mm[*it] - step_mm(*it), {}});
    if (ends_between(*it, knots.back().at_mm)) knots.push_back({s_->at_mm[*it], numbers(*it)});
  }
  knots.push_back({length_mm, at(move, length_mm)});
  if (knots.size() < 3) return out;
  const auto stay = kept(knots, tolerance_);
  for (std::size_t i = 1; i + 1 < knots.size(); ++i) {
    if (stay[i]) out.emplace_back(knots[i].at_mm, knots[i].v);
  }
  return out;
}

double PathSections::volume(std::size_t first, std::size_t last) const {
  double out = 0.0;
  for (auto it = order_.begin() + static_cast<std::ptrdiff_t>(begin_of(first));
       it != order_.end() && s_->move[*it] <= last; ++it)
    out += s_->removed_mm3[*it];
  return out;
}

}  // namespace capstan::exchange::ap238
