#include "planner/proof/verify/told/raw_piece.h"

#include <algorithm>
#include <cmath>

#include "planner/ground/base/stopping.h"
#include "planner/proof/verify/copies/copies.h"
#include "planner/proof/verify/sweep/grid/grid.h"
#include "planner/proof/verify/sweep/sweep.h"
#include "planner/proof/verify/told/phrases.h"

namespace capstan::verify {
namespace {

/// Of the cell: a disc so wide holds a centre wherever it stands, for half a cell's diagonal is 0.71 of it.
constexpr double kPin = 0.75;
/// By which a ball's or a drill's end stands back from its tip that near the axis; default, unsourced.
constexpr double kFormMm = 0.3;

/// A flat or a ball end of this diameter.
CutterOutline ended(model::CutterClass is, double diameter_mm) {
  model::Cutter c;
  c.cutter_class = is;
  c.cutting_diameter_mm = diameter_mm;
  return CutterOutline(outline_of(c));
}
CutterOutline flat(double diameter_mm) { return ended(model::CutterClass::kEndmill, diameter_mm); }

/// Whether its end is at least a ball, whatever its corner is.
bool holds_a_ball(const model::Cutter& c) { return is_raked(c.cutter_class) || is_ball(c.cutter_class); }

bool sound(const model::Cutter* c) {
  return c != nullptr && std::isfinite(c->cutting_diameter_mm) && c->cutting_diameter_mm > 0.0;
}

}  // namespace

std::optional<ToldRaw> told_raw(const Program& program) {
  if (program.markers.empty()) return std::nullopt;
  const StepMarker& first = program.markers.front();
  if (first.setup <= 0) return std::nullopt;
  const std::string head = "set-up " + std::to_string(first.setup) + ": the raw piece reaches from";
  const std::vector<Phrase> begins = phrases_of(head), whole = phrases_of(head + " X0 Y0 Z0 to X0 Y0 Z0");
  const auto& told = program.told;
  for (std::size_t k = 0; k < told.size() && told[k].line < first.line; ++k) {
    std::vector<Phrase> said = phrases_of(told[k].text);
    if (!stands_at(begins, said, 0, 0.0)) continue;
    // A narrow control's comment goes on in the next one.
    for (std::size_t j = k + 1; j < told.size() && said.size() < whole.size(); ++j) {
      for (Phrase& p : phrases_of(told[j].text)) said.push_back(std::move(p));
    }
    // With more behind it the piece was cut before.
    if (said.size() != whole.size()) continue;
    std::vector<double> numbers;
    for (std::size_t i = begins.size(); i < said.size(); ++i) {
      if (said[i].word != whole[i].word) return std::nullopt;
      if (said[i].word.empty()) numbers.push_back(said[i].number);
    }
    ToldRaw out{first.setup, {}};
    out.box.lo = {numbers[0], numbers[1], numbers[2]};
    out.box.hi = {numbers[3], numbers[4], numbers[5]};
    const geometry::Vec3 size = out.box.size();
    const bool is = size.x > 0.0 && size.y > 0.0 && size.z > 0.0 && std::isfinite(size.x * size.y * size.z);
    return is ? std::optional<ToldRaw>(out) : std::nullopt;
  }
  return std::nullopt;
}

void check_told_raw(const ProgramCase& c, const ToldRaw& raw, const std::vector<StepMoves>& steps,
                    Findings& findings) {
  const auto setup_of = [&](const StepMoves& s) {
    return s.order == 0 ? 0 : c.program.markers[s.order - 1].setup;
  };
  // Wider above than its diameter says: what it leaves of walls is not known.
  const bool tapers = std::any_of(steps.begin(), steps.end(), [](const StepMoves& s) {
    return s.cutter != nullptr && s.cutter->cutter_class == model::CutterClass::kTaperedEndmill;
  });
  double smallest = 1e300;
  for (const StepMoves& s : steps) {
    if (sound(s.cutter)) smallest = std::min(smallest, s.cutter->cutting_diameter_mm);
  }
  const geometry::Vec3 size = raw.box.size();
  Grid grid({raw.box.lo.x, raw.box.lo.y}, {raw.box.hi.x, raw.box.hi.y}, cell_for(size.x * size.y, smallest),
            kMaximumCells);
  grid.begin_level(raw.box.hi.z, raw.box.lo.z);
  grid.floor = raw.box.lo.z;
  for (const StepMoves& s : steps) {
    if (s.order > 0 && setup_of(s) != raw.setup) return;
    if (!sound(s.cutter)) {
      const bool cuts = std::any_of(s.moves.begin(), s.moves.end(), [](const Move& m) {
        return m.kind != model::MoveKind::kRapid && m.kind != model::MoveKind::kDwell;
      });
      if (cuts) return;  // what it takes away is not known
      continue;
    }
    const double diameter = s.cutter->cutting_diameter_mm;
    const CutterOutline outline = flat(diameter);
    const CutterOutline within = !tapers && holds_a_ball(*s.cutter)
                                     ? ended(model::CutterClass::kBallEndmill, diameter)
                                     : flat(std::min(diameter, 2.0 * kPin * grid.cell()));
    for (const Move& m : s.moves) {
      poll();
      if (m.kind != model::MoveKind::kRapid) {
        (void)cut(grid, m, outline, {.contact = false});
        continue;
      }
      geometry::Vec2 where;
      const double dip = rapid_collision(grid, m, within, kRapidClearanceMm, where);
      if (!(dip > kFormMm)) continue;
      const bool falls = m.to.z < m.from.z - 1e-9 && norm(xy(m.to) - xy(m.from)) < 1e-9;
      findings.unproved(Severity::kWarning, falls ? 10 : 9, falls ? "CHK-RAPID-DOWN" : "CHK-RAPID",
                        {s.order + 1, s.id, m.where},
                        (falls ? "a rapid goes down to z = " + plain(m.to.z)
                               : "a rapid at z = " + plain(std::min(m.from.z, m.to.z)) +
                                     ", axes taken as not arriving together,") +
                            " runs " + mm(dip) + " into the raw piece that the header says, at (" +
                            plain(where.x) + ", " + plain(where.y) +
                            "), as far as this program has left it; check with the plan");
    }
    grid.find_top_after_cuts();
  }
}

}  // namespace capstan::verify
