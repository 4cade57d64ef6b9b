#include "planner/making/workholding/place.h"

#include <algorithm>
#include <cmath>

#include "planner/ground/base/number.h"

namespace capstan::workholding {
namespace {

using geometry::Box3;
using geometry::Vec2;
using geometry::Vec3;
using model::FixtureSolid;
using model::Workholding;
using tooling::ClampWish;
using tooling::Fixture;
using tooling::FixtureKind;
using tooling::HoldingWish;
using tooling::Side;

constexpr double kTouch = 0.01;         // mm: nearer is contact, deeper is inside
constexpr double kLeastStanding = 1.0;  // mm of the piece above the jaws; default, unsourced
constexpr double kBlock = 20.0;         // mm: a strap clamp's rear block; default, unsourced
constexpr double kBoltToPiece = 3.0;    // mm between a strap clamp's bolt and the piece; default, unsourced
constexpr double kBehindBolt = 2.0;     // mm of the strap behind its bolt; default, unsourced

std::string n(double v) { return trimmed(v, 3); }

FixtureSolid prism(std::string id, std::string kind, Vec2 a, Vec2 b, double bottom, double top,
                   bool presses) {
  const Vec2 lo{std::min(a.x, b.x), std::min(a.y, b.y)};
  const Vec2 hi{std::max(a.x, b.x), std::max(a.y, b.y)};
  return {std::move(id), std::move(kind), {lo, {hi.x, lo.y}, hi, {lo.x, hi.y}}, bottom, top, presses};
}

/// Coordinates along and across the jaws: u along, v outwards from the piece's middle to the fixed jaw.
struct Across {
  Vec2 origin, u, v;
  [[nodiscard]] Vec2 at(double along, double out) const { return origin + along * u + out * v; }
};

class Placer {
 public:
  Placer(const HoldingWish& wish, const Box3& piece, const std::vector<Fixture>& fixtures, std::string file)
      : wish_(wish), piece_(piece), fixtures_(fixtures), file_(std::move(file)) {}

  Result<Workholding> run() {
    const Fixture* f = find_fixture(fixtures_, wish_.fixture);
    if (f == nullptr) return wrong("HOLD-UNKNOWN", "there is no fixture '" + wish_.fixture + "'", wish_.line);
    out_.id = f->id;
    out_.description = f->description;
    out_.source = f->source;
    out_.clearance_mm = wish_.clearance_mm;
    out_.holding_force_n = f->holding_force_n;
    Status ok;
    if (f->kind == FixtureKind::kPlate) {
      ok = plate(*f);
    } else if (f->kind == FixtureKind::kVise || f->kind == FixtureKind::kSoftJaws) {
      ok = vise(*f);
    } else {
      ok = tl::unexpected(
          fault("HOLD-KIND", "'" + f->id + "' is a clamp: it needs a plate or a vise under it", wish_.line));
    }
    if (!ok) return tl::unexpected(ok.error());
    for (const ClampWish& c : wish_.clamps) {
      if (auto placed = clamp(c, *f); !placed) return tl::unexpected(placed.error());
    }
    return std::move(out_);
  }

 private:
  [[nodiscard]] Diagnostic fault(const char* code, std::string message, std::uint64_t line,
                                 std::string hint = {}) const {
    return {.code = code,
            .message = "set-up " + wish_.setup + ": " + std::move(message),
            .file = file_,
            .line = line,
            .hint = std::move(hint)};
  }
  [[nodiscard]] tl::unexpected<Diagnostic> wrong(const char* code, std::string message, std::uint64_t line,
                                                 std::string hint = {}) const {
    return tl::unexpected(fault(code, std::move(message), line, std::move(hint)));
  }

