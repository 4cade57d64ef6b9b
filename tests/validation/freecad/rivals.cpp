#include "tests/validation/freecad/rivals.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <sstream>
#include <utility>

#include "planner/ground/base/number.h"
#include "planner/model/plan/cutter/ramp.h"
#include "tests/support/corpus.h"
#include "tests/support/shop.h"
#include "tests/validation/freecad/foreign_path.h"

namespace capstan::validation {
namespace {

/// make_programs.py was asked for this cutter.
constexpr double kDiameterMm = 10.0;
/// Its moves are cut into pieces of this length, mm: the shortest that our own are split into, a fifth of the
/// diameter (optimise::split_moves).
constexpr double kPieceMm = kDiameterMm / 5.0;
/// How far below the pocket's floor the block goes on, mm.
constexpr int kBelowMm = 15;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

bool roughs(const model::Plan& plan, const model::StepResult& s) {
  const auto* step = plan.model.get<model::MachiningWorkingstep>(s.step);
  return step != nullptr && plan.model.holds<model::BottomAndSideRoughMilling>(step->its_operation);
}

struct Roughing {
  double time_s = 0.0, removed_mm3 = 0.0;
  std::optional<std::size_t> first;
};

Roughing roughing_of(const model::Plan& plan) {
  Roughing out;
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    const model::StepResult& s = plan.steps[i];
    if (!roughs(plan, s)) continue;
    if (!out.first) out.first = i;
    out.time_s += s.cutting_s + s.rapid_s;
    for (std::size_t k = 0; s.sections && k < s.sections->size(); ++k)
      out.removed_mm3 += s.sections->removed_mm3[k];
  }
  return out;
}

/// What "pocket_10_0_60_1_3.ngc" says: operation, depth, boss, step-over, levels.
struct Recipe {
  std::string operation;
  int depth_mm = 0, boss_mm = 0, stepover = 0, levels = 0;
};

Recipe recipe_of(const std::filesystem::path& file) {
  Recipe r;
  std::string words = file.stem().string();
  std::replace(words.begin(), words.end(), '_', ' ');
  std::istringstream(words) >> r.operation >> r.depth_mm >> r.boss_mm >> r.stepover >> r.levels;
  return r;
}

/// "pocket 60 % × 1"
std::string name_of(const Recipe& r) {
  return r.operation + " " + std::to_string(r.stepover) + " % × " + std::to_string(r.levels);
}

/// How steeply a path goes down into the material, rad; moves shorter than kSlopeMm are rounded too coarsely.
double steepest_rad(const model::CutterPath& path) {
  constexpr double kSlopeMm = 1.0;
  double out = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double fall = path.z[i - 1] - path.z[i], way = model::move_length(path, i);
    if (path.role[i] == model::MoveRole::kRamp && way > kSlopeMm)
      out = std::max(out, std::asin(std::clamp(fall / way, -1.0, 1.0)));
  }
  return out;
}

/// By how much FreeCAD misses a slope that it is asked for: chords of its arcs, and of its offsets.
constexpr double kSlopeMissed = 1.1;

std::vector<std::string> programs_of(const RivalCase& c) {
  std::vector<std::string> out;
  for (const auto& f : std::filesystem::recursive_directory_iterator(testing::source_dir() +
                                                                     "/tests/validation/freecad/programs")) {
    const Recipe r = recipe_of(f.path());
    if (r.depth_mm == c.depth_mm && r.boss_mm == c.boss_mm && r.levels > 0) out.push_back(f.path().string());
  }
  std::sort(out.begin(), out.end());
  return out;
}

/// The rival's plan; fails where no feed keeps the limits.
Result<model::Plan> planned(const Match& m, const model::CutterPath& path, const pipeline::Inputs& in) {
  Job quiet;
  auto plan = with_path(m.ours, m.step, in_pieces(path, kPieceMm), in, quiet);
  if (!plan) return plan;
  const auto at = roughing_of(*plan).first;
  if (!at) return fail("VAL-LIMIT", "the path is not planned");
  const auto& exceeded = plan->steps[*at].exceeded;
  if (!exceeded.empty())
    return fail("VAL-LIMIT", "the path exceeds " + exceeded.front().name + " at any feed");
  return plan;
}

}  // namespace

