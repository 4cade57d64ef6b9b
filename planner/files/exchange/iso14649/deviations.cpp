#include "planner/files/exchange/iso14649/deviations.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/files/exchange/common/ratio.h"
#include "planner/files/exchange/common/text.h"
#include "planner/files/exchange/iso14649/deviations_internal.h"
#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/unit_factors.h"
#include "planner/model/nouns/all.h"

namespace capstan::exchange {

using model::AnyRef;
using model::Binder;
using model::Decision;

namespace deviations {

void note(Reading& r, AnyRef at, std::string_view attribute, bool repaired, const std::string& code,
          const std::string& why) {
  auto& ledger = r.plan.ledger;
  Decision d;
  d.binder = Binder::kGiven;
  d.lexeme = lexeme_of(r.parameter(at, attribute));
  std::string text = why;
  if (const Decision* before = ledger.find(at, attribute)) {
    text = ledger.reason(before->reason).text + "; " + why;
    d.lexeme = before->lexeme;
    repaired = repaired || ledger.reason(before->reason).id == "given.repaired";
    d.state = before->state;
  }
  d.reason = ledger.reason({repaired ? "given.repaired" : "given.suspicious", text, "the file"});
  ledger.set({at, std::string(attribute)}, std::move(d));
  r.reporter.about(
      r.plan.model, at,
      {.code = code, .severity = Severity::kWarning, .message = attribute_name(at, attribute) + ": " + why});
}

std::string in_file(const Reading& r, AnyRef at, std::string_view attribute) {
  return lexeme_of(r.parameter(at, attribute));
}

}  // namespace deviations

namespace {

using deviations::in_file;
using deviations::note;

std::string show(double v) { return trimmed(v, 3); }

// --- angles -----------------------------------------------------------------------------------------------

struct AngleAt {
  AnyRef at;
  const model::Attribute* attribute;
  double degrees;  // as the file's number reads by the standard
};

std::vector<AngleAt> angles(const Reading& r) {
  std::vector<AngleAt> out;
  for (const AnyRef at : r.object_of) {
    if (at.type == model::TypeId::kKeptInstance) continue;
    for (const model::Attribute& a : model::noun_type(at.type).attributes) {
      if (a.unit != model::Unit::kAngle || a.storage != model::Storage::kReal || !a.in_iso14649) continue;
      const auto& v = *static_cast<const model::Real*>(a.in(r.plan.model.object(at)));
      if (v && *v != 0.0) out.push_back({at, &a, *v / kRadPerDegree});
    }
  }
  return out;
}

// A number that is not round in degrees and, read as radians, is a multiple of half a degree to nine digits
// is in radians: such an angle in degrees is not written by hand.
bool is_radians(double v) {
  const double halves = 2.0 * v / kRadPerDegree;
  const bool round_in_radians = std::abs(halves - std::round(halves)) < 1e-7 && std::round(halves) != 0.0;
  const bool round_as_written = std::abs(1000.0 * v - std::round(1000.0 * v)) < 1e-9;
  return std::abs(v) <= 2.0 * std::numbers::pi && round_in_radians && !round_as_written;
}

/// Parameters that trim circles and ellipses are angles, in degrees in the model as in the standard. A
/// curve's two have one unit: if one is in radians without doubt, so is the other.
void check_trims(Reading& r) {
  for (const AnyRef at : r.object_of) {
    auto* c = r.plan.model.get<model::TrimmedCurve>(at);
    if (c == nullptr) continue;
    if (!r.plan.model.holds<model::Circle>(c->basis_curve) &&
        !r.plan.model.holds<model::Ellipse>(c->basis_curve))
      continue;
    bool sure = false, fits = true;
    for (const auto* list : {&c->trim_1, &c->trim_2}) {
      for (const auto& v : list->items) {
        sure = sure || (v.real && is_radians(*v.real));
        fits = fits && (!v.real || std::abs(*v.real) <= 2.0 * std::numbers::pi);
      }
    }
    if (!sure || !fits) continue;
    for (const char* name : {"trim_1", "trim_2"}) {
      for (auto& v : (name[5] == '1' ? c->trim_1 : c->trim_2).items) {
        if (!v.real) continue;
        v.real = *v.real / kRadPerDegree;
        note(r, at, name, true, "EXC-UNIT-ANGLE",
             in_file(r, at, name) + " is taken as radians, that is " + show(*v.real) +
                 " degrees: read as degrees the arc's ends would be no round numbers");
      }
    }
  }
}

void check_angles(Reading& r) {
  check_trims(r);
  const auto all = angles(r);
  const bool any =
      std::any_of(all.begin(), all.end(), [](const AngleAt& a) { return is_radians(a.degrees); });
  if (!any) return;
  for (const AngleAt& a : all) {
    const bool sure = is_radians(a.degrees);
    if (std::abs(a.degrees) > 2.0 * std::numbers::pi) {
      note(r, a.at, a.attribute->name, false, "EXC-UNIT-ANGLE",
           in_file(r, a.at, a.attribute->name) +
               " is too large for radians, in which other angles of the file are; kept as degrees");
      continue;
    }
    *static_cast<model::Real*>(a.attribute->at(r.plan.model.object(a.at))) =
        a.degrees;  // rad are the model's
    note(r, a.at, a.attribute->name, true, "EXC-UNIT-ANGLE",
         in_file(r, a.at, a.attribute->name) + " is taken as radians, that is " +
             show(a.degrees / kRadPerDegree) + " degrees: " +
             (sure ? "read as degrees it would be no round number"
                   : "other angles of the file are in radians without doubt"));
  }
}

// --- drill points -----------------------------------------------------------------------------------------

// Half of a point angle of a drill lies in this range (90 to 150 degrees in full); default, unsourced.
constexpr double kHalfPointMin = 45.0, kHalfPointMax = 75.0;

void check_drill_points(Reading& r) {
  auto& m = r.plan.model;
  for (const AnyRef at : m.all_below(model::TypeId::kDrill)) {
    const AnyRef dimension = m.at<model::Drill>(at).dimension;
    auto* d = m.get<model::MillingToolDimension>(dimension);
    if (d == nullptr || !d->tool_top_angle) continue;
    const double half = *d->tool_top_angle / kRadPerDegree;
    const double other = 90.0 - half;
    if (half >= kHalfPointMin || half <= 0.0 || other < kHalfPointMin || other > kHalfPointMax) continue;
    d->tool_top_angle = other * kRadPerDegree;
    note(r, dimension, "tool_top_angle", true, "EXC-TIP-ANGLE",
         in_file(r, dimension, "tool_top_angle") + " would be a point of " + show(2.0 * half) +
             " degrees; taken as the complement, so that the half angle is " + show(other) +
             " and the point " + show(2.0 * other) + " degrees");
  }
}

// --- ratios -----------------------------------------------------------------------------------------------

void check_ratios(Reading& r) {
  auto& m = r.plan.model;
  for (const AnyRef at : r.object_of) {
    if (at.type == model::TypeId::kKeptInstance) continue;
    for (const model::Attribute& a : model::noun_type(at.type).attributes) {
      if (a.unit != model::Unit::kRatio || a.storage != model::Storage::kReal || !a.in_iso14649) continue;
      auto& v = *static_cast<model::Real*>(a.at(m.object(at)));
      if (!v || !beyond_ratio(a.name, *v)) continue;
      const bool percent = is_percent(a.name, *v);
      const std::string file = in_file(r, at, a.name);
      if (percent) v = *v / 100.0;
      note(r, at, a.name, percent, "EXC-RATIO",
           percent ? file + " is taken as percent, that is " + shortest(*v) + ": a ratio lies between 0 and 1"
                   : file + " is no ratio between 0 and 1, and may be percent or a length; kept as it is");
    }
  }
}

// --- zeros ------------------------------------------------------------------------------------------------

void check_zeros(Reading& r) {
  auto& m = r.plan.model;
  const auto zero = [&](AnyRef at, std::string_view attribute, const model::Real& v, const char* what) {
    if (v && *v == 0.0) {
      note(r, at, attribute, false, "EXC-ZERO",
           in_file(r, at, attribute) + " is not " + what + "; taken as not stated");
    }
  };
  for (const AnyRef at : m.all(model::TypeId::kMillingToolDimension)) {
    const auto& d = m.at<model::MillingToolDimension>(at);
    zero(at, "diameter", d.diameter, "a diameter");
    zero(at, "cutting_edge_length", d.cutting_edge_length, "a length that cuts");
  }
  for (const AnyRef at : m.all(model::TypeId::kCuttingComponent)) {
    const auto& c = m.at<model::CuttingComponent>(at);
    zero(at, "tool_offset_length", c.tool_offset_length, "the length of a tool");
    zero(at, "expected_tool_life", c.expected_tool_life, "a tool's life");
  }
}

}  // namespace

void find_deviations(Reading& r) {
  check_angles(r);
  check_drill_points(r);
  check_ratios(r);
  check_zeros(r);
  deviations::check_technology(r);
}

std::vector<Suspicion> suspicions(const model::Plan& plan) {
  std::vector<Suspicion> out;
  for (const auto& [key, d] : plan.ledger.entries()) {
    const model::Reason& why = plan.ledger.reason(d.reason);
    if (why.id != "given.repaired" && why.id != "given.suspicious") continue;
    out.push_back({key.object, key.attribute, why.id == "given.repaired", d.lexeme, why.text});
  }
  return out;
}

}  // namespace capstan::exchange
