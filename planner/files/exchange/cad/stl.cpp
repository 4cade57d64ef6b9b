#include "planner/files/exchange/cad/stl.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <tuple>

#include "planner/ground/base/no_number.h"
#include "planner/ground/base/number.h"
#include "planner/ground/geometry/mesh/mesh_form.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/range/ranges.h"

namespace capstan::exchange {

using geometry::Mesh;
using geometry::Vec3;

namespace {

constexpr std::size_t kHeader = 84, kTriangle = 50;  // bytes of the binary form

std::uint32_t u32(std::string_view s, std::size_t at) {
  std::uint32_t v = 0;
  for (std::size_t i = 4; i-- > 0;) v = (v << 8) | static_cast<unsigned char>(s[at + i]);
  return v;
}

bool is_binary(std::string_view s) {
  return s.size() >= kHeader && s.size() == kHeader + kTriangle * std::size_t{u32(s, 80)};
}

class Builder {
 public:
  /// Gives what is wrong with the corner, as "a coordinate is 1e300; ...", or nothing.
  [[nodiscard]] std::string corner(Vec3 p) {
    for (const double v : {p.x, p.y, p.z}) {
      if (!model::range::kPositionMm.holds(v))
        return "a coordinate is " + model::value_text(v) + "; it can be " +
               to_text(model::range::kPositionMm) + " mm";
    }
    const auto next = static_cast<std::uint32_t>(mesh_.vertices.size());
    // + 0.0 makes one corner of 0 and -0.
    const auto [it, fresh] = index_.emplace(std::tuple(p.x + 0.0, p.y + 0.0, p.z + 0.0), next);
    if (fresh) mesh_.vertices.push_back({p.x + 0.0, p.y + 0.0, p.z + 0.0});
    corners_[count_++] = it->second;
    if (count_ == 3) triangle();
    return {};
  }
  [[nodiscard]] bool between_triangles() const { return count_ == 0; }

  Result<Mesh> finish(const std::string& name, Job& job) {
    if (flat_ != 0) {
      job.report({.code = "STL-FLAT",
                  .severity = Severity::kWarning,
                  .message = std::to_string(flat_) + " triangles without area left out",
                  .file = name});
    }
    if (mesh_.triangles.empty())
      return fail({.code = "STL-EMPTY", .message = "the mesh is empty", .file = name});
    return std::move(mesh_);
  }

 private:
  void triangle() {
    count_ = 0;
    const auto& v = mesh_.vertices;
    const Vec3 n = cross(v[corners_[1]] - v[corners_[0]], v[corners_[2]] - v[corners_[0]]);
    if (n == Vec3{}) {
      ++flat_;
    } else {
      mesh_.triangles.push_back({corners_[0], corners_[1], corners_[2]});
    }
  }

  Mesh mesh_;
  std::map<std::tuple<double, double, double>, std::uint32_t> index_;
  std::array<std::uint32_t, 3> corners_{};
  std::size_t count_ = 0, flat_ = 0;
};

Result<Mesh> read_binary(std::string_view s, const std::string& name, Job& job) {
  Builder out;
  const std::size_t n = u32(s, 80);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t at = kHeader + i * kTriangle + 12;  // behind the normal
    for (std::size_t k = 0; k < 3; ++k) {
      const auto f = [&](std::size_t c) { return double{std::bit_cast<float>(u32(s, at + 12 * k + 4 * c))}; };
      if (const std::string wrong = out.corner({f(0), f(1), f(2)}); !wrong.empty()) {
        return fail({.code = "STL-NUMBER",
                     .message = "triangle " + std::to_string(i + 1) + ": " + wrong,
                     .file = name});
      }
    }
  }
  return out.finish(name, job);
}

class Words {
 public:
  explicit Words(std::string_view s) : s_(s) {}
  std::string_view next() {
    while (i_ < s_.size() && is_space(s_[i_])) line_ += s_[i_++] == '\n' ? 1 : 0;
    const std::size_t from = i_;
    while (i_ < s_.size() && !is_space(s_[i_])) ++i_;
    return s_.substr(from, i_ - from);
  }
  void skip_line() {
    while (i_ < s_.size() && s_[i_] != '\n') ++i_;
  }
  [[nodiscard]] std::uint64_t line() const { return line_; }

