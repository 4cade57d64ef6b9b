#include "tests/removal/random_part.h"

#include <cstdint>
#include <numbers>
#include <random>

namespace capstan::testing::removal {
namespace {

constexpr double kOver = 2.0;    // mm that a hollow stands out of the block, where it is open
constexpr double kField = 24.0;  // mm, side of the field of one feature
constexpr double kDeg = std::numbers::pi / 180.0;

class Maker {
 public:
  explicit Maker(unsigned seed) : random_(seed) {
    fields_ = chance(0.4) ? 2 : 1;
    const double strips = chance(0.3) ? 18.0 : 0.0;
    raw_ = chance(0.25) ? 1.0 : 0.0;
    height_ = whole(12, 20);
    block_ = block(fields_ * kField + strips, kField, height_, raw_);
    name_ = "RANDOM " + std::to_string(seed);
    drawing_ = Drawing(name_, block_);
    target_ = Target(body(block_));
    if (raw_ > 0.0) {
      drawing_.face("TOP", 0, 0, block_.hi.x, block_.hi.y, raw_, raw_);
      keep("TOP", block_.lo, block_.hi);
    }
    for (int i = 0; i < fields_; ++i) {
      x_ = kField * (i + 0.5);
      y_ = 0.5 * kField;
      feature(i);
    }
    if (strips > 0.0) strip(fields_ * kField);
  }

  RandomPart done(unsigned seed) {
    static const std::vector<std::string> kMaterials{"EN AW-6061", "EN AW-6061", "C45", "GG25", "42CrMo4"};
    drawing_.material(kMaterials[static_cast<std::size_t>(whole(0, 4))]);
    static const std::vector<std::string> kMachines{
        "", "", "", "tormach_1100mx", "linuxcnc_axis_mm", "small_router"};
    RandomPart out{{"random_" + std::to_string(seed), drawing_.text(), block_, target_}, std::move(spaces_)};
    out.part.options.machine = kMachines[static_cast<std::size_t>(whole(0, 5))];
    // A shop with a handful of cutters: most features cannot be made, and that must be said.
    if (chance(0.1)) out.part.options.tools = CAPSTAN_SOURCE_DIR "/examples/reference_pocket_tools.yaml";
    if (chance(0.2)) out.part.options.feeds = "constant";
    if (chance(0.2)) out.part.options.objective = "cost";
    return out;
  }

 private:
  // Drawn without the library's distributions, which differ between libraries.
  int whole(int lo, int hi) {
    return lo + static_cast<int>(random_() % static_cast<std::uint32_t>(hi - lo + 1));
  }
  double half(double lo, double hi) { return lo + 0.5 * whole(0, static_cast<int>(2.0 * (hi - lo))); }
  bool chance(double p) { return random_() % 1000U < static_cast<std::uint32_t>(1000.0 * p); }
  void keep(const std::string& name, Point lo, Point hi) { spaces_.push_back({name, {lo, hi}}); }
  void keep_field(const std::string& name) {
    keep(name, {x_ - 0.5 * kField, y_ - 0.5 * kField, block_.lo.z},
         {x_ + 0.5 * kField, y_ + 0.5 * kField, block_.hi.z});
  }
  Drawing::Id at(double dx = 0.0, double dy = 0.0, double z = 0.0) {
    return drawing_.placement({x_ + dx, y_ + dy, z});
  }

  void feature(int i) {
    const std::string n = std::to_string(i);
    switch (whole(0, 9)) {
      case 0:
        return pocket("POCKET " + n);
      case 1:
        return round_pocket("ROUND POCKET " + n);
      case 2:
        return drawn_pocket("DRAWN POCKET " + n);
      case 3:
        return hole("HOLE " + n);
      case 4:
        return counterbored("COUNTERBORED " + n);
      case 5:
        return countersunk("COUNTERSUNK " + n);
      case 6:
        return circle("CIRCLE " + n);
      case 7:
        return rows("ROWS " + n);
      case 8:
        return closed_slot("CLOSED SLOT " + n);
      default:
        return thread("THREAD " + n);
    }
  }

