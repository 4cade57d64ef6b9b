#include "planner/files/exchange/cad/stl.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <tuple>

#include "planner/ground/base/no_number.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/stopping.h"
#include "planner/ground/geometry/mesh/mesh_form.h"
#include "planner/ground/geometry/mesh/turned_alike.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/range/ranges.h"

namespace capstan::exchange {

using geometry::Mesh;
using geometry::Vec3;

namespace {

constexpr std::size_t kHeader = 84, kTriangle = 50;  // bytes of the binary form
/// Of the largest side of a mesh whose unit nobody stated: in mm, parts that are milled are larger, and 10
/// inches are what small machines travel. Default; PrusaSlicer asks below 9 mm3 of volume, which a plate of
/// 4 x 4 x 1 inches has not.
constexpr double kInchMm = 10.0;
/// Less area that faces down is the rounding of coordinates. Default, unsourced.
constexpr double kHiddenMm2 = 0.01;

std::uint32_t u32(std::string_view s, std::size_t at) {
  std::uint32_t v = 0;
  for (std::size_t i = 4; i-- > 0;) v = (v << 8) | static_cast<unsigned char>(s[at + i]);
  return v;
}

bool is_binary(std::string_view s) {
  return s.size() >= kHeader && s.size() == kHeader + kTriangle * std::size_t{u32(s, 80)};
}

/// Leaves one of triangles that have the same corners in the same order, the first; gives how many it left
/// out. Two that face opposite ways are no doubles: bodies that touch have such. But where every triangle has
/// its opposite, the mesh is one sheet drawn from both sides, and one side is left.
std::size_t leave_out_doubles(std::vector<std::array<std::uint32_t, 3>>& triangles) {
  struct Named {
    std::array<std::uint32_t, 3> corners;  ///< from the lowest on
    std::uint32_t at;
    bool other;  ///< the two corners behind the lowest were swapped: as its opposite has them
  };
  std::vector<Named> all;
  all.reserve(triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    tick();
    auto c = triangles[i];
    std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
    const bool other = c[2] < c[1];
    if (other) std::swap(c[1], c[2]);
    all.push_back({c, i, other});
  }
  std::sort(all.begin(), all.end(), [](const Named& a, const Named& b) {
    return std::tie(a.corners, a.other, a.at) < std::tie(b.corners, b.other, b.at);
  });
  std::vector<bool> out(triangles.size()), opposite(triangles.size());
  std::size_t left_out = 0, pairs = 0;
  for (std::size_t i = 0; i < all.size();) {
    std::array<std::size_t, 2> of{};  // how many run either way
    const std::size_t from = i;
    for (; i < all.size() && all[i].corners == all[from].corners; ++i) {
      if (of[all[i].other ? 1 : 0]++ == 0) continue;
      out[all[i].at] = true;
      ++left_out;
    }
    if (of[0] == 0 || of[1] == 0) continue;
    ++pairs;
    opposite[std::max(all[from].at, all[from + of[0]].at)] = true;
  }
  if (2 * pairs == triangles.size() - left_out) {
    left_out += pairs;
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = out[i] || opposite[i];
  }
  if (left_out == 0) return 0;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    if (!out[i]) triangles[kept++] = triangles[i];
  triangles.resize(kept);
  return left_out;
}

class Builder {
 public:
  explicit Builder(double mm_per_unit) : mm_per_unit_(mm_per_unit) {}

