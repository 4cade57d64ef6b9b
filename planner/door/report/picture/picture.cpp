#include "planner/door/report/picture/picture.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/door/report/picture/png.h"
#include "planner/door/report/picture/raster.h"
#include "planner/door/report/picture/svg.h"
#include "planner/door/report/picture/views.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/text.h"
#include "planner/model/nouns/executable.h"
#include "planner/model/plan/edit/step_names.h"
#include "planner/model/plan/order/step_ids.h"
#include "planner/model/plan/resources/setup_position.h"
#include "planner/physics/motion/time.h"

namespace capstan::report::picture {
namespace {

using geometry::Vec2;
using model::Plan;

constexpr double kWide = 1040.0, kMargin = 16.0, kRow = 12.0;
constexpr double kLegend = kMargin + kViewsWide + 20.0;

/// The text in so many characters; a longer one ends in two points.
std::string within(const std::string& text, std::size_t most) {
  std::string out;
  std::size_t shown = 0, last_two = 0;
  const std::string known = utf8_text(text);
  for (std::size_t at = 0; at < known.size(); ++shown) {
    const std::size_t n = std::max<std::size_t>(1, utf8_length(known, at));
    if (shown == most) return out.substr(0, last_two) + "..";
    if (shown + 2 == most) last_two = out.size();
    out += known.substr(at, n);
    at += n;
  }
  return out;
}
std::size_t characters(double wide) { return static_cast<std::size_t>(wide / kGlyphWide); }

/// As the report has it: neighbours in the order of steps differ most.
Colour colour_of(std::size_t step) {
  const double hue = std::fmod(0.618034 * static_cast<double>(step), 1.0);
  const auto part = [&](double n) {
    const double k = std::fmod(n + 12.0 * hue, 12.0);
    const double v = 0.45 - 0.33 * std::max(-1.0, std::min({k - 3.0, 9.0 - k, 1.0}));
    return static_cast<std::uint8_t>(std::lround(255.0 * v));
  };
  return {part(0.0), part(8.0), part(4.0)};
}

/// Whether each step is drawn. Fails  PIC-STEP.
Result<std::vector<bool>> drawn_steps(const Plan& plan, const std::vector<std::string>& ids,
                                      const std::vector<std::string>& wanted) {
  std::vector<bool> out(plan.steps.size(), wanted.empty());
  for (const std::string& text : wanted) {
    bool any = false;
    for (std::size_t n = 0; n < plan.steps.size(); ++n) {
      const auto* ws = plan.model.get<model::MachiningWorkingstep>(plan.steps[n].step);
      const model::AnyRef feature = ws == nullptr ? model::AnyRef{} : model::AnyRef(ws->its_feature);
      const model::StepNames names = model::step_names(plan.model, plan.steps[n].step, feature);
      if (text != std::to_string(n + 1) && text != ids[n] && !model::names(text, names)) continue;
      out[n] = any = true;
    }
    if (any) continue;
    std::string known;
    for (const std::string& id : ids) known += (known.empty() ? "" : ", ") + id;
    return fail({.code = "PIC-STEP",
                 .message = "the plan has no step '" + text + "' to draw",
                 .file = plan.file_name,
                 .expected = known.empty() ? "the plan has no steps" : known});
  }
  return out;
}

std::string tool_text(const Plan& plan, const model::StepResult& step) {
  const model::Cutter* c = model::find_cutter(plan, step.cutter_id);
  if (c == nullptr) return step.cutter_id.empty() ? "-" : step.cutter_id;
  return (c->pocket > 0 ? "T" + std::to_string(c->pocket) + " " : std::string()) +
         trimmed(c->cutting_diameter_mm, 3) + " mm " + std::string(model::words_of(c->cutter_class));
}

std::string head_text(const Plan& plan) {
  std::string out =
      "Plan of " +
      (plan.file_name.empty() ? std::string("a part") : plan.file_name.substr(plan.file_name.rfind('/') + 1));
  if (!plan.machine.id.empty()) out += " on " + plan.machine.id;
  out += ": " + counted(plan.steps.size(), "step", "steps") + ", " +
         counted(plan.cutters.size(), "tool", "tools");
  if (const auto t = motion::time_of(plan); t && t->total_s() > 0.0)
    out += ", " + motion::duration_text(t->total_s());
  return out;
}

/// One set-up on the sheet, with what it needs to be drawn.
struct Panel {
  const Plan& plan;
  const std::vector<std::string>& ids;
  std::size_t setup;
  std::vector<std::size_t> steps;
  std::size_t most;  ///< points of each line of a path
};

void words(Group& into, Vec2 at, std::string text, Colour colour = kInk, bool bold = false,
           bool ends_there = false) {
  into.shapes.emplace_back(
      Words{.at = at, .text = std::move(text), .colour = colour, .bold = bold, .ends_there = ends_there});
}

/// The text in lines of so many characters, broken at blanks; what is more than `most` lines is cut off.
std::vector<std::string> lines_of(const std::string& text, std::size_t wide, std::size_t most) {
  std::vector<std::string> out = {""};
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, end - at);
    at = end + 1;
    std::string& line = out.back();
    if (line.empty()) {
      line = word;
    } else if (line.size() + 1 + word.size() <= wide || out.size() == most) {
      line += " " + word;
    } else {
      out.push_back(word);
    }
  }
  for (std::string& line : out) line = within(line, wide);
  return out;
}