  void pocket(const std::string& name) {
    const double l = half(12, 18), w = half(12, 18), r = half(2.5, 5), deep = whole(2, 8);
    const double turn = chance(0.3) ? whole(1, 3) * 15.0 : 0.0;
    const double c = std::cos(turn * kDeg), s = std::sin(turn * kDeg);
    const auto place = drawing_.placement({x_, y_, 0}, {0, 0, 1}, {c, s, 0});
    const Depth hollow =
        prism(rounded_rectangle(x_ - l / 2, y_ - w / 2, x_ + l / 2, y_ + w / 2, r), -deep, kOver);
    std::vector<Drawing::Id> bosses;
    const double island = chance(0.25) && std::min(l, w) >= 17 ? 4.0 : 0.0;
    if (island > 0.0) bosses.push_back(drawing_.boss(name + " ISLAND", at(), deep, drawing_.circle(island)));
    const auto made = drawing_.closed_pocket(name, place, deep, drawing_.rectangle(l, w), r, bosses);
    Depth cut = rotated(hollow, x_, y_, turn * kDeg);
    if (island > 0.0) cut = without(cut, cylinder(x_, y_, island / 2, -deep - 1, kOver));
    target_.cut(cut);
    keep_field(name);
    if (island == 0.0 && chance(0.3)) {
      const double dx = half(-2, 2);
      const std::string in = name + " FLOOR HOLE";
      drawing_.hole(in, at(dx, 0, -deep), height_ - deep, 4, drawing_.through_bottom());
      target_.cut(cylinder(x_ + dx, y_, 2, -height_ - kOver, -deep + 1));
      keep_field(in);
    }
    if (island == 0.0 && chance(0.2)) {
      // Over an outline that is turned the chamfer turns, too.
      const Depth2 outline = rounded_rectangle(x_ - l / 2, y_ - w / 2, x_ + l / 2, y_ + w / 2, r);
      drawing_.chamfer(name + " EDGE", made, made, 45, 0.5);
      target_.cut(rotated(
          [outline](const Point& p) {
            return std::min((outline(p.x, p.y) + 0.5 + p.z) / std::numbers::sqrt2,
                            std::min(p.z + 0.5, kOver - p.z));
          },
          x_, y_, turn * kDeg));
      keep_field(name + " EDGE");
    }
  }

  void round_pocket(const std::string& name) {
    const double d = half(12, 19), deep = whole(2, 8);
    drawing_.closed_pocket(name, at(), deep, drawing_.circle(d), 0);
    target_.cut(cylinder(x_, y_, d / 2, -deep, kOver));
    keep_field(name);
  }

  // A rectangle with round corners as a composite curve, either way round, its arcs with 0 or 360 degrees.
  void drawn_pocket(const std::string& name) {
    const double l = half(12, 18), w = half(12, 18), r = half(3, 5), deep = whole(2, 6);
    const bool clockwise = chance(0.5);
    const double last = chance(0.5) ? 0.0 : 360.0;
    std::vector<std::pair<Drawing::Id, bool>> s;
    const auto line = [&](Point a, Point b) {
      s.emplace_back(clockwise ? drawing_.polyline({b, a}) : drawing_.polyline({a, b}), true);
    };
    const auto arc = [&](double cx, double cy, double from, double to) {
      const Point c{cx, cy, 0};
      s.emplace_back(clockwise ? drawing_.arc(c, r, to, from, false) : drawing_.arc(c, r, from, to, true),
                     true);
    };
    const double a = l / 2, b = w / 2;
    line({-a + r, -b, 0}, {a - r, -b, 0});
    arc(a - r, -b + r, 270, last);
    line({a, -b + r, 0}, {a, b - r, 0});
    arc(a - r, b - r, 0, 90);
    line({a - r, b, 0}, {-a + r, b, 0});
    arc(-a + r, b - r, 90, 180);
    line({-a, b - r, 0}, {-a, -b + r, 0});
    arc(-a + r, -b + r, 180, 270);
    if (clockwise) std::reverse(s.begin(), s.end());
    drawing_.closed_pocket(name, at(), deep, drawing_.closed(drawing_.composite(s)), 0);
    target_.cut(prism(rounded_rectangle(x_ - a, y_ - b, x_ + a, y_ + b, r), -deep, kOver));
    keep_field(name);
  }

  // A toleranced diameter: anything between its limits is right.
  void bored(double x, double y, double d, double below, double top, double tolerance) {
    target_.cut(cylinder(x, y, d / 2 - tolerance, below, top), cylinder(x, y, d / 2 + tolerance, below, top));
  }

