#include "planner/files/from_cad/from_cad.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "planner/files/exchange/brep/one_body.h"
#include "planner/files/from_cad/areas.h"
#include "planner/files/from_cad/asked/requirements.h"
#include "planner/files/from_cad/cover.h"
#include "planner/files/from_cad/holes.h"
#include "planner/ground/base/number.h"
#include "planner/model/plan/decision/not_recognised.h"

namespace capstan::from_cad {
namespace {

using recognise::Feature;
using recognise::Recognition;

bool is_hole(const Feature& f) {
  return f.type == model::TypeId::kRoundHole || f.type == model::TypeId::kCounterboreHole ||
         f.type == model::TypeId::kCountersunkHole;
}

std::string word_of(model::TypeId type) {
  std::string out;
  for (const char c : model::noun_type(type).keyword)
    out += c == '_' ? ' ' : static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return out;
}

/// Faces that no feature of the plan makes, and why.
struct Left {
  std::vector<std::uint32_t> faces;
  std::string why;
};

/// Recognition in terms of rooms and holes.
struct Removal {
  std::vector<Room> rooms;
  std::vector<Hole> holes;
  std::vector<std::size_t> hole_of;  ///< per hole: into Recognition::features
  std::vector<Left> left;
};

std::string too_thin(const Room& room) {
  return "its area of " + trimmed(geometry::area(room.area), 4) + " mm2 at the level of " +
         trimmed(room.level_mm, 3) + " mm is thinner than points are told apart, 0.0001 mm: nothing is drawn";
}

/// The sides of the part that lie below the raw piece's: faces to be milled.
std::vector<Feature> sides_to_mill(const Part& part, const Recognition& found) {
  std::vector<Feature> out;
  for (const std::uint32_t f : found.on_raw) {
    const Vec3 normal = normal_of(part.brep().faces[f]);
    const geometry::Placement frame = Part::frame_along(normal);
    if (part.raw_span(frame).second - part.span(frame, {f}).second < kLevelMm) continue;
    const auto same = std::find_if(out.begin(), out.end(), [&](const Feature& o) {
      return recognise::kSameAngleRad > norm(o.access - normal);
    });
    if (same != out.end()) {
      same->faces.push_back(f);
      continue;
    }
    Feature side;
    side.type = model::TypeId::kPlanarFace;
    side.access = normal;
    side.faces = {f};
    side.reason = "a side of the part below that of the raw piece";
    out.push_back(side);
  }
  return out;
}

/// Why a feature is not asked for ways at all; empty: it is.
std::string not_written(const Feature& f) {
  const bool leans =
      std::any_of(f.parameters.begin(), f.parameters.end(), [](const auto& p) { return p.name == "slope"; });
  if (leans) return "its walls lean; walls that lean are not planned from CAD files yet";
  if (f.type == model::TypeId::kRegionSurfaceList)
    return "it is a surface without walls and floors; such surfaces are planned from STL meshes only";
  return {};
}

Removal removal_of(const Part& part, const std::vector<Feature>& features) {
  Removal out;
  struct Wanted {
    std::size_t feature = 0;
    std::vector<Way> ways;
  };
  std::vector<Wanted> wanted;
  for (std::size_t i = 0; i < features.size(); ++i) {
    const Feature& f = features[i];
    std::string why = not_written(f);
    if (why.empty() && is_hole(f)) {
      if (auto hole = hole_of(part, f, why)) {
        out.holes.push_back(*std::move(hole));
        out.hole_of.push_back(i);
        continue;
      }
    }
    // A hole that no drill makes may be a pocket.
    if (why.empty() || is_hole(f)) {
      std::string no_way;
      Wanted w{i, ways_of(part, f, no_way)};
      if (!w.ways.empty()) {
        wanted.push_back(std::move(w));
        continue;
      }
      if (why.empty()) why = no_way;
    }
    out.left.push_back({f.faces, "a " + word_of(f.type) + ": " + why});
  }
  // Fewest set-ups: first the directions without which a feature is not reached, then what these reach.
  std::vector<Vec3> used;
  const auto known = [&](Vec3 d) { return std::find(used.begin(), used.end(), d) != used.end(); };
  for (const Hole& h : out.holes) {
    if (!known(h.frame.z)) used.push_back(h.frame.z);
  }
  for (const Wanted& w : wanted) {
    if (w.ways.size() == 1 && !known(w.ways.front().frame.z)) used.push_back(w.ways.front().frame.z);
  }
  for (const Wanted& w : wanted) {
    const auto best =
        std::find_if(w.ways.begin(), w.ways.end(), [&](const Way& x) { return known(x.frame.z); });
    const Way& way = best == w.ways.end() ? w.ways.front() : *best;
    if (!known(way.frame.z)) used.push_back(way.frame.z);
    for (Room& room : rooms_of(part, features[w.feature], way)) {
      room.recognised = {w.feature};
      out.rooms.push_back(std::move(room));
    }
  }
  settle(out.rooms);
  join_contours(part, out.rooms);
  for (Hole& h : out.holes) raise(part, out.rooms, h);
  end(part, out.rooms, out.holes);
  return out;
}

geometry::Box3 box_of(const Brep& brep, const exchange::Body& body) {
  geometry::Box3 out;
  for (std::uint32_t f = body.first_face; f < body.first_face + body.face_count; ++f) {
    const exchange::Face& face = brep.faces[f];
    for (std::uint32_t t = face.first_triangle; t < face.first_triangle + face.triangle_count; ++t) {
      for (const std::uint32_t c : brep.triangles[t]) out.add(brep.points[c]);
    }
  }
  return out;
}

/// The raw piece of the part: recognition knows its sides exactly, where the mesh has chords.
geometry::Box3 box_of(const Recognition& found) {
  geometry::Box3 out;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 p;
    for (std::size_t k = 0; k < 3; ++k)
      p = p + ((corner >> k & 1) != 0 ? found.raw.hi[k] : found.raw.lo[k]) * found.raw.axis[k];
    out.add(p);
  }
  const auto rounded = [](double v) { return std::round(v * 1e6) / 1e6; };
  out.lo = {rounded(out.lo.x), rounded(out.lo.y), rounded(out.lo.z)};
  out.hi = {rounded(out.hi.x), rounded(out.hi.y), rounded(out.hi.z)};
  return out;
}

class Writer {
 public:
  Writer(const Part& part, const std::vector<Feature>& features, const std::string& name)
      : part_(part), features_(features), nouns_(plan_.model) {
    plan_.file_name = name;
    auto& m = plan_.model;
    model::Workpiece raw;
    raw.its_id = "RAW PIECE";
    model::Block block;
    block.name = "RAW PIECE";
    block.position = nouns_.placement({.origin = part.raw().lo});
    const Vec3 size = part.raw().size();
    block.x = size.x;
    block.y = size.y;
    block.z = size.z;
    raw.its_bounding_geometry = m.add(block);
    raw.clamping_positions.given = true;
    model::Workpiece piece;
    piece.its_id = part.body().name.empty() ? "part" : part.body().name;
    piece.its_rawpiece = m.add(raw);
    piece.clamping_positions.given = true;
    piece_ = m.add(piece);
    model::Workplan workplan;
    workplan.its_id = "main";
    workplan.its_elements.given = true;
    model::Project project;
    project.its_id = name;
    project.main_workplan = m.add(workplan);
    project.its_workpieces.push_back(piece_);
    plan_.project = m.add(project);
  }

