#include "planner/files/exchange/brep/helper/read_shape.h"

#include <BRepBndLib.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <Geom_Surface.hxx>
#include <IMeshTools_Parameters.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <Precision.hxx>
#include <STEPControl_Reader.hxx>
#include <ShapeAnalysis_ShapeTolerance.hxx>
#include <ShapeBuild_ReShape.hxx>
#include <ShapeFix_Shape.hxx>
#include <Standard_Failure.hxx>
#include <StepData_StepModel.hxx>
#include <StepShape_ConnectedFaceSet.hxx>
#include <StepShape_FaceSurface.hxx>
#include <StepShape_ManifoldSolidBrep.hxx>
#include <StepShape_ShellBasedSurfaceModel.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "planner/files/exchange/brep/helper/carriers.h"
#include "planner/files/exchange/brep/helper/findings.h"
#include "planner/ground/base/number.h"

namespace capstan::exchange {
namespace {

constexpr const char* kExport = "export the part again from the CAD system";
constexpr const char* kCompare = "compare its volume and box with the CAD system, or export it again";
/// Above these the distance between an edge and its faces is told, or too large to plan on. Defaults without
/// a source: a tenth of a fine tolerance, and a coarse one.
constexpr double kToldGapMm = 0.001, kRefusedGapMm = 0.1;
/// Chords turn by no more than this, so that a small hole keeps its roundness. A default without a source.
constexpr double kMeshAngleRad = 0.35;

geometry::Vec3 vec(const gp_XYZ& p) { return {p.X(), p.Y(), p.Z()}; }
geometry::Vec3 vec(const gp_Pnt& p) { return vec(p.XYZ()); }

bool reversed(const TopoDS_Shape& s) { return s.Orientation() == TopAbs_REVERSED; }

/// A shape as the file's instances know it: where it is placed and how it is turned does not matter.
TopoDS_Shape unplaced(const TopoDS_Shape& s) { return s.Located(TopLoc_Location()).Oriented(TopAbs_FORWARD); }

/// Instances by the shapes that were made of them.
class Origins {
 public:
  explicit Origins(const STEPControl_Reader& reader) : model_(reader.StepModel()) {
    const auto process = reader.WS()->TransferReader()->TransientProcess();
    // Solids last: a shell of one that is not closed is known as the solid.
    for (const bool solids : {false, true}) {
      for (int i = 1; i <= model_->NbEntities(); ++i) {
        const Handle(Standard_Transient) entity = model_->Value(i);
        if (entity->IsKind(STANDARD_TYPE(StepShape_ManifoldSolidBrep)) != solids) continue;
        const bool face = entity->IsKind(STANDARD_TYPE(StepShape_FaceSurface));
        if (!solids && !face && !entity->IsKind(STANDARD_TYPE(StepShape_ConnectedFaceSet))) continue;
        if (face) ++faces_;
        const TopoDS_Shape shape = TransferBRep::ShapeResult(process, entity);
        if (shape.IsNull()) continue;
        TopAbs_ShapeEnum kind = face ? TopAbs_FACE : TopAbs_SHELL;
        if (solids && TopExp_Explorer(shape, TopAbs_SOLID).More()) kind = TopAbs_SOLID;
        for (TopExp_Explorer e(shape, kind); e.More(); e.Next()) entities_.Bind(unplaced(e.Current()), i);
      }
    }
  }
  /// Faces of the file.
  [[nodiscard]] std::size_t faces() const { return faces_; }
  /// Faces of the file that are not among these.
  [[nodiscard]] std::vector<std::int64_t> missing(const std::vector<Face>& faces) const {
    std::set<std::int64_t> there;
    for (const Face& f : faces) there.insert(f.id);
    std::vector<std::int64_t> out;
    for (int i = 1; i <= model_->NbEntities(); ++i) {
      const Handle(Standard_Transient) entity = model_->Value(i);
      if (!entity->IsKind(STANDARD_TYPE(StepShape_FaceSurface))) continue;
      const std::int64_t id = model_->IdentLabel(entity);
      if (there.count(id) == 0) out.push_back(id);
    }
    return out;
  }
  /// Whether the file says that this is a solid.
  [[nodiscard]] bool claims_solid(const TopoDS_Shape& shape) const {
    const int* at = entities_.Seek(unplaced(shape));
    return at != nullptr && model_->Value(*at)->IsKind(STANDARD_TYPE(StepShape_ManifoldSolidBrep));
  }
  /// Takes up what mending made of the shapes.
  void follow(const Handle(ShapeBuild_ReShape) & mended) {
    const auto before = entities_;
    for (decltype(entities_)::Iterator i(before); i.More(); i.Next()) {
      const TopoDS_Shape now = mended->Apply(i.Key());
      if (now.IsNull()) continue;
      for (TopExp_Explorer e(now, i.Key().ShapeType()); e.More(); e.Next())
        entities_.Bind(unplaced(e.Current()), i.Value());
    }
  }
  /// `#id` of the instance that a shape was made of; 0 where there is none.
  [[nodiscard]] std::int64_t id(const TopoDS_Shape& shape) const {
    const int* at = entities_.Seek(unplaced(shape));
    return at == nullptr ? 0 : model_->IdentLabel(model_->Value(*at));
  }