  void hole(const std::string& name) {
    const double dx = half(-4, 4), dy = half(-4, 4), d = half(3, 10), deep = whole(4, 8);
    const double x = x_ + dx, y = y_ + dy;
    static const double kTolerances[] = {0.2, 0.1, 0.05, 0.009};
    const double tolerance = kTolerances[whole(0, 3)];
    keep_field(name);
    switch (whole(0, 3)) {
      case 0:
        drawing_.hole(name, at(dx, dy), height_, d, drawing_.through_bottom(), 0, tolerance);
        return bored(x, y, d, -height_ - kOver, kOver, tolerance / 2);
      case 1:
        drawing_.hole(name, at(dx, dy), deep, d, drawing_.flat_bottom(), 0, tolerance);
        return bored(x, y, d, -deep, kOver, tolerance / 2);
      case 2: {
        drawing_.hole(name, at(dx, dy), deep, d, drawing_.conical_bottom(118), 0, tolerance);
        bored(x, y, d, -deep, kOver, tolerance / 2);
        const double tip = d / 2 / std::tan(59 * kDeg);
        return target_.cut(cone(x, y, -deep - tip, 0, -deep + 0.01, d / 2 * (1 + 0.01 / tip)));
      }
      default:
        drawing_.hole(name, at(dx, dy), deep + d / 2, d, drawing_.spherical_bottom(d / 2), 0, 0.1);
        bored(x, y, d, -deep, kOver, 0.05);
        return target_.cut(sphere({x, y, -deep}, d / 2));
    }
  }

  void counterbored(const std::string& name) {
    const double d = half(3, 7), wide = d + half(3, 5), deep = whole(2, 5);
    const auto bore =
        drawing_.hole(name + " BORE", drawing_.placement({0, 0, 0}), deep, wide, drawing_.flat_bottom());
    const auto core = drawing_.hole(name + " CORE", drawing_.placement({0, 0, -deep}), height_ - deep, d,
                                    drawing_.through_bottom());
    const bool bore_first = chance(0.5);
    const double dx = half(-3, 3);
    drawing_.compound(name, at(dx), bore_first ? std::vector{bore, core} : std::vector{core, bore},
                      chance(0.5) ? "COUNTERBORE_HOLE" : "COMPOUND_FEATURE");
    bored(x_ + dx, y_, wide, -deep, kOver, 0.05);
    bored(x_ + dx, y_, d, -height_ - kOver, kOver, 0.05);
    for (const char* of : {"", " BORE", " CORE"}) keep_field(name + of);
  }

  void countersunk(const std::string& name) {
    const double d = half(3, 6), wide = d + 2 * half(1, 2), deep = (wide - d) / 2;
    const auto core =
        drawing_.hole(name + " CORE", drawing_.placement({0, 0, 0}), height_, d, drawing_.through_bottom());
    const auto sink = drawing_.hole(name + " SINK", drawing_.placement({0, 0, 0}), deep, wide,
                                    drawing_.through_bottom(), drawing_.angle_taper(45));
    drawing_.compound(name, at(), {core, sink}, "COUNTERSUNK_HOLE");
    bored(x_, y_, d, -height_ - kOver, kOver, 0.05);
    target_.cut(cone(x_, y_, -deep, d / 2, 0.2, wide / 2 + 0.2));
    for (const char* of : {"", " CORE", " SINK"}) keep_field(name + of);
  }

  void circle(const std::string& name) {
    const int count = whole(2, 4);
    const double d = half(2, 4), on = half(12, 16), step = 360.0 / (count + whole(0, 1));
    const int without = chance(0.3) ? 2 : 0;
    const auto base = drawing_.hole(name + " BASE", drawing_.placement({on / 2, 0, 0}), height_, d,
                                    drawing_.through_bottom());
    drawing_.circular_pattern(name, at(), base, step, count, on,
                              without > 0 ? std::vector{without} : std::vector<int>{});
    for (int i = 0; i < count; ++i) {
      if (i + 1 == without) continue;
      bored(x_ + on / 2 * std::cos(i * step * kDeg), y_ + on / 2 * std::sin(i * step * kDeg), d,
            -height_ - kOver, kOver, 0.05);
    }
    keep_field(name);
    keep_field(name + " BASE");
  }

