#include "planner/door/service/shop.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "casebase/casebase.h"

#include "planner/controls/controls.h"
#include "planner/door/service/edits/edits_file.h"
#include "planner/door/service/edits/known_names.h"
#include "planner/door/service/options.h"
#include "planner/door/service/state/machine_state.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/nearest_names.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/stopping.h"
#include "planner/making/given/edits/value_limits.h"
#include "planner/making/given/tool_material.h"
#include "planner/model/plan/edit/deciding.h"
#include "planner/model/plan/edit/provenance.h"
#include "planner/model/plan/resources/by_cases.h"
#include "planner/model/plan/resources/shop_texts.h"
#include "rules/engine/check.h"
#include "rules/rules.h"
#include "tooling/library/cutters/generic.h"
#include "tooling/library/library.h"
#include "tooling/shop/data/tree.h"
#include "tooling/shop/fixtures/fixtures.h"
#include "tooling/shop/machine/machine.h"
#include "tooling/shop/material/material.h"

namespace capstan::service {
namespace {

constexpr const char* kDefault = "built-in default";

std::string objective_text(pipeline::Objective o) {
  switch (o) {
    case pipeline::Objective::kTime:
      return "time";
    case pipeline::Objective::kCost:
      return "cost";
    case pipeline::Objective::kProfit:
      return "profit";
  }
  return "time";
}

/// Name of an option in the provenance of a plan.
std::string option(const Request& o, const std::string& name) {
  const auto of_shop = o.from_shop.find(name.substr(0, name.find(' ')));
  return (of_shop == o.from_shop.end() ? o.sign : of_shop->second + ": ") + name;
}

/// A material that is at hand, as a plan holds it.
Status take_material(pipeline::Inputs& in, model::WorkMaterial own) {
  if (auto ok = tooling::add_start_values(own, in.library); !ok) return ok;
  in.material_name = own.id;
  in.materials.push_back(std::move(own));
  return {};
}

/// The plan's provenance of that name, or null.
const model::Provenance* made_with(const model::Plan& plan, std::string_view what) {
  for (const auto& p : plan.provenance) {
    if (p.what == what) return &p;
  }
  return nullptr;
}

Status material_of(const Request& o, const model::Plan& plan, pipeline::Inputs& in, Job& job) {
  auto& p = in.provenance;
  if (o.material) {
    if (auto ok = name_material(in, *o.material, job); !ok) return ok;
    p.push_back({"material", *in.material_name,
                 option(o, *in.material_name == *o.material ? "material" : "material " + *o.material)});
    return {};
  }
  const auto* before = made_with(plan, "material");
  if (before == nullptr) return {};
  in.material_of_plan = true;
  const bool shipped = std::any_of(in.materials.begin(), in.materials.end(),
                                   [&](const auto& m) { return m.id == before->value; });
  if (!shipped && plan.material.id == before->value) {
    // A shop's own: the plan has what its file said.
    if (auto ok = take_material(in, model::without_cases(plan.material)); !ok) return ok;
  } else {
    in.material_name = before->value;
  }
  p.push_back(*before);
  return {};
}

/// What is taken of tools that do not state their material: the caller's word, also that of an earlier
/// planning; else what the plan took them to be before.
template <class Carried>
void assumptions(const Request& o, const model::Plan& plan, pipeline::Inputs& in, const Carried& carried) {
  std::string text;
  carried("assume", o.assume, text);
  given::ToolMaterialWish& wish = in.tool_materials;
  wish = {};
  if (text.starts_with(kAssumeToolMaterial)) {
    wish.assumed = model::substrate_from_text(text.substr(std::string_view(kAssumeToolMaterial).size()));
    wish.assumed_by = option(o, "assume ") + text;
  }
  wish.of_plan = model::assumed_tool_materials(plan);
  given::assume_materials(in.library, wish);
}

/// The option that a plan was made with still holds when it is planned again, unless another is given.
void choices(const Request& o, const model::Plan& plan, pipeline::Inputs& in) {
  auto& p = in.provenance;
  in.stock = o.stock;
  in.stock_allowance_mm = o.stock_allowance_mm;
  if (!o.stock_text.empty()) {
    p.push_back({"stock", o.stock_text, option(o, "stock")});
  } else if (const auto* before = made_with(plan, "stock"); before != nullptr && !plan.stock.box.empty()) {
    in.stock = plan.stock.box;
    in.stock_of_plan = true;
    p.push_back(*before);
  }
  in.objective = o.objective.value_or(pipeline::Objective::kTime);
  p.push_back({"objective", objective_text(in.objective), o.objective ? option(o, "objective") : kDefault});
  if (o.margin) in.margin = mechanics::margin_policy(*o.margin);
  in.revenue = o.revenue;
  if (o.revenue) p.push_back({"revenue", trimmed(*o.revenue, 4) + " a piece", option(o, "revenue")});
  const auto carried = [&](const char* what, const std::optional<std::string>& given, std::string& into) {
    if (given) {
      into = *given;
      p.push_back({what, into, option(o, what)});
    } else if (const auto* before = made_with(plan, what)) {
      into = before->value;
      constexpr std::string_view kKept = ", of the plan";
      p.push_back({what, into,
                   before->source.ends_with(kKept) ? before->source : before->source + std::string(kKept)});
    }
  };
  carried("general-tolerance", o.general_tolerance, in.general_tolerance);
  carried("workholding", o.workholding, in.workholding);
  std::string feeds = "scheduled";
  carried("feeds", o.feeds, feeds);
  in.constant_feeds = feeds == "constant";
  assumptions(o, plan, in, carried);
  in.batch = o.batch;
  if (o.batch > 1) p.push_back({"batch", std::to_string(o.batch), option(o, "batch")});
  in.edge_break_mm = o.edge_break_mm;
  if (const auto* before = made_with(plan, "may")) p.push_back(*before);
  if (o.edge_break_mm > 0.0) p.push_back({"edges", trimmed(o.edge_break_mm, 4) + " mm", option(o, "edges")});
  in.solver = o.solver.value_or(optimise::kSolvers.front().solver);
  p.push_back({"solver", optimise::word_of(in.solver), o.solver ? option(o, "solver") : kDefault});
}

/// Why something is taken that nobody named.
std::string by_default(const std::optional<Request::Suited>& suited) {
  return suited ? kDefault + (", " + suited->why) : kDefault;
}

Status machine_of(const Request& o, const model::Plan& plan, pipeline::Inputs& in, Job& job) {
  const auto shipped = tooling::shipped_machines();
  const bool known = std::find(shipped.begin(), shipped.end(), plan.machine.id) != shipped.end();
  const auto* before = made_with(plan, "machine");
  if (!o.machine && has_data(plan.machine)) {
    in.machine = plan.machine;
    in.provenance.push_back(
        before != nullptr ? *before : model::Provenance{"machine", in.machine.id, "the plan's own"});
    return {};
  }
  const bool named = !o.machine && known;
  if (!o.machine && !named && !plan.machine.id.empty()) {
    Diagnostic d = unknown_name("machine", plan.machine.id, shipped, "capstan machines list");
    d.file = plan.file_name;
    d.hint =
        "the plan was made for it and does not hold its data: name one with " + o.sign + "machine; " + d.hint;
    return fail(std::move(d));
  }
  auto machine = tooling::load_machine(o.machine           ? *o.machine
                                       : named             ? plan.machine.id
                                       : o.machine_of_part ? o.machine_of_part->name
                                                           : std::string(tooling::kDefaultMachine),
                                       job);
  if (!machine) return tl::unexpected(machine.error());
  in.machine = *std::move(machine);
  if (!o.machine && !named && o.machine_of_part)
    job.note("SHOP-MACHINE", "no machine is named, and " + o.machine_of_part->why +
                                 ": the program is made for '" + in.machine.id + "'; name yours with " +
                                 o.sign + "machine");
  if (named && before != nullptr) {
    in.provenance.push_back(*before);
  } else {
    in.provenance.push_back({"machine", in.machine.id,
                             o.machine ? option(o, "machine " + *o.machine) : by_default(o.machine_of_part)});
  }
  return {};
}

/// The control that the caller names in place of the machine's.
void take_control(const Request& o, pipeline::Inputs& in, Job& job) {
  if (!o.control || *o.control == in.machine.control.dialect) return;
  in.machine = controls::with_control(std::move(in.machine), *o.control);
  in.provenance.push_back({"control", *o.control, option(o, "control")});
  // Travels, speeds and feeds in the program are those of whichever machine this is.
  const auto named_by_nobody = [](const model::Provenance& p) {
    return p.what == "machine" && p.source.starts_with(kDefault);
  };
  if (std::any_of(in.provenance.begin(), in.provenance.end(), named_by_nobody))
    job.note("SHOP-MACHINE", "no machine is named: the program for " + *o.control + " is made for machine '" +
                                 in.machine.id +
                                 "', whose travels, speeds and options may not be yours; name yours with " +
                                 o.sign + "machine");
}

/// Warns of gaps and contradictions in a shop's own tables; planning continues, for the deciding rows are
/// sound.
void judge_rules(const rules::RuleBase& base, Job& job) {
  constexpr std::size_t kMostTold = 10;
  const auto findings = rules::check(base);
  for (std::size_t i = 0; i < std::min(kMostTold, findings.size()); ++i) {
    const auto& f = findings[i];
    job.report({.code = std::string(rules::code_of(f.fault)),
                .severity = Severity::kWarning,
                .message = f.text(),
                .file = f.file,
                .line = f.line});
  }
  if (findings.size() > kMostTold)
    job.warn("RULE-MORE", std::to_string(findings.size() - kMostTold) +
                              " further findings in the rules; capstan rules check --rules shows them all");
}

/// Why edges cannot be broken so wide, with the widths that the tables know; nothing when they can.
std::optional<Diagnostic> edges_wrong(const Request& o, const pipeline::Inputs& in) {
  const double width = in.edge_break_mm;
  const rules::Table* table = in.rules.table("edge_break");
  const auto fact = rules::find_fact("edge_break_mm");
  if (!(width > 0.0) || table == nullptr || !fact) return std::nullopt;
  const auto at = std::find(table->facts.begin(), table->facts.end(), *fact);
  if (at == table->facts.end()) return std::nullopt;
  const auto side = static_cast<std::size_t>(at - table->facts.begin());
  std::string ranges;
  for (const rules::Row& row : table->rows) {
    if (row.chains.empty()) continue;
    const rules::Side& s = row.when[side];
    if (rules::holds(s, width)) return std::nullopt;
    const std::string range = "from " + trimmed(s.from, 3) + " to below " + trimmed(s.below, 3) + " mm";
    if (ranges.find(range) == std::string::npos) ranges += (ranges.empty() ? "" : ", ") + range;
  }
  return Diagnostic{.code = "APP-EDGES",
                    .message = o.sign + "edges " + trimmed(width, 4) + ": no rule breaks edges so wide",
                    .expected = "0 for none, or a width " + (ranges.empty() ? "that rules know" : ranges)};
}

/// Reads what holds the piece before anything is planned: a file that cannot be read is no failure of
/// planning.
std::optional<Diagnostic> holding_wrong(const std::string& how, const std::vector<tooling::Fixture>& own,
                                        Job& job) {
  if (how == "auto" || how == "none") return std::nullopt;
  auto fixtures = tooling::known_fixtures(own, job);
  if (!fixtures || tooling::find_fixture(*fixtures, how) != nullptr) return std::nullopt;
  auto text = read_file(how, tooling::kDataFileCap);
  if (!text && only_a_name(how))
    return unknown_name("fixture", how, tooling::ids_of(*fixtures), tooling::kListFixtures);
  if (!text) {
    text.error().hint = "workholding is auto, none, the id of a fixture, or a file";
    return text.error();
  }
  Job silent;  // its diagnostics are reported when it is used
  auto file = tooling::read_holding(*text, how, silent, own);
  if (file) return std::nullopt;
  for (const Diagnostic& d : silent.diagnostics()) {
    if (!(d == file.error())) job.report(d);
  }
  return file.error();
}

/// The shop's texts; where it has none now, those that the plan was made with.
void take_texts(const Request& o, const model::Plan& plan, pipeline::Inputs& in) {
  for (const model::Provenance& p : o.texts.empty() ? plan.provenance : o.texts) {
    if (model::is_shop_text(p)) in.provenance.push_back(p);
  }
}

/// The edits of this call: those of its file, then the others.
Result<std::vector<model::Edit>> edits_of_call(const Request& o, Job& job) {
  std::vector<model::Edit> out;
  if (o.edits_file) {
    auto of_file = load_edits(*o.edits_file, job);
    if (!of_file) return of_file;
    out = *std::move(of_file);
  }
  out.insert(out.end(), o.edits.begin(), o.edits.end());
  return out;
}

/// What the operator wants: a file says all of it, but for what the caller adds; without a file what the plan
/// was made with holds, too. Only what this call names must be known here: what a plan was made without need
/// not be at the machine that it comes to.
Result<std::vector<model::Edit>> edits_of(const Request& o, const model::Plan& plan,
                                          const std::vector<model::Cutter>& library, Job& job) {
  auto of_call = edits_of_call(o, job);
  if (!of_call) return of_call;
  if (auto ok = known_names(*of_call, library, plan); !ok) return tl::unexpected(ok.error());
  std::vector<model::Edit> out;
  if (!o.edits_file) out = model::edits_of(plan);
  for (model::Edit& e : with_tool_names(*std::move(of_call), library, plan)) {
    if (std::none_of(out.begin(), out.end(), [&](const auto& x) { return model::says_the_same(x, e); }))
      out.push_back(std::move(e));
  }
  return out;
}

}  // namespace

Result<std::vector<tooling::Fixture>> own_fixtures(const std::vector<std::string>& files, Job& job) {
  std::vector<tooling::Fixture> out;
  for (const std::string& file : files) {
    auto of_file = tooling::load_fixtures(file, job);
    if (!of_file) return of_file;
    for (tooling::Fixture& f : *of_file) {
      if (tooling::find_fixture(out, f.id) != nullptr)
        return fail({.code = "HOLD-TWICE",
                     .message = "fixture '" + f.id + "' is in an earlier file of the shop's, too",
                     .file = file,
                     .hint = "give one of them another id"});
      out.push_back(std::move(f));
    }
  }
  return out;
}

bool has_data(const model::Machine& machine) { return !machine.axes[0].name.empty(); }

Status name_material(pipeline::Inputs& in, const std::string& given, Job& job) {
  if (!tooling::names_a_material_file(given)) {
    in.material_name = given;
    return {};
  }
  auto own = tooling::load_material(given, in.materials, job);
  if (!own) return tl::unexpected(own.error());
  return take_material(in, *std::move(own));
}

Result<pipeline::Inputs> open_shop(const Request& o, const model::Plan& plan, Job& job,
                                   const rules::RuleBase* shipped) {
  pipeline::Inputs in;
  if (auto ok = machine_of(o, plan, in, job); !ok) return tl::unexpected(ok.error());
  take_control(o, in, job);
  take_state(o.state, o.sign, in.machine, in.provenance, job);

  poll();
  // The sizes that a plan was made with are there when it is read again.
  const auto* before = made_with(plan, "tools");
  const bool inch_before = before != nullptr && before->value.starts_with(tooling::kGenericInch);
  const std::string tools = o.tools           ? *o.tools
                            : o.tools_of_part ? o.tools_of_part->name
                            : inch_before     ? std::string(tooling::kGenericInch)
                                              : std::string(tooling::kGeneric);
  if (!o.tools && o.tools_of_part)
    job.note("SHOP-TOOLS", "no tools are named, and " + o.tools_of_part->why + ": taken is the library '" +
                               tools + "'; name yours with " + o.sign + "tools");
  auto library = tooling::load_library(
      tools, job,
      {.mm_per_unit = {}, .offsets_against_reference = in.machine.control.offsets_against_reference});
  if (!library) return tl::unexpected(library.error());
  in.library = *std::move(library);
  in.provenance.push_back({"tools", tools + ", " + std::to_string(in.library.size()) + " cutters",
                           o.tools                           ? option(o, "tools " + *o.tools)
                           : inch_before && !o.tools_of_part ? before->source
                                                             : by_default(o.tools_of_part)});
  if (!o.holders.all.empty()) {
    in.holders = o.holders;
    tooling::give_holders(in.library, in.holders, job);
    std::string ids;
    for (const std::string& id : in.holders.by_default) ids += (ids.empty() ? "" : ", ") + id;
    in.provenance.push_back({"holders", ids.empty() ? "those that tools name" : ids, in.holders.source});
  }

  poll();
  auto materials = tooling::shipped_materials();
  if (!materials) return tl::unexpected(materials.error());
  in.materials = *std::move(materials);
  in.provenance.push_back(
      {"materials", "shipped table, " + std::to_string(in.materials.size()) + " materials", kDefault});

  for (const std::string& file : o.materials) {
    auto own = tooling::load_material(file, in.materials, job);
    if (!own) return tl::unexpected(own.error());
    in.provenance.push_back({"materials", own->id, o.shop.value_or("") + ": materials " + file});
    if (auto ok = tooling::add_start_values(*own, in.library); !ok) return tl::unexpected(ok.error());
    in.materials.push_back(*std::move(own));
  }

  poll();
  if (shipped != nullptr && !o.rules) {
    in.rules = *shipped;
  } else {
    auto rules = rules::load_rules(o.rules.value_or(""), job);
    if (!rules) return tl::unexpected(rules.error());
    in.rules = *std::move(rules);
  }
  in.provenance.push_back({"rules",
                           o.rules ? "shipped tables and " + *o.rules : std::string("shipped tables"),
                           o.rules ? option(o, "rules " + *o.rules) : kDefault});
  poll();
  if (o.rules) judge_rules(in.rules, job);

  auto fixtures = own_fixtures(o.fixtures, job);
  if (!fixtures) return tl::unexpected(fixtures.error());
  in.own_fixtures = *std::move(fixtures);
  if (o.workholding) {
    if (auto wrong = holding_wrong(*o.workholding, in.own_fixtures, job)) return fail(*std::move(wrong));
  }
  if (o.cases) {
    auto base = casebase::CaseBase::open(*o.cases, job);
    if (!base) return tl::unexpected(base.error());
    if (!base->whole()) {
      job.report({.code = "CASE-LOST",
                  .severity = Severity::kWarning,
                  .message =
                      "cases of it were altered or are gone: what went well raises no value, lowers no "
                      "force and makes no life longer; what failed still binds, and edges may be worn "
                      "more than is told",
                  .file = casebase::name_of(*o.cases),
                  .hint = "restore it from a copy, or plan without it"});
    }
    in.cases = std::make_shared<const casebase::CaseBase>(*std::move(base));
  }
  if (o.cache) {
    auto memo = memo::Memo::in_folder(*o.cache);
    if (!memo) return tl::unexpected(memo.error());
    in.memo = *std::move(memo);
  }
  in.backends = o.backends;
  return in;
}

Status take_choices(const Request& o, const model::Plan& plan, pipeline::Inputs& in, Job& job) {
  if (auto ok = material_of(o, plan, in, job); !ok) return ok;
  choices(o, plan, in);
  if (auto wrong = edges_wrong(o, in)) return fail(*std::move(wrong));
  if (o.cases) in.provenance.push_back({"cases", casebase::name_of(*o.cases), "named by the caller"});
  take_texts(o, plan, in);
  auto edits = edits_of(o, plan, in.library, job);
  if (!edits) return tl::unexpected(edits.error());
  in.edits = *std::move(edits);
  if (auto ok = given::within_machine(in.edits, in.machine, plan.file_name); !ok) return ok;
  if (o.edits_file)
    in.provenance.push_back(
        {std::string(model::kEditsFile), *o.edits_file, option(o, "edits " + *o.edits_file)});
  return {};
}

Result<pipeline::Inputs> gather(const Request& o, const model::Plan& plan, Job& job) {
  auto in = open_shop(o, plan, job);
  if (!in) return in;
  if (auto ok = take_choices(o, plan, *in, job); !ok) return tl::unexpected(ok.error());
  return in;
}

void take_tools_of_plan(const Request& o, const model::Plan& plan, pipeline::Inputs& in, Job& job) {
  std::vector<model::Cutter> own;
  for (const model::Cutter& c : plan.cutters) {
    if (c.pocket <= 0) continue;
    own.push_back(c);
    own.back().loaded = true;
  }
  if (own.empty()) return;
  job.note("APP-TOOLS", "no " + option(o, "tools") + ": the plan's own " + std::to_string(own.size()) +
                            (own.size() == 1 ? " cutter" : " cutters") +
                            " count as loaded, in the plan's tool numbers");
  in.provenance.push_back({"tools", "those of the plan", "no " + option(o, "tools") + " is given"});
  in.library = std::move(own);
}

}  // namespace capstan::service