 private:
  Handle(StepData_StepModel) model_;
  std::size_t faces_ = 0;
  NCollection_DataMap<TopoDS_Shape, int, TopTools_ShapeMapHasher> entities_;
};

/// How an edge is used: by which face, walked which way.
struct Use {
  std::uint32_t face;
  bool forward;
};

/// The oriented edges of a wire of a forward face, in the order of the walk.
std::vector<TopoDS_Edge> walk(const TopoDS_Wire& wire, const TopoDS_Face& face, bool& whole) {
  std::vector<TopoDS_Edge> ordered, all;
  for (TopoDS_Iterator i(wire); i.More(); i.Next()) all.push_back(TopoDS::Edge(i.Value()));
  for (BRepTools_WireExplorer w(wire, face); w.More(); w.Next()) ordered.push_back(w.Current());
  whole = ordered.size() == all.size();
  return whole ? ordered : all;
}

class Builder {
 public:
  Builder(const Origins& origins, Brep& out) : origins_(origins), out_(out) {}

  void add(const TopoDS_Shape& piece) {
    const std::size_t first_face = out_.faces.size();
    Body body;
    body.solid = piece.ShapeType() == TopAbs_SOLID;
    body.first_face = count(first_face);
    body.id = origins_.id(piece);
    TopoDS_Shape shape = piece;
    if (body.solid) {
      GProp_GProps volume;
      BRepGProp::VolumeProperties(shape, volume);
      body.volume = volume.Mass();
      if (body.volume < 0) {  // turned inside out
        shape.Reverse();
        body.volume = -body.volume;
      }
      if (body.id == 0) {
        for (TopExp_Explorer e(shape, TopAbs_SHELL); e.More() && body.id == 0; e.Next())
          body.id = origins_.id(e.Current());
      }
    }
    faces_.clear();
    edges_.Clear();
    uses_.clear();
    points_of_edge_.clear();
    point_of_vertex_.Clear();
    first_edge_ = out_.edges.size();
    first_face_ = first_face;
    solid_ = body.solid || origins_.claims_solid(piece);
    id_of_body_ = body.id;
    for (TopExp_Explorer e(shape, TopAbs_FACE); e.More(); e.Next()) add_face(TopoDS::Face(e.Current()));
    for (int i = 1; i <= edges_.Extent(); ++i) add_edge(TopoDS::Edge(edges_(i)), uses_[std::size_t(i - 1)]);
    body.face_count = count(out_.faces.size() - first_face);
    for (std::size_t i = first_face; i < out_.faces.size(); ++i) body.area += out_.faces[i].area;
    out_.bodies.push_back(std::move(body));
  }

  [[nodiscard]] const Findings& findings() const { return findings_; }

 private:
  static std::uint32_t count(std::size_t n) {
    if (n > std::numeric_limits<std::uint32_t>::max()) throw std::bad_alloc();
    return static_cast<std::uint32_t>(n);
  }

