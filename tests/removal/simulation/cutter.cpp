#include "tests/removal/simulation/cutter.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace capstan::testing::removal {
namespace {

using Outline = std::vector<std::pair<double, double>>;
constexpr double kStep = 0.005;  // mm of radius between two entries of a body's table

double widest(const Outline& o) {
  double r = 0.0;
  for (const auto& [h, radius] : o) r = std::max(r, radius);
  return r;
}

// Heights at which the outline reaches r: from the first to the last.
CutterBody::Span reach(const Outline& o, double r) {
  CutterBody::Span s{1e9, -1e9};
  const auto add = [&](double h) {
    s.lo = std::min(s.lo, h);
    s.hi = std::max(s.hi, h);
  };
  for (std::size_t i = 0; i < o.size(); ++i) {
    if (o[i].second >= r) add(o[i].first);
    if (i == 0) continue;
    const double a = o[i - 1].second, b = o[i].second;
    if ((a < r) != (b < r)) add(o[i - 1].first + (r - a) / (b - a) * (o[i].first - o[i - 1].first));
  }
  return s;
}

std::vector<CutterBody::Span> table(const Outline& o) {
  std::vector<CutterBody::Span> out;
  const double r = widest(o);
  for (int i = 0; i * kStep <= r + kStep; ++i) out.push_back(reach(o, std::min(i * kStep, r)));
  return out;
}

CutterBody::Span look_up(const std::vector<CutterBody::Span>& t, double r, double most) {
  if (t.empty() || r > most) return {};
  const double f = r / kStep;
  const auto i = std::min(static_cast<std::size_t>(f), t.size() - 1);
  const auto j = std::min(i + 1, t.size() - 1);
  const double part = f - static_cast<double>(i);
  return {t[i].lo + part * (t[j].lo - t[i].lo), t[i].hi + part * (t[j].hi - t[i].hi)};
}

void add_corner(Outline& o, double radius, double corner) {
  constexpr int kPieces = 48;
  const double c = std::min(corner, radius);
  for (int i = 0; i <= kPieces; ++i) {
    const double a = 0.5 * std::numbers::pi * i / kPieces;
    o.emplace_back(c - c * std::cos(a), radius - c + c * std::sin(a));
  }
}

}  // namespace

CutterBody::CutterBody(Outline edges, Outline shank)
    : edges_(table(edges)),
      shank_(table(shank)),
      radius_(widest(edges)),
      shank_radius_(shank.empty() ? 0.0 : widest(shank)) {
  if (shank.empty()) shank_.clear();
}

CutterBody::Span CutterBody::edges_at(double r) const { return look_up(edges_, r, radius_); }
CutterBody::Span CutterBody::shank_at(double r) const { return look_up(shank_, r, shank_radius_); }

double CutterText::operator[](const std::string& name) const {
  const auto at = number.find(name);
  return at == number.end() ? 0.0 : at->second;
}

// A scan of the text: an object per cutter, of each only the fields at its own level.
std::map<int, CutterText> cutters_of_json(const std::string& json) {
  std::map<int, CutterText> out;
  auto at = json.find("\"cutters\":");
  if (at == std::string::npos) return out;
  int depth = 0;
  CutterText cutter;
  std::string key;
  bool value = false;
  for (at = json.find('[', at); at < json.size(); ++at) {
    const char c = json[at];
    if (c == '"') {
      std::string text;
      for (++at; at < json.size() && json[at] != '"'; ++at) {
        if (json[at] == '\\') ++at;
        text += json[at];
      }
      if (depth == 2 && !value) key = text;
      if (depth == 2 && value && key == "cutter_class") cutter.kind = text;
    } else if (c == '[' || c == '{') {
      ++depth;
      value = false;
    } else if (c == ']' || c == '}') {
      --depth;
      if (depth == 1) {
        out[static_cast<int>(cutter["pocket"])] = cutter;
        cutter = {};
      }
      if (depth == 0) break;
      value = false;
    } else if (c == ':') {
      value = true;
      if (depth == 2) {
        char* end = nullptr;
        const double v = std::strtod(json.c_str() + at + 1, &end);
        if (end != json.c_str() + at + 1) cutter.number[key] = v;
      }
    } else if (c == ',') {
      value = false;
    }
  }
  return out;
}