  // Rows of holes, or of counterbored ones; or the same at places of their own.
  void rows(const std::string& name) {
    const int columns = 2, lines = whole(1, 2);
    const double d = half(2, 3), apart = half(8, 10), between = half(8, 10);
    const bool compound = chance(0.5), general = chance(0.4);
    const auto origin = drawing_.placement({0, 0, 0});
    auto base = drawing_.hole(name + " BASE", origin, height_, d, drawing_.through_bottom());
    if (compound) {
      const auto bore = drawing_.hole(name + " BORE", origin, 2, d + 2, drawing_.flat_bottom());
      base = drawing_.compound(name + " SCREW", origin, {bore, base});
      keep_field(name + " SCREW");
    }
    const double x0 = -apart / 2, y0 = -between / 2;
    if (general) {
      std::vector<Drawing::Id> places;
      for (int l = 0; l < lines; ++l) {
        for (int c = 0; c < columns; ++c) {
          if (l + c > 0) places.push_back(drawing_.placement({c * apart, l * between, 0}));
        }
      }
      drawing_.general_pattern(name, at(x0, y0), base, places);
    } else {
      drawing_.rectangular_pattern(name, at(x0, y0), base, apart, {1, 0, 0}, columns, lines, between,
                                   {0, 1, 0});
    }
    for (int l = 0; l < lines; ++l) {
      for (int c = 0; c < columns; ++c) {
        const double x = x_ + x0 + c * apart, y = y_ + y0 + l * between;
        bored(x, y, d, -height_ - kOver, kOver, 0.05);
        if (compound) bored(x, y, d + 2, -2, kOver, 0.05);
      }
    }
    for (const char* of : {"", " BASE", " BORE"}) keep_field(name + of);
  }

  void closed_slot(const std::string& name) {
    const double w = whole(4, 10), l = half(4, 8), deep = whole(2, 5);
    const bool across = chance(0.5);
    const Point way = across ? Point{0, 1, 0} : Point{1, 0, 0};
    const double dx = across ? 0 : -l / 2, dy = across ? -l / 2 : 0;
    drawing_.slot(name, at(dx, dy), deep, drawing_.linear_path(l, way), drawing_.square_u(w), "radiused",
                  "radiused");
    target_.cut(prism(stroke({{x_ + dx, y_ + dy}, {x_ - dx, y_ - dy}}, w), -deep, kOver));
    keep_field(name);
  }

  void thread(const std::string& name) {
    struct Size {
      double major, pitch, core;
    };
    static const Size kSizes[] = {{4, 0.7, 3.3}, {5, 0.8, 4.2}, {6, 1, 5}, {8, 1.25, 6.8}};
    const Size& s = kSizes[whole(0, 3)];
    const double deep = std::min(height_ - 5.0, 2.0 * s.major), full = deep - 4.0 * s.pitch;
    const auto core = drawing_.hole_of(name + " CORE", at(), deep, drawing_.length(s.core, 0.15, 0.05),
                                       drawing_.conical_bottom(118));
    drawing_.thread(name, at(), full, core, s.major, s.pitch);
    const double tip = s.core / 2 / std::tan(59 * kDeg);
    const auto drilled = [&](double more) {
      return either({cylinder(x_, y_, s.core / 2 + more, -deep, kOver),
                     cone(x_, y_, -deep - tip, more, -deep + 0.01, s.core / 2 * (1 + 0.01 / tip) + more)});
    };
    // The flanks lie anywhere between core and major diameter; a tap runs on by its chamfer.
    target_.cut(drilled(-0.025),
                either({drilled(0.075), cylinder(x_, y_, s.major / 2 + 0.05, -full - 3.5 * s.pitch, kOver)}));
    for (const char* of : {"", " CORE"}) keep_field(name + of);
  }

