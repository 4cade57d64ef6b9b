#include "tests/removal/simulation/compare.h"

#include <sstream>

namespace capstan::testing::removal {
namespace {

constexpr std::size_t kSpeck = 1;  // points: one alone lies within what rounding of the text explains
constexpr double kApart = 3.0;     // mm: left-over further apart is told apart

void add(Amount& a, const Point& p, double beyond, double volume) {
  if (a.points == 0) a.around = {p, p};
  ++a.points;
  a.volume_mm3 += volume;
  if (beyond > a.deepest_mm) {
    a.deepest_mm = beyond;
    a.worst = p;
  }
  a.around.lo = {std::min(a.around.lo.x, p.x), std::min(a.around.lo.y, p.y), std::min(a.around.lo.z, p.z)};
  a.around.hi = {std::max(a.around.hi.x, p.x), std::max(a.around.hi.y, p.y), std::max(a.around.hi.z, p.z)};
}

bool near(const Amount& a, const Point& p) {
  return p.x > a.around.lo.x - kApart && p.x < a.around.hi.x + kApart && p.y > a.around.lo.y - kApart &&
         p.y < a.around.hi.y + kApart && p.z > a.around.lo.z - kApart && p.z < a.around.hi.z + kApart;
}

std::string place(const Point& p) {
  std::ostringstream out;
  out.precision(4);
  out << "(" << p.x << ", " << p.y << ", " << p.z << ")";
  return out.str();
}

std::string told(const Amount& a) {
  std::ostringstream out;
  out.precision(4);
  out << a.volume_mm3 << " mm3, up to " << a.deepest_mm << " mm at " << place(a.worst) << ", within "
      << place(a.around.lo) << " to " << place(a.around.hi);
  return out.str();
}

}  // namespace

// Along a column the depth changes by no more than the way, so that a point deep inside speaks for those near
// it.
Comparison compare(const Stock& stock, const Target& target, double tolerance) {
  Comparison out;
  const auto& n = stock.count();
  const double h = stock.cell_z();
  const double volume = stock.point_volume();
  for (int y = 0; y < n[1]; ++y) {
    for (int x = 0; x < n[0]; ++x) {
      for (int z = 0; z < n[2];) {
        const Point p = stock.at(x, y, z);
        const double stays = target.stays(p) - tolerance;
        const double goes = stays > 0.0 ? -1.0 : target.goes(p) - tolerance;
        if (stays <= 0.0 && goes <= 0.0) {
          const double room = std::min(-stays, -goes);
          z += 1 + static_cast<int>(room / h);
          continue;
        }
        const double sure = std::max(stays, goes);
        const int run = std::min(n[2] - z, 1 + static_cast<int>(sure / h));
        for (int k = z; k < z + run; ++k) {
          if (stock.present(x, y, k) == (stays > 0.0)) continue;
          const Point q = stock.at(x, y, k);
          if (stays > 0.0) {
            add(out.gouges[stock.remover(x, y, k)], q, target.stays(q), volume);
            continue;
          }
          auto at =
              std::find_if(out.left.begin(), out.left.end(), [&](const Amount& a) { return near(a, q); });
          if (at == out.left.end()) at = out.left.insert(out.left.end(), Amount{});
          add(*at, q, target.goes(q), volume);
        }
        z += run;
      }
    }
  }
  return out;
}

bool Verdict::agrees() const {
  return gouges.empty() && left.empty() && idle.empty() && rapids.empty() && rubs.empty() && faults.empty();
}

std::string Verdict::text() const {
  std::string out;
  const auto list = [&](const char* what, const std::vector<std::string>& lines) {
    for (const std::string& line : lines) out += std::string(what) + ": " + line + "\n";
  };
  list("fault", faults);
  list("gouge", gouges);
  list("left over", left);
  list("cuts nothing", idle);
  list("rapid through material", rapids);
  list("shank or holder through material", rubs);
  return out.empty() ? "agrees\n" : out;
}

Verdict simulate(const Motions& motions, const std::map<int, CutterBody>& cutters,
                 const std::map<int, Frame>& frames, const Box& block, const Target& target, const Grid& grid,
                 Stock* remains) {
  Verdict v;
  if (motions.status != 0) v.faults.push_back("rs274 gives status " + std::to_string(motions.status));
  if (!motions.fault.empty()) v.faults.push_back(motions.fault);
  Stock stock(block, grid.cell_mm, grid.cell_z_mm);
  std::vector<StepRemoval> records(motions.steps.size());
  v.steps = motions.steps.size() - 1;
  for (const Motion& m : motions.moves) {
    StepRemoval& record = records[m.step];
    const auto frame = frames.find(m.setup);
    const auto cutter = cutters.find(m.tool);
    if (m.from.z >= kFarAbove && m.to.z >= kFarAbove) continue;
    if (frame == frames.end() || cutter == cutters.end()) {
      record.fault = "tool " + std::to_string(m.tool) + " or set-up " + std::to_string(m.setup) +
                     " is not known to the simulation";
      continue;
    }
    if (!m.rapid && m.tool != motions.steps[m.step].tool)
      record.fault = "T" + std::to_string(m.tool) + " is in the spindle";
    stock.sweep(m, cutter->second, frame->second, record);
  }
  for (std::size_t s = 0; s < records.size(); ++s) {
    const StepRemoval& r = records[s];
    const std::string name = "'" + motions.steps[s].id + "'";
    if (!r.fault.empty()) v.faults.push_back(name + ": " + r.fault);
    if (s > 0 && r.points == 0) v.idle.push_back(name);
    if (r.by_rapid > kSpeck)
      v.rapids.push_back(name + ": " + std::to_string(r.by_rapid) + " points, one at " + place(r.rapid_at));
    if (r.by_shank > kSpeck)
      v.rubs.push_back(name + ": " + std::to_string(r.by_shank) + " points, one at " + place(r.shank_at));
  }
  const Comparison c = compare(stock, target, grid.tolerance_mm);
  for (const auto& [step, amount] : c.gouges) {
    if (amount.points > kSpeck) v.gouges.push_back("'" + motions.steps[step].id + "' " + told(amount));
  }
  for (const Amount& a : c.left) {
    if (a.points <= kSpeck) continue;
    v.left.push_back(told(a));
    v.left_at.push_back(a.worst);
  }
  if (remains != nullptr) *remains = std::move(stock);
  return v;
}

Verdict simulate(const Emitted& emitted, const Box& block, const Target& target, const Grid& grid,
                 Stock* remains) {
  Verdict none;
  std::string fault;
  const std::map<int, Frame> frames = frames_of(emitted.iso14649, fault);
  if (!fault.empty()) none.faults.push_back(fault);
  std::map<int, CutterBody> cutters;
  for (const auto& [tool, text] : cutters_of_json(emitted.json)) {
    const auto body = body_of(text);
    if (body) {
      cutters.emplace(tool, *body);
    } else {
      none.faults.push_back("no body of a " + text.kind);
    }
  }
  if (!none.faults.empty()) return none;
  return simulate(read_motions(emitted.program, emitted.tool_table), cutters, frames, block, target, grid,
                  remains);
}

}  // namespace capstan::testing::removal
