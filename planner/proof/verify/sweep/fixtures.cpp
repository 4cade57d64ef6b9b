#include "planner/proof/verify/sweep/fixtures.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "planner/proof/verify/sweep/apart.h"
#include "planner/proof/verify/sweep/tool_body.h"

namespace capstan::verify {
namespace {

using geometry::Vec2;
using model::FixtureSolid;
using model::MoveKind;

constexpr double kChordMm = 0.005;
constexpr double kSlackMm = 0.01;  // of clearances: coordinates are rounded
constexpr int kPieces = 64;        // of a sloping line

/// A piece of a move: where its axis may be, and how low and how high the tip.
struct Piece {
  std::vector<Vec2> track;
  double low_mm = 0.0, high_mm = 0.0;
};

std::vector<Piece> pieces(const Move& m) {
  if (m.kind == MoveKind::kRapid) {
    const Vec2 lo{std::min(m.from.x, m.to.x), std::min(m.from.y, m.to.y)};
    const Vec2 hi{std::max(m.from.x, m.to.x), std::max(m.from.y, m.to.y)};
    return {{{lo, {hi.x, lo.y}, hi, {lo.x, hi.y}}, std::min(m.from.z, m.to.z), std::max(m.from.z, m.to.z)}};
  }
  const bool slopes = std::abs(m.from.z - m.to.z) > 1e-9 && norm(xy(m.to) - xy(m.from)) > 1e-9;
  const int n = std::max(pieces_of(m, kChordMm), slopes ? kPieces : 1);
  std::vector<Piece> out;
  geometry::Vec3 a = m.from;
  for (int i = 1; i <= n; ++i) {
    const geometry::Vec3 b = point_of(m, static_cast<double>(i) / n);
    out.push_back({{xy(a), xy(b)}, std::min(a.z, b.z), std::max(a.z, b.z)});
    a = b;
  }
  return out;
}

class FixtureChecks {
 public:
  FixtureChecks(const model::Workholding& holding, const StepMoves& step, Findings& out)
      : holding_(holding), step_(step), out_(out), body_(body_of(*step.cutter)) {
    for (const BodyPart& p : body_) widest_ = std::max(widest_, p.radius_mm);
    for (const FixtureSolid& s : holding.solids) top_ = std::max(top_, s.top_mm);
  }

  void run() {
    for (const Move& m : step_.moves) {
      if (m.kind == MoveKind::kDwell || std::min(m.from.z, m.to.z) >= top_ + holding_.clearance_mm) continue;
      const auto box = box_of(m);
      for (const FixtureSolid& s : holding_.solids) {
        if (s.outline.size() < 3 || !near(box, s)) continue;
        against(m, s);
      }
    }
  }

 private:
  [[nodiscard]] bool near(const geometry::Box3& box, const FixtureSolid& s) const {
    const double r = widest_ + holding_.clearance_mm + kChordMm;
    double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300;
    for (const Vec2 p : s.outline) {
      x0 = std::min(x0, p.x);
      x1 = std::max(x1, p.x);
      y0 = std::min(y0, p.y);
      y1 = std::max(y1, p.y);
    }
    return box.lo.x - r < x1 && box.hi.x + r > x0 && box.lo.y - r < y1 && box.hi.y + r > y0 &&
           box.lo.z < s.top_mm + holding_.clearance_mm;
  }

  void against(const Move& m, const FixtureSolid& s) {
    double gap = 1e300;
    const BodyPart* part = nullptr;
    for (const Piece& piece : pieces(m)) {
      const double flat = apart(piece.track, s.outline);
      for (const BodyPart& p : body_) {
        const double beside = flat - p.radius_mm - (is_arc(m.kind) ? kChordMm : 0.0);
        // The part passes all heights between its lowest and its highest place.
        const double above =
            std::max(piece.low_mm + p.from_mm - s.top_mm, s.bottom_mm - (piece.high_mm + p.to_mm));
        const double one = std::max(beside, above);
        if (one < gap) {
          gap = one;
          part = &p;
        }
      }
    }
    if (part == nullptr || gap >= holding_.clearance_mm - kSlackMm) return;
    say(m, s, *part, gap);
  }

  void say(const Move& m, const FixtureSolid& s, const BodyPart& part, double gap) {
    const Findings::Where at{step_.order + 1, step_.id, m.where};
    const bool rapid = m.kind == MoveKind::kRapid;
    const std::string move = std::string(rapid ? "a rapid" : "a feed move") + " to (" + plain(m.to.x) + ", " +
                             plain(m.to.y) + ", " + plain(m.to.z) + ")";
    const std::string solid =
        "'" + s.id + "' (" + s.kind + " of '" + holding_.id + "', its top at z = " + plain(s.top_mm) + ")";
    if (gap >= 0.0) {
      out_.warn(rapid ? 9 : 31, "CHK-FIXTURE-NEAR", at,
                move + ": " + to_text(part.what) + " passes " + mm(gap) + " from " + solid + "; " +
                    mm(holding_.clearance_mm) + " are to be kept",
                -gap);
      return;
    }
    const std::string text = move + ": " + to_text(part.what) + " enters " + solid + " by " + mm(-gap) +
                             (rapid ? ", axes taken as not arriving together" : "");
    if (rapid) {
      out_.error(9, "CHK-RAPID-FIXTURE", at, text, -gap);
    } else if (part.what == BodyPart::What::kCutter) {
      out_.error(31, "CHK-CLAMP-CUT", at, text, -gap);
    } else {
      out_.error(12, "CHK-HOLDER-FIXTURE", at, text, -gap);
    }
  }

  const model::Workholding& holding_;
  const StepMoves& step_;
  Findings& out_;
  std::vector<BodyPart> body_;
  double widest_ = 0.0, top_ = -1e300;
};

}  // namespace

void check_bodies(const model::Plan& plan, const std::vector<StepMoves>& steps, Findings& findings) {
  std::set<std::string> said;
  for (const StepMoves& step : steps) {
    if (step.cutter == nullptr || !(step.cutter->cutting_diameter_mm > 0.0)) continue;
    const std::string what = not_described(*step.cutter);
    if (what.empty()) continue;
    // Where something stands around the piece this is no small matter.
    const bool fixtures = step.setup < plan.setups.size() && !plan.setups[step.setup].holding.solids.empty();
    if (!said.insert(step.cutter->id + (fixtures ? "/held" : "")).second) continue;
    const Findings::Where at{step.order + 1, step.id, -1};
    findings.unproved(fixtures ? Severity::kWarning : Severity::kNote, 12, "CHK-BODY-UNDECIDED", at,
                      "tool '" + step.cutter->id + "': " + what);
  }
}

void check_fixtures(const model::Plan& plan, const std::vector<StepMoves>& steps, Findings& findings) {
  for (const StepMoves& step : steps) {
    if (step.cutter == nullptr || step.setup >= plan.setups.size()) continue;
    const model::Workholding& holding = plan.setups[step.setup].holding;
    if (holding.solids.empty() || !(step.cutter->cutting_diameter_mm > 0.0)) continue;
    FixtureChecks(holding, step, findings).run();
  }
}

}  // namespace capstan::verify
