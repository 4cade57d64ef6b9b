#include "planner/making/piece/workpiece.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "planner/ground/base/nearest_names.h"
#include "planner/ground/base/number.h"
#include "planner/ground/geometry/mesh/mesh_form.h"
#include "planner/model/features/in_piece.h"
#include "planner/model/features/raw_piece.h"
#include "planner/model/features/shape.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"
#include "tooling/shop/material/hardness.h"
#include "tooling/shop/material/material.h"

namespace capstan::piece {
namespace {

using geometry::Box3;
using geometry::Vec3;
using model::AnyRef;
using model::Ref;

/// Stock added around outside contours when no raw piece is stated, mm, so that there is material to mill.
/// Default, unsourced.
constexpr double kOverOutsides = 5.0;

/// Extends the raw piece over an outside's contour, down to its depth.
void add_outside(const model::FeatureShape& s, Box3& out) {
  geometry::Region within;
  for (const auto& i : s.islands) within = geometry::unite(within, i.area);
  geometry::Box2 b = geometry::bounds(geometry::offset_sharp(within, kOverOutsides));
  if (within.empty()) {
    if (s.spine.size() < 2) return;
    // Beside an open line, on the right of it.
    for (std::size_t i = 0; i + 1 < s.spine.size(); ++i) {
      const geometry::Vec2 d = (1.0 / norm(s.spine[i + 1] - s.spine[i])) * (s.spine[i + 1] - s.spine[i]);
      for (const std::size_t k : {i, i + 1}) {
        const geometry::Vec2 over = s.spine[k] + kOverOutsides * geometry::Vec2{d.y, -d.x};
        for (const geometry::Vec2 p : {s.spine[k], over}) {
          b.lo = {std::min(b.lo.x, p.x), std::min(b.lo.y, p.y)};
          b.hi = {std::max(b.hi.x, p.x), std::max(b.hi.y, p.y)};
        }
      }
    }
  }
  for (const double z : {0.0, -s.depth_mm}) {
    for (const double x : {b.lo.x, b.hi.x}) {
      for (const double y : {b.lo.y, b.hi.y}) out.add(s.frame.to_parent({x, y, z}));
    }
  }
}

/// A property as text: "hardness = 200 HB".
std::string property_text(const model::Model& m, const std::string& of, AnyRef parameter) {
  std::string name = of;
  if (const auto* p = m.get<model::PropertyParameter>(parameter)) {
    const std::string own = p->parameter_name.value_or("");
    if (!own.empty() && own != of) name += (name.empty() ? "" : " ") + own;
  }
  if (const auto* n = m.get<model::NumericParameter>(parameter)) {
    const std::string unit = n->its_parameter_unit.value_or("");
    return name + " = " + (n->its_parameter_value ? trimmed(*n->its_parameter_value, 4) : std::string("?")) +
           (unit.empty() ? "" : " " + unit);
  }
  const auto* d = m.get<model::DescriptiveParameter>(parameter);
  return name + " = " + (d == nullptr ? std::string("?") : d->descriptive_string.value_or("?"));
}

/// A parameter of the material, and the property that it belongs to.
struct StatedProperty {
  std::string of;
  AnyRef parameter;
};

std::vector<StatedProperty> properties_of(const model::Model& m, const model::Material& material) {
  std::vector<StatedProperty> out;
  for (std::size_t i = 0; i < material.material_property.size(); ++i)
    out.push_back({"", material.material_property[i]});
  for (std::size_t i = 0; i < material.its_properties.size(); ++i) {
    const auto* p = m.get<model::MaterialProperty>(material.its_properties[i]);
    if (p == nullptr) continue;
    const std::string name = p->name.value_or("a property");
    if (p->its_parameters.size() == 0) out.push_back({name, {}});
    for (std::size_t k = 0; k < p->its_parameters.size(); ++k) out.push_back({name, p->its_parameters[k]});
  }
  return out;
}

std::string text_of(const model::Model& m, const StatedProperty& p) {
  return p.parameter.set() ? property_text(m, p.of, p.parameter) : p.of;
}

/// Says of each property whether the card was chosen by it.
void tell_properties(const model::Plan& plan, const std::vector<std::string>& properties,
                     const tooling::ChosenMaterial& chosen, const AnyRef& at, Job& job) {
  const auto say = [&](Diagnostic d) {
    d.file = plan.file_name;
    d.instance = plan.model.origin(at).instance;
    job.report(std::move(d));
  };
  const model::WorkMaterial& card = chosen.material;
  for (const std::string& text : properties) {
    const auto said = tooling::stated_words(text).hardness;
    const bool used = chosen.by_hardness && std::any_of(said.begin(), said.end(), [&](const auto& h) {
                        return tooling::converts(h.scale, card.iso_group);
                      });
    if (used) {
      say({.code = "PIP-MATERIAL-HARDNESS",
           .severity = Severity::kNote,
           .message = "the part states " + text + "; " + chosen.grade + " is planned as '" + card.id + "' (" +
                      trimmed(card.hardness_hb, 0) + " HB)"});
      continue;
    }
    say({.code = "PIP-MATERIAL-PROPERTY",
         .severity = Severity::kWarning,
         .message = "the part states " + text + " for its material; planning does not use it",
         .hint = "forces and speeds are those of '" + card.id +
                 "'; name a harder material with --material where that is too little"});
  }
}

/// The box that the features' own extents span: what must be there at least.
Box3 box_of_features(const model::Model& m) {
  Box3 out;
  for (const AnyRef f : m.all_below(model::TypeId::kManufacturingFeature)) {
    const auto shapes = model::shapes_of(m, Ref<model::ManufacturingFeature>(f));
    if (!shapes) continue;
    for (const auto& s : *shapes) {
      if (s.kind == model::ShapeKind::kOutside) add_outside(s, out);
      if (s.area.empty() || model::has(s.kind, model::ShapeTrait::kOutwards)) continue;
      const auto b = geometry::bounds(s.area);
      for (const Vec3 corner : {Vec3{b.lo.x, b.lo.y, 0}, Vec3{b.hi.x, b.lo.y, 0}, Vec3{b.lo.x, b.hi.y, 0},
                                Vec3{b.hi.x, b.hi.y, 0}}) {
        out.add(s.frame.to_parent(corner));
        out.add(s.frame.to_parent({corner.x, corner.y, -s.depth_mm}));
      }
    }
  }
  return out;
}

constexpr const char* kMargin = "margin";   // by this name in Plan::provenance
constexpr double kLargestPiece = 20'000.0;  // mm: more is a mistake of units

std::string words(const Box3& b) {
  const Vec3 s = b.size();
  return trimmed(s.x, 3) + " x " + trimmed(s.y, 3) + " x " + trimmed(s.z, 3) + " mm, from (" +
         trimmed(b.lo.x, 3) + ", " + trimmed(b.lo.y, 3) + ", " + trimmed(b.lo.z, 3) + ")";
}

/// The file's, else the box of the surface or of the features.
void look_for_raw_piece(const model::Plan& plan, const WorkpieceWish& wish, model::Stock& stock, Job& job) {
  const model::Workpiece* piece = model::workpiece_of(plan.model, plan.project);
  if (piece != nullptr) {
    const AnyRef shape = model::raw_solid(plan.model, *piece);
    if (const auto box = model::box_of(plan.model, shape)) {
      stock.box = *box;
      stock.source = "given: " + std::string(model::noun_type(shape.type).keyword) + " of the workpiece";
      if (const auto* c = plan.model.get<model::RightCircularCylinder>(shape))
        stock.cylinder_radius_mm = c->radius;
    }
  }
  if (stock.box.empty() && plan.target_mesh) {
    stock.box = geometry::bounds(*plan.target_mesh);
    stock.source = "inferred: the box of the surface";
    // --stock states how much stands around the surface: then the raw piece is given. Around features it is
    // not: what the part is beside them is still a guess.
    if (!wish.allowance_mm)
      job.warn("PIP-STOCK", "no raw piece is given; taken as the box of the surface: " + words(stock.box));
  }
  if (stock.box.empty()) {
    stock.box = box_of_features(plan.model);
    if (stock.box.empty()) return;
    stock.source = "inferred: the box of the features";
    job.warn("PIP-STOCK",
             "no raw piece is given; taken as the box that the features span: " + words(stock.box));
  }
  if (wish.allowance_mm) {
    const double a = *wish.allowance_mm;
    stock.box.lo = stock.box.lo - Vec3{a, a, a};
    stock.box.hi = stock.box.hi + Vec3{a, a, a};
    stock.source += ", grown by " + trimmed(a, 3) + " mm (--stock)";
  }
}

/// Outside a sheet's outline nothing says what is to be made, and a cutter on its border would cut there.
Status sheet_covers_raw_piece(const model::Plan& plan, const Box3& raw) {
  if (!plan.target_mesh) return {};
  const geometry::MeshForm form = geometry::form_of(*plan.target_mesh);
  if (form.kind != geometry::MeshForm::Kind::kSheet) return {};
  const double bare =
      geometry::area(geometry::subtract(geometry::rectangle(xy(raw.lo), xy(raw.hi)), form.outline));
  constexpr double kTraceMm2 = 0.01;  // of outlines rounded to single precision
  if (bare <= kTraceMm2) return {};
  return fail(
      {.code = "PIP-SHEET",
       .message = "the surface is a sheet, and " + trimmed(bare, 2) +
                  " mm2 of the raw piece lie outside its outline: what is to stand there is not known",
       .file = plan.file_name,
       .expected = "a sheet over the whole raw piece (" + words(raw) + "), or a closed solid",
       .hint = "extend the surface, close it to a solid, or give a smaller raw piece with --stock box:"});
}

}  // namespace

Result<model::WorkMaterial> material_of(const model::Plan& plan, const WorkpieceWish& wish, Job& job) {
  const model::Workpiece* piece = model::workpiece_of(plan.model, plan.project);
  std::vector<std::string> names;
  const AnyRef at = piece == nullptr ? AnyRef{} : AnyRef(piece->its_material);
  const auto* stated = plan.model.get<model::Material>(at);
  if (wish.material) {
    names.push_back(*wish.material);
  } else if (stated != nullptr) {
    names.push_back(stated->standard_identifier.value_or(""));
    names.push_back(stated->material_identifier.value_or(""));
  }
  std::vector<std::string> properties;
  if (stated != nullptr)
    for (const StatedProperty& p : properties_of(plan.model, *stated))
      properties.push_back(text_of(plan.model, p));
  // Who asks for another material's figures has them as they are.
  const bool like = wish.material && wish.material->starts_with(tooling::kLike);
  auto material =
      tooling::choose_material(names, like ? std::vector<std::string>{} : properties, wish.known, job,
                               wish.material ? tooling::Families::kRefused : tooling::Families::kTaken);
  if (!material) {
    Diagnostic d = material.error();
    if (!wish.material || !properties.empty()) d.file = plan.file_name;
    if (!wish.material) {
      d.instance = plan.model.origin(at).instance;
      d.hint = "name one with --material, or one that it cuts like with --material like:C45; " + d.hint;
    }
    return fail(std::move(d));
  }
  if (like) material->by_hardness = false;  // by the name's, at most
  tell_properties(plan, properties, *material, at, job);
  return std::move(material->material);
}

std::optional<mechanics::MarginPolicy> margin_said(const model::Plan& plan) {
  for (const model::Provenance& p : plan.provenance)
    if (p.what == kMargin) return mechanics::margin_policy(p.value);
  return mechanics::usual_margin();
}

Result<Margin> margin_of(const model::Plan& plan, const WorkpieceWish& wish, Job& job) {
  if (wish.margin) return Margin{*wish.margin, {kMargin, wish.margin->name, "named by the caller"}};
  const auto before = std::find_if(plan.provenance.begin(), plan.provenance.end(),
                                   [](const model::Provenance& p) { return p.what == kMargin; });
  if (before == plan.provenance.end())
    return Margin{mechanics::usual_margin(), {kMargin, mechanics::usual_margin().name, "default"}};
  const auto policy = mechanics::margin_policy(before->value);
  if (!policy) {
    Diagnostic d = unknown_name(kMargin, before->value, mechanics::margin_names(), "capstan plan --help");
    d.file = plan.file_name;
    d.expected = mechanics::margins_asked();
    d.hint = "the plan says that it was made with it: name one with --margin; " + d.hint;
    return fail(std::move(d));
  }
  if (policy->name != mechanics::kUsualMargin.name)
    job.report({.code = "PIP-MARGIN",
                .severity = Severity::kNote,
                .message = "the plan was made with the margin '" + before->value + "', which holds",
                .file = plan.file_name,
                .hint = "name another with --margin"});
  return Margin{*policy, *before};
}

void state_raw_piece(model::Model& m, const Box3& box) {
  for (const AnyRef f : m.all_below(model::TypeId::kGeneralOutsideProfile)) {
    const auto* outside = m.get<model::GeneralOutsideProfile>(f);
    const auto owner = outside->its_workpiece;
    const auto* piece = m.get<model::Workpiece>(owner);
    if (!m.holds<model::OpenProfile>(outside->feature_boundary) || piece == nullptr ||
        model::raw_solid(m, *piece).set())
      continue;
    model::CartesianPoint corner;
    corner.coordinates = {{box.lo.x, box.lo.y, box.lo.z}, true};
    model::Axis2Placement3d at;
    at.location = m.add(corner);
    model::Block block;
    block.name = "RAW PIECE";
    block.position = m.add(at);
    block.x = box.size().x;
    block.y = box.size().y;
    block.z = box.size().z;
    model::Workpiece raw;
    raw.its_id = "RAW PIECE";
    raw.its_bounding_geometry = m.add(block);
    const auto made = m.add(raw);
    m.get<model::Workpiece>(owner)->its_rawpiece = made;
  }
}

Result<model::Stock> raw_piece_of(const model::Plan& plan, const WorkpieceWish& wish, Job& job) {
  model::Stock stock = plan.stock;
  if (wish.raw) {
    stock.box = *wish.raw;
    stock.source = "given: --stock";
  } else {
    look_for_raw_piece(plan, wish, stock, job);
  }
  if (stock.box.empty()) {
    return fail({.code = "PIP-NOTHING",
                 .message = "nothing to plan: no raw piece, and no feature whose size is known",
                 .file = plan.file_name,
                 .hint = "state the raw piece in the file (its_bounding_geometry) or with --stock"});
  }
  if (auto ok = sheet_covers_raw_piece(plan, stock.box); !ok) return tl::unexpected(ok.error());
  const Vec3 size = stock.box.size();
  const double largest = std::max({size.x, size.y, size.z});
  if (!(largest <= kLargestPiece)) {
    return fail({.code = "PIP-STOCK-SIZE",
                 .message = "the raw piece would be " + trimmed(largest / 1000.0, 1) + " m long",
                 .file = plan.file_name,
                 .expected = "at most " + trimmed(kLargestPiece / 1000.0, 0) + " m",
                 .hint = "look at the unit of the file, or at --stock"});
  }
  return stock;
}

void report_outside(const model::Plan& plan, const StatedShapes& stated, Job& job) {
  constexpr double kBeyond = model::kBeyondPieceMm;
  for (const auto& [f, shapes] : stated) {
    if (!shapes || !plan.model.holds<model::MachiningFeature>(f)) continue;
    for (const auto& s : *shapes) {
      if (s.area.empty() || model::has(s.kind, model::ShapeTrait::kOutwards)) continue;
      const auto b = geometry::bounds(s.area);
      const Box3 raw = transformed(plan.stock.box, inverse(s.frame));
      std::string how;
      if (b.lo.x > raw.hi.x || b.hi.x < raw.lo.x || b.lo.y > raw.hi.y || b.hi.y < raw.lo.y ||
          -s.depth_mm > raw.hi.z || raw.lo.z > 0.0) {
        how = "lies wholly outside the raw piece: its tool cuts air, or what holds the piece";
      } else if (-s.depth_mm < raw.lo.z - kBeyond) {
        how = "goes " + trimmed(raw.lo.z + s.depth_mm, 2) +
              " mm below the underside of the raw piece: there its tool cuts into what holds the piece; a "
              "depth of " +
              trimmed(-raw.lo.z, 2) + " mm ends at the underside";
      } else if (s.kind == model::ShapeKind::kFace && -s.depth_mm < raw.lo.z + kBeyond) {
        how = "goes down to the underside of the raw piece: nothing of the piece stays below it";
      } else if (s.kind != model::ShapeKind::kFace && !s.open &&
                 (b.lo.x < raw.lo.x - kBeyond || b.hi.x > raw.hi.x + kBeyond || b.lo.y < raw.lo.y - kBeyond ||
                  b.hi.y > raw.hi.y + kBeyond)) {
        how = "reaches over the edge of the raw piece";
      }
      if (how.empty()) continue;
      job.report({.code = "PIP-OUTSIDE",
                  .severity = Severity::kWarning,
                  .message = "feature '" + s.name + "' " + how,
                  .file = plan.file_name,
                  .instance = plan.model.origin(f).instance,
                  .hint = "look at its placement, or at the raw piece (" + words(plan.stock.box) + ")"});
      break;
    }
  }
}

}  // namespace capstan::piece