/// How the piece lies. Gives the base line of its last line.
double heading(const Panel& p, double y, Group& out) {
  const model::SetupResult& s = p.plan.setups[p.setup];
  const geometry::Placement piece = model::placed_in(p.plan, p.setup);
  const std::string zero = model::zero_text(p.plan.stock.box, piece, 3);
  const std::size_t wide = characters(kWide - 2.0 * kMargin);
  words(out, {kMargin, y},
        within("Set-up " + std::to_string(p.setup + 1) + " of " + std::to_string(p.plan.setups.size()) +
                   ", " + s.work_offset + (zero.empty() ? "" : ": " + zero),
               wide),
        kInk, true);
  const std::string held = s.holding.id.empty()            ? "what holds the piece is not stated"
                           : s.holding.description.empty() ? "held by " + s.holding.id
                                                           : "held by " + s.holding.description;
  const std::string lies = model::axis_text(piece, {0.0, 0.0, 1.0}) + " of the piece is up, " +
                           model::axis_text(piece, {1.0, 0.0, 0.0}) + " to the right; " + held;
  for (const std::string& line : lines_of(lies, wide, 4)) words(out, {kMargin, y += 13.0}, line, kGrey);
  return y;
}

/// A row per step, then what the colours mean. Gives the lower end.
double legend(const Panel& p, const PieceDrawn& shown, double y, std::vector<Group>& into) {
  constexpr double kNumber = kLegend + 42.0, kName = kNumber + 6.0, kTool = kName + 29.0 * kGlyphWide,
                   kTime = kWide - kMargin;
  Group head;
  words(head, {kName, y}, "step", kGrey);
  words(head, {kTool, y}, "tool", kGrey);
  words(head, {kTime, y}, "time", kGrey, false, true);
  into.push_back(std::move(head));
  for (std::size_t i = 0; i < std::min(p.steps.size(), kMostInLegend); ++i) {
    y += kRow;
    const std::size_t n = p.steps[i];
    const model::StepResult& s = p.plan.steps[n];
    Group row{.title = p.ids[n], .step = n + 1};
    row.shapes.emplace_back(Lines{
        .lines = {{{kLegend, y - 3.0}, {kLegend + 14.0, y - 3.0}}}, .stroke = colour_of(n), .width = 3.0});
    words(row, {kNumber, y}, std::to_string(n + 1), kInk, false, true);
    words(row, {kName, y}, within(p.ids[n], 28));
    const std::string time = motion::duration_text(s.cutting_s + s.rapid_s);
    const double room = kTime - kTool - kGlyphWide * static_cast<double>(time.size() + 1);
    words(row, {kTool, y}, within(tool_text(p.plan, s), characters(room)));
    words(row, {kTime, y}, time, kInk, false, true);
    into.push_back(std::move(row));
  }
  Group key;
  if (p.steps.size() > kMostInLegend) {
    y += kRow;
    words(key, {kName, y}, "and " + std::to_string(p.steps.size() - kMostInLegend) + " more", kGrey);
  }
  y += 0.5 * kRow;
  const auto sample = [&](Colour fill, Colour edge, const char* text) {
    y += kRow;
    key.shapes.emplace_back(
        Lines{.lines = {{{kLegend, y - 7.0}, {kLegend + 14.0, y - 7.0}, {kLegend + 14.0, y}, {kLegend, y}}},
              .closed = true,
              .fill = fill,
              .stroke = edge,
              .width = 0.7});
    words(key, {kLegend + 22.0, y}, text, kGrey);
  };
  if (shown.piece) sample(kPieceFill, kPieceEdge, "raw piece");
  if (shown.features) sample(kFeatureFill, kFeatureEdge, "what the features remove");
  if (shown.fixtures) sample(kFixtureFill, kFixtureEdge, "what holds the piece");
  y += kRow;
  key.shapes.emplace_back(Lines{.lines = {{{kLegend, y - 3.0}, {kLegend + 14.0, y - 3.0}}},
                                .stroke = kRapid,
                                .width = 0.6,
                                .dashed = true});
  words(key, {kLegend + 22.0, y}, "rapid", kGrey);
  y += kRow;
  key.shapes.emplace_back(Dots{.at = {{kLegend + 7.0, y - 3.0}}, .radius = 1.8, .fill = kInk});
  words(key, {kLegend + 22.0, y}, "feed begins", kGrey);
  into.push_back(std::move(key));
  return y;
}

