#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/model/nouns/all.h"
#include "planner/proof/verify/volumes/reading.h"

// Round holes, and what is on other features: threads, chamfers and edge rounds.
//
// From the text of ISO 14649-10: the diameter is that at the placement, a taper says the diameter at the
// depth or the angle between wall and axis; a blind bottom lies at the depth. Left open are: below which
// depth a ball lies, which of the two sides a chamfer's offset is measured on, and where a cone's tip_angle
// is no point of a drill, its tip.

namespace capstan::verify::volumes {

using model::AnyRef;
using model::Model;

namespace {

constexpr double kPi = std::numbers::pi;

/// The angle of a drill's point that a tip_angle means: the full angle, half of it, or that of the flank
/// against the bottom plane; 0: none of them is a point of a drill.
double point_of_drill(double tip_rad) {
  constexpr double kSlack = 1e-6;
  const double least = 90.0 * kPi / 180.0 - kSlack,
               most = 150.0 * kPi / 180.0 + kSlack;  // ISO 235 and makers
  for (const double point : {tip_rad, 2.0 * tip_rad, kPi - 2.0 * tip_rad}) {
    if (point >= least && point <= most) return point;
  }
  return 0.0;
}

/// Only the first of several elements, in each of its copies.
void keep_first(Reading& r) {
  if (r.solids.empty()) return;
  const AnyRef first = r.solids.front().noun;
  std::erase_if(r.solids, [&](const Solid& s) { return s.noun != first; });
}

/// number_of_threads counts them per length, in mm or inches as its unit says; 0: it is not stated.
double pitch_of(const Model& m, const model::Thread& t) {
  constexpr double kInchMm = 25.4;
  const auto* n = m.get<model::NumericParameter>(t.number_of_threads);
  const double count = n == nullptr ? 0.0 : n->its_parameter_value.value_or(0.0);
  if (!(count > 0.0)) return 0.0;
  const std::string unit = n->its_parameter_unit.value_or("");
  return (unit.find("in") != std::string::npos || unit.find("IN") != std::string::npos ? kInchMm : 1.0) /
         count;
}

bool turns_left(const Model& m, const model::Thread& t) {
  const auto* hand = m.get<model::DescriptiveParameter>(t.thread_hand);
  const std::string text = hand == nullptr ? "" : hand->descriptive_string.value_or("");
  return text.find("left") != std::string::npos || text.find("LEFT") != std::string::npos;
}

Reading thread(const Model& m, AnyRef self, const model::Thread& t, Reading others) {
  for (Solid& s : others.solids) {
    auto* bore = std::get_if<Bore>(&s.form);
    if (bore == nullptr) return unread("it is a thread on what is no hole");
    bore->thread_major_mm = t.major_diameter.value_or(0.0);
    const auto* part = m.get<model::PartialAreaDefinition>(t.partial_profile);
    bore->thread_depth_mm = part != nullptr ? part->effective_length.value_or(s.depth_mm) : s.depth_mm;
    bore->thread_pitch_mm = pitch_of(m, t);
    bore->left_hand = turns_left(m, t);
    s.noun = self;
  }
  return others;
}

/// The outline of an edge that a simple feature opens with at its top.
bool edge_of(const Solid& s, Bevel& into) {
  if (const auto* b = std::get_if<Bore>(&s.form)) {
    into.outline.add(round({0.0, 0.0}, b->top_radius_mm, 0.0, 2.0 * kPi));
    return true;
  }
  const auto* a = std::get_if<Area>(&s.form);
  if (a == nullptr || a->overhead || a->leaning_mm > 0.0) return false;
  for (const Edge& e : a->outline.edges) {
    if (e.open) return false;
    into.outline.add(e);
  }
  into.within = a->around;
  return true;
}

Reading bore_of(const Source& source, AnyRef self, Solid solid) {
  const Model& m = source.m;
  const auto* h = m.get<model::RoundHole>(self);
  const auto d = h == nullptr ? std::nullopt : size_of(m, h->diameter);
  if (!d || !(*d > 0.0)) return unread("it has no diameter");
  Bore b;
  b.top_radius_mm = b.bottom_radius_mm = 0.5 * *d;
  if (const auto* t = m.get<model::DiameterTaper>(h->change_in_diameter)) {
    const auto end = size_of(m, t->final_diameter);
    if (!end) return unread("its taper has no final_diameter");
    b.bottom_radius_mm = 0.5 * *end;
  } else if (const auto* a = m.get<model::AngleTaper>(h->change_in_diameter)) {
    b.bottom_radius_mm -= solid.depth_mm * std::tan(a->angle.value_or(0.0));
  } else if (h->change_in_diameter.set()) {
    return unread("its taper is of a kind that this reading does not know");
  }
  if (b.bottom_radius_mm < -1e-6) return unread("its taper closes it above its depth");
  b.bottom_radius_mm = std::max(b.bottom_radius_mm, 0.0);
  const AnyRef bottom = h->bottom_condition;
  const auto radius = [&](AnyRef r) { return size_of(m, r).value_or(-1.0); };
  if (m.holds<model::ThroughBottomCondition>(bottom)) {
    b.bottom = Bore::Bottom::kThrough;
    solid.through = true;
  } else if (m.holds<model::FlatHoleBottom>(bottom)) {
    b.bottom = Bore::Bottom::kFlat;
  } else if (const auto* c = m.get<model::ConicalHoleBottom>(bottom)) {
    b.bottom = Bore::Bottom::kCone;
    const double point = point_of_drill(c->tip_angle.value_or(0.0));
    if (point > 0.0) b.tip_mm = b.bottom_radius_mm / std::tan(0.5 * point);
    if (c->tip_radius.set()) b.blunt_mm = std::max(0.0, radius(c->tip_radius));
  } else if (const auto* s = m.get<model::SphericalHoleBottom>(bottom)) {
    b.bottom = Bore::Bottom::kBall;
    b.radius_mm = radius(s->radius);
    if (b.radius_mm < b.bottom_radius_mm - 1e-6) return unread("the ball of its bottom is narrower than it");
  } else if (const auto* w = m.get<model::FlatWithRadiusHoleBottom>(bottom)) {
    b.bottom = Bore::Bottom::kRounded;
    b.radius_mm = radius(w->corner_radius);
    if (b.radius_mm < 0.0 || b.radius_mm > b.bottom_radius_mm + 1e-6)
      return unread("the corner of its bottom does not fit into it");
  } else {
    return unread("it has no bottom_condition");
  }
  solid.form = b;
  Reading out;
  out.solids.push_back(std::move(solid));
  return out;
}

}  // namespace

std::vector<ReadingRow> bores_readings() {
  return {
      {model::TypeId::kRoundHole, model::ShapeKind::kHole, bore_of},
  };
}

Reading on_others(const Source& source, AnyRef self, Reading others) {
  const Model& m = source.m;
  if (!others.unread.empty()) return others;
  keep_first(others);
  if (others.solids.empty()) return unread("what it is on has no volume");
  if (const auto* t = m.get<model::Thread>(self)) return thread(m, self, *t, std::move(others));
  Bevel form;
  if (const auto* c = m.get<model::Chamfer>(self)) {
    const auto width = size_of(m, c->first_offset_amount);
    const double angle = c->angle_to_plane.value_or(0.25 * kPi);
    if (!width || !(*width > 0.0)) return unread("it has no first_offset_amount");
    if (!(angle > 0.0 && angle < 0.5 * kPi))
      return unread("its angle_to_plane is not between 0 and 90 degrees");
    form.width_mm = *width;
    form.depth_mm = *width * std::tan(angle);
    form.other_width_mm = form.depth_mm;
    form.other_depth_mm = *width;
  } else if (const auto* e = m.get<model::EdgeRound>(self)) {
    const auto r = size_of(m, e->radius);
    if (!r || !(*r > 0.0)) return unread("it has no radius");
    form.width_mm = form.depth_mm = form.other_width_mm = form.other_depth_mm = *r;
    form.round = true;
  } else {
    return unread("it is of a kind that this reading does not know");
  }
  for (Solid& s : others.solids) {
    Bevel b = form;
    if (!edge_of(s, b))
      return unread("the edge that it breaks is not that of a hole, a pocket or an outside");
    s.noun = self;
    s.depth_mm = form.depth_mm;
    s.through = false;
    s.form = std::move(b);
  }
  return others;
}

}  // namespace capstan::verify::volumes
