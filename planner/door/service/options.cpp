#include "planner/door/service/options.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <sstream>
#include <utility>

#include "planner/controls/controls.h"
#include "planner/controls/profile/profile.h"
#include "planner/door/late/branches.h"
#include "planner/door/late/changes.h"
#include "planner/door/service/cad/cad_options.h"
#include "planner/door/service/edits/edit_options.h"
#include "planner/door/service/formats.h"
#include "planner/door/service/state/state_options.h"
#include "planner/ground/base/nearest_names.h"
#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/cutter_class.h"
#include "planner/model/features/fit/general.h"
#include "planner/physics/mechanics/loads/margin.h"

namespace capstan::service {
namespace {

template <class T>
using Named = std::vector<std::pair<std::string, T>>;

// In alphabetical order, as help texts list them.
const Named<pipeline::Reopen>& reopen_words() {
  static const Named<pipeline::Reopen> kWords = {{"all", pipeline::Reopen::kAll},
                                                 {"operations", pipeline::Reopen::kOperations},
                                                 {"technology", pipeline::Reopen::kTechnology},
                                                 {"tools", pipeline::Reopen::kTools}};
  return kWords;
}
const Named<pipeline::Bind>& bind_words() {
  static const Named<pipeline::Bind> kWords = {{"all", pipeline::Bind::kAll},
                                               {"none", pipeline::Bind::kNone},
                                               {"strategy", pipeline::Bind::kStrategy},
                                               {"tools", pipeline::Bind::kTools}};
  return kWords;
}
const Named<pipeline::Objective>& objective_words() {
  static const Named<pipeline::Objective> kWords = {{"cost", pipeline::Objective::kCost},
                                                    {"profit", pipeline::Objective::kProfit},
                                                    {"time", pipeline::Objective::kTime}};
  return kWords;
}
const Named<optimise::Solver>& solver_words() {
  static const Named<optimise::Solver> kWords = [] {
    Named<optimise::Solver> words;
    for (const auto& [solver, word] : optimise::kSolvers) words.emplace_back(word, solver);
    std::sort(words.begin(), words.end());
    return words;
  }();
  return kWords;
}

/// "nlopt or ipopt": in the order of their rows.
const char* solver_help() {
  static const std::string kText = [] {
    std::string out;
    for (const auto& [solver, word] : optimise::kSolvers)
      out += (out.empty() ? "" : " or ") + std::string(word);
    return out;
  }();
  return kText.c_str();
}

template <class T>
std::vector<std::string> names(const Named<T>& of) {
  std::vector<std::string> out;
  for (const auto& [name, value] : of) out.push_back(name);
  return out;
}

/// The words were looked at before.
template <class T>
T value_of(const Named<T>& of, const std::string& word) {
  return std::find_if(of.begin(), of.end(), [&](const auto& p) { return p.first == word; })->second;
}

using Text = const std::string&;

std::string set_rules(Request& r, Text text) {
  std::error_code error;
  if (!std::filesystem::is_directory(text, error)) return "'" + text + "' is no folder";
  r.rules = text;
  return {};
}
std::string set_revenue(Request& r, Text text) {
  const auto v = parse_double(text);
  if (!v || !std::isfinite(*v) || !(*v > 0.0)) return "'" + text + "' is no amount above 0, e.g. 12.5";
  r.revenue = *v;
  return {};
}
std::string set_margin(Request& r, Text text) {
  if (!mechanics::margin_policy(text))
    return "'" + text + "' is no margin; expected " + mechanics::margins_asked();
  r.margin = text;
  return {};
}
std::string set_general_tolerance(Request& r, Text text) {
  if (text.find(',') != std::string::npos)
    return "'" + text + "' has a comma; decimals are written with a point";
  const auto read = model::parse_general(text);
  if (!read) return read.error().message + "; expected " + read.error().expected;
  r.general_tolerance = text;
  return {};
}
/// How wide an edge the rules break is theirs to say.
std::string set_edges(Request& r, Text text) {
  const auto v = parse_double(text);
  if (!v || !std::isfinite(*v) || *v < 0.0) return "'" + text + "' is no width of 0 or more in mm, e.g. 0.3";
  r.edge_break_mm = *v;
  return {};
}
std::vector<std::string> control_words() {
  std::vector<std::string> words;
  for (const controls::Dialect* d : controls::dialects()) words.emplace_back(d->id);
  std::sort(words.begin(), words.end());
  return words;
}
/// The words of `--assume`; each is a value of one name.
const std::vector<std::string>& assume_words() {
  static const std::vector<std::string> kWords = [] {
    std::vector<std::string> words;
    for (const auto s : {model::Substrate::kCarbide, model::Substrate::kHss})
      words.push_back(kAssumeToolMaterial + std::string(model::to_text(s)));
    return words;
  }();
  return kWords;
}

std::string set_deadline(Request& r, Text text) {
  r.deadline = parse_duration(text);
  return r.deadline ? "" : "'" + text + "' is no time above 0, e.g. 200ms or 2s";
}

std::string set_measured(Request& r, Text text) {
  const auto read = late::parse_measured(text);
  if (!read) return read.error().message + "; expected " + read.error().expected;
  r.measured = text;
  return {};
}

std::string set_may(Request& r, Text text) {
  const auto may = late::Decisions::parse(text);
  if (!may) return may.error().message + "; expected " + may.error().expected;
  r.may = text;
  return {};
}

const char* allow_help() {
  static const std::string kText = "write the program (" + endings_of(Holds::kProgram) + ", " +
                                   endings_of(Holds::kToolTable) +
                                   ") although the check condemns it: its header and markers say why, and it "
                                   "stops (M0) before each condemned step";
  return kText.c_str();
}
const char* profile_help() {
  static const std::string kText = [] {
    std::string out = "hold plans against what this control is able to do: ";
    for (const std::string& id : controls::profile_ids()) out += id + ", ";
    return out + "or a profile's file";
  }();
  return kText.c_str();
}
constexpr const char* kStrict = "write nothing when there are findings";

/// The same help for `plan` and `bind`.
constexpr std::array<const char*, kVerbs> both(const char* text) { return {text, text, nullptr}; }

std::vector<Option> table() {
  constexpr const char* kShop =
      "the shop's settings: a file, or none; without it shop.yaml of this folder or of ~/.config/capstan";
  std::vector<Option> out = {
      {"shop",
       Value::kText,
       {kShop, kShop, kShop},
       [](Request& r, Text t) { return r.shop = t, std::string(); },
       {}},
      {"machine",
       Value::kText,
       {"machine: a file, or the id of a built-in one", "machine: a file, or the id of a built-in one",
        "machine that programs run on"},
       [](Request& r, Text t) { return r.machine = t, std::string(); },
       {}},
      {"control",
       Value::kWord,
       {"the machine's control, instead of the one that its file names; its options are at their defaults",
        "the machine's control, instead of the one that its file names",
        "the control that the programs are for, instead of the machine's"},
       [](Request& r, Text t) { return r.control = t, std::string(); },
       control_words()},
      {"tools",
       Value::kText,
       {"tool library: a file, `generic` (the default), or `generic-inch`, which has inch sizes, too "
        "(the default of CAD parts drawn in inches)",
        "the loaded tools: a tool table or library; without it the plan's own, in its tool numbers",
        "tool library with the programs' tools"},
       [](Request& r, Text t) { return r.tools = t, std::string(); },
       {}},
      {"material",
       Value::kText,
       both("work material, instead of the part's: a name, like:NAME, or a file of one"),
       [](Request& r, Text t) { return r.material = t, std::string(); },
       {}},
      {"stock",
       Value::kText,
       both("raw piece: block:+2 (the part and 2 mm all round) or box:x0,y0,z0,x1,y1,z1"),
       [](Request& r, Text t) { return parse_stock(t, r); },
       {}},
      {"mesh-unit",
       Value::kWord,
       of_plan("unit of an STL mesh, which does not say it: mm (the default) or inch"),
       [](Request& r, Text t) { return r.mesh_unit = t, std::string(); },
       {"inch", "mm"}},
      {"objective", Value::kWord,
       both("what is made least or most: time, cost, or profit per time (needs --revenue)"),
       [](Request& r, Text t) { return r.objective = value_of(objective_words(), t), std::string(); },
       names(objective_words())},
      {"margin", Value::kText,
       both("how far above the expected loads the loads are that limits are held against: careful "
            "(19 of 20 cuts stay below), usual (5 of 6; the default), bold (7 of 10), or a number of "
            "standard deviations, e.g. 1.28 (9 of 10)"),
       &set_margin, mechanics::margin_names()},
      {"revenue",
       Value::kText,
       both("what a piece brings less its material, in the currency of the machine's cost per hour"),
       &set_revenue,
       {}},
      {"feeds",
       Value::kWord,
       both("scheduled: along the path, as each cross section allows (the default); constant: one feed, "
            "the largest that all of them bear"),
       [](Request& r, Text t) { return r.feeds = t, std::string(); },
       {"constant", "scheduled"}},
      {"rules", Value::kText, both("a folder of rule tables to add to the built-in ones"), &set_rules, {}},
      {"cases",
       Value::kText,
       both("a case base to begin from"),
       [](Request& r, Text t) { return r.cases = t, std::string(); },
       {}},
      {"cache",
       Value::kText,
       both("a folder that keeps results of stages from call to call: a plan that differs little from an "
            "earlier one is made in a fraction of the time, byte for byte the same"),
       [](Request& r, Text t) { return r.cache = t, std::string(); },
       {}},
      {"solver", Value::kWord, both(solver_help()),
       [](Request& r, Text t) { return r.solver = value_of(solver_words(), t), std::string(); },
       names(solver_words())},
      {"workholding",
       Value::kText,
       both("how the piece is held: an id or file of fixtures, auto (the first of the shop's that does), "
            "or none"),
       [](Request& r, Text t) { return r.workholding = t, std::string(); },
       {}},
      {"general-tolerance",
       Value::kText,
       both("for sizes without one: \"ISO 2768-m\", \"ISO 22081 0.2\" or \"+-0.1\""),
       &set_general_tolerance,
       {}},
      {"assume", Value::kWord,
       both("what tools are made of whose file or list does not say it, instead of what is likely"),
       [](Request& r, Text t) { return r.assume = t, std::string(); }, assume_words()},
      {"batch",
       Value::kWhole,
       both("pieces to be made"),
       [](Request& r, Text t) { return r.batch = std::stoi(t), std::string(); },
       {},
       1,
       1000000},
      {"edges", Value::kText, both("chamfer edges that the part leaves sharp, mm"), &set_edges, {}},
      {"bind", Value::kWord, of_plan("how far decisions are closed: none, strategy, tools or all"),
       [](Request& r, Text t) { return r.bind = value_of(bind_words(), t), std::string(); },
       names(bind_words())},
      {"reopen", Value::kWord, of_plan("what to plan anew although the file has it"),
       [](Request& r, Text t) { return r.reopen = value_of(reopen_words(), t), std::string(); },
       names(reopen_words())},
      {"deadline",
       Value::kText,
       of_bind("e.g. 200ms or 2s; a plan that comes later ends with 5"),
       &set_deadline,
       {}},
      {"next",
       Value::kWhole,
       of_bind(
           "bind so many workingsteps only: the first of which something is open, or those from --from on"),
       [](Request& r, Text t) { return r.next = std::stoul(t), std::string(); },
       {},
       1,
       1000000},
      {"from",
       Value::kWhole,
       of_bind("the first workingstep that is bound, as the workplan counts them; those before are cut"),
       [](Request& r, Text t) { return r.from = std::stoul(t), std::string(); },
       {},
       1,
       1000000},
      {"stop-at-deadline",
       Value::kFlag,
       of_bind(
           "give nothing, in time, where nothing is checked by the deadline; without it the plan comes late"),
       [](Request& r, Text t) { return r.stop_at_deadline = t == "yes", std::string(); },
       {}},
      {"measured",
       Value::kText,
       of_bind("what was measured, by names of NC variables: wall=0.04,floor=-0.01; decides if and while "
               "statements"),
       &set_measured,
       {}},
      {"may",
       Value::kText,
       {"what a control may decide of the plan: tools, feeds, depths, strategy, order, alternatives, "
        "conditions "
        "(with commas), all or none",
        "what may be decided: tools, feeds, depths, strategy, order, alternatives, conditions (with commas), "
        "all or "
        "none; no more than the plan itself allows",
        nullptr},
       &set_may,
       {}},
      {"time",
       Value::kText,
       of_bind("when this is, for the plan's record of late bindings"),
       [](Request& r, Text t) { return r.time = t, std::string(); },
       {}},
      {"strict",
       Value::kFlag,
       both(kStrict),
       [](Request& r, Text t) { return r.strict = t == "yes", std::string(); },
       {}},
      {"allow-findings",
       Value::kFlag,
       both(allow_help()),
       [](Request& r, Text t) { return r.allow_findings = t == "yes", std::string(); },
       {},
       0,
       0,
       "strict"},
      {"without",
       Value::kWord,
       both("sections: plans are written without the cross sections along paths; each step's peak stays"),
       [](Request& r, Text /*t*/) { return r.sections = false, std::string(); },
       {"sections"}},
      {.name = "draw",
       .help = both("of pictures (.svg, .png): the steps whose paths are drawn, by number or by a pattern of "
                    "their names or their features', instead of all"),
       .set = [](Request& r, Text t) { return r.draw.push_back(t), std::string(); },
       .repeatable = true},
      {"profile",
       Value::kText,
       {nullptr, profile_help(), profile_help()},
       [](Request& r, Text t) { return r.profile = t, std::string(); },
       {}},
      {"schema",
       Value::kFlag,
       {nullptr, nullptr, "what does not follow the schema is a finding, too"},
       [](Request& r, Text t) { return r.schema = t == "yes", std::string(); },
       {}},
      {"threads",
       Value::kWhole,
       {"worker threads; results do not depend on it", "worker threads; results do not depend on it",
        "worker threads; results do not depend on it"},
       [](Request& r, Text t) { return r.threads = static_cast<unsigned>(std::stoi(t)), std::string(); },
       {},
       1,
       256,
       {},
       true},
  };
  // Before what any command takes.
  const auto before = [&out](std::string_view name, const std::vector<Option>& more) {
    out.insert(std::find_if(out.begin(), out.end(), [&](const Option& o) { return o.name == name; }),
               more.begin(), more.end());
  };
  before("objective", cad_options());
  before("bind", edit_options());
  before("may", state_options());
  for (Option& o : out) {
    static constexpr std::string_view kOfShop[] = {
        "machine", "control", "tools", "material", "stock",       "objective",         "margin", "feeds",
        "rules",   "cases",   "cache", "solver",   "workholding", "general-tolerance", "assume", "edges"};
    o.of_shop = std::find(std::begin(kOfShop), std::end(kOfShop), o.name) != std::end(kOfShop);
  }
  return out;
}

/// The fault of the text itself, before its meaning is looked at; empty: none.
std::string not_taken(const Option& o, const std::string& text) {
  const auto list = [](const std::vector<std::string>& words) {
    std::string out;
    for (const auto& w : words) out += (out.empty() ? "" : ", ") + w;
    return out;
  };
  if (text.find_first_not_of(" \t\n\r") == std::string::npos)  // blanks name nothing
    return "the value is empty; leave the option out instead";
  if (o.value == Value::kWord && std::find(o.words.begin(), o.words.end(), text) == o.words.end())
    return "'" + text + "' is none of " + list(o.words);
  if (o.value == Value::kFlag && text != "yes" && text != "no") return "'" + text + "' is neither yes nor no";
  if (o.value == Value::kWhole) {
    const auto v = parse_double(text);
    if (!v || !(*v >= o.least && *v <= o.most) || *v != std::floor(*v))
      return "'" + text + "' is no whole number from " + std::to_string(o.least) + " to " +
             std::to_string(o.most);
  }
  return {};
}

}  // namespace

std::span<const Option> options() {
  static const std::vector<Option> kOptions = table();
  return kOptions;
}

const Option* find_option(std::string_view name) {
  const auto all = options();
  const auto at = std::find_if(all.begin(), all.end(), [&](const Option& o) { return o.name == name; });
  return at == all.end() ? nullptr : &*at;
}

Status set(Request& request, std::string_view name, const std::string& text) {
  const Option* option = find_option(name);
  if (option == nullptr) {
    std::vector<std::string> known;
    for (const Option& o : options()) known.emplace_back(o.name);
    Diagnostic d = unknown_name("option", std::string(name), known, "capstan plan --help");
    d.code = "OPTION-UNKNOWN";
    return fail(std::move(d));
  }
  std::string wrong = not_taken(*option, text);
  // A whole number may be written as one with a point; what sets it wants digits.
  const std::string given =
      wrong.empty() && option->value == Value::kWhole ? trimmed(*parse_double(text), 0) : text;
  if (wrong.empty()) wrong = option->set(request, given);
  if (wrong.empty()) {
    request.given.insert(std::string(name));
    return {};
  }
  return fail({.code = "OPTION-VALUE", .message = request.sign + std::string(name) + ": " + wrong});
}

std::string contradiction(const Request& r) {
  const bool profit = r.objective == pipeline::Objective::kProfit;
  if (profit && !r.revenue)
    return r.sign + "objective profit: needs " + r.sign +
           "revenue, what a piece brings less its material, in the currency of the machine's cost per hour";
  if (!profit && r.revenue)
    return r.sign + "revenue: only " + r.sign + "objective profit asks what a piece brings";
  if (r.strict && r.allow_findings)
    return r.sign + "strict: excludes " + r.sign + "allow-findings, which writes in spite of findings";
  if (r.features_only && r.bind != pipeline::Bind::kAll)
    return r.sign + "features-only: plans nothing, so that " + r.sign + "bind has nothing to say";
  return {};
}

std::optional<std::chrono::milliseconds> parse_duration(const std::string& text) {
  std::string number = text;
  double factor = 1.0;
  if (number.ends_with("ms")) {
    number.resize(number.size() - 2);
  } else if (number.ends_with("s")) {
    number.pop_back();
    factor = 1000.0;
  }
  const auto v = parse_double(number);
  constexpr double kLongest = 1e9;  // ms, above eleven days
  if (!v || !(*v * factor >= 1.0) || *v * factor > kLongest) return std::nullopt;
  return std::chrono::milliseconds(static_cast<long>(*v * factor));
}

std::string parse_stock(const std::string& text, Request& into) {
  into.stock_text = text;
  if (text.starts_with("block:")) {
    const std::string rest = text.substr(text.find(':') + 1);
    const auto v = parse_double(rest.starts_with("+") ? rest.substr(1) : rest);
    if (!v || *v < 0.0) return "'" + rest + "' is no allowance in mm, e.g. block:+2";
    into.stock_allowance_mm = *v;
    return {};
  }
  if (!text.starts_with("box:")) return "'" + text + "' is neither block:+2 nor box:x0,y0,z0,x1,y1,z1";
  std::vector<double> v;
  std::istringstream numbers(text.substr(4));
  for (std::string one; std::getline(numbers, one, ',');) {
    const auto d = parse_double(one);
    if (!d) return "'" + one + "' is not a number";
    v.push_back(*d);
  }
  if (v.size() != 6) return "a box needs six numbers, " + std::to_string(v.size()) + " are given";
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(v[i] < v[i + 3]))
      return "the box is empty: each of its first three numbers must be below its partner";
  }
  into.stock = geometry::Box3{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
  return {};
}

}  // namespace capstan::service