  void write(Removal& removal) {
    struct Item {
      std::uint32_t first;
      const Room* room;
      const Hole* hole;
      std::vector<std::size_t> of;
    };
    std::vector<Item> items;
    for (const Room& r : removal.rooms) items.push_back({r.faces.front(), &r, nullptr, r.recognised});
    for (std::size_t i = 0; i < removal.holes.size(); ++i)
      items.push_back({removal.holes[i].faces.front(), nullptr, &removal.holes[i], {removal.hole_of[i]}});
    std::stable_sort(items.begin(), items.end(),
                     [](const Item& a, const Item& b) { return a.first < b.first; });
    int number = 0;
    for (const Item& item : items) {
      const std::string n = std::to_string(++number);
      const AnyRef made = item.room != nullptr ? noun_of(part_, *item.room, plan_.model, piece_, n)
                                               : noun_of(*item.hole, plan_.model, piece_, n);
      const auto& faces = item.room != nullptr ? item.room->faces : item.hole->faces;
      if (!made.set()) {
        removal.left.push_back({faces, too_thin(*item.room)});
        continue;
      }
      if (item.room != nullptr && item.room->blend_radius_mm > 0.0)
        blends_.emplace(made, item.room->blend_radius_mm);
      std::string why = "from faces " + recognise::faces_in_words(part_.brep(), faces);
      std::vector<model::Rejected> rejected;
      for (const std::size_t of : item.of) {
        const Feature& f = features_[of];
        why += "; " + word_of(f.type) + ": " + f.reason;
        for (const auto& a : f.alternatives)
          rejected.push_back({word_of(a.type) + ", " + a.reason, "not the first choice of recognition"});
      }
      plan_.ledger.bind(made, "feature_placement", model::Binder::kRecognition,
                        {"recognise.feature", why, "the shape of " + plan_.file_name}, {},
                        std::move(rejected));
      plan_.kept.push_back(made);
      made_.push_back({made, faces});
    }
  }