  /// The normal that the file states of the triangle whose corners follow; zero: none.
  void normal(Vec3 n) { normal_ = n; }
  /// Gives what is wrong with the corner, as "a coordinate is 1e300; ...", or nothing.
  [[nodiscard]] std::string corner(Vec3 p) {
    for (const double v : {p.x, p.y, p.z}) {
      if (!model::range::kPositionMm.holds(mm_per_unit_ * v))
        return "a coordinate is " + model::value_text(v) +
               (mm_per_unit_ == 1.0 ? std::string() : " x " + trimmed(mm_per_unit_, 3) + " mm") +
               "; it can be " + to_text(model::range::kPositionMm) + " mm";
    }
    p = mm_per_unit_ * p;
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
    if (against_ != 0) {
      job.report({.code = "STL-NORMAL",
                  .severity = Severity::kWarning,
                  .message = "the normals that " + std::to_string(against_) + " of " +
                             std::to_string(mesh_.triangles.size()) +
                             " triangles state are against the order of their corners; the order is taken",
                  .file = name});
    }
    if (const std::size_t twice = leave_out_doubles(mesh_.triangles); twice != 0) {
      job.report(
          {.code = "STL-TWICE",
           .severity = Severity::kWarning,
           .message = std::to_string(twice) + " triangles are there more than once; one of each is taken",
           .file = name});
    }
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
      if (dot(n, normal_) < -0.5 * norm(n) * norm(normal_)) ++against_;  // slivers' normals are rounded
      mesh_.triangles.push_back({corners_[0], corners_[1], corners_[2]});
    }
    normal_ = {};
  }