  void add_face(const TopoDS_Face& shape) {
    if (BRep_Tool::Surface(shape).IsNull()) {
      findings_.add(Severity::kError, "BREP-TESSELLATED", "faces without a surface", kExport, 0);
      return;
    }
    Face face;
    set_carrier(shape, face);
    face.id = origins_.id(shape);
    GProp_GProps area;
    BRepGProp::SurfaceProperties(shape, area);
    face.area = std::abs(area.Mass());
    const auto index = count(faces_.size());
    const TopoDS_Face plain = TopoDS::Face(shape.Oriented(TopAbs_FORWARD));
    const TopoDS_Wire outer = BRepTools::OuterWire(plain);
    for (TopoDS_Iterator i(plain); i.More(); i.Next()) {
      if (i.Value().ShapeType() != TopAbs_WIRE) continue;
      Loop loop;
      bool whole = true;
      auto edges = walk(TopoDS::Wire(i.Value()), plain, whole);
      if (!whole)
        findings_.add(Severity::kWarning, "BREP-LOOP", "loops whose edges do not follow one another", kExport,
                      face.id);
      if (reversed(shape)) std::reverse(edges.begin(), edges.end());
      for (const TopoDS_Edge& edge : edges) {
        if (BRep_Tool::Degenerated(edge)) continue;
        if (edge.Orientation() != TopAbs_FORWARD && edge.Orientation() != TopAbs_REVERSED) continue;
        const bool forward = reversed(edge) == reversed(shape);
        const int at = edges_.Add(edge.Oriented(TopAbs_FORWARD));
        if (static_cast<std::size_t>(at) > uses_.size()) uses_.emplace_back();
        uses_[static_cast<std::size_t>(at - 1)].push_back({index, forward});
        loop.edges.push_back(count(first_edge_ + static_cast<std::size_t>(at) - 1));
        loop.forward.push_back(forward);
      }
      if (loop.edges.empty()) continue;
      const bool is_outer = i.Value().IsSame(outer);
      face.loops.insert(is_outer ? face.loops.begin() : face.loops.end(), std::move(loop));
    }
    faces_.push_back(shape);
    tessellate(shape, face);
    out_.faces.push_back(std::move(face));
  }

  void add_edge(const TopoDS_Edge& shape, const std::vector<Use>& uses) {
    Edge edge;
    set_curve(shape, edge);
    if (!(edge.length > Precision::Confusion()))
      findings_.add(Severity::kWarning, "BREP-SHORT", "edges without length", kExport,
                    out_.faces[first_face_ + uses.front().face].id);
    edge.face = {count(first_face_ + uses.front().face), count(first_face_ + uses.back().face)};
    if (edge.face[0] > edge.face[1]) std::swap(edge.face[0], edge.face[1]);
    if (uses.size() == 2 && uses[0].forward != uses[1].forward) {
      for (const double part : {0.5, 0.37, 0.71}) {
        const auto a = side_at(shape, uses[0].forward, faces_[uses[0].face], part);
        const auto b = side_at(shape, uses[1].forward, faces_[uses[1].face], part);
        if (!a || !b) continue;
        set_angle(*a, *b, edge);
        break;
      }
    } else if (uses.size() == 1) {
      if (solid_)
        findings_.add(Severity::kError, "BREP-OPEN", "edges of a solid with a face on one side only",
                      "close the solid in the CAD system", id_of_body_);
    } else {
      findings_.add(Severity::kWarning, "BREP-CROWDED",
                    "edges where more than two faces meet, or two the same way round", kExport,
                    out_.faces[edge.face[0]].id);
    }
    out_.edges.push_back(edge);
  }

  std::uint32_t add_point(const gp_Pnt& p) {
    out_.points.push_back(vec(p));
    return count(out_.points.size() - 1);
  }