  /// The parallel that is requested, else the one with the deepest grip within two thirds of the piece.
  [[nodiscard]] Vec2 parallel_of(const Fixture& f, double height) const {
    if (wish_.parallel) return *wish_.parallel;
    Vec2 best{};
    for (const Vec2 p : f.parallels) {
      const double grip = f.height_mm - p.y;
      const double best_grip = f.height_mm - best.y;
      const bool fits = grip >= kLeastGrip && grip <= kUsualGrip * height;
      if (fits && (best.y == 0.0 || grip > best_grip)) best = p;
    }
    if (best.y == 0.0) {
      for (const Vec2 p : f.parallels) {
        if (p.y > best.y) best = p;
      }
    }
    return best;
  }

  Status vise(const Fixture& f) {
    const Vec2 v = direction_of(wish_.fixed_jaw);
    const bool along_x = v.x == 0.0;
    const Vec3 size = piece_.size();
    const double width = along_x ? size.y : size.x;
    const double length = along_x ? size.x : size.y;
    if (width > f.opening_mm + 1e-9) {
      return wrong("HOLD-OPENING",
                   "the piece is " + n(width) + " mm wide between the jaws; '" + f.id + "' opens " +
                       n(f.opening_mm) + " mm",
                   wish_.line, "turn it (fixed_jaw), or take a larger vise or a plate");
    }
    const Vec2 parallel = parallel_of(f, size.z);
    const double grip = f.height_mm - parallel.y;
    if (parallel.y <= 0.0 || grip < kLeastGrip || grip > size.z - kLeastStanding) {
      return wrong("HOLD-PARALLEL",
                   "on parallels of " + n(parallel.y) + " mm the jaws of '" + f.id + "' (" + n(f.height_mm) +
                       " mm high) hold " + n(grip) + " mm of a piece of " + n(size.z) + " mm",
                   wish_.line,
                   "at least " + n(kLeastGrip) + " mm must be held, and " + n(kLeastStanding) +
                       " mm stand above the jaws");
    }
    if (parallel.x * 2.0 > width) {
      return wrong(
          "HOLD-PARALLEL",
          "two parallels of " + n(parallel.x) + " mm do not fit under a piece of " + n(width) + " mm",
          wish_.line);
    }
    const double seat = piece_.lo.z;
    const double bed = seat - parallel.y;
    const double top = bed + f.height_mm;
    const Across c{0.5 * (xy(piece_.lo) + xy(piece_.hi)), along_x ? Vec2{1, 0} : Vec2{0, 1}, v};
    const double half = 0.5 * width;
    const double a0 = wish_.offset_mm - 0.5 * f.width_mm;
    const double a1 = wish_.offset_mm + 0.5 * f.width_mm;
    if (a0 > 0.5 * length - kTouch || a1 < -0.5 * length + kTouch)
      return wrong("HOLD-CONTACT",
                   "an offset of " + n(wish_.offset_mm) + " mm moves the jaws off the piece; at most " +
                       n(0.5 * (length + f.width_mm) - kTouch) + " mm to either side",
                   wish_.line);
    const std::string kind = f.kind == FixtureKind::kSoftJaws ? "soft_jaw" : "jaw";
    auto& s = out_.solids;
    s.push_back(
        prism("vise.fixed_jaw", kind, c.at(a0, half), c.at(a1, half + f.thickness_mm), bed, top, true));
    s.push_back(
        prism("vise.moving_jaw", kind, c.at(a0, -half - f.thickness_mm), c.at(a1, -half), bed, top, true));
    const double p0 = std::max(a0, -0.5 * length), p1 = std::min(a1, 0.5 * length);
    s.push_back(
        prism("vise.parallel_fixed", "stop", c.at(p0, half - parallel.x), c.at(p1, half), bed, seat, false));
    s.push_back(prism("vise.parallel_moving", "stop", c.at(p0, -half), c.at(p1, -half + parallel.x), bed,
                      seat, false));
    const double out = half + f.thickness_mm;
    s.push_back(prism("vise.body", "body", c.at(a0, out), c.at(a1, out - std::max(f.length_mm, 2.0 * out)),
                      bed - f.bed_mm, bed, false));
    const std::string side(to_text(wish_.fixed_jaw));
    out_.description +=
        "; fixed jaw at " + side + ", piece on " +
        (f.kind == FixtureKind::kSoftJaws ? "the step of the soft jaws"
                                          : "parallels " + n(parallel.x) + " x " + n(parallel.y) + " mm") +
        ", held " + n(grip) + " mm high by the jaws, whose top lies at Z " + n(top);
    // Touched off at the end of the fixed jaw's face, and at the top.
    const Vec2 corner = c.at(-0.5 * length, half);
    out_.pickup = {corner.x, corner.y, piece_.hi.z};
    out_.pickup_text = "corner of the piece at its " + std::string(along_x ? "-x" : "-y") +
                       " end against the fixed jaw (" + side + "), Z at its top: the work offset reads X " +
                       n(corner.x) + ", Y " + n(corner.y) + ", Z " + n(piece_.hi.z) + " there";
    return {};
  }

