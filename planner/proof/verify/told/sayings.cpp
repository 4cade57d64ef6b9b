#include "planner/proof/verify/told/sayings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "planner/ground/base/number.h"
#include "planner/proof/verify/sweep/target/target.h"

namespace capstan::verify {
namespace {

using geometry::Placement;
using geometry::Vec3;

constexpr double kAlong = 1.0 - 1e-6;  ///< cosine to an axis
constexpr double kStillRad = 1e-6;
constexpr int kOfDirection = 3, kOfAngle = 2;  ///< decimals

/// "+Z" for a direction in the workpiece's axes, or its three parts.
std::string direction(Vec3 v) {
  const std::array<double, 3> parts{v.x, v.y, v.z};
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::abs(parts[i]) <= kAlong) continue;
    return std::string(parts[i] > 0.0 ? "+" : "-") + "XYZ"[i];
  }
  return "(" + trimmed(v.x, kOfDirection) + ", " + trimmed(v.y, kOfDirection) + ", " +
         trimmed(v.z, kOfDirection) + ")";
}

bool upright(const Placement& at) {
  for (const Vec3 d : {at.x, at.y, at.z}) {
    if (std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) < kAlong) return false;
  }
  return true;
}

/// The way from one set-up to the next, in words; two where half a turn is the same about either sense.
std::vector<std::string> turns(const Placement& before, const Placement& now) {
  // R takes the workpiece's directions, as they lay, to how they lie: its columns.
  const auto turned = [&](Vec3 d) { return now.direction_to_parent(before.direction_to_local(d)); };
  const Vec3 x = turned({1, 0, 0}), y = turned({0, 1, 0}), z = turned({0, 0, 1});
  const double angle = std::acos(std::clamp(0.5 * (x.x + y.y + z.z - 1.0), -1.0, 1.0));
  if (angle < kStillRad) return {"not turned"};
  const bool half = angle > std::numbers::pi - kStillRad;
  // R - R^T is 2 sin(a) times the axis crossed; at half a turn R + 1 is 2 n n^T.
  Vec3 axis{y.z - z.y, z.x - x.z, x.y - y.x};
  if (half) {
    const Vec3 columns[3] = {x + Vec3{1, 0, 0}, y + Vec3{0, 1, 0}, z + Vec3{0, 0, 1}};
    axis = *std::max_element(std::begin(columns), std::end(columns),
                             [](Vec3 a, Vec3 b) { return norm(a) < norm(b); });
  }
  axis = (1.0 / norm(axis)) * axis;
  std::vector<std::string> out;
  for (const double sense : {1.0, -1.0}) {
    if (sense < 0.0 && !half) break;
    std::string about = direction(before.direction_to_local(sense * axis));
    if (about.front() == '+') about.erase(0, 1);
    out.push_back(std::string(z.z < -kAlong ? "turned over, " : "turned ") +
                  trimmed(angle * 180.0 / std::numbers::pi, kOfAngle) + " deg about its " + about + " axis");
  }
  return out;
}

/// Where the zero of one axis is on the raw piece, which reaches from `lo` to `hi`.
struct Side {
  const char *axis, *at_low, *at_high, *outside_low, *inside;
};
constexpr std::array<Side, 3> kSides{{{"X0", "its left side", "its right side", "left of", "right of"},
                                      {"Y0", "its front", "its back", "in front of", "behind"},
                                      {"Z0", "its underside", "its top", "below", "above"}}};

std::string zero_on(const Side& s, double lo, double hi, int decimals) {
  const double least = 0.5 * std::pow(10.0, -decimals);
  const std::string axis = std::string(s.axis) + " ";
  const auto off = [&](double mm, const char* where, const char* side) {
    return axis + trimmed(mm, decimals) + " mm " + where + " " + side;
  };
  if (std::abs(lo) < least) return axis + "at " + s.at_low;
  if (std::abs(hi) < least) return axis + "at " + s.at_high;
  if (lo > 0.0) return off(lo, s.outside_low, s.at_low);
  if (hi < 0.0) return off(-hi, s.inside, s.at_high);
  return off(-lo, s.inside, s.at_low);
}

class OfSetup {
 public:
  OfSetup(const model::Plan& plan, std::size_t n, std::optional<std::size_t> before)
      : plan_(plan),
        setup_(plan.setups[n]),
        before_(before),
        name_("set-up " + std::to_string(n + 1) + ": "),
        decimals_(plan.machine.control.decimals),
        here_(workpiece_in(plan, n)) {
    if (before) turns_ = turns(workpiece_in(plan, *before), here_);
    if (plan.stock.box.empty() || !upright(here_)) return;
    raw_ = placed(plan.stock.box, here_);
    zero_ = zero_on(kSides[0], raw_.lo.x, raw_.hi.x, decimals_) + ", " +
            zero_on(kSides[1], raw_.lo.y, raw_.hi.y, decimals_) + ", " +
            zero_on(kSides[2], raw_.lo.z, raw_.hi.z, decimals_);
  }