  /// A region of its own for faces that nothing makes.
  void leave(const Left& left) {
    model::TopologicalRegion region;
    region.its_id = "FACES " + recognise::faces_in_words(part_.brep(), left.faces);
    region.its_workpiece = piece_;
    region.its_operations.given = true;
    region.name = "not recognised";
    region.cfs_faces.given = true;
    const AnyRef made = plan_.model.add(region);
    plan_.kept.push_back(made);
    model::set_not_recognised(plan_, made, left.why);
  }

  /// Why a feature is not planned that, read as it is written, would cut into the part.
  [[nodiscard]] std::string cutting(const Cut& cut) const {
    const std::string cuts = "it would cut " + trimmed(cut.volume_mm3, 1) + " mm3 out of the part";
    const auto blend = blends_.find(cut.feature);
    if (blend == blends_.end()) return "as it is written " + cuts;
    return "its floor meets walls in fillets of " + trimmed(blend->second, 3) +
           " mm, and fillets at the walls of steps and open pockets and at islands are not planned yet: "
           "without them " +
           cuts;
  }

  model::Plan plan_;
  std::vector<MadeOf> made_;
  Ref<model::Workpiece> piece_;

 private:
  std::map<AnyRef, double> blends_;  ///< features with fillets at their floors: the radius, mm
  const Part& part_;
  const std::vector<Feature>& features_;
  Nouns nouns_;
};

std::string words(const geometry::Box3& b) {
  const Vec3 s = b.size();
  return trimmed(s.x, 3) + " x " + trimmed(s.y, 3) + " x " + trimmed(s.z, 3) + " mm, from (" +
         trimmed(b.lo.x, 3) + ", " + trimmed(b.lo.y, 3) + ", " + trimmed(b.lo.z, 3) + ")";
}

using Axes = std::array<Vec3, 3>;

/// Of the 24 right-handed ways to name three axes x, y and z the one that is turned least from the file's.
Axes nearest_to_file(const Axes& axes) {
  Axes best = axes;
  double most = -4.0;  // the sum of the cosines, which falls with the angle of the turn
  for (const auto& order : {std::array{0U, 1U, 2U}, std::array{1U, 2U, 0U}, std::array{2U, 0U, 1U},
                            std::array{0U, 2U, 1U}, std::array{2U, 1U, 0U}, std::array{1U, 0U, 2U}}) {
    for (int signs = 0; signs < 4; ++signs) {
      const Vec3 x = ((signs & 1) != 0 ? -1.0 : 1.0) * axes[order[0]];
      const Vec3 y = ((signs & 2) != 0 ? -1.0 : 1.0) * axes[order[1]];
      const Vec3 z = dot(cross(x, y), axes[order[2]]) > 0.0 ? axes[order[2]] : -1.0 * axes[order[2]];
      const double trace = x.x + y.y + z.z;
      if (trace < most + 1e-9) continue;
      most = trace;
      best = {x, y, z};
    }
  }
  return best;
}

/// The axes of the first solid's box; nothing where they are the file's.
std::optional<Axes> turned_axes(const Brep& brep) {
  for (std::size_t b = 0; b < brep.bodies.size(); ++b) {
    if (!brep.bodies[b].solid) continue;
    const auto axes = recognise::recognise(brep, b).raw.axis;
    const auto straight = [](Vec3 a) {
      return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)}) > 1.0 - 1e-9;
    };
    if (std::all_of(axes.begin(), axes.end(), straight)) return std::nullopt;
    return nearest_to_file({axes[0], axes[1], axes[2]});
  }
  return std::nullopt;
}