  Status plate(const Fixture& f) {
    const Vec3 size = piece_.size();
    if (size.x > f.width_mm || size.y > f.length_mm) {
      return wrong("HOLD-SIZE",
                   "the piece is " + n(size.x) + " x " + n(size.y) + " mm; '" + f.id + "' is " +
                       n(f.width_mm) + " x " + n(f.length_mm) + " mm",
                   wish_.line);
    }
    if (wish_.clamps.empty())
      return wrong("HOLD-NOTHING", "nothing holds the piece on '" + f.id + "'", wish_.line,
                   "name its clamps");
    const Vec2 middle = 0.5 * (xy(piece_.lo) + xy(piece_.hi));
    const Vec2 half{0.5 * f.width_mm, 0.5 * f.length_mm};
    const double top = piece_.lo.z - f.support_mm;
    out_.solids.push_back(
        prism("plate", "plate", middle - half, middle + half, top - f.height_mm, top, false));
    out_.pickup = {piece_.lo.x, piece_.lo.y, piece_.hi.z};
    out_.pickup_text = "lower left corner of the piece (-x, -y), Z at its top: the work offset reads X " +
                       n(out_.pickup.x) + ", Y " + n(out_.pickup.y) + ", Z " + n(out_.pickup.z) + " there";
    out_.description += "; piece on supports of " + n(f.support_mm) + " mm under its clamps";
    return {};
  }