  std::vector<Saying> run() {
    if (before_) {
      std::vector<std::string> lies;
      for (const std::string& t : turns_)
        lies.push_back("the workpiece is " + t + " after set-up " + std::to_string(*before_ + 1));
      say("the workpiece is", std::move(lies));
    }
    const auto own = [&](Vec3 d) { return direction(here_.direction_to_local(d)); };
    say("the workpiece's", {"the workpiece's " + own({0, 0, 1}) + " up, its " + own({1, 0, 0}) +
                            " to the right, its " + own({0, 1, 0}) + " to the back"});
    const std::string in_part = "the point " + point(here_.to_local({0, 0, 0})) + " of the part's drawing";
    say("zero", {"zero " + setup_.work_offset +
                 (zero_.empty() ? ": " + in_part
                                : " on the raw piece as it lies: " + zero_ + "; that is " + in_part)});
    if (!zero_.empty())
      say("the raw piece reaches",
          {"the raw piece reaches from " + point(raw_.lo) + " to " + point(raw_.hi) +
           (before_ ? "; a side that was cut before stands back by what was cut" : "")});
    holding();
    if (before_) clamping();
    return std::move(out_);
  }

 private:
  [[nodiscard]] std::string number(double v) const { return trimmed(v, decimals_); }
  [[nodiscard]] std::string point(Vec3 p) const {
    return "X" + number(p.x) + " Y" + number(p.y) + " Z" + number(p.z);
  }

  void say(const std::string& head, std::vector<std::string> texts) {
    for (std::string& t : texts) t.insert(0, name_);
    out_.push_back({{name_ + head}, std::move(texts)});
  }

  void holding() {
    const model::Workholding& h = setup_.holding;
    const std::string pick_up = "pick up " + setup_.work_offset + ":";
    if (!h.pickup_text.empty()) say(pick_up, {pick_up + " " + h.pickup_text});
    if (h.solids.empty()) {
      say("what holds the piece",
          {"what holds the piece is not planned: fixtures and clamps are not checked"});
      return;
    }
    say("held by", {"held by " + (h.description.empty() ? h.id : h.description)});
    for (const model::FixtureSolid& s : h.solids) {
      geometry::Box3 seen;
      for (const geometry::Vec2 p : s.outline) {
        seen.add({p.x, p.y, s.bottom_mm});
        seen.add({p.x, p.y, s.top_mm});
      }
      if (seen.empty()) continue;
      const auto range = [&](double lo, double hi) { return number(lo) + " to " + number(hi); };
      say(s.id + ": X",
          {s.id + ": X " + range(seen.lo.x, seen.hi.x) + ", Y " + range(seen.lo.y, seen.hi.y) + ", Z " +
           range(seen.lo.z, seen.hi.z) + " mm" + (s.presses ? "" : ", does not press")});
    }
  }

  /// What a message has no room for stands in the comments before it: long, shorter or short.
  void clamping() {
    const std::string anew = "clamp the workpiece anew", set = "set " + setup_.work_offset;
    const std::string by_comments = " as the program says", last = ", then continue";
    Saying s{{name_ + anew, name_ + "clamp anew"}, {}, true};
    for (const std::string& t : turns_) {
      const std::string lies =
          ", " + t + ", its " + direction(here_.direction_to_local({0, 0, 1})) + " up; " + set;
      if (!zero_.empty()) s.texts.push_back(name_ + anew + lies + ": " + zero_ + last);
      s.texts.push_back(name_ + anew + lies + by_comments + last);
      s.texts.push_back(name_ + "clamp anew" + lies + last);
    }
    s.texts.push_back(name_ + anew + by_comments + "; " + set + last);
    out_.push_back(std::move(s));
  }

  const model::Plan& plan_;
  const model::SetupResult& setup_;
  std::optional<std::size_t> before_;
  std::string name_;
  int decimals_;
  Placement here_;
  std::vector<std::string> turns_;
  geometry::Box3 raw_;
  std::string zero_;  ///< empty: no side of the piece faces an axis
  std::vector<Saying> out_;
};

}  // namespace

std::vector<Saying> sayings_of_header(const model::Plan& plan) {
  std::vector<Saying> out;
  if (!plan.material.id.empty()) out.push_back({{"material:"}, {"material: " + plan.material.id}});
  if (!plan.stock.box.empty()) {
    const Vec3 s = plan.stock.box.size();
    const int decimals = plan.machine.control.decimals;
    out.push_back({{"stock:"},
                   {"stock: " + trimmed(s.x, decimals) + " x " + trimmed(s.y, decimals) + " x " +
                    trimmed(s.z, decimals) + " mm"}});
  }
  return out;
}

std::vector<Saying> sayings_of_setup(const model::Plan& plan, std::size_t n,
                                     std::optional<std::size_t> before) {
  return OfSetup(plan, n, before).run();
}

}  // namespace capstan::verify