std::vector<RivalCase> rival_cases() {
  std::vector<RivalCase> out;
  for (const int boss_mm : {0, 14}) {
    for (const char* material : {"EN AW-6061", "C45", "X5CrNi18-10"}) {
      for (const int depth_mm : {10, 20}) out.push_back({material, depth_mm, boss_mm});
    }
  }
  return out;
}

std::string rival_part(const RivalCase& c) {
  const std::string floor = std::to_string(c.depth_mm), under = std::to_string(c.depth_mm + kBelowMm);
  std::string text = testing::slurp(testing::source_dir() + "/examples/reference_pocket.p21");
  text = replaced(std::move(text), "(0.,0.,-10.)", "(0.,0.,-" + floor + ".)");
  text = replaced(std::move(text), "(0.,0.,-25.)", "(0.,0.,-" + under + ".)");
  text = replaced(std::move(text), "100.,80.,25.", "100.,80.," + under + ".");
  if (c.boss_mm == 0) return text;
  text = replaced(std::move(text), "#32,#35,(),$", "#32,#35,(#46),$");
  return replaced(std::move(text), "ENDSEC;\nEND-ISO",
                  "#44=TOLERANCED_LENGTH_MEASURE(" + std::to_string(c.boss_mm) +
                      ".,#39);\n#45=CIRCULAR_CLOSED_PROFILE($,#44);\n"
                      "#46=BOSS('BOSS',#4,(),#32,#35,#45,$);\nENDSEC;\nEND-ISO");
}

Result<Match> match(const RivalCase& c, const std::string& machine) {
  Job job;
  pipeline::ShopFiles files;
  files.machine = machine;
  auto in = pipeline::load_shop(files, job);
  if (!in) return tl::unexpected(in.error());
  in->material_name = c.material;
  std::erase_if(in->library, [](const model::Cutter& k) {
    return k.cutter_class != model::CutterClass::kEndmill ||
           std::abs(k.cutting_diameter_mm - kDiameterMm) > 1e-9;
  });
  const auto part = pipeline::read_plan(rival_part(c), "rival.p21", job);
  if (!part) return tl::unexpected(part.error());
  auto made = pipeline::bind_checked(*part, *in, {}, job);
  if (!made) return tl::unexpected(made.error());
  Match out;
  const Roughing ours = roughing_of(made->plan);
  if (!ours.first) return fail("VAL-LIMIT", std::string("no roughing is planned in ") + c.material);
  out.ours = std::move(made->plan);
  out.step = *ours.first;
  out.ours_s = ours.time_s;
  out.removed_mm3 = ours.removed_mm3;
  const std::string& chosen = out.ours.steps[out.step].cutter_id;
  const auto cutter = std::find_if(in->library.begin(), in->library.end(),
                                   [&](const model::Cutter& k) { return k.id == chosen; });
  if (cutter == in->library.end()) return fail("VAL-PLAN", "no cutter " + chosen);
  const model::Ramp may = model::ramp_of(*cutter, out.ours.material);
  for (const std::string& file : programs_of(c)) {
    const auto path = path_of_program(testing::slurp(file), 0.0);
    if (!path) return tl::unexpected(path.error());
    const Recipe recipe = recipe_of(file);
    if (steepest_rad(*path) > kSlopeMissed * may.angle_rad) continue;
    if (static_cast<double>(c.depth_mm) / recipe.levels > may.bore_depth_mm + 1e-9) continue;
    Rival r;
    r.name = name_of(recipe);
    r.adaptive = recipe.operation == "adaptive";
    for (const bool constant : {false, true}) {
      in->constant_feeds = constant;
      auto plan = planned(out, *path, *in);
      if (!plan) {
        plan.error().message = r.name + ": " + plan.error().message;
        return tl::unexpected(plan.error());
      }
      const Roughing roughing = roughing_of(*plan);
      (constant ? r.constant_s : r.scheduled_s) = roughing.time_s;
      r.removed_mm3 = roughing.removed_mm3;
      (constant ? r.constant : r.scheduled) = *std::move(plan);
    }
    out.rivals.push_back(std::move(r));
  }
  return out;
}

const Rival* fastest(const Match& m, bool adaptive, bool constant) {
  const Rival* out = nullptr;
  const auto time = [&](const Rival& r) { return constant ? r.constant_s : r.scheduled_s; };
  for (const Rival& r : m.rivals) {
    if (r.adaptive == adaptive && (out == nullptr || time(r) < time(*out))) out = &r;
  }
  return out;
}

}  // namespace capstan::validation
