#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "casebase/tune/card.h"
#include "casebase/tune/picture.h"
#include "planner/door/app/command/cases/shared.h"
#include "planner/door/service/explain/values.h"
#include "planner/door/service/outputs.h"
#include "planner/door/service/reading.h"
#include "planner/door/service/tuning/planned_limits.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "planner/physics/mechanics/force/force_law.h"
#include "tooling/shop/material/material.h"

// `capstan cases tune`: what cases would change of a plan's speeds and feeds and of the models, why, and how
// sure that is. Nothing is changed by it.

namespace capstan::app {
namespace {

namespace tune = casebase::tune;
using service::table;
using Tree = nlohmann::ordered_json;

struct StepAdvice {
  std::string name;
  tune::PlannedStep planned;
  std::vector<tune::Evidence> evidence;
  tune::Advice advice;
};

struct MaterialCorrections {
  std::string material, tool;
  tune::Corrections corrections;
  tune::CorrectionHandbook handbook;
  model::WorkMaterial card;  ///< with the corrections in it
};

std::string signed_percent(double ln) {
  const double p = 100.0 * (std::exp(ln) - 1.0);
  return (p >= 0.0 ? "+" : "") + fixed(p, 0) + " %";
}

std::string value_text(const StepAdvice& s, const tune::Setting& at) {
  return "vc " + trimmed(s.planned.step.bound.vc_m_min * std::exp(at.ln_vc), 1) + " m/min (" +
         signed_percent(at.ln_vc) + "), fz " + trimmed(s.planned.step.bound.fz_mm * std::exp(at.ln_fz), 4) +
         " mm (" + signed_percent(at.ln_fz) + ")";
}

std::string step_text(const StepAdvice& s) {
  const tune::Advice& a = s.advice;
  std::string out = s.name + "\n  " + a.why + "\n";
  if (a.heard == 0 && a.refused.empty()) return out;
  out += "  start with  " + value_text(s, a.proven.at) + ": " +
         (a.proven.at == tune::Setting{} ? std::string("the handbook's")
                                         : std::to_string(a.proven.repeats.good) + " good parts") +
         "\n";
  if (!(a.trial.at == a.proven.at)) {
    out += "  try next    " + value_text(s, a.trial.at) + ": time " + fixed(a.trial.time, 2) + " +- " +
           fixed(a.trial.time * a.trial.time_std_dev, 2) + " of the handbook's\n";
  }
  std::vector<std::vector<std::string>> rows = {{"limit", "load at handbook", "95 % below", "exceeded in",
                                                 "load at trial", "95 % below", "exceeded in"}};
  for (std::size_t i = 0; i < a.trial.limits.size(); ++i) {
    const auto cells = [&](const tune::SettingView& v, std::vector<std::string>& row) {
      const tune::LimitView& l = v.limits[i];
      const bool load = l.load > 0.0;
      row.push_back(load ? fixed(l.load, 2) : "-");
      row.push_back(load ? fixed(l.load_95, 2) : "-");
      row.push_back(fixed(100.0 * l.probability, 1) + " %");
    };
    std::vector<std::string> row = {a.trial.limits[i].name};
    cells(a.handbook, row);
    cells(a.trial, row);
    rows.push_back(std::move(row));
  }
  out += table(rows, "  ");
  if (a.days_in_future > 0)
    out += "  " + counted(a.days_in_future, "case lies", "cases lie") + " in the future: no day of its own\n";
  for (const tune::Refused& r : a.refused) {
    out += "  not heard: case " + s.evidence[r.index].id.substr(0, 12) + ": " + r.why + "\n";
  }
  return out;
}

std::vector<const tune::Corrected*> models_of(const tune::Corrections& c) {
  std::vector<const tune::Corrected*> out;
  if (c.force) out.push_back(&c.force->how);
  if (c.life) out.push_back(&c.life->how);
  if (c.time) out.push_back(&c.time->how);
  for (const auto& [cutter, bores] : c.bores) out.push_back(&bores.how);
  return out;
}

std::string corrections_text(const MaterialCorrections& m) {
  std::string out;
  for (const tune::Corrected* c : models_of(m.corrections)) {
    if (out.empty()) out = m.material + ", " + m.tool + "\n";
    out += "  " + c->model + ": " + counted(c->cases, "case", "cases") + " on " +
           counted(c->groups, "edge or part", "edges or parts") +
           (c->doubted > 0 ? ", " + std::to_string(c->doubted) + " of them doubted" : std::string());
    if (c->left_out) {
      out += "; each left out in turn: rms " + fixed(c->left_out->rms, 3) + ", " +
             fixed(100.0 * c->left_out->within_90, 0) + " % within the interval of 90 %";
    }
    out += "\n";
    std::vector<std::vector<std::string>> rows = {{"term", "handbook", "now", "unit"}};
    for (const tune::CorrectedTerm& t : c->terms) {
      rows.push_back({t.name, trimmed(t.handbook, 3) + " +- " + trimmed(t.handbook_std_dev, 3),
                      trimmed(t.value, 3) + " +- " + trimmed(t.std_dev, 3), t.unit.empty() ? "-" : t.unit});
    }
    out += table(rows, "    ");
  }
  if (const auto& f = m.corrections.force) {
    // What of it reaches a margin: spread in the root of the sum of squares of mechanics/loads/margin.h.
    mechanics::ForceMargin before{.spread = m.handbook.force.spread}, after{.spread = f->spread};
    out += "  kc1.1 " + trimmed(m.card.kc11_n_mm2, 0) + " N/mm2, mc " + trimmed(m.card.mc, 3) + " (" +
           m.card.sources.back().second + ")\n  margin of forces: " + fixed(before.factor(), 2) +
           " with the handbook's spread, " + fixed(after.factor(), 2) + " with that of the cases\n";
  }
  if (const auto& t = m.corrections.time) {
    for (const double block_s : {0.02, 0.1, 1.0}) {
      out += "  blocks of " + trimmed(block_s, 2) + " s take " + fixed(t->factor(block_s), 2) +
             " of the planned time, +- " + fixed(100.0 * t->ln_std_dev(block_s), 0) + " %\n";
    }
  }
  for (const auto& [cutter, bores] : m.corrections.bores) {
    for (const double ratio : {3.0, 6.0}) {
      out += "  " + bores.how.model + " at 0.05 mm per turn, stick-out " + trimmed(ratio, 0) +
             " D: " + fixed(bores.deviation_mm(0.05, ratio), 3) + " +- " +
             fixed(bores.half_90_mm(0.05, ratio), 3) + " mm (90 of 100)\n";
    }
  }
  return out;
}

Tree view_json(const StepAdvice& s, const tune::SettingView& v) {
  Tree t;
  t["vc_m_min"] = s.planned.step.bound.vc_m_min * std::exp(v.at.ln_vc);
  t["fz_mm"] = s.planned.step.bound.fz_mm * std::exp(v.at.ln_fz);
  t["time_ratio"] = v.time;
  t["time_ln_std_dev"] = v.time_std_dev;
  t["probability_of_exceeding"] = v.probability;
  if (v.hard > 0.0) t["planner_load_over_limit"] = v.hard;
  t["good_parts"] = v.repeats.good;
  t["edges"] = v.repeats.edges;
  t["days"] = v.repeats.days;
  Tree limits = Tree::array();
  for (const tune::LimitView& l : v.limits) {
    Tree one;
    one["limit"] = l.name;
    if (l.load > 0.0) {
      one["load_over_limit"] = l.load;
      one["load_over_limit_95"] = l.load_95;
    }
    one["probability"] = l.probability;
    limits.push_back(std::move(one));
  }
  t["limits"] = std::move(limits);
  return t;
}

std::string all_json(const std::vector<StepAdvice>& steps, const std::vector<MaterialCorrections>& materials,
                     const std::vector<std::string>& taken) {
  Tree list = Tree::array();
  for (const StepAdvice& s : steps) {
    Tree t;
    t["step"] = s.name;
    t["cases"] = s.advice.heard;
    t["edges"] = s.advice.edges;
    t["days"] = s.advice.days;
    t["why"] = s.advice.why;
    t["lowered"] = s.advice.lowered;
    t["another_cut"] = s.advice.another_cut;
    if (!s.advice.binding.empty()) t["binding"] = s.advice.binding;
    t["handbook"] = view_json(s, s.advice.handbook);
    t["proven"] = view_json(s, s.advice.proven);
    t["trial"] = view_json(s, s.advice.trial);
    Tree refused = Tree::array();
    for (const tune::Refused& r : s.advice.refused)
      refused.push_back({{"case", s.evidence[r.index].id}, {"why", r.why}});
    t["not_heard"] = std::move(refused);
    list.push_back(std::move(t));
  }
  Tree models = Tree::array();
  for (const MaterialCorrections& m : materials) {
    for (const tune::Corrected* c : models_of(m.corrections)) {
      Tree t;
      t["material_group"] = m.material;
      t["tool_class"] = m.tool;
      t["model"] = c->model;
      t["cases"] = c->cases;
      t["groups"] = c->groups;
      t["doubted"] = c->doubted;
      if (c->left_out) {
        t["left_out_rms"] = c->left_out->rms;
        t["left_out_within_90"] = c->left_out->within_90;
      }
      for (const tune::CorrectedTerm& term : c->terms) {
        t["terms"].push_back({{"name", term.name},
                              {"unit", term.unit},
                              {"handbook", term.handbook},
                              {"handbook_std_dev", term.handbook_std_dev},
                              {"value", term.value},
                              {"std_dev", term.std_dev}});
      }
      models.push_back(std::move(t));
    }
  }
  Tree out;
  out["steps"] = std::move(list);
  out["models"] = std::move(models);
  out["taken_by_planning"] = taken;
  return out.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

Result<std::vector<StepAdvice>> advise_steps(const model::Plan& plan, const casebase::CaseBase& base,
                                             const tune::TuneOptions& options, Job& job) {
  std::vector<StepAdvice> out;
  for (const model::StepResult& step : plan.steps) {
    auto planned = service::planned_step(plan, step);
    if (!planned) {
      Diagnostic d = planned.error();
      d.severity = Severity::kNote;
      job.report(std::move(d));
      continue;
    }
    StepAdvice s{
        .name = model::step_id(plan, step), .planned = *std::move(planned), .evidence = {}, .advice = {}};
    const auto near = base.within(s.planned.step.asked, casebase::kPrecedentDistance);
    if (!near) return tl::unexpected(near.error());
    for (const casebase::Neighbour& n : *near) {
      // What a planner computed is no evidence of what the machine does.
      if (n.found.origin == casebase::Origin::kSimulated) continue;
      s.evidence.push_back(tune::evidence_of(n.found, s.planned));
    }
    s.advice = tune::advise(s.evidence, tune::handbook_of(s.planned), options);
    out.push_back(std::move(s));
  }
  return out;
}

// What a predicted force holds beside the sharp one, where the plan's own margin is not kept: the usual
// margin on a machine whose feed can be turned up by a fifth (tooling/data/machines/generic_vmc.yaml).
constexpr double kUsualOverride = 1.2;

/// Corrections by material and tool class, in the order of their names.
std::vector<MaterialCorrections> correct_models(const casebase::CaseBase& base,
                                                const std::vector<model::WorkMaterial>& materials) {
  std::map<std::pair<std::string, std::string>, std::vector<casebase::Case>> groups;
  for (casebase::Case& c : base.cases()) {
    auto& group = groups[{c.asked.material_group, c.asked.tool_class}];
    group.push_back(std::move(c));
  }
  std::vector<MaterialCorrections> out;
  for (const auto& [names, cases] : groups) {
    MaterialCorrections m{
        .material = names.first, .tool = names.second, .corrections = {}, .handbook = {}, .card = {}};
    for (const model::WorkMaterial& material : materials) {
      if (casebase::material_group_of(material) != names.first) continue;
      m.handbook.force = {material.kc11_n_mm2, material.mc, mechanics::kienzle_margin(material).spread};
      for (const model::ToolLifeLaw& law : material.life) {
        if (m.tool.starts_with(law.substrate)) m.handbook.life = law;
      }
      m.handbook.force_margin = mechanics::kienzle_margin(material, {.feed_up = kUsualOverride}).factor();
      m.card = material;
    }
    std::vector<casebase::Case> others;  // what else wore such tools tells exponents of lives
    for (const auto& [other, of_other] : groups) {
      if (other.second != names.second || other.first == names.first) continue;
      std::copy_if(of_other.begin(), of_other.end(), std::back_inserter(others),
                   [](const casebase::Case& c) { return !c.observed.wear_series_mm.samples.empty(); });
    }
    m.corrections = tune::corrections_of(cases, m.handbook, others);
    m.card = tune::corrected(std::move(m.card), m.corrections);
    if (!models_of(m.corrections).empty()) out.push_back(std::move(m));
  }
  return out;
}

/// What `plan --cases` takes of these cases on the material's card, by material and machine.
std::vector<std::string> taken_by_planning(const casebase::CaseBase& base,
                                           const std::vector<model::WorkMaterial>& materials) {
  std::map<std::pair<std::string, std::string>, std::vector<casebase::Case>> groups;
  for (casebase::Case& c : base.measured_in({}, {}, std::numeric_limits<std::size_t>::max())) {
    auto& group = groups[{c.asked.material_group, c.asked.machine_class}];
    group.push_back(std::move(c));
  }
  std::vector<std::string> out;
  for (const auto& [names, cases] : groups) {
    for (const model::WorkMaterial& card : materials) {
      if (casebase::material_group_of(card) != names.first) continue;
      const auto spread_of = [&](model::Substrate s) { return mechanics::force_margin(card, s).spread; };
      for (const tune::CardCorrection& c : tune::card_corrections(cases, card, spread_of)) {
        out.push_back(names.first + " on " + names.second + ": " + c.all_words() +
                      (c.taken() ? "; by cases " + c.named() : "; not taken: " + c.why_not));
      }
    }
  }
  return out;
}

/// A picture of each step of which cases were heard: FILE, or FILE-2.svg and on where there are more. All of
/// them or none.
Status write_pictures(const std::filesystem::path& file, const std::vector<StepAdvice>& steps,
                      const tune::TuneOptions& options, const Job& job) {
  std::vector<service::Output> pictures;
  for (const StepAdvice& s : steps) {
    if (s.advice.heard == 0) continue;
    const tune::Handbook handbook = tune::handbook_of(s.planned);
    const tune::Setting through = s.advice.trial.at;
    std::filesystem::path name = file;
    if (!pictures.empty()) {
      name.replace_filename(file.stem().string() + '-' + std::to_string(pictures.size() + 1) +
                            file.extension().string());
    }
    pictures.push_back({.path = name.string(),
                        .bytes = tune::picture_of(
                            s.name, s.advice, tune::along(s.evidence, handbook, options, through, false),
                            tune::along(s.evidence, handbook, options, through, true))});
  }
  if (pictures.empty()) {
    return fail(Diagnostic{.code = "CASE-NONE-NEAR",
                           .message = "no measured case is near a step: there is nothing to draw",
                           .hint = "leave -o out"});
  }
  return service::write_all(pictures, job);
}

}  // namespace

int run_cases_tune(Session& s) {
  if (auto ok = are_pictures(s.options.outputs); !ok) return s.end(ok.error(), kUsage);
  const auto base = casebase::CaseBase::open(*s.options.inputs.cases, s.job);
  if (!base) return s.end(base.error(), kUnreadable);
  tune::TuneOptions options;
  options.today = tune::day_of(s.options.today);
  if (!s.options.today.empty() && !options.today) {
    return s.end(Diagnostic{.code = "USAGE-DATE",
                            .message = "--today " + s.options.today + " is no date",
                            .expected = "a date, e.g. 2016-06-28"},
                 kUsage);
  }
  std::vector<StepAdvice> steps;
  if (!s.options.files.empty()) {
    const std::string& path = s.options.files.front();
    auto bytes = read_file(path);
    if (!bytes) return s.end(bytes.error(), kUnreadable);
    const auto plan = service::read_plan(*std::move(bytes), path, s.job);
    if (!plan) return s.end(plan.error(), kUnreadable);
    auto advised = advise_steps(*plan, *base, options, s.job);
    if (!advised) return s.end(advised.error(), kImpossible);
    steps = *std::move(advised);
  }
  const auto cards = tooling::shipped_materials();
  if (!cards) return s.end(cards.error(), kUnreadable);
  const std::vector<MaterialCorrections> materials = correct_models(*base, *cards);
  if (!report_faults(s, *base)) {
    return s.end(
        Diagnostic{
            .code = "CASE-LOST",
            .message =
                "cases of it were altered, are gone or could not be read now, and they may speak against "
                "what the others say: nothing is proposed",
            .file = casebase::name_of(*s.options.inputs.cases),
            .hint = "try again where reading failed, else restore it from a copy, or export its cases into a "
                    "new one"},
        kImpossible);
  }
  if (!s.options.outputs.empty()) {
    if (auto drawn = write_pictures(s.options.outputs.front(), steps, options, s.job); !drawn)
      return s.end(drawn.error(), kImpossible);
  }
  std::size_t faster = 0, lowered = 0;
  std::string out;
  for (const StepAdvice& step : steps) {
    out += step_text(step);
    faster += step.advice.proven.time < 1.0 && !(step.advice.proven.at == tune::Setting{}) ? 1 : 0;
    lowered += step.advice.lowered ? 1 : 0;
  }
  for (const MaterialCorrections& m : materials) out += corrections_text(m);
  const std::vector<std::string> taken = taken_by_planning(*base, *cards);
  if (!taken.empty()) {
    out += "plan --cases takes of these\n";
    for (const std::string& line : taken) out += "  " + line + "\n";
  }
  if (out.empty()) out = "no measured case corrects anything\n";
  s.summary = counted(steps.size(), "step", "steps") + ": " + std::to_string(faster) +
              " with proven faster values, " + std::to_string(lowered) + " that cases speak against";
  return print(s.options.json ? all_json(steps, materials, taken) : out) ? kDone : kImpossible;
}

}  // namespace capstan::app
