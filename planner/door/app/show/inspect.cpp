#include "planner/door/app/show/inspect.h"

#include <algorithm>
#include <map>
#include <variant>

#include "planner/door/app/show/node.h"
#include "planner/door/app/show/paths.h"
#include "planner/door/service/explain/step_view.h"
#include "planner/door/service/explain/values.h"
#include "planner/ground/base/number.h"
#include "planner/model/features/shape.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"

namespace capstan::app {

using model::AnyRef;
using model::Model;
using service::box_text;
using service::kListShown;
using service::label;
using service::open_decisions;
using service::table;
using service::value_text;
using service::with_unit;

namespace {

constexpr std::size_t kShown = 40;  // features and unhandled instances shown one by one

using Rows = std::vector<std::vector<std::string>>;

std::string kept_text(const Model& m, const model::KeptInstance& kept) {
  std::string out;
  for (const auto& piece : kept.pieces) {
    if (const auto* text = std::get_if<std::string>(&piece)) {
      out += *text;
    } else {
      out += "#" + std::to_string(m.origin(std::get<AnyRef>(piece)).instance);
    }
  }
  return out;
}

std::string object_text(const model::Plan& plan, AnyRef at) {
  const Model& m = plan.model;
  if (const auto* kept = m.get<model::KeptInstance>(at)) {
    return "#" + std::to_string(m.origin(at).instance) + " (unhandled, kept as it was read)\n  " +
           kept_text(m, *kept) + "\n";
  }
  Rows rows;
  for (const auto& a : model::noun_type(at.type).attributes) {
    const bool shown = model::has_value(a, m.object(at)) || a.in_iso14649;
    if (shown) rows.push_back({std::string(a.name), value_text(m, a, m.object(at))});
  }
  return label(m, at) + "\nat " + Paths(plan).of(at) + "\n" + table(rows);
}

std::string place_text(const model::Plan& plan, const Node& node) {
  const Model& m = plan.model;
  const auto size = list_size(m, node);
  if (!size) {
    const AnyRef at = object_of(m, node);
    return at.set() ? object_text(plan, at) : node_text(m, node) + "\n";
  }
  std::string out;
  for (std::size_t i = 0; i < *size; ++i) {
    Node item = node;
    if (node.is_list) {
      item = Node{};
      item.object = node.list[i];
    } else {
      item.item.push_back(i);
    }
    out += "[" + std::to_string(i) + "] " + node_text(m, item) + "\n";
  }
  return out.empty() ? "(empty)\n" : out;
}

std::string text_or_dash(const model::Text& t) { return t && !t->empty() ? *t : "-"; }

void workpieces(const model::Plan& plan, std::string& out) {
  const Model& m = plan.model;
  const auto* project = m.get<model::Project>(plan.project);
  if (project == nullptr) return;
  for (const AnyRef at : project->its_workpieces.items) {
    const auto* w = m.get<model::Workpiece>(at);
    if (w == nullptr) continue;
    out += "Workpiece  " + label(m, at);
    if (const auto* material = m.get<model::Material>(w->its_material)) {
      out += ", material " + text_or_dash(material->standard_identifier) + " / " +
             text_or_dash(material->material_identifier);
    }
    if (w->global_tolerance) out += ", tolerance " + with_unit(*w->global_tolerance, model::Unit::kLength);
    out += "\n";
  }
  if (plan.target_mesh != nullptr) {
    out += "Mesh       " + std::to_string(plan.target_mesh->triangles.size()) + " triangles, " +
           box_text(geometry::bounds(*plan.target_mesh)) + "\n";
  }
}

std::string shape_text(const model::FeatureShape& s) {
  const auto n = [](double v) { return trimmed(v, 4); };
  std::string out(model::to_text(s.kind));
  if (s.diameter.nominal_mm > 0.0) {
    out += ", diameter " + n(s.diameter.nominal_mm);
    if (s.diameter.given) out += " (" + n(s.diameter.lower_mm) + ".." + n(s.diameter.upper_mm) + ")";
  }
  if (s.thread_major_mm > 0.0) out += ", thread " + n(s.thread_major_mm) + " x " + n(s.thread_pitch_mm);
  out += s.through ? ", through " : ", depth ";
  return out + n(s.depth_mm) + " mm, at x " + n(s.frame.origin.x) + " y " + n(s.frame.origin.y) + " z " +
         n(s.frame.origin.z);
}

void features(const model::Plan& plan, std::string& out) {
  const Model& m = plan.model;
  const auto all = m.all_below(model::TypeId::kManufacturingFeature);
  if (all.empty()) return;
  out += "\nFeatures (" + std::to_string(all.size()) + ")\n";
  Rows rows;
  for (const AnyRef at : all) {
    if (rows.size() == kShown) {
      rows.push_back({"and " + std::to_string(all.size() - kShown) + " more"});
      break;
    }
    const auto shapes = model::shapes_of(m, model::Ref<model::ManufacturingFeature>(at));
    std::string what = shapes ? (shapes->size() > 1 ? std::to_string(shapes->size()) + " x " : "") +
                                    shape_text(shapes->front())
                              : "shape not known: " + shapes.error().message;
    rows.push_back(
        {label(m, at),
         std::to_string(m.at<model::ManufacturingFeature>(at).its_operations.size()) + " operations",
         std::move(what)});
  }
  out += table(rows);
}

void counts(const Model& m, std::string& out) {
  Rows rows;
  std::size_t total = 0;
  for (std::size_t t = 1; t < model::kTypeCount; ++t) {
    const auto type = static_cast<model::TypeId>(t);
    if (type == model::TypeId::kKeptInstance || m.count(type) == 0) continue;
    total += m.count(type);
    rows.push_back({std::string(model::noun_type(type).keyword), std::to_string(m.count(type))});
  }
  out += "\nInstances by kind (" + std::to_string(total) + ")\n" + table(rows);
}

void unhandled(const Model& m, std::string& out) {
  std::map<std::string, std::vector<std::uint64_t>> by_keyword;
  for (const AnyRef at : m.all(model::TypeId::kKeptInstance)) {
    by_keyword[m.at<model::KeptInstance>(at).keyword].push_back(m.origin(at).instance);
  }
  if (by_keyword.empty()) return;
  out += "\nUnhandled (kept, written back as they were read)\n";
  Rows rows;
  for (const auto& [keyword, numbers] : by_keyword) {
    std::string where;
    for (std::size_t i = 0; i < numbers.size() && i < kListShown; ++i)
      where += (i != 0 ? ", #" : "#") + std::to_string(numbers[i]);
    if (numbers.size() > kListShown) where += ", ...";
    rows.push_back({keyword, std::to_string(numbers.size()), where});
  }
  out += table(rows);
}

void still_open(const model::Plan& plan, std::string& out) {
  Rows rows;
  for (const auto& key : open_decisions(plan)) rows.push_back({label(plan.model, key.object), key.attribute});
  if (rows.empty()) return;
  out += "\nOpen decisions (" + std::to_string(rows.size()) + ")\n" + table(rows);
}

}  // namespace

std::string faults(const std::vector<Diagnostic>& diagnostics) {
  if (diagnostics.empty()) return {};
  std::string out = "\nReading it, said (" + std::to_string(diagnostics.size()) + ")\n";
  for (Diagnostic d : diagnostics) {
    d.file.clear();
    out += "  " + (d.line != 0 ? "line " + std::to_string(d.line) + ": " : std::string()) + to_text(d) + "\n";
  }
  return out;
}

std::string inspect(const model::Plan& plan, const std::vector<Diagnostic>& diagnostics) {
  const Model& m = plan.model;
  std::string out =
      "Project    " + (plan.project.set() ? label(m, plan.project) : std::string("none")) + "\n";
  std::string about = plan.header_description;
  std::replace(about.begin(), about.end(), '\n', ' ');
  if (!about.empty()) out += "About      " + about + "\n";
  workpieces(plan, out);
  if (!plan.machine.id.empty()) out += "Machine    " + plan.machine.id + "\n";
  if (!plan.stock.box.empty())
    out += "Stock      " + box_text(plan.stock.box) + " (" + plan.stock.source + ")\n";
  out += "Steps      " + std::to_string(m.count(model::TypeId::kMachiningWorkingstep)) + " workingsteps, " +
         std::to_string(plan.steps.size()) + " planned\n";
  features(plan, out);
  counts(m, out);
  unhandled(m, out);
  still_open(plan, out);
  return out + faults(diagnostics);
}

Result<std::string> inspect(const model::Plan& plan, std::string_view path) {
  const auto query = parse_query(path);
  if (!query) return tl::unexpected(query.error());
  const auto nodes = nodes_at(plan, *query);
  if (!nodes) return tl::unexpected(nodes.error());
  if (query->count) {
    std::string out;
    for (const Node& n : *nodes) {
      if (const auto size = list_size(plan.model, n)) out += std::to_string(*size) + "\n";
    }
    return out.empty() ? std::to_string(nodes->size()) + "\n" : out;
  }
  if (nodes->empty()) return std::string("(none)\n");
  if (nodes->size() == 1) return place_text(plan, nodes->front());
  // Results of a search are shown with their path.
  const bool search = std::any_of(query->steps.begin(), query->steps.end(), [](const QueryStep& s) {
    return s.kind == QueryStep::Kind::kBelow || s.kind == QueryStep::Kind::kFilter;
  });
  const bool objects = std::all_of(nodes->begin(), nodes->end(),
                                   [&](const Node& n) { return object_of(plan.model, n).set(); });
  if (search && objects) {
    const Paths paths(plan);
    Rows rows;
    for (const Node& n : *nodes) {
      const AnyRef at = object_of(plan.model, n);
      rows.push_back({paths.of(at), label(plan.model, at)});
    }
    return table(rows, "");
  }
  std::string out;
  for (const Node& n : *nodes) out += node_text(plan.model, n) + "\n";
  return out;
}

}  // namespace capstan::app