  /// The triangles of a face. Points of edges and corners are those of the neighbours, too, so that the
  /// triangles of a closed body leave no gap.
  void tessellate(const TopoDS_Face& shape, Face& face) {
    face.first_triangle = count(out_.triangles.size());
    TopLoc_Location place;
    const auto mesh = BRep_Tool::Triangulation(shape, place);
    if (mesh.IsNull()) {
      findings_.add(Severity::kWarning, "BREP-MESH", "faces that could not be tessellated", kExport, face.id);
      return;
    }
    constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> index(static_cast<std::size_t>(mesh->NbNodes()) + 1, kNone);
    const auto node = [&](int i) { return mesh->Node(i).Transformed(place); };
    for (TopExp_Explorer e(shape.Oriented(TopAbs_FORWARD), TopAbs_EDGE); e.More(); e.Next()) {
      const TopoDS_Edge& edge = TopoDS::Edge(e.Current());
      const auto polygon = BRep_Tool::PolygonOnTriangulation(edge, mesh, place);
      if (polygon.IsNull()) continue;
      const int n = polygon->NbNodes();
      TopoDS_Vertex ends[2];
      TopExp::Vertices(TopoDS::Edge(edge.Oriented(TopAbs_FORWARD)), ends[0], ends[1]);
      const bool point_like = BRep_Tool::Degenerated(edge);
      auto& inner = points_of_edge_[edges_.FindIndex(edge.Oriented(TopAbs_FORWARD))];
      for (int i = 1; i <= n; ++i) {
        const int at = polygon->Node(i);
        std::uint32_t& global = index[static_cast<std::size_t>(at)];
        if (i == 1 || i == n || point_like) {
          const TopoDS_Vertex& vertex = ends[i == n ? 1 : 0];
          if (vertex.IsNull()) continue;
          if (!point_of_vertex_.IsBound(vertex))
            point_of_vertex_.Bind(vertex, static_cast<int>(add_point(node(at))));
          global = static_cast<std::uint32_t>(point_of_vertex_.Find(vertex));
        } else {
          const auto k = static_cast<std::size_t>(i - 2);
          if (k >= inner.size()) inner.push_back(add_point(node(at)));
          global = inner[k];
        }
      }
    }
    for (int i = 1; i <= mesh->NbTriangles(); ++i) {
      int corner[3];
      mesh->Triangle(i).Get(corner[0], corner[1], corner[2]);
      std::array<std::uint32_t, 3> t{};
      for (int k = 0; k < 3; ++k) {
        std::uint32_t& global = index[static_cast<std::size_t>(corner[k])];
        if (global == kNone) global = add_point(node(corner[k]));
        t[static_cast<std::size_t>(k)] = global;
      }
      if (reversed(shape) != place.Transformation().IsNegative()) std::swap(t[1], t[2]);
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) out_.triangles.push_back(t);
    }
    face.triangle_count = count(out_.triangles.size()) - face.first_triangle;
  }

