#include "planner/files/from_cad/asked/threads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "planner/ground/base/number.h"
#include "planner/model/features/shape.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/placed_nouns.h"
#include "planner/model/plan/edit/edit.h"

// A CAD file draws a tapped hole as a cylinder, and most say nowhere that it is tapped. Which thread it is,
// the caller says; what follows from it is ISO 965-1: the core lies between D1 and D1 + TD1 of the thread's
// class, and a hole that is drawn with another diameter is no core of that thread.

namespace capstan::from_cad {
namespace {

/// Pitches of metric coarse threads, mm: ISO 261, table 2, to M48.
constexpr std::array<std::pair<double, double>, 26> kCoarse = {
    {{1.6, 0.35}, {2, 0.4},  {2.5, 0.45}, {3, 0.5}, {3.5, 0.6}, {4, 0.7},  {5, 0.8},  {6, 1.0},  {7, 1.0},
     {8, 1.25},   {10, 1.5}, {12, 1.75},  {14, 2},  {16, 2},    {18, 2.5}, {20, 2.5}, {22, 2.5}, {24, 3},
     {27, 3},     {30, 3.5}, {33, 3.5},   {36, 4},  {39, 4},    {42, 4.5}, {45, 4.5}, {48, 5}}};

/// TD1 of grade 6 by pitch, micrometres: ISO 965-1, table 3.
constexpr std::array<std::pair<double, double>, 21> kCore6 = {
    {{0.35, 100}, {0.4, 112}, {0.45, 125}, {0.5, 140}, {0.6, 160},  {0.7, 180}, {0.75, 190},
     {0.8, 200},  {1, 236},   {1.25, 265}, {1.5, 300}, {1.75, 335}, {2, 375},   {2.5, 450},
     {3, 500},    {3.5, 560}, {4, 600},    {4.5, 670}, {5, 710},    {5.5, 750}, {6, 800}}};
/// Of the grades 4 to 8 over that of grade 6: ISO 965-1, 13.2.
constexpr std::array<double, 5> kOverGrade6 = {0.63, 0.8, 1.0, 1.25, 1.6};
constexpr int kFirstGrade = 4;

/// D1 = d - 2 * (5/8) H, H = P * sqrt(3) / 2: ISO 724.
double basic_core(double major, double pitch) { return major - 1.25 * 0.5 * std::sqrt(3.0) * pitch; }
/// D2 = d - 2 * (3/8) H: ISO 724.
double basic_flank(double major, double pitch) { return major - 0.75 * 0.5 * std::sqrt(3.0) * pitch; }

/// A hole that may be tapped.
struct Core {
  model::Ref<model::RoundHole> hole;
  std::string name;
  double diameter_mm = 0.0, depth_mm = 0.0;
  bool through = false;
  geometry::Placement frame;
  std::vector<std::uint32_t> faces;  ///< of a hole in several steps those of all
  bool alone = true;                 ///< no element of a hole in several steps
};

std::vector<Core> cores_of(const model::Model& m, const std::vector<MadeOf>& made) {
  std::vector<Core> out;
  for (const MadeOf& of : made) {
    const auto shapes = model::shapes_of(m, model::Ref<model::ManufacturingFeature>(of.feature));
    if (!shapes) continue;
    for (const model::FeatureShape& s : *shapes) {
      const model::AnyRef at = s.made_of.empty() ? of.feature : s.made_of.back();
      const auto* hole = m.get<model::RoundHole>(at);
      if (s.kind != model::ShapeKind::kHole || hole == nullptr || hole->change_in_diameter.set()) continue;
      out.push_back({model::Ref<model::RoundHole>(at), hole->its_id.value_or(""), s.diameter.nominal_mm,
                     s.depth_mm, s.through, s.frame, of.faces, at == of.feature});
    }
  }
  return out;
}

std::string diameter_words(const Core& c) { return c.name + " (" + trimmed(c.diameter_mm, 3) + " mm)"; }

std::string list_of(const std::vector<Core>& cores) {
  constexpr std::size_t kMost = 12;
  std::string out;
  for (std::size_t i = 0; i < cores.size() && i < kMost; ++i)
    out += (i == 0 ? "" : ", ") + diameter_words(cores[i]);
  if (cores.size() > kMost) out += " and " + std::to_string(cores.size() - kMost) + " more";
  return out.empty() ? "no round hole" : out;
}

tl::unexpected<Diagnostic> wrong(std::string_view text, const std::string& what) {
  return fail({.code = "OPTION-THREAD",
               .message = "the thread '" + std::string(text) + "': " + what,
               .expected = "HOLES=SIZE, such as 'HOLE 3=M8:16', 'HOLE*=M10x1', '#120=M6-6H-LH:12'",
               .hint = "sizes are in mm; the depth of full thread stands after the colon"});
}

/// A core's diameter that a file draws to three decimals.
constexpr double kDrawnMm = 5e-4;

bool fits(const StatedThread& t, const Core& c) {
  return c.diameter_mm >= t.least_core_mm() - kDrawnMm && c.diameter_mm <= t.most_core_mm() + kDrawnMm;
}

std::string size_words(const StatedThread& t) {
  return "M" + trimmed(t.major_mm, 3) + " x " + trimmed(t.pitch_mm, 3) + " - " + std::to_string(t.grade) +
         "H" + (t.left_hand ? " - LH" : "");
}

class Adder {
 public:
  Adder(const std::string& source, model::Plan& plan) : source_(source), plan_(plan), m_(plan.model) {}