  // What runs along y from side to side, 18 mm at the right of the block.
  void strip(double x0) {
    const double w = block_.hi.y, deep = whole(2, 6);
    const auto space = [&](const std::string& name) { keep(name, {x0 - 2, 0, block_.lo.z}, block_.hi); };
    const auto whole_length = [&](double x, Depth2 s) {
      return along({x, -kOver, 0}, {x, w + kOver, 0}, std::move(s));
    };
    const double x = x0 + 9;
    const auto path = [&] { return drawing_.linear_path(w, {0, 1, 0}); };
    switch (whole(0, 3)) {
      case 0: {
        drawing_.step("STEP", drawing_.placement({x, 0, 0}), deep, w, {0, 1, 0});
        target_.cut(box({x, -kOver, -deep}, {block_.hi.x + kOver, w + kOver, kOver}));
        return space("STEP");
      }
      case 1: {
        const double wide = whole(5, 10);
        drawing_.slot("SLOT", drawing_.placement({x, 0, 0}), deep, path(), drawing_.square_u(wide), "open",
                      "open");
        target_.cut(whole_length(x, rectangle(-wide / 2, -deep, wide / 2, kOver)));
        return space("SLOT");
      }
      case 2: {
        static const double kWidths[] = {6, 8, 10};
        const double wide = kWidths[whole(0, 2)], r = wide / 2, low = r + whole(0, 2);
        drawing_.slot("ROUND SLOT", drawing_.placement({x, 0, 0}), low, path(), drawing_.rounded_u(wide),
                      "open", "open");
        target_.cut(whole_length(x, [r, low](double u, double z) {
          return z > r - low ? std::min(r - std::abs(u), kOver - z) : r - std::hypot(u, z + low - r);
        }));
        return space("ROUND SLOT");
      }
      default: {
        const double wide = half(10, 16), l = 14, r = half(3, 5);
        const double a = wide / 2;
        // Opens at the front.
        const auto curve = drawing_.composite({{drawing_.polyline({{-a, 0, 0}, {-a, l - r, 0}}), true},
                                               {drawing_.arc({-a + r, l - r, 0}, r, 180, 90, false), true},
                                               {drawing_.polyline({{-a + r, l, 0}, {a - r, l, 0}}), true},
                                               {drawing_.arc({a - r, l - r, 0}, r, 90, 0, false), true},
                                               {drawing_.polyline({{a, l - r, 0}, {a, 0, 0}}), true}});
        drawing_.open_pocket("OPEN POCKET", drawing_.placement({x, 0, 0}), deep, drawing_.open(curve), r);
        target_.cut(
            prism(both(rounded_rectangle(x - a, -20, x + a, l, r), rectangle(x - 20, -kOver, x + 20, l)),
                  -deep, kOver));
        return space("OPEN POCKET");
      }
    }
  }

  std::mt19937 random_;
  int fields_ = 1;
  double raw_ = 0.0, height_ = 0.0;
  Box block_;
  std::string name_;
  Drawing drawing_{"", {}};
  Target target_{[](const Point&) { return 0.0; }};
  std::vector<Space> spaces_;
  double x_ = 0.0, y_ = 0.0;
};

// The names of the features that a plan says it does not make.
std::vector<std::string> unplanned(const std::string& json) {
  std::vector<std::string> out;
  const auto begin = json.find("\"unplanned\":[");
  if (begin == std::string::npos) return out;
  const auto end = json.find("\"provenance\":", begin);
  const std::string key = "{\"feature\":\"";
  for (auto at = json.find(key, begin); at < end; at = json.find(key, at + 1)) {
    const auto from = at + key.size();
    const std::string id = json.substr(from, json.find('"', from) - from);
    const auto object = json.find("\"" + id + "\",\"@instance\"");
    const std::string name = "\"its_id\":\"";
    const auto named = json.find(name, object);
    if (object == std::string::npos || named == std::string::npos) continue;
    out.push_back(
        json.substr(named + name.size(), json.find('"', named + name.size()) - named - name.size()));
  }
  return out;
}

}  // namespace

RandomPart random_part(unsigned seed) { return Maker(seed).done(seed); }

std::string broken_promise(const RandomPart& random, const Outcome& o) {
  const auto says_why = [&] {
    if (o.plan.unplanned > 0) return true;
    return std::any_of(o.plan.diagnostics.begin(), o.plan.diagnostics.end(),
                       [](const PlanMessage& m) { return m.severity == "error"; }) ||
           std::any_of(o.plan.findings.begin(), o.plan.findings.end(),
                       [](const PlanMessage& m) { return m.severity == "error"; });
  };
  if (!o.written()) return says_why() ? "" : "no program, and nothing says why";
  std::string out;
  for (const PlanMessage& f : o.plan.findings) {
    if (f.severity == "error") out += "the program has an error finding: " + f.text + "\n";
  }
  Verdict v = o.verdict;
  const std::vector<std::string> names = unplanned(o.plan.json);
  if (names.size() != o.plan.unplanned) out += "not every unplanned feature is named in the plan\n";
  const auto excused = [&](const Point& p) {
    return std::any_of(random.features.begin(), random.features.end(), [&](const Space& s) {
      return std::find(names.begin(), names.end(), s.name) != names.end() && p.x >= s.around.lo.x &&
             p.x <= s.around.hi.x && p.y >= s.around.lo.y && p.y <= s.around.hi.y;
    });
  };
  std::vector<std::string> left;
  for (std::size_t i = 0; i < v.left.size(); ++i) {
    if (i < v.left_at.size() && excused(v.left_at[i])) continue;
    left.push_back(v.left[i]);
  }
  v.left = std::move(left);
  return v.agrees() ? out : out + v.text();
}

}  // namespace capstan::testing::removal