  double mm_per_unit_;
  Vec3 normal_;
  Mesh mesh_;
  std::map<std::tuple<double, double, double>, std::uint32_t> index_;
  std::array<std::uint32_t, 3> corners_{};
  std::size_t count_ = 0, flat_ = 0, against_ = 0;
};

Result<Mesh> read_binary(std::string_view s, const std::string& name, double mm_per_unit, Job& job) {
  Builder out(mm_per_unit);
  const std::size_t n = u32(s, 80);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t from = kHeader + i * kTriangle, at = from + 12;  // behind the normal
    const auto stated = [&](std::size_t c) { return double{std::bit_cast<float>(u32(s, from + 4 * c))}; };
    out.normal({stated(0), stated(1), stated(2)});
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
  void skip_line() { (void)rest_of_line(); }
  std::string_view rest_of_line() {
    const std::size_t from = i_;
    while (i_ < s_.size() && s_[i_] != '\n') ++i_;
    return s_.substr(from, i_ - from);
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

/// Of "normal 0 0 1"; zero where it is not written so, for the order of the corners holds.
Vec3 stated_normal(std::string_view line) {
  Words words(line);
  if (!same_word(words.next(), "normal")) return {};
  std::array<double, 3> n{};
  for (double& x : n) {
    const auto v = parse_double(words.next());
    if (!v) return {};
    x = *v;
  }
  return {n[0], n[1], n[2]};
}

Result<Mesh> read_ascii(std::string_view s, const std::string& name, double mm_per_unit, Job& job) {
  Words words(s);
  Builder out(mm_per_unit);
  bool ended = false;
  for (std::string_view w = words.next(); !w.empty(); w = words.next()) {
    if (same_word(w, "solid") || same_word(w, "endsolid") || same_word(w, "outer")) {
      ended = same_word(w, "endsolid");
      words.skip_line();  // a name, "loop"
    } else if (same_word(w, "facet")) {
      ended = false;
      out.normal(stated_normal(words.rest_of_line()));
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

Result<Mesh> read_stl(std::string_view s, const std::string& name, Job& job, double mm_per_unit) {
  return is_binary(s) ? read_binary(s, name, mm_per_unit, job) : read_ascii(s, name, mm_per_unit, job);
}

namespace {

/// The area of a solid that faces down above its underside, mm2, and the share of it in all but the
/// underside.
struct Hidden {
  double area_mm2 = 0.0, share = 0.0;
};
Hidden hidden_of(const Mesh& mesh, bool inside_out) {
  const double lowest = geometry::bounds(mesh).lo.z + geometry::kWeldMm;
  Hidden out;
  double all = 0.0;
  for (const auto& t : mesh.triangles) {
    tick();
    const Vec3 a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
    const Vec3 n = (inside_out ? -0.5 : 0.5) * cross(b - a, c - a);
    const bool down = n.z < -geometry::kUprightNormal * norm(n);
    if (down && std::max({a.z, b.z, c.z}) <= lowest) continue;  // the underside
    all += norm(n);
    if (down) out.area_mm2 += norm(n);
  }
  if (all > 0.0) out.share = out.area_mm2 / all;
  return out;
}

}  // namespace

Result<Mesh> judged_mesh(Mesh mesh, const std::string& name, Job& job, bool unit_stated) {
  using Kind = geometry::MeshForm::Kind;
  const auto warn = [&](const char* code, std::string text, std::string hint = {}) {
    job.report({.code = code,
                .severity = Severity::kWarning,
                .message = std::move(text),
                .file = name,
                .hint = std::move(hint)});
  };
  geometry::MeshForm form = geometry::form_of(mesh);
  if (form.turned_edges > 0) {
    geometry::TurnedAlike alike = geometry::turned_alike(std::move(mesh));
    mesh = std::move(alike.mesh);
    if (alike.turned > 0) {
      warn("STL-TURNED", std::to_string(alike.turned) + " of " + std::to_string(mesh.triangles.size()) +
                             " triangles face against their neighbours, the first at (" +
                             trimmed(alike.first.x, 3) + ", " + trimmed(alike.first.y, 3) + ", " +
                             trimmed(alike.first.z, 3) + "); they are turned to face as these do");
      form = geometry::form_of(mesh);
    }
    if (form.turned_edges > 0)
      warn("STL-TURNED", std::to_string(form.turned_edges) +
                             " edges lie between triangles that face opposite ways, and no turning mends it; "
                             "the surface is taken as it lies");
  }
  if (form.kind == Kind::kBroken) {
    return fail({.code = "STL-OPEN",
                 .message = "the mesh is neither closed nor a sheet: " + form.fault,
                 .file = name,
                 .expected = "every edge between two triangles (corners within " +
                             trimmed(geometry::kWeldMm, 4) +
                             " mm are one), or a surface open at its outer border only",
                 .hint = "close it in the program that wrote it; what stands under an opening is not known"});
  }
  if (form.kind == Kind::kSheet)
    warn("STL-SHEET", "the mesh is a sheet, not a solid: what lies outside its outline stays as it is");
  if (form.crowded_edges > 0)
    warn("STL-CROWDED", std::to_string(form.crowded_edges) + " edges are shared by more than two triangles");
  if (form.inside_out)
    warn("STL-INSIDE-OUT",
         "the triangles of the mesh face inwards; it is read as the solid that they enclose");
  if (form.faces_down) {
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
    warn("STL-FACES-DOWN",
         "the triangles of the sheet face down; it is read as the surface that is seen from above",
         "if its other side is meant, turn the part over in the program that wrote it");
  }
  if (form.kind == Kind::kSolid) {
    if (const Hidden hidden = hidden_of(mesh, form.inside_out); hidden.area_mm2 > kHiddenMm2)
      warn("STL-UNDERCUT",
           trimmed(hidden.area_mm2, 2) + " mm2 of the mesh (" + trimmed(100.0 * hidden.share, 1) +
               " % of what is not its underside) face down: no cutter reaches them from above");
  }
  const Vec3 size = geometry::bounds(mesh).size();
  if (!unit_stated && std::max({size.x, size.y, size.z}) < kInchMm)
    warn("STL-INCH",
         "the mesh is " + trimmed(size.x, 3) + " x " + trimmed(size.y, 3) + " x " + trimmed(size.z, 3) +
             " mm if its unit is mm, which STL does not state: it may be in inches",
         "say what its unit is where it is planned or converted (mesh-unit: inch or mm)");
  return mesh;
}

model::Plan plan_of_mesh(Mesh mesh, const std::string& name, model::Provenance unit) {
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
  plan.provenance.push_back(std::move(unit));
  plan.target_mesh = std::make_shared<const Mesh>(std::move(mesh));
  return plan;
}

}  // namespace capstan::exchange