std::optional<CutterBody> body_of(const CutterText& t) {
  const double r = 0.5 * t["cutting_diameter_mm"];
  const double length = std::max(t["maximum_depth_of_cut_mm"], 0.1);
  const double tip = 0.5 * t["tip_diameter_mm"];
  const double half = 0.5 * t["point_angle_rad"];
  const double width = t["cutting_width_mm"] > 0.0 ? t["cutting_width_mm"] : length;
  const std::string& k = t.kind;
  Outline o;
  if (k == "endmill" || k == "bullnose_endmill" || k == "facemill" || k == "reamer" || k == "boring_tool" ||
      k == "counterbore" || k == "thread_mill") {
    if (k == "facemill" && t["lead_angle_rad"] > 0.0) {
      o = {{0.0, r}, {length, r + length * std::tan(t["lead_angle_rad"])}};
    } else if (k == "reamer" && t["lead_length_mm"] > 0.0) {
      o = {{0.0, r - std::min(t["lead_length_mm"], 0.5 * r)}, {t["lead_length_mm"], r}, {length, r}};
    } else if (t["corner_radius_mm"] > 0.0) {
      add_corner(o, r, t["corner_radius_mm"]);
      o.emplace_back(std::max(length, t["corner_radius_mm"]), r);
    } else {
      o = {{0.0, r}, {length, r}};
    }
  } else if (k == "ball_endmill") {
    add_corner(o, r, r);
    o.emplace_back(std::max(length, r), r);
  } else if (k == "twist_drill" || k == "center_drill" || k == "spotdrill" || k == "gun_drill" ||
             k == "countersink" || k == "chamfer_mill") {
    const double cone = half > 0.0 ? (r - tip) / std::tan(half) : 0.0;
    o = {{0.0, tip}, {cone, r}, {std::max(length, cone), r}};
  } else if (k == "tap") {
    const double pitch = t["thread_pitch_mm"];
    const double lead = t["lead_threads"] * pitch;
    o = {{0.0, r - 0.6 * pitch}, {lead, r}, {std::max(length, lead), r}};
  } else if (k == "t_slot_mill" || k == "side_mill" || k == "back_counterbore") {
    o = {{0.0, r}, {width, r}};
  } else if (k == "dovetail_mill") {
    // The half angle of its flanks is stated as a lead angle.
    const double lean = t["lead_angle_rad"] > 0.0 ? t["lead_angle_rad"] : t["taper_angle_rad"];
    o = {{0.0, r}, {width, r - width * std::tan(lean)}};
  } else if (k == "back_countersink") {
    o = {{0.0, r}, {half > 0.0 ? (r - tip) / std::tan(half) : width, tip}};
  } else if (k == "corner_rounding_mill") {
    const double c = t["corner_radius_mm"];
    constexpr int kPieces = 48;
    for (int i = 0; i <= kPieces; ++i) {
      const double h = c * i / kPieces;
      o.emplace_back(h, tip + c - std::sqrt(std::max(0.0, c * c - h * h)));
    }
    o.emplace_back(std::max(length, c), tip + c);
  } else if (k == "tapered_endmill") {
    o = {{0.0, r}, {length, r + length * std::tan(t["taper_angle_rad"])}};
  } else {
    return std::nullopt;
  }
  // What follows has no edges: a neck, then the shank, to the holder.
  Outline shank;
  double from = o.back().first;
  const double end = std::max(t["stick_out_mm"], from + 0.1);
  const double neck = 0.5 * t["neck_diameter_mm"];
  if (neck > 0.0 && t["neck_length_mm"] > from) {
    shank = {{from, neck}, {t["neck_length_mm"], neck}};
    from = t["neck_length_mm"];
  }
  if (t["shank_diameter_mm"] > 0.0 && from < end) {
    shank.emplace_back(from, 0.5 * t["shank_diameter_mm"]);
    shank.emplace_back(end, 0.5 * t["shank_diameter_mm"]);
  }
  if (t["holder_diameter_mm"] > 0.0) {
    constexpr double kSpindle = 60.0;  // how much of the holder matters, mm
    shank.emplace_back(end, 0.5 * t["holder_diameter_mm"]);
    shank.emplace_back(end + kSpindle, 0.5 * t["holder_diameter_mm"]);
  }
  return CutterBody(std::move(o), std::move(shank));
}

}  // namespace capstan::testing::removal
