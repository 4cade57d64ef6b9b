#include "planner/files/exchange/cad/stl.h"
#include "planner/files/exchange/common/standard.h"
#include "planner/files/exchange/exchange.h"
#include "planner/ground/base/file.h"

namespace capstan::exchange {
namespace {

// The text behind white space, a byte order mark and comments.
std::string_view body(std::string_view s) {
  if (s.substr(0, 3) == "\xEF\xBB\xBF") s.remove_prefix(3);
  while (!s.empty()) {
    const auto i = s.find_first_not_of(" \t\r\n");
    if (i == std::string_view::npos) return {};
    s.remove_prefix(i);
    if (s.substr(0, 2) != "/*") break;
    const auto end = s.find("*/", 2);
    if (end == std::string_view::npos) return s;
    s.remove_prefix(end + 2);
  }
  return s;
}

}  // namespace

Result<model::Plan> read(const std::string& path, Job& job) { return read(path, ReadOptions{}, job); }

Result<model::Plan> read(const std::string& path, const ReadOptions& options, Job& job) {
  auto bytes = read_file(path, options.limits.bytes);
  if (!bytes) return fail(bytes.error());
  return read_bytes(std::move(*bytes), path, options, job);
}

Result<model::Plan> read_bytes(std::string bytes, const std::string& name, const ReadOptions& options,
                               Job& job) {
  if (body(bytes).substr(0, 12) == "ISO-10303-21") {
    const auto file = p21::parse(std::move(bytes), name, options.limits, job);
    if (!file) return fail(file.error());
    const Standard standard = standard_of(*file);
    if (standard == Standard::kIso14649) return read_iso14649(*file, job, options.strict);
    if (standard == Standard::kAp238) return read_ap238(*file, job, options.strict);
    const auto schemas = file->schemas();
    if (standard == Standard::kShapes)
      return fail({.code = "EXC-UNSUPPORTED",
                   .message = "the file is a CAD model (" +
                              (schemas.empty() ? std::string("no schema") : schemas.front()) +
                              "), which holds no plan",
                   .file = name,
                   .expected = "a plan (ISO 14649, ISO 10303-238)",
                   .hint = "capstan plan " + name + " plans it; capstan inspect " + name +
                           " shows its bodies, faces and features"});
    return fail(
        {.code = "EXC-UNSUPPORTED",
         .message = "the file's schema " + (schemas.empty() ? std::string("(none)") : schemas.front()) +
                    " cannot be read as a plan",
         .file = name,
         .expected =
             "MACHINING_SCHEMA, MILLING_SCHEMA, COMBINED_SCHEMA (ISO 14649), INTEGRATED_CNC_SCHEMA or "
             "MODEL_BASED_INTEGRATED_MANUFACTURING_SCHEMA (ISO 10303-238)"});
  }
  if (looks_like_stl(bytes)) {
    const MeshUnit unit = options.mesh_unit.value_or(MeshUnit{});
    auto mesh = read_stl(bytes, name, job, unit.mm);
    if (!mesh) return fail(mesh.error());
    mesh = judged_mesh(std::move(*mesh), name, job, options.mesh_unit.has_value());
    if (!mesh) return fail(mesh.error());
    return plan_of_mesh(std::move(*mesh), name, {std::string(kMeshUnit), unit.name, unit.source});
  }
  return fail(
      {.code = "EXC-UNKNOWN-FORMAT",
       .message = "the file is neither a Part 21 file (which begins with 'ISO-10303-21;') nor an STL mesh",
       .file = name,
       .hint = "give a plan (ISO 14649, AP238), a CAD part (STEP) or a mesh (STL)"});
}

}  // namespace capstan::exchange