  Status clamp(const ClampWish& c, const Fixture& under) {
    const Fixture* f = find_fixture(fixtures_, c.clamp);
    if (f == nullptr) return wrong("HOLD-UNKNOWN", "there is no clamp '" + c.clamp + "'", c.line);
    const Vec2 back = direction_of(c.from);
    const Vec2 across{-back.y, back.x};
    const Vec2 w = (0.5 * f->width_mm) * across;
    const bool strap = f->kind == FixtureKind::kStrapClamp;
    if (!strap && f->kind != FixtureKind::kToeClamp)
      return wrong("HOLD-KIND", "'" + c.clamp + "' is no clamp", c.line);
    const double bottom = c.bottom.value_or(strap ? piece_.hi.z : piece_.lo.z);
    const Vec2 tail = c.at + f->length_mm * back;
    FixtureSolid body = prism(c.name, "clamp", c.at - w, tail + w, bottom, bottom + f->height_mm, true);
    if (auto ok = touches(c, body, strap); !ok) return ok;
    out_.holding_force_n += f->holding_force_n;
    out_.description += "; " + c.name + " (" + f->description + ") at X " + n(c.at.x) + " Y " + n(c.at.y) +
                        " from " + std::string(to_text(c.from));
    out_.solids.push_back(std::move(body));
    if (!strap) return {};
    // Bolt and rear block are outside the piece; the block reaches down to the surface under the clamp.
    const double edge =
        dot(geometry::Vec2{back.x > 0 ? piece_.hi.x : piece_.lo.x, back.y > 0 ? piece_.hi.y : piece_.lo.y} -
                c.at,
            {std::abs(back.x), std::abs(back.y)}) *
        (back.x + back.y);
    const double stud = std::max(edge, 0.0) + 0.5 * f->stud_mm + kBoltToPiece;
    if (stud + 0.5 * f->stud_mm + kBehindBolt > f->length_mm) {
      return wrong("HOLD-CONTACT",
                   c.name + " ('" + c.clamp + "') is " + n(f->length_mm) + " mm long, and needs " +
                       n(stud + 0.5 * f->stud_mm + kBehindBolt) +
                       " mm to have its bolt outside the piece, whose edge is " + n(edge) +
                       " mm behind its tip; set it nearer to the edge or use a longer one",
                   c.line);
    }
    const Vec2 bolt = c.at + stud * back;
    const Vec2 r = (0.5 * f->stud_mm) * (across + back);
    const double base =
        under.kind == FixtureKind::kPlate ? piece_.lo.z - under.support_mm : piece_.lo.z - under.height_mm;
    out_.solids.push_back(prism(c.name + ".bolt", "clamp", bolt - r, bolt + r, base,
                                bottom + f->height_mm + f->stud_height_mm, false));
    const Vec2 block = tail - std::min(kBlock, 0.25 * f->length_mm) * back;
    out_.solids.push_back(prism(c.name + ".block", "body", block - w, tail + w, base, bottom, false));
    if (under.kind == FixtureKind::kPlate) {
      // The support is under the tip.
      const double reach = std::clamp(edge, kTouch, f->reach_mm);
      const Vec2 rim = c.at + edge * back;
      out_.solids.push_back(
          prism(c.name + ".support", "stop", rim - w, rim - reach * back + w, base, piece_.lo.z, false));
    }
    return {};
  }

  /// A clamp holds the piece where they meet, and is nowhere inside it.
  Status touches(const ClampWish& c, const FixtureSolid& s, bool strap) const {
    const Vec2 lo = s.outline[0], hi = s.outline[2];
    const double dx = std::min(hi.x, piece_.hi.x) - std::max(lo.x, piece_.lo.x);
    const double dy = std::min(hi.y, piece_.hi.y) - std::max(lo.y, piece_.lo.y);
    const double dz = std::min(s.top_mm, piece_.hi.z) - std::max(s.bottom_mm, piece_.lo.z);
    const std::string who = c.name + " ('" + c.clamp + "')";
    if (dx > kTouch && dy > kTouch && dz > kTouch) {
      return wrong("HOLD-INSIDE",
                   who + " lies inside the piece, " + n(std::min({dx, dy, dz})) + " mm deep: it spans X " +
                       n(lo.x) + " to " + n(hi.x) + ", Y " + n(lo.y) + " to " + n(hi.y) + ", Z " +
                       n(s.bottom_mm) + " to " + n(s.top_mm),
                   c.line);
    }
    const bool above = strap && dx > kTouch && dy > kTouch && std::abs(dz) <= kTouch;
    const bool beside = !strap && dz > kTouch && std::min(dx, dy) >= -kTouch && std::max(dx, dy) > kTouch;
    if (!above && !beside) {
      return wrong("HOLD-CONTACT",
                   who + " does not touch the piece, which spans X " + n(piece_.lo.x) + " to " +
                       n(piece_.hi.x) + ", Y " + n(piece_.lo.y) + " to " + n(piece_.hi.y) + ", Z " +
                       n(piece_.lo.z) + " to " + n(piece_.hi.z),
                   c.line);
    }
    return {};
  }

  const HoldingWish& wish_;
  const Box3& piece_;
  const std::vector<Fixture>& fixtures_;
  std::string file_;
  Workholding out_;
};

}  // namespace

Result<Workholding> place(const HoldingWish& wish, const Box3& piece, const std::vector<Fixture>& fixtures,
                          const std::string& file) {
  return Placer(wish, piece, fixtures, file).run();
}

}  // namespace capstan::workholding