  Status add(const StatedThread& t, const Core& core) {
    if (!done_.insert(core.hole).second)
      return refused(t, core.name + " is given two threads", "state one of each hole");
    if (!fits(t, core))
      return refused(t,
                     core.name + " is drawn with " + trimmed(core.diameter_mm, 3) + " mm, and the core of " +
                         size_words(t) + " is " + trimmed(t.least_core_mm(), 3) + " to " +
                         trimmed(t.most_core_mm(), 3) + " mm (ISO 965-1)",
                     "draw the hole with its core's diameter, or state the thread that it is the core of");
    if (!core.through && !t.depth_mm)
      return refused(t, core.name + " is blind, and how deep its thread is cut is not stated",
                     "state the depth of full thread, such as ':" +
                         trimmed(std::max(t.pitch_mm, std::floor(core.depth_mm - 5.0 * t.pitch_mm)), 3) +
                         "'");
    const double depth = t.depth_mm.value_or(core.depth_mm);
    if (depth > core.depth_mm + 1e-9)
      return refused(t,
                     "its depth is " + trimmed(depth, 3) + " mm, and " + core.name + " is " +
                         trimmed(core.depth_mm, 3) + " mm deep",
                     "state a depth that the hole has");
    const model::AnyRef made = m_.add(noun(t, core, depth));
    tolerance(t, core);
    plan_.ledger.bind(
        made, "feature_placement", model::Binder::kOperator,
        {"thread.stated",
         core.name + " is tapped " + size_words(t) + ", " + trimmed(depth, 3) + " mm deep: " + t.text,
         source_});
    plan_.kept.push_back(made);
    return {};
  }

  [[nodiscard]] Status refused(const StatedThread& t, const std::string& what,
                               const std::string& hint) const {
    return fail({.code = "CAD-THREAD",
                 .message = "the thread '" + t.text + "': " + what,
                 .file = plan_.file_name,
                 .hint = hint});
  }

 private:
  model::Ref<model::DescriptiveParameter> word(const char* name, const std::string& text) {
    model::DescriptiveParameter p;
    p.parameter_name = name;
    p.descriptive_string = text;
    return m_.add(p);
  }

  model::DefinedThread noun(const StatedThread& t, const Core& core, double depth) {
    model::DefinedThread f;
    f.its_id = "THREAD " + core.name;
    f.its_workpiece = m_.get<model::RoundHole>(core.hole)->its_workpiece;
    f.its_operations.given = true;
    f.feature_placement = model::add_placement(m_, core.frame);
    model::Plane bottom;
    bottom.name = "";
    bottom.position = model::add_placement(m_, {.origin = {0.0, 0.0, -depth}});
    f.depth = m_.add(bottom);
    model::PartialAreaDefinition part;
    part.effective_length = depth;
    part.placement = model::add_placement(m_, core.frame);
    f.partial_profile = m_.add(part);
    f.applied_shape.push_back(core.hole);
    f.inner_or_outer_thread = true;
    f.fit_class = word("fit class", std::to_string(t.grade) + "H");
    f.form = word("form", "M");
    f.major_diameter = t.major_mm;
    model::NumericParameter count;
    count.parameter_name = "threads per mm";
    count.its_parameter_value = 1.0 / t.pitch_mm;
    count.its_parameter_unit = "mm";
    f.number_of_threads = m_.add(count);
    f.thread_hand = word("hand", t.left_hand ? "left" : "right");
    f.pitch_diameter = basic_flank(t.major_mm, t.pitch_mm);
    f.minor_diameter = core.diameter_mm;
    return f;
  }

  /// That of the core, where the file states none: a hole is drilled for its thread.
  void tolerance(const StatedThread& t, const Core& core) {
    auto* d = m_.get<model::TolerancedLengthMeasure>(m_.get<model::RoundHole>(core.hole)->diameter);
    if (d == nullptr || d->implicit_tolerance.set()) return;
    model::PlusMinusValue limits;
    limits.upper_limit = std::max(0.0, rounded(t.most_core_mm() - core.diameter_mm, 4));
    limits.lower_limit = std::max(0.0, rounded(core.diameter_mm - t.least_core_mm(), 4));
    limits.significant_digits = 4;
    const auto made = m_.add(limits);
    m_.get<model::TolerancedLengthMeasure>(m_.get<model::RoundHole>(core.hole)->diameter)
        ->implicit_tolerance = made;
  }

