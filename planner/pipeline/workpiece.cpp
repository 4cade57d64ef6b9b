#include <algorithm>
#include <array>
#include <cmath>

#include "planner/base/number.h"
#include "planner/geometry/mesh_form.h"
#include "planner/model/resolve.h"
#include "planner/pipeline/work.h"
#include "tooling/catalogue/material.h"

namespace capstan::pipeline {
namespace {

using geometry::Box3;
using geometry::Vec3;

Box3 box_between(Vec3 a, Vec3 b) {
  Box3 out;
  out.add(a);
  out.add(b);
  return out;
}

/// The box of a block or a cylinder, workpiece coordinates.
std::optional<Box3> box_of(const model::Model& m, AnyRef geometry) {
  if (const auto* b = m.get<model::Block>(geometry)) {
    const auto frame = model::placement_or_identity(m, b->position);
    if (!frame || !b->x || !b->y || !b->z) return std::nullopt;
    if (!(*b->x > 0.0 && *b->y > 0.0 && *b->z > 0.0)) return std::nullopt;
    return transformed(box_between({0, 0, 0}, {*b->x, *b->y, *b->z}), *frame);
  }
  if (const auto* c = m.get<model::RightCircularCylinder>(geometry)) {
    const auto* at = m.get<model::Axis1Placement>(c->position);
    if (at == nullptr || !c->height || !c->radius) return std::nullopt;
    const auto origin = model::point(m, at->location);
    if (!origin) return std::nullopt;
    const auto axis = model::direction(m, at->axis);
    const auto frame = geometry::make_placement(*origin, axis ? *axis : Vec3{0, 0, 1});
    if (!frame) return std::nullopt;
    const double r = *c->radius;
    return transformed(box_between({-r, -r, 0}, {r, r, *c->height}), *frame);
  }
  return std::nullopt;
}

const model::Workpiece* first_workpiece(const model::Plan& plan) {
  const auto* project = plan.model.get<model::Project>(plan.project);
  if (project != nullptr) {
    for (std::size_t i = 0; i < project->its_workpieces.size(); ++i) {
      if (const auto* w = plan.model.get<model::Workpiece>(project->its_workpieces[i])) return w;
    }
  }
  const auto all = plan.model.all(model::TypeId::kWorkpiece);
  return all.empty() ? nullptr : plan.model.get<model::Workpiece>(all.front());
}

/// The box that the features' own extents span: what must be there at least.
Box3 box_of_features(const Work& w) {
  Box3 out;
  for (const AnyRef f : w.plan.model.all_below(model::TypeId::kManufacturingFeature)) {
    const auto shapes = model::shapes_of(w.plan.model, Ref<model::ManufacturingFeature>(f));
    if (!shapes) continue;
    for (const auto& s : *shapes) {
      if (s.area.empty() || s.kind == model::ShapeKind::kStep || s.kind == model::ShapeKind::kOutside)
        continue;
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

constexpr double kLargestPiece = 20'000.0;  // mm: more is a mistake of units

std::string words(const Box3& b) {
  const Vec3 s = b.size();
  return trimmed(s.x, 3) + " x " + trimmed(s.y, 3) + " x " + trimmed(s.z, 3) + " mm, from (" +
         trimmed(b.lo.x, 3) + ", " + trimmed(b.lo.y, 3) + ", " + trimmed(b.lo.z, 3) + ")";
}

void resolve_stock(Work& w, const model::Workpiece* piece) {
  model::Stock& stock = w.plan.stock;
  if (w.inputs.stock) {
    stock.box = *w.inputs.stock;
    stock.source = "given: --stock";
    return;
  }
  if (piece != nullptr) {
    AnyRef shape = piece->its_bounding_geometry;
    if (const auto* raw = w.plan.model.get<model::Workpiece>(piece->its_rawpiece)) {
      if (raw->its_bounding_geometry.set()) shape = raw->its_bounding_geometry;
    }
    if (const auto box = box_of(w.plan.model, shape)) {
      stock.box = *box;
      stock.source = "given: " + std::string(model::noun_type(shape.type).keyword) + " of the workpiece";
      if (const auto* c = w.plan.model.get<model::RightCircularCylinder>(shape))
        stock.cylinder_radius_mm = c->radius;
    }
  }
  if (stock.box.empty() && w.plan.target_mesh) {
    stock.box = geometry::bounds(*w.plan.target_mesh);
    stock.source = "inferred: the box of the surface";
    w.job.warn("PIP-STOCK", "no raw piece is given; taken as the box of the surface: " + words(stock.box));
  }
  if (stock.box.empty()) {
    stock.box = box_of_features(w);
    if (stock.box.empty()) return;
    stock.source = "inferred: the box of the features";
    w.job.warn("PIP-STOCK",
               "no raw piece is given; taken as the box that the features span: " + words(stock.box));
  }
  if (w.inputs.stock_allowance_mm) {
    const double a = *w.inputs.stock_allowance_mm;
    stock.box.lo = stock.box.lo - Vec3{a, a, a};
    stock.box.hi = stock.box.hi + Vec3{a, a, a};
    stock.source += ", grown by " + trimmed(a, 3) + " mm (--stock)";
  }
}

/// Outside a sheet's outline nothing says what is to be made, and a cutter on its border would cut there.
Status sheet_covers_raw_piece(const Work& w) {
  if (!w.plan.target_mesh) return {};
  const geometry::MeshForm form = geometry::form_of(*w.plan.target_mesh);
  if (form.kind != geometry::MeshForm::Kind::kSheet) return {};
  const Box3& raw = w.plan.stock.box;
  const double bare =
      geometry::area(geometry::subtract(geometry::rectangle(xy(raw.lo), xy(raw.hi)), form.outline));
  constexpr double kTraceMm2 = 0.01;  // of outlines rounded to single precision
  if (bare <= kTraceMm2) return {};
  return fail(
      {.code = "PIP-SHEET",
       .message = "the surface is a sheet, and " + trimmed(bare, 2) +
                  " mm2 of the raw piece lie outside its outline: what is to stand there is not known",
       .file = w.plan.file_name,
       .expected = "a sheet over the whole raw piece (" + words(raw) + "), or a closed solid",
       .hint = "extend the surface, close it to a solid, or give a smaller raw piece with --stock box:"});
}

}  // namespace

Box3 transformed(const Box3& box, const geometry::Placement& to) {
  Box3 out;
  for (const double x : {box.lo.x, box.hi.x}) {
    for (const double y : {box.lo.y, box.hi.y}) {
      for (const double z : {box.lo.z, box.hi.z}) out.add(to.to_parent({x, y, z}));
    }
  }
  return out;
}

Box3 part_box(const Work& w) {
  Box3 out = w.plan.stock.box;
  const model::Workpiece* piece = first_workpiece(w.plan);
  const auto own = piece != nullptr ? box_of(w.plan.model, piece->its_bounding_geometry) : std::nullopt;
  const double grown = w.inputs.stock_allowance_mm.value_or(0.0);
  if (own && piece->its_rawpiece.set()) {
    out = *own;
  } else if (grown > 0.0) {
    out.lo = out.lo + Vec3{grown, grown, grown};
    out.hi = out.hi - Vec3{grown, grown, grown};
  }
  return out.empty() ? w.plan.stock.box : out;
}

Status resolve_workpiece(Work& w) {
  const model::Workpiece* piece = first_workpiece(w.plan);
  std::vector<std::string> names;
  if (w.inputs.material_name) {
    names.push_back(*w.inputs.material_name);
  } else if (piece != nullptr) {
    if (const auto* material = w.plan.model.get<model::Material>(piece->its_material)) {
      names.push_back(material->standard_identifier.value_or(""));
      names.push_back(material->material_identifier.value_or(""));
    }
  }
  auto material = tooling::find_material(names, w.inputs.materials, w.job);
  if (!material) return tl::unexpected(material.error());
  w.plan.material = *std::move(material);
  w.plan.machine = w.inputs.machine;
  w.plan.provenance = w.inputs.provenance;
  resolve_stock(w, piece);
  if (w.plan.stock.box.empty()) {
    return fail(
        {.code = "PIP-NOTHING",
         .message =
             "there is neither a raw piece nor a feature whose size is known, so there is nothing to plan",
         .file = w.plan.file_name,
         .hint = "give the workpiece a bounding geometry, or name one with --stock"});
  }
  if (auto ok = sheet_covers_raw_piece(w); !ok) return ok;
  const Vec3 size = w.plan.stock.box.size();
  const double largest = std::max({size.x, size.y, size.z});
  if (!(largest <= kLargestPiece)) {
    return fail({.code = "PIP-STOCK-SIZE",
                 .message = "the raw piece would be " + trimmed(largest / 1000.0, 1) + " m long",
                 .file = w.plan.file_name,
                 .expected = "at most " + trimmed(kLargestPiece / 1000.0, 0) + " m",
                 .hint = "look at the unit of the file, or at --stock"});
  }
  return {};
}

void report_outside(Work& w) {
  constexpr double kBeyond = 0.01;  // mm
  for (const AnyRef f : w.plan.model.all_below(model::TypeId::kMachiningFeature)) {
    const auto shapes = model::shapes_of(w.plan.model, Ref<model::ManufacturingFeature>(f));
    if (!shapes) continue;
    for (const auto& s : *shapes) {
      if (s.area.empty() || s.kind == model::ShapeKind::kStep || s.kind == model::ShapeKind::kOutside)
        continue;
      const auto b = geometry::bounds(s.area);
      const Box3 raw = transformed(w.plan.stock.box, inverse(s.frame));
      std::string how;
      if (b.lo.x > raw.hi.x || b.hi.x < raw.lo.x || b.lo.y > raw.hi.y || b.hi.y < raw.lo.y ||
          -s.depth_mm > raw.hi.z || raw.lo.z > 0.0) {
        how = "lies wholly outside the raw piece: its tool cuts air, or what holds the piece";
      } else if (-s.depth_mm < raw.lo.z - kBeyond ||
                 (s.kind == model::ShapeKind::kFace && -s.depth_mm < raw.lo.z + kBeyond)) {
        how = "goes down to or below the underside of the raw piece";
      } else if (s.kind != model::ShapeKind::kFace && !s.open &&
                 (b.lo.x < raw.lo.x - kBeyond || b.hi.x > raw.hi.x + kBeyond || b.lo.y < raw.lo.y - kBeyond ||
                  b.hi.y > raw.hi.y + kBeyond)) {
        how = "reaches over the edge of the raw piece";
      }
      if (how.empty()) continue;
      w.job.report({.code = "PIP-OUTSIDE",
                    .severity = Severity::kWarning,
                    .message = "feature '" + s.name + "' " + how,
                    .file = w.plan.file_name,
                    .instance = w.plan.model.origin(f).instance,
                    .hint = "look at its placement, or at the raw piece (" + words(w.plan.stock.box) + ")"});
      break;
    }
  }
}

}  // namespace capstan::pipeline