 private:
  static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
  std::string_view s_;
  std::size_t i_ = 0;
  std::uint64_t line_ = 1;
};

bool same_word(std::string_view a, std::string_view lower) {
  if (a.size() != lower.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const char c = a[i] >= 'A' && a[i] <= 'Z' ? static_cast<char>(a[i] - 'A' + 'a') : a[i];
    if (c != lower[i]) return false;
  }
  return true;
}

tl::unexpected<Diagnostic> truncated(const std::string& name, std::uint64_t line) {
  return fail(
      {.code = "STL-TRUNCATED", .message = "the mesh ends without endsolid", .file = name, .line = line});
}

Result<Mesh> read_ascii(std::string_view s, const std::string& name, Job& job) {
  Words words(s);
  Builder out;
  bool ended = false;
  for (std::string_view w = words.next(); !w.empty(); w = words.next()) {
    if (same_word(w, "solid") || same_word(w, "endsolid") || same_word(w, "facet") || same_word(w, "outer")) {
      ended = same_word(w, "endsolid");
      words.skip_line();  // a name, a normal, "loop"
    } else if (same_word(w, "vertex")) {
      std::array<double, 3> c{};
      for (double& x : c) {
        const std::string_view number = words.next();
        const auto v = parse_double(number);
        if (number.empty()) return truncated(name, words.line());
        if (!v) {
          return fail(
              {.code = "STL-NUMBER", .message = no_number(number), .file = name, .line = words.line()});
        }
        x = *v;
      }
      if (const std::string wrong = out.corner({c[0], c[1], c[2]}); !wrong.empty()) {
        return fail({.code = "STL-NUMBER", .message = wrong, .file = name, .line = words.line()});
      }
    } else if (same_word(w, "endloop") || same_word(w, "endfacet")) {
      if (!out.between_triangles()) {
        return fail({.code = "STL-SYNTAX",
                     .message = "a facet has not three corners",
                     .file = name,
                     .line = words.line()});
      }
    } else {
      return fail({.code = "STL-SYNTAX",
                   .message = "'" + std::string(w.substr(0, 40)) + "' does not belong here",
                   .file = name,
                   .line = words.line()});
    }
  }
  if (!ended || !out.between_triangles()) return truncated(name, words.line());
  return out.finish(name, job);
}

}  // namespace

bool looks_like_stl(std::string_view s) {
  if (is_binary(s)) return true;
  Words words(s.substr(0, 4096));
  if (!same_word(words.next(), "solid")) return false;
  words.skip_line();
  const std::string_view w = words.next();
  return same_word(w, "facet") || same_word(w, "endsolid");
}

Result<Mesh> read_stl(std::string_view s, const std::string& name, Job& job) {
  return is_binary(s) ? read_binary(s, name, job) : read_ascii(s, name, job);
}

Status judge_mesh(const Mesh& mesh, const std::string& name, Job& job) {
  using Kind = geometry::MeshForm::Kind;
  const geometry::MeshForm form = geometry::form_of(mesh);
  if (form.kind == Kind::kBroken) {
    return fail({.code = "STL-OPEN",
                 .message = "the mesh is neither closed nor a sheet: " + form.fault,
                 .file = name,
                 .expected = "every edge between two triangles (corners within " +
                             trimmed(geometry::kWeldMm, 4) +
                             " mm are one), or a surface open at its outer border only",
                 .hint = "close it in the program that wrote it; what stands under an opening is not known"});
  }
  const auto warn = [&](const char* code, std::string text) {
    job.report({.code = code, .severity = Severity::kWarning, .message = std::move(text), .file = name});
  };
  if (form.kind == Kind::kSheet)
    warn("STL-SHEET", "the mesh is a sheet, not a solid: what lies outside its outline stays as it is");
  if (form.crowded_edges > 0)
    warn("STL-CROWDED", std::to_string(form.crowded_edges) + " edges are shared by more than two triangles");
  if (form.turned_edges > 0)
    warn("STL-TURNED",
         std::to_string(form.turned_edges) +
             " edges lie between triangles that face opposite ways; the surface is taken as it lies");
  if (form.inside_out)
    warn("STL-INSIDE-OUT",
         "the triangles of the mesh face inwards; it is read as the solid that they enclose");
  return {};
}

model::Plan plan_of_mesh(Mesh mesh, const std::string& name) {
  model::Plan plan;
  auto& m = plan.model;
  plan.file_name = name;
  model::Workpiece piece;
  piece.its_id = "part";
  piece.clamping_positions.given = true;
  const auto workpiece = m.add(std::move(piece));
  model::Workplan workplan;
  workplan.its_id = "main";
  workplan.its_elements.given = true;
  model::Project project;
  project.its_id = name;
  project.main_workplan = m.add(std::move(workplan));
  project.its_workpieces.push_back(workpiece);
  plan.project = m.add(std::move(project));
  model::TopologicalRegion region;
  region.its_id = "surface";
  region.its_workpiece = workpiece;
  region.its_operations.given = true;
  region.name = "the whole mesh";
  region.cfs_faces.given = true;
  plan.kept.push_back(m.add(std::move(region)));
  plan.provenance.push_back({"mesh unit", "mm", "assumed: STL states none"});
  plan.target_mesh = std::make_shared<const Mesh>(std::move(mesh));
  return plan;
}

}  // namespace capstan::exchange