/// Gives the lower end.
double draw(const Panel& p, double y, std::vector<Group>& into) {
  Group head;
  const double top = heading(p, y, head) + 26.0;
  into.push_back(std::move(head));
  const Views views = views_of(p.plan, p.setup, p.steps, {kMargin, top});
  PieceDrawn piece = piece_in(p.plan, p.setup, views);
  for (Group& g : piece.groups) into.push_back(std::move(g));
  for (const std::size_t n : p.steps) {
    const model::StepResult& s = p.plan.steps[n];
    Group path = path_in(s, colour_of(n), views, p.most);
    path.step = n + 1;
    path.title = std::to_string(n + 1) + " " + p.ids[n] + ", " + tool_text(p.plan, s) + ", " +
                 motion::duration_text(s.cutting_s + s.rapid_s);
    into.push_back(std::move(path));
  }
  for (Group& g : marks_in(views)) into.push_back(std::move(g));
  const double legend_end = legend(p, piece, top, into);
  return std::max(legend_end, top + views.size.y + 20.0);
}

}  // namespace

Result<Drawing> drawing_of(const Plan& plan, const std::vector<std::string>& wanted) {
  const std::vector<std::string> ids = model::step_ids(plan);
  const auto drawn = drawn_steps(plan, ids, wanted);
  if (!drawn) return tl::unexpected(drawn.error());
  Drawing out{.width = kWide, .title = head_text(plan)};
  double y = kMargin + 8.0;
  Group head;
  words(head, {kMargin, y}, within(out.title, characters(kWide - 2.0 * kMargin)), kInk, true);
  if (plan.setups.empty())
    words(head, {kMargin, y += 16.0}, "No set-up is planned: there is nothing to draw.", kGrey);
  out.groups.push_back(std::move(head));
  // Each step has four lines: rapids and feeds, in two views.
  const auto shown = static_cast<std::size_t>(std::count(drawn->begin(), drawn->end(), true));
  const std::size_t most = std::max(kLeastPoints, kMostPoints / (4 * std::max<std::size_t>(1, shown)));
  for (std::size_t s = 0; s < plan.setups.size(); ++s) {
    Panel panel{.plan = plan, .ids = ids, .setup = s, .steps = {}, .most = most};
    for (std::size_t n = 0; n < plan.steps.size(); ++n)
      if ((*drawn)[n] && plan.steps[n].setup == s) panel.steps.push_back(n);
    if (panel.steps.empty() && !wanted.empty()) continue;
    y = draw(panel, y + 26.0, out.groups);
  }
  out.height = std::ceil(y + kMargin);
  return out;
}

Result<std::string> svg(const Plan& plan, const std::vector<std::string>& steps) {
  const auto drawing = drawing_of(plan, steps);
  if (!drawing) return tl::unexpected(drawing.error());
  return svg_text(*drawing);
}

Result<std::string> png(const Plan& plan, const std::vector<std::string>& steps) {
  const auto drawing = drawing_of(plan, steps);
  if (!drawing) return tl::unexpected(drawing.error());
  const double wide = kPixelsPerUnit * drawing->width, high = kPixelsPerUnit * drawing->height;
  if (wide * high > static_cast<double>(kMostPixels))
    return fail({.code = "PIC-SIZE",
                 .message = "the picture would have " + trimmed(wide, 0) + " x " + trimmed(high, 0) +
                            " pixels, for the plan has " + counted(plan.setups.size(), "set-up", "set-ups"),
                 .file = plan.file_name,
                 .expected = "at most " + std::to_string(kMostPixels / 1'000'000) + " million",
                 .hint = "draw fewer steps (--draw), or write .svg"});
  return png_bytes(pixels_of(*drawing));
}

}  // namespace capstan::report::picture