  const std::string& source_;
  model::Plan& plan_;
  model::Model& m_;
  std::set<model::AnyRef> done_;
};

}  // namespace

double StatedThread::least_core_mm() const { return basic_core(major_mm, pitch_mm); }

double StatedThread::most_core_mm() const {
  const auto* at =
      std::find_if(kCore6.begin(), kCore6.end(), [&](const auto& row) { return row.first == pitch_mm; });
  // ISO 965-1, 13.5: the formula that the table's values are rounded from, for other pitches.
  const double grade6 = at != kCore6.end() ? at->second
                        : pitch_mm >= 1.0  ? 230.0 * std::pow(pitch_mm, 0.7)
                                           : 433.0 * pitch_mm - 190.0 * std::pow(pitch_mm, 1.22);
  return least_core_mm() + 1e-3 * kOverGrade6.at(static_cast<std::size_t>(grade - kFirstGrade)) * grade6;
}

Result<StatedThread> parse_thread(std::string_view text) {
  StatedThread out;
  out.text = text;
  const auto equals = text.rfind('=');
  if (equals == std::string_view::npos || equals == 0) return wrong(text, "it names no hole before '='");
  out.holes = text.substr(0, equals);
  std::string_view size = text.substr(equals + 1);
  if (const auto colon = size.find(':'); colon != std::string_view::npos) {
    out.depth_mm = parse_double(size.substr(colon + 1));
    if (!out.depth_mm || !(*out.depth_mm > 0.0))
      return wrong(text, "what stands after ':' is no depth above 0");
    size = size.substr(0, colon);
  }
  std::vector<std::string_view> words;
  for (std::string_view rest = size;;) {
    const auto dash = rest.find('-');
    words.push_back(rest.substr(0, dash));
    if (dash == std::string_view::npos) break;
    rest = rest.substr(dash + 1);
  }
  std::string_view first = words.front();
  if (first.size() < 2 || first.front() != 'M') return wrong(text, "only metric threads (M) are known");
  const auto x = first.find_first_of("xX");
  const auto major = parse_double(first.substr(1, x == std::string_view::npos ? x : x - 1));
  if (!major || !(*major > 0.0)) return wrong(text, "what stands after M is no diameter above 0");
  out.major_mm = *major;
  if (x != std::string_view::npos) {
    const auto pitch = parse_double(first.substr(x + 1));
    if (!pitch || !(*pitch > 0.0)) return wrong(text, "what stands after x is no pitch above 0");
    out.pitch_mm = *pitch;
  } else {
    const auto* at =
        std::find_if(kCoarse.begin(), kCoarse.end(), [&](const auto& row) { return row.first == *major; });
    if (at == kCoarse.end())
      return wrong(text, "no coarse pitch is known of M" + trimmed(*major, 3) + " (ISO 261); state it: M" +
                             trimmed(*major, 3) + "xPITCH");
    out.pitch_mm = at->second;
  }
  for (std::size_t i = 1; i < words.size(); ++i) {
    const std::string_view w = words[i];
    if (w == "LH") {
      out.left_hand = true;
    } else if (w.size() == 2 && w[1] == 'H' && w[0] >= '4' && w[0] <= '8') {
      out.grade = w[0] - '0';
    } else {
      return wrong(text, "'" + std::string(w) + "' is neither a class from 4H to 8H nor LH");
    }
  }
  if (!(out.least_core_mm() > 0.0)) return wrong(text, "its pitch leaves no core");
  return out;
}

Status add_threads(const std::vector<StatedThread>& stated, const std::vector<MadeOf>& made,
                   const exchange::Brep& brep, const std::string& source, model::Plan& plan, Job& job) {
  const std::vector<Core> cores = cores_of(plan.model, made);
  Adder adder(source, plan);
  for (const StatedThread& t : stated) {
    const bool face = t.holes.front() == '#';
    const bool pattern = !face && t.holes.find_first_of("*?") != std::string::npos;
    std::vector<Core> meant, others;
    for (const Core& c : cores) {
      const bool named = face ? std::any_of(c.faces.begin(), c.faces.end(),
                                            [&](std::uint32_t f) {
                                              return "#" + std::to_string(brep.faces[f].id) == t.holes;
                                            })
                              : model::names(t.holes, c.name);
      // Of a hole in several steps its faces mean the step that is a core of that thread.
      if (named) (fits(t, c) || !(pattern || (face && !c.alone)) ? meant : others).push_back(c);
    }
    if (meant.empty())
      return adder.refused(t,
                           others.empty() ? "no hole is named so; the holes are " + list_of(cores)
                                          : "none of the holes that it names has a core's diameter, " +
                                                trimmed(t.least_core_mm(), 3) + " to " +
                                                trimmed(t.most_core_mm(), 3) + " mm: " + list_of(others),
                           "name one of these, or a face of one: '#12=M8'");
    for (const Core& c : meant)
      if (auto ok = adder.add(t, c); !ok) return ok;
    job.report(
        {.code = "CAD-THREAD",
         .severity = Severity::kNote,
         .message = size_words(t) + " is cut in " + list_of(meant) +
                    (others.empty() ? std::string() : "; no core of it, and plain: " + list_of(others)),
         .file = plan.file_name});
  }
  return {};
}

}  // namespace capstan::from_cad