  const Origins& origins_;
  Brep& out_;
  // Of the body at hand:
  std::vector<TopoDS_Face> faces_;
  TopTools_IndexedMapOfShape edges_;
  std::vector<std::vector<Use>> uses_;
  std::map<int, std::vector<std::uint32_t>> points_of_edge_;
  TopTools_DataMapOfShapeInteger point_of_vertex_;
  std::size_t first_edge_ = 0, first_face_ = 0;
  bool solid_ = false;
  std::int64_t id_of_body_ = 0;
  Findings findings_;
};

/// The names of the lengths in the file, each once, as "mm", "inch", …, or "mixed".
std::string unit_of(STEPControl_Reader& reader) {
  TColStd_SequenceOfAsciiString lengths, angles, solid_angles;
  reader.FileUnits(lengths, angles, solid_angles);
  std::set<std::string> names;
  for (auto name : lengths) {
    name.LowerCase();
    names.insert(name == "millimetre"   ? "mm"
                 : name == "metre"      ? "m"
                 : name == "centimetre" ? "cm"
                                        : name.ToCString());
  }
  return names.empty() ? "mm" : names.size() == 1 ? *names.begin() : "mixed";
}

void add_pieces(const TopoDS_Shape& shape, Builder& builder) {
  for (TopExp_Explorer e(shape, TopAbs_SOLID); e.More(); e.Next()) builder.add(e.Current());
  for (TopExp_Explorer e(shape, TopAbs_SHELL, TopAbs_SOLID); e.More(); e.Next()) builder.add(e.Current());
  for (TopExp_Explorer e(shape, TopAbs_FACE, TopAbs_SHELL); e.More(); e.Next()) builder.add(e.Current());
}

/// The box of the exact geometry: that of the triangles, and of each face that may reach beyond it.
bool set_box(const TopoDS_Shape& shape, Brep& brep) {
  geometry::Box3 seen;
  for (const Point3& p : brep.points) seen.add(p);
  for (const Edge& e : brep.edges) {
    seen.add(e.start);
    seen.add(e.end);
  }
  if (seen.empty()) return false;
  brep.box = seen;
  for (TopExp_Explorer e(shape, TopAbs_FACE); e.More(); e.Next()) {
    Bnd_Box rough;
    BRepBndLib::Add(e.Current(), rough);
    if (rough.IsVoid()) continue;
    geometry::Vec3 lo, hi;
    rough.Get(lo.x, lo.y, lo.z, hi.x, hi.y, hi.z);
    const bool within = lo.x >= seen.lo.x && lo.y >= seen.lo.y && lo.z >= seen.lo.z && hi.x <= seen.hi.x &&
                        hi.y <= seen.hi.y && hi.z <= seen.hi.z;
    if (within) continue;
    Bnd_Box exact;
    BRepBndLib::AddOptimal(e.Current(), exact, false, false);
    if (exact.IsVoid() || exact.IsOpen()) return false;
    exact.SetGap(0.0);
    exact.Get(lo.x, lo.y, lo.z, hi.x, hi.y, hi.z);
    brep.box.add(lo);
    brep.box.add(hi);
  }
  return true;
}

void read(const std::string& step, double chord_mm, BrepMessage& out) {
  const auto error = [&out](const char* code, std::string message, const char* hint) {
    out.brep.reset();
    out.remarks.push_back(remark(Severity::kError, code, std::move(message), hint));
  };
  const auto warn = [&out](const char* code, std::string message, const char* hint) {
    out.remarks.push_back(remark(Severity::kWarning, code, std::move(message), hint));
  };
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer));
  STEPControl_Reader reader;
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  std::istringstream stream(step);
  if (reader.ReadStream("part", stream) != IFSelect_RetDone)
    return error("BREP-SYNTAX", "OpenCASCADE cannot read the file", kExport);
  reader.TransferRoots();
  TopoDS_Shape shape = reader.OneShape();
  if (shape.IsNull() && step.find("TESSELLATED_S") != std::string::npos)
    return error("BREP-TESSELLATED",
                 "the shape consists of triangles (TESSELLATED_SOLID, TESSELLATED_SHELL), without surfaces",
                 "export exact geometry (a boundary representation)");
  Origins origins(reader);
  if (shape.IsNull() && origins.faces() != 0)
    return error("BREP-LOST", "none of the file's " + std::to_string(origins.faces()) + " faces makes a body",
                 kExport);
  if (shape.IsNull()) return error("BREP-EMPTY", "the file holds no shape", "export a solid body");
  if (!TopExp_Explorer(shape, TopAbs_FACE).More())
    return error("BREP-WIRE", "the file's shapes are points and curves, none has a face",
                 "export a solid body");
  if (!BRepCheck_Analyzer(shape).IsValid()) {
    ShapeFix_Shape fix(shape);
    fix.Perform();
    shape = fix.Shape();
    origins.follow(fix.Context());
    const bool mended = BRepCheck_Analyzer(shape).IsValid();
    warn(mended ? "BREP-MENDED" : "BREP-INVALID",
         mended ? "the shape was inconsistent (BRepCheck of OpenCASCADE) and has been mended"
                : "the shape is inconsistent (BRepCheck of OpenCASCADE), and mending did not help",
         kCompare);
  }
  IMeshTools_Parameters fine;
  fine.Deflection = chord_mm;
  fine.Angle = kMeshAngleRad;
  BRepMesh_IncrementalMesh(shape, fine);
  Brep& brep = out.brep.emplace();
  brep.chord = chord_mm;
  brep.unit = unit_of(reader);
  Builder builder(origins, brep);
  add_pieces(shape, builder);
  builder.findings().tell(out);
  if (!out.brep) return;
  if (!set_box(shape, brep) || !finite(brep))
    return error("BREP-NUMBER", "a figure of the shape is not finite", kExport);
  const double apart = ShapeAnalysis_ShapeTolerance().Tolerance(shape, 1);
  const std::string gaps = "edges lie up to " + fixed(apart, 3) + " mm beside their faces";
  if (apart > kRefusedGapMm)
    return error("BREP-GAPS", gaps + "; at most " + fixed(kRefusedGapMm, 1) + " mm are let pass", kExport);
  if (apart > kToldGapMm) warn("BREP-GAPS", gaps, kCompare);
  if (const auto missing = origins.missing(brep.faces); !missing.empty()) {
    warn("BREP-LOST",
         "in no body that was read: " + counted(missing.size(), "face", "faces") + " of the file", kCompare);
    out.remarks.back().instance = static_cast<std::uint64_t>(missing.front());
  }
  tell_bodies(out);
  judge_volumes(out);
}

}  // namespace

BrepMessage read_shape(const std::string& step, double chord_mm) {
  BrepMessage out;
  const auto fail_with = [&out](const char* code, const std::string& message, const char* hint) {
    out.brep.reset();
    out.remarks.push_back(remark(Severity::kError, code, message, hint));
  };
  try {
    read(step, chord_mm, out);
  } catch (const std::bad_alloc&) {
    fail_with("BREP-MEMORY", "the shape needs more memory than it may take", "simplify the part");
  } catch (const Standard_Failure& e) {
    fail_with(
        "BREP-OCCT",
        std::string("OpenCASCADE gave the shape up: ") + e.DynamicType()->Name() + " " + e.GetMessageString(),
        kExport);
  }
  return out;
}

}  // namespace capstan::exchange