std::string words(Vec3 d) {
  return "(" + trimmed(d.x, 4) + ", " + trimmed(d.y, 4) + ", " + trimmed(d.z, 4) + ")";
}

/// What is asked of the part beside its shape, and what of it is not planned for.
void tell(const Attached& asked, const std::string& name, Job& job) {
  if (asked.stated == 0) return;
  job.report({.code = "CAD-PMI",
              .severity = Severity::kNote,
              .message = std::to_string(asked.attached) + " of " +
                         counted(asked.stated, "tolerance or texture of the file is",
                                 "tolerances and textures of the file are") +
                         " asked of features",
              .file = name});
  constexpr std::size_t kMost = 12;
  std::string list;
  for (std::size_t i = 0; i < asked.lost.size() && i < kMost; ++i)
    list += (i == 0 ? "" : "; ") + asked.lost[i];
  if (asked.lost.size() > kMost) list += "; and " + std::to_string(asked.lost.size() - kMost) + " more";
  if (list.empty()) return;
  job.report({.code = "CAD-PMI",
              .severity = Severity::kWarning,
              .message = counted(asked.lost.size(), "tolerance or texture", "tolerances and textures") +
                         " of the file are not planned for: " + list,
              .file = name,
              .hint = "measure these on the finished part"});
}

/// The one solid of a file.
Result<std::size_t> only_solid(const Brep& brep, const std::string& name) {
  std::vector<std::size_t> solids;
  for (std::size_t b = 0; b < brep.bodies.size(); ++b) {
    if (brep.bodies[b].solid) solids.push_back(b);
  }
  if (solids.size() == 1 && brep.bodies.size() == 1) return solids.front();
  const auto sheets = brep.bodies.size() - solids.size();
  return fail(
      {.code = "CAD-BODIES",
       .message = "the file holds " + counted(solids.size(), "solid", "solids") +
                  (sheets > 0 ? " and " + counted(sheets, "sheet", "sheets") : std::string()) +
                  ": which of them is the part is not known; there are: " + exchange::bodies_in_words(brep),
       .file = name,
       .expected = "one solid",
       .hint = "name it by its number or name (--body), or save the part alone"});
}

}  // namespace

exchange::Brep straightened(exchange::Brep brep) {
  const auto axes = turned_axes(brep);
  if (!axes) return brep;
  const auto turned = [&](Vec3 v) {
    return Vec3{dot(v, (*axes)[0]), dot(v, (*axes)[1]), dot(v, (*axes)[2])};
  };
  for (auto& f : brep.faces) {
    f.point = turned(f.point);
    f.axis = turned(f.axis);
  }
  for (auto& e : brep.edges) {
    for (Vec3* p : {&e.start, &e.end, &e.middle, &e.centre, &e.axis}) *p = turned(*p);
  }
  brep.box = {};
  for (Vec3& p : brep.points) {
    p = turned(p);
    brep.box.add(p);
  }
  return brep;
}

