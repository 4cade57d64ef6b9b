#include "planner/files/from_cad/from_cad.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "planner/files/exchange/brep/one_body.h"
#include "planner/files/from_cad/asked/requirements.h"
#include "planner/files/from_cad/cover.h"
#include "planner/files/from_cad/removal.h"
#include "planner/ground/base/number.h"
#include "planner/model/plan/decision/not_recognised.h"

namespace capstan::from_cad {
namespace {

using recognise::Feature;
using recognise::Recognition;

std::string too_thin(const Room& room) {
  return "its area of " + trimmed(geometry::area(room.area), 4) + " mm2 at the level of " +
         trimmed(room.level_mm, 3) + " mm is thinner than points are told apart, 0.0001 mm: nothing is drawn";
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
    // A room without faces is the outline of the raw piece, which a rim goes round.
    for (const Room& r : removal.rooms)
      items.push_back({r.faces.empty() ? 0 : r.faces.front(), &r, nullptr, r.recognised});
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
      keep(made, "feature_placement", faces, item.of);
      if (item.room != nullptr) nouns_of_rooms_[item.room] = made;
    }
    for (const OnEdge& e : removal.on_edges) {
      const Room& room = removal.rooms[e.of.room];
      const auto edge = nouns_of_rooms_.find(&room);
      const AnyRef of = edge == nouns_of_rooms_.end()
                            ? AnyRef()
                            : noun_with(part_, room, e.of.loop, edge->second, plan_.model);
      if (!of.set()) {
        removal.left.push_back({e.rim.faces, "the feature whose edge it breaks is not written"});
        continue;
      }
      const AnyRef made = noun_of(e.rim, of, plan_.model, piece_, std::to_string(++number));
      keep(made, "first_feature", e.rim.faces, e.recognised);
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

  model::Plan plan_;
  std::vector<MadeOf> made_;
  Ref<model::Workpiece> piece_;

 private:
  /// A feature that recognition bound: from which faces, and as what.
  void keep(AnyRef made, const char* attribute, const std::vector<std::uint32_t>& faces,
            const std::vector<std::size_t>& of) {
    std::string why = faces.empty() ? "the outline of the raw piece, for the edge that is broken round it"
                                    : "from faces " + recognise::faces_in_words(part_.brep(), faces);
    std::vector<model::Rejected> rejected;
    for (const std::size_t i : of) {
      const Feature& f = features_[i];
      why += "; " + word_of(f.type) + ": " + f.reason;
      for (const auto& a : f.alternatives)
        rejected.push_back({word_of(a.type) + ", " + a.reason, "not the first choice of recognition"});
    }
    plan_.ledger.bind(made, attribute, model::Binder::kRecognition,
                      {"recognise.feature", why, "the shape of " + plan_.file_name}, {}, std::move(rejected));
    plan_.kept.push_back(made);
    if (!faces.empty()) made_.push_back({made, faces});
  }

  std::map<const Room*, AnyRef> nouns_of_rooms_;
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
  std::vector<Feature> features;
  Removal removal = removal_of(part, found, features);

  Writer writer(part, features, name);
  writer.write(removal);
  for (const Cut& wrong : cuts_into(part, writer.plan_.model)) {
    // A reading of the nouns that differs from what was meant: never planned.
    model::set_not_recognised(
        writer.plan_, wrong.feature,
        "as it is written it would cut " + trimmed(wrong.volume_mm3, 1) + " mm3 out of the part");
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
