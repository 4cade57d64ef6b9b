#include "planner/door/service/reading.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "planner/controls/controls.h"
#include "planner/door/service/formats.h"
#include "planner/files/exchange/brep/one_body.h"
#include "planner/files/exchange/brep/read_brep.h"
#include "planner/files/exchange/cad/stl.h"
#include "planner/files/exchange/common/standard.h"
#include "planner/files/json/json.h"
#include "planner/files/recognise/recognise.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/foreign/foreign_file.h"
#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/unit_factors.h"
#include "planner/proof/verify/program_signs.h"

namespace capstan::service {
namespace {

constexpr std::string_view kMark = "\xEF\xBB\xBF";  // UTF-8's byte order mark
constexpr std::string_view kBlank = " \t\r\n";

std::string_view trimmed_front(std::string_view s) {
  if (s.starts_with(kMark)) s.remove_prefix(kMark.size());
  const auto at = s.find_first_not_of(kBlank);
  return at == std::string_view::npos ? std::string_view{} : s.substr(at);
}

/// Every line that is not blank or a comment begins with T and a digit, and has a P or a D.
bool looks_like_tool_table(std::string_view bytes) {
  std::size_t lines = 0;
  while (!bytes.empty()) {
    const auto end = std::min(bytes.find('\n'), bytes.size());
    std::string_view line = trimmed_front(bytes.substr(0, end));
    bytes.remove_prefix(std::min(end + 1, bytes.size()));
    if (line.empty() || line.front() == ';') continue;
    line = line.substr(0, std::min(line.find(';'), line.size()));
    const bool tool = line.size() > 1 && (line[0] == 'T' || line[0] == 't') &&
                      std::isdigit(static_cast<unsigned char>(line[1])) != 0 &&
                      line.find_first_of("PpDdZz") != std::string_view::npos &&
                      line.find_first_of("MmGg") == std::string_view::npos;
    if (!tool) return false;
    ++lines;
  }
  return lines != 0;
}

}  // namespace

Content content_of(std::string_view bytes) {
  const std::string_view text = trimmed_front(bytes);
  if (text.starts_with('{')) return Content::kPlanJson;
  // Comments may precede a Part 21 file.
  const std::string_view head = bytes.substr(0, std::min<std::size_t>(bytes.size(), 1 << 20));
  if (head.find("ISO-10303-21") != std::string_view::npos || exchange::looks_like_stl(bytes))
    return Content::kPart;
  if (looks_like_tool_table(bytes)) return Content::kToolTable;
  return Content::kProgram;
}

bool is_cad_model(std::string_view bytes) {
  return content_of(bytes) == Content::kPart && exchange::standard_of(bytes) == exchange::Standard::kShapes;
}

namespace {

/// What a file is that is no part and no plan; nothing: it may be one.
std::optional<Diagnostic> no_plan(std::string_view bytes, const std::string& path) {
  std::string what, hint;
  if (const auto foreign = foreign_file(bytes)) {
    what = foreign->what;
    hint = foreign->hint;
  } else if (content_of(bytes) == Content::kProgram) {
    const auto sign = verify::dialect_sign(bytes.substr(0, std::min<std::size_t>(bytes.size(), 1 << 16)));
    if (!sign) return std::nullopt;
    const controls::Dialect* control = controls::find_dialect(sign->dialects.front());
    what = "a program" + (control == nullptr ? "" : " for " + std::string(control->name)) + " (" +
           sign->text + ", in line " + std::to_string(sign->line) + ")";
    hint = kPlanItsPart;
  } else {
    return std::nullopt;
  }
  return Diagnostic{.code = "READ-FOREIGN",
                    .message = "this is " + what + ", which is no part and no plan",
                    .file = path,
                    .expected = read_text(),
                    .hint = hint};
}

Result<model::Plan> read_with(std::string bytes, const std::string& path, Job& job, bool strict,
                              const std::optional<exchange::MeshUnit>& unit) {
  if (unit && !exchange::looks_like_stl(bytes))
    return fail({.code = "READ-UNIT",
                 .message = "a mesh's unit is stated (" + unit->name + "), but the file is no STL mesh",
                 .file = path,
                 .expected = "an STL mesh, or no " + unit->source,
                 .hint = "other files state their unit themselves"});
  if (content_of(bytes) == Content::kPlanJson) {
    if (bytes.starts_with(kMark)) bytes.erase(0, kMark.size());
    return json::read_json(std::move(bytes), path, job);
  }
  if (auto d = no_plan(bytes, path)) return fail(*std::move(d));
  exchange::ReadOptions options;
  options.strict = strict;
  options.mesh_unit = unit;
  return exchange::read_bytes(std::move(bytes), path, options, job);
}

/// The shape of a CAD model as the check asks for it.
std::shared_ptr<const verify::AskedShape> asked_shape(const exchange::Brep& shape, const std::string& name) {
  verify::AskedShape out;
  out.file = name;
  out.chord_mm = shape.chord;
  out.mesh = {shape.points, shape.triangles};
  for (std::uint32_t f = 0; f < shape.faces.size(); ++f) {
    const exchange::Face& face = shape.faces[f];
    if (face.carrier != exchange::Carrier::kPlane) continue;
    verify::AskedShape::Plane plane{recognise::faces_in_words(shape, {f}), {}};
    for (std::uint32_t t = 0; t < face.triangle_count; ++t)
      plane.triangles.push_back(face.first_triangle + t);
    out.planes.push_back(std::move(plane));
  }
  return std::make_shared<const verify::AskedShape>(std::move(out));
}

/// The number of the one solid of a file that holds sheets, too: a sheet has no volume, so that it is help or
/// reference. Nothing: there are no sheets, or it is not one solid.
std::optional<std::string> the_solid(const exchange::Brep& shape, const std::string& name, Job& job) {
  std::vector<std::size_t> solids;
  for (std::size_t b = 0; b < shape.bodies.size(); ++b) {
    if (shape.bodies[b].solid) solids.push_back(b);
  }
  if (solids.size() != 1 || shape.bodies.size() == 1) return std::nullopt;
  // A sheet with more faces may be the part, not closed.
  const std::uint32_t most = shape.bodies[solids.front()].face_count;
  if (std::any_of(shape.bodies.begin(), shape.bodies.end(),
                  [&](const auto& b) { return b.face_count > most; }))
    return std::nullopt;
  job.report(
      {.code = "CAD-SHEETS",
       .severity = Severity::kWarning,
       .message = "beside the one solid the file holds " +
                  counted(shape.bodies.size() - 1, "sheet", "sheets") +
                  ", without volume: the solid is planned; there are: " + exchange::bodies_in_words(shape),
       .file = name,
       .hint = "save the part alone, or name a body by its number or name (--body)"});
  return std::to_string(solids.front() + 1);
}

}  // namespace

Result<model::Plan> read_plan(std::string bytes, const std::string& path, Job& job, bool strict) {
  return read_with(std::move(bytes), path, job, strict, {});
}

Result<PartRead> read_part(std::string bytes, const std::string& name, const from_cad::Stated& stated,
                           Job& job, bool strict, const std::optional<exchange::MeshUnit>& unit,
                           const std::optional<std::string>& body) {
  if (unit || !is_cad_model(bytes)) {
    if (body)
      return fail({.code = "READ-BODY",
                   .message = "body '" + *body + "' is to be planned, but the file is no CAD model",
                   .file = name,
                   .expected = "a CAD part in STEP (AP203, AP214 or AP242)",
                   .hint = "leave the body out"});
    if (!stated.threads.empty())
      return fail({.code = "READ-TAPPED",
                   .message = "'" + stated.threads.front().text +
                              "' states a thread of a hole, but the file is no CAD model",
                   .file = name,
                   .expected = "a CAD part in STEP (AP203, AP214 or AP242)",
                   .hint = "threads of other files are features of theirs"});
    auto plan = read_with(std::move(bytes), name, job, strict, unit);
    if (!plan) return tl::unexpected(plan.error());
    return PartRead{*std::move(plan), nullptr};
  }
  auto shape = exchange::read_brep_bytes(std::move(bytes), name, {}, job);
  if (!shape) return tl::unexpected(shape.error());
  const auto asked = body ? body : the_solid(*shape, name, job);
  if (asked) {
    shape = exchange::one_body(*shape, *asked, name);
    if (!shape) return tl::unexpected(shape.error());
  }
  auto plan = from_cad::plan_of_part(*shape, name, stated, job);
  if (!plan) return tl::unexpected(plan.error());
  std::string of_lengths = shape->unit;
  const double more = 2.0 * stated.raw.allowance_mm;
  const geometry::Vec3 size =
      stated.raw.box ? stated.raw.box->size() : shape->box.size() + geometry::Vec3{more, more, more};
  return PartRead{*std::move(plan), asked_shape(from_cad::straightened(*std::move(shape)), name),
                  std::move(of_lengths), size};
}

Result<model::Plan> load_plan(const std::string& path, Job& job, bool strict,
                              const std::optional<exchange::MeshUnit>& unit) {
  auto bytes = read_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  return read_with(*std::move(bytes), path, job, strict, unit);
}

std::optional<exchange::MeshUnit> mesh_unit(const std::optional<std::string>& stated,
                                            const std::string& source) {
  if (!stated) return std::nullopt;
  return exchange::MeshUnit{*stated == "inch" ? kMmPerInch : 1.0, *stated, source};
}

}  // namespace capstan::service