Result<model::Plan> plan_of_part(const Brep& given, const std::string& name, const Stated& stated, Job& job) {
  const RawPiece& raw = stated.raw;
  const auto body = only_solid(given, name);
  if (!body) return tl::unexpected(body.error());
  const Brep brep = straightened(given);
  const auto turned = turned_axes(given);
  const Recognition found = recognise::recognise(brep, *body);
  const geometry::Box3 least = box_of(found);
  geometry::Box3 box = raw.box ? *raw.box : least;
  if (!raw.box) {
    const Vec3 more{raw.allowance_mm, raw.allowance_mm, raw.allowance_mm};
    box = {box.lo - more, box.hi + more};
  }
  const geometry::Box3 needs = box_of(brep, brep.bodies[*body]);
  const Vec3 under = needs.lo - box.lo;
  const Vec3 over = box.hi - needs.hi;
  if (std::min({under.x, under.y, under.z, over.x, over.y, over.z}) < -kLevelMm) {
    return fail(
        {.code = "CAD-STOCK",
         .message = "the raw piece (" + words(box) + ") does not hold the part (" + words(needs) + ")",
         .file = name,
         .hint = "name a larger one with --stock"});
  }
  const Part part(brep, *body, box);
  std::vector<Feature> features = found.features;
  for (Feature& side : sides_to_mill(part, found)) features.push_back(std::move(side));
  Removal removal = removal_of(part, features);
  for (const recognise::Rest& r : found.unrecognised) removal.left.push_back({r.faces, r.reason});

  Writer writer(part, features, name);
  writer.write(removal);
  for (const Cut& wrong : cuts_into(part, writer.plan_.model)) {
    // A reading of the nouns that differs from what was meant: never planned.
    model::set_not_recognised(writer.plan_, wrong.feature, writer.cutting(wrong));
  }
  for (const Left& left : removal.left) writer.leave(left);
  std::vector<MadeOf> planned = writer.made_;
  std::erase_if(planned, [stays = model::not_recognised(writer.plan_)](const MadeOf& f) {
    return stays.count(f.feature) != 0;
  });
  const Attached asked = attach_requirements(brep, planned, writer.piece_, writer.plan_);
  if (auto ok = add_threads(stated.threads, planned, brep, stated.threads_from, writer.plan_, job); !ok)
    return tl::unexpected(ok.error());
  model::Plan plan = std::move(writer.plan_);

  const auto say = [&](const char* code, std::string text) {
    job.report({.code = code, .severity = Severity::kNote, .message = std::move(text), .file = name});
  };
  if (!raw.box)
    say("CAD-STOCK", "the file names no raw piece; taken is the box of the part" +
                         (raw.allowance_mm > 0.0 ? " and " + trimmed(raw.allowance_mm, 3) + " mm on each side"
                                                 : std::string(", whose sides stay as they are")) +
                         ": " + words(box) + "; name another with --stock");
  if (turned)
    say("CAD-TURNED",
        "the part lies askew in its file; the workpiece's axes are those of its box, in the file's x " +
            words((*turned)[0]) + ", y " + words((*turned)[1]) + ", z " + words((*turned)[2]));
  if (const Missing gap = not_covered(part, plan.model, removal.left.empty()); gap.volume_mm3 > 0.0) {
    Left rest;
    model::TopologicalRegion region;
    region.its_id = "VOLUME OF NO FEATURE";
    region.its_operations.given = true;
    region.name = "not recognised";
    region.cfs_faces.given = true;
    region.its_workpiece = Ref<model::Workpiece>(plan.model.all(model::TypeId::kWorkpiece).back());
    const AnyRef at = plan.model.add(region);
    plan.kept.push_back(at);
    model::set_not_recognised(plan, at,
                              "about " + trimmed(gap.volume_mm3, 1) +
                                  " mm3 between part and raw piece are in no feature, the most about (" +
                                  trimmed(gap.at.x, 2) + ", " + trimmed(gap.at.y, 2) + ", " +
                                  trimmed(gap.at.z, 2) + ")");
  }
  const auto stays = model::not_recognised(plan);
  std::size_t features_made = 0;
  std::size_t faces_made = 0;
  for (const auto& [feature, faces] : writer.made_) {
    if (stays.count(feature) != 0) continue;
    ++features_made;
    faces_made += faces.size();
  }
  say("CAD-RECOGNISED",
      counted(features_made, "feature", "features") + " of " + counted(faces_made, "face", "faces") + "; " +
          counted(found.on_raw.size(), "face lies", "faces lie") + " on the sides of the part's box; " +
          (stays.empty() ? "no face and no volume is left over"
                         : counted(stays.size(), "group of faces or volume is no feature and stays",
                                   "groups of faces or volumes are no features and stay")));
  tell(asked, name, job);
  plan.provenance.push_back({"unit of the CAD file", brep.unit, "the file; planned in mm"});
  return plan;
}

}  // namespace capstan::from_cad
