#include "tests/sweep/sweep.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <regex>

#include "planner/door/pipeline/program_check.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "planner/physics/mechanics/constants.h"
#include "planner/physics/motion/time.h"
#include "tests/support/shop.h"
#include "tests/sweep/catalogue.h"

namespace capstan::testing::sweep {
namespace {

/// Moves that are too short to come to speed do no harm; as the check has it.
constexpr double kHarmlessMm = 1.0;
/// Feeds are written with few decimals.
constexpr double kWritten = 0.01;
/// Of a zone, what one wall may be off.
constexpr double kWallOfZone = 0.5;

void keep(const std::string& name, const std::string& ending, const std::string& text) {
  if (const char* folder = std::getenv("CAPSTAN_SWEEP_KEEP"); folder != nullptr)
    (void)write_file(std::string(folder) + "/" + name + ending, text);
}

/// What is fed sideways; drills, reamers, taps and sinks are fed by the turn.
bool mills(const model::Cutter& c) { return !model::has(c.cutter_class, model::CutterTrait::kAlongAxis); }

/// The thinnest chip of the edge, and no more than what the cutter's start values say.
double least_chip(const model::Cutter& c, const model::WorkMaterial& m) {
  const bool hss = c.substrate == model::Substrate::kHss;
  double least = mechanics::least_chip_mm(c.cutting_diameter_mm, hss, m.iso_group);
  for (const auto& p : c.presets)
    if (p.fz_mm > 0.0 && (p.material_group == m.id || p.material_group == m.iso_group))
      least = std::min(least, p.fz_mm);
  return least;
}

/// Way in material below the least chip, mm, and the least feed per tooth there.
std::pair<double, double> rubbed(const model::StepResult& s, const model::Cutter& c, double least_mm) {
  double way = 0.0, thinnest = least_mm;
  if (s.path == nullptr || s.sections == nullptr) return {way, thinnest};
  const model::FeedSchedule schedule = motion::schedule_of(s);
  const std::vector<bool> cuts = cutting_moves(s);
  for (std::size_t i = 1; i < s.path->size(); ++i) {
    const bool sideways = s.path->x[i] != s.path->x[i - 1] || s.path->y[i] != s.path->y[i - 1];
    if (!cuts[i] || !sideways || s.path->kind[i] == model::MoveKind::kRapid) continue;
    const double fz = schedule.feed_mm_min[i] / (std::abs(schedule.spindle_rpm[i]) * std::max(1, c.teeth));
    if (!(fz < least_mm * (1.0 - kWritten))) continue;
    way += model::move_length(*s.path, i);
    thinnest = std::min(thinnest, fz);
  }
  return {way, thinnest};
}

}  // namespace

std::vector<bool> cutting_moves(const model::StepResult& s) {
  std::vector<bool> out(s.path->size());
  for (std::size_t k = 0; k < s.sections->size(); ++k)
    if (s.sections->csa_mm2[k] > 0.0) out[s.sections->move[k]] = true;
  return out;
}

std::string Case::name() const {
  std::string out = features().at(feature).name + "," + kMaterials[material].name + "," + kMachines[machine];
  std::replace(out.begin(), out.end(), ' ', '_');
  return out;
}

std::vector<Case> all_cases() {
  std::vector<Case> out;
  for (std::size_t f = 0; f < features().size(); ++f)
    for (std::size_t m = 0; m < std::size(kMaterials); ++m)
      for (std::size_t k = 0; k < std::size(kMachines); ++k) out.push_back({f, m, k});
  return out;
}

std::vector<Case> diagonal() {
  std::vector<Case> out;
  for (std::size_t i = 0; i < features().size(); ++i)
    // Neighbours in the list of materials are of one group: steps of five meet each of the twelve once.
    out.push_back({i, (5 * i) % std::size(kMaterials), i % std::size(kMachines)});
  return out;
}

std::vector<Case> each_once_per_machine() {
  std::vector<Case> out;
  for (std::size_t k = 0; k < std::size(kMachines); ++k)
    for (std::size_t i = 0; i < features().size(); ++i)
      out.push_back({i, (5 * i + 4 * k) % std::size(kMaterials), k});
  return out;
}

Sweep::Sweep() {
  Job quiet;
  for (const char* machine : kMachines) {
    pipeline::ShopFiles files;
    files.machine = machine;
    shops_.push_back(pipeline::load_shop(files, quiet));
  }
}

Outcome Sweep::plan(const Case& c) {
  Outcome out;
  const Feature& feature = features().at(c.feature);
  if (!shops_[c.machine]) {
    out.failed = shops_[c.machine].error().message;
    return out;
  }
  Job quiet;
  pipeline::Inputs in = *shops_[c.machine];
  in.material_name = kMaterials[c.material].name;
  if (feature.allowance_mm > 0.0) in.stock_allowance_mm = feature.allowance_mm;
  const bool mesh = feature.text.starts_with("solid");
  const auto read = pipeline::read_plan(feature.text, c.name() + (mesh ? ".stl" : ".p21"), quiet);
  if (!read) {
    out.failed = to_text(read.error());
    return out;
  }
  auto made = pipeline::bind_checked(*read, in, {}, quiet);
  if (!made) {
    out.failed = to_text(made.error());
    return out;
  }
  out.made = *std::move(made);
  pipeline::CheckedProgram program;
  out.findings = pipeline::findings_of(out.made, quiet, &program);
  const model::Plan& plan = out.made.plan;
  if (const auto time = motion::time_of(plan)) out.plan_s = time->at_feed_s() + time->rapid_s + time->link_s;
  out.catalogue_s = catalogue_s(feature.catalogue, in.library, plan.material, plan.machine);
  if (std::getenv("CAPSTAN_SWEEP_KEEP") != nullptr) {
    keep(c.name(), mesh ? ".stl" : ".p21", feature.text);
    keep(c.name(), ".ngc", program.text);
    if (const auto json = pipeline::write_plan(plan, pipeline::Format::kJson, quiet))
      keep(c.name(), ".json", *json);
  }
  return out;
}

std::string broken(const Case& c, const Outcome& o) {
  if (!o.failed.empty()) return "no plan: " + o.failed + "\n";
  std::string out;
  for (const auto& f : o.findings)
    if (f.severity == Severity::kError) out += f.code + " " + f.step + ": " + f.message + "\n";
  const model::Plan& plan = o.made.plan;
  const double zone = features().at(c.feature).wall_zone_mm;
  for (const model::StepResult& s : plan.steps) {
    const std::string id = model::step_id(plan, s);
    for (const auto& e : s.exceeded)
      out += id + ": " + e.name + " " + fixed(e.value, 4) + " exceeds " + fixed(e.limit, 4) + " " + e.unit +
             "\n";
    const model::Cutter* cutter = model::find_cutter(plan, s.cutter_id);
    if (cutter == nullptr) continue;
    if (zone > 0.0 && std::abs(s.loads.wall_error_mm) > kWallOfZone * zone)
      out += id + ": a wall error of " + fixed(s.loads.wall_error_mm, 4) + " mm in a zone of " +
             fixed(zone, 3) + "\n";
    if (!mills(*cutter)) continue;
    const double least = least_chip(*cutter, plan.material);
    // The feed per tooth bounds the chip from above only: a step whose thickest chip is thinner than the
    // least one rubs all along, however it is fed.
    if (s.loads.chip_thickness_mm > 0.0 && s.loads.chip_thickness_mm < least * (1.0 - kWritten))
      out += id + ": its thickest chip is " + fixed(s.loads.chip_thickness_mm, 5) + " of at least " +
             fixed(least, 5) + " mm\n";
    if (const auto [way, fz] = rubbed(s, *cutter, least); way > kHarmlessMm)
      out += id + ": " + fixed(way, 1) + " mm of way below the least chip, down to " + fixed(fz, 5) + " of " +
             fixed(least, 5) + " mm\n";
  }
  for (const auto& u : plan.unplanned)
    if (!helps(u.reason)) out += "a refusal that does not help: " + u.reason + "\n";
  return out;
}

bool helps(const std::string& reason) {
  static const std::regex kFigure(
      R"([0-9] ?(mm2?|um|deg|m/min|mm/min|1/min|min|s|N|Nm|kW|W|HRC|HB|%)(?![A-Za-z0-9]))");
  static const std::regex kOption("--[a-z]+");
  // What there would have to be, or is to be done.
  static const std::regex kRemedy(
      R"(\b(use|name|choose|take|allow|allowed|would|needs?|asks?|at least|at most|no [a-z -]+ of)\b)");
  if (std::regex_search(reason, kOption)) return true;
  return std::regex_search(reason, kFigure) && std::regex_search(reason, kRemedy);
}

}  // namespace capstan::testing::sweep
