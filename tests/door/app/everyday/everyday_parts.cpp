// Writes parts as CAD systems make them every day, as STEP files: edges that are chamfered or rounded, floors
// that meet walls in fillets, bosses.
//
//   everyday_parts NAME FILE

#include <BRepAdaptor_Curve.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepFilletAPI_MakeChamfer.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Writer.hxx>
#include <ShapeUpgrade_UnifySameDomain.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <cmath>
#include <functional>
#include <iostream>
#include <map>
#include <string>
#include <vector>

namespace {

using Shape = TopoDS_Shape;
/// Whether an edge is meant, by its ends and its middle.
using Pick = std::function<bool(const gp_Pnt& a, const gp_Pnt& b, const gp_Pnt& middle)>;

constexpr double kNear = 1e-6;

Shape box(const gp_Pnt& lo, const gp_Pnt& hi) { return BRepPrimAPI_MakeBox(lo, hi).Shape(); }

Shape cylinder(double x, double y, double z, double radius, double height) {
  return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(x, y, z), gp_Dir(0, 0, 1)), radius, height).Shape();
}

Shape cut(const Shape& a, const Shape& b) { return BRepAlgoAPI_Cut(a, b).Shape(); }

Shape fused(const Shape& a, const Shape& b) {
  ShapeUpgrade_UnifySameDomain one(BRepAlgoAPI_Fuse(a, b).Shape());
  one.Build();
  return one.Shape();
}

template <class Maker>
Shape with(const Shape& s, double mm, const Pick& pick) {
  Maker maker(s);
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(s, TopAbs_EDGE, edges);
  for (int i = 1; i <= edges.Extent(); ++i) {
    const TopoDS_Edge edge = TopoDS::Edge(edges(i));
    if (BRep_Tool::Degenerated(edge)) continue;
    const BRepAdaptor_Curve curve(edge);
    const double from = curve.FirstParameter(), to = curve.LastParameter();
    if (pick(curve.Value(from), curve.Value(to), curve.Value(0.5 * (from + to)))) maker.Add(mm, edge);
  }
  return maker.Shape();
}

Shape filleted(const Shape& s, double mm, const Pick& pick) {
  return with<BRepFilletAPI_MakeFillet>(s, mm, pick);
}
Shape chamfered(const Shape& s, double mm, const Pick& pick) {
  return with<BRepFilletAPI_MakeChamfer>(s, mm, pick);
}

bool upright(const gp_Pnt& a, const gp_Pnt& b, const gp_Pnt& /*middle*/) {
  return std::hypot(a.X() - b.X(), a.Y() - b.Y()) < kNear && std::abs(a.Z() - b.Z()) > kNear;
}

Pick at_height(double z) {
  return [z](const gp_Pnt& a, const gp_Pnt& b, const gp_Pnt& m) {
    return std::abs(a.Z() - z) + std::abs(b.Z() - z) + std::abs(m.Z() - z) < kNear;
  };
}

/// A plate of 100 x 70 x 20 mm, its top at z = 0, with corners of 8 mm.
Shape plate() { return filleted(box({0, 0, -20}, {100, 70, 0}), 8, upright); }

/// A pocket of 60 x 30 x 8 mm in the plate, with corners of 6 mm.
Shape pocketed(const Shape& s) { return cut(s, filleted(box({20, 20, -8}, {80, 50, 1}), 6, upright)); }

/// A slot of 15 x 6 mm across the plate.
Shape slotted(const Shape& s) { return cut(s, box({40, -1, -6}, {55, 71, 1})); }

/// A boss of 36 mm on a plate 8 mm thick: its foot in a fillet of 2 mm, its edge chamfered.
Shape with_boss() {
  Shape s = fused(box({0, 0, -20}, {100, 70, -12}), cylinder(50, 35, -13, 18, 13));
  s = filleted(s, 2, [](const gp_Pnt&, const gp_Pnt&, const gp_Pnt& m) {
    return std::abs(m.Z() + 12) < kNear && std::abs(std::hypot(m.X() - 50, m.Y() - 35) - 18) < kNear;
  });
  return chamfered(s, 1, at_height(0));
}

/// A plate of 100 x 70 mm, 8 mm thick, with a block of 40 x 30 mm, 12 mm high, its upright edges sharp: at
/// its foot fillets of 3 mm, which meet in mitres.
Shape with_sharp_block() {
  const Shape s = fused(box({0, 0, -20}, {100, 70, -12}), box({30, 20, -13}, {70, 50, 0}));
  return filleted(s, 3, [](const gp_Pnt& a, const gp_Pnt& b, const gp_Pnt& m) {
    return at_height(-12)(a, b, m) && m.X() > 29 && m.X() < 71 && m.Y() > 19 && m.Y() < 51;
  });
}

/// A shoulder of 30 x 10 mm with a fillet of 2 mm at the foot of its wall.
Shape shoulder(double x, double y0, double y1) {
  return filleted(box({-1, y0, -10}, {x, y1, 1}), 2, [x](const gp_Pnt& a, const gp_Pnt& b, const gp_Pnt& m) {
    return std::abs(m.X() - x) < kNear && at_height(-10)(a, b, m);
  });
}

/// A slot of 20 x 8 mm with fillets of 3 mm along its floor.
Shape round_slot() {
  return filleted(box({-1, 25, -8}, {101, 45, 1}), 3, [](const gp_Pnt& a, const gp_Pnt& b, const gp_Pnt& m) {
    return std::abs(m.X() - 50) < kNear && at_height(-8)(a, b, m);
  });
}

/// An open pocket of 41 x 30 x 12 mm, corners of 5 mm, fillets of 2 mm along its floor.
Shape open_pocket() {
  const Shape s = filleted(
      box({50, 20, -12}, {101, 50, 1}), 5,
      [](const gp_Pnt& a, const gp_Pnt& b, const gp_Pnt& m) { return m.X() < 51 && upright(a, b, m); });
  return filleted(s, 2, [](const gp_Pnt& a, const gp_Pnt& b, const gp_Pnt& m) {
    return m.X() < 100 && at_height(-12)(a, b, m);
  });
}

const std::map<std::string, std::function<Shape()>>& parts() {
  static const std::map<std::string, std::function<Shape()>> kParts{
      {"block_with_chamfers",
       [] {
         return chamfered(box({0, 0, -20}, {100, 70, 0}), 2, at_height(0));
       }},
      {"plate_with_chamfers", [] { return chamfered(pocketed(plate()), 1, at_height(0)); }},
      {"plate_with_chamfers_and_slot", [] { return slotted(chamfered(plate(), 1, at_height(0))); }},
      {"plate_with_rounds", [] { return filleted(plate(), 2, at_height(0)); }},
      {"plate_with_boss", [] { return with_boss(); }},
      {"plate_with_sharp_block", [] { return with_sharp_block(); }},
      // Two corners stand that are round where they end at the sides.
      {"block_with_round_corners_standing",
       [] {
         const auto corner = [](const gp_Pnt& lo, const gp_Pnt& hi, double x, double y) {
           return filleted(box(lo, hi), 8, [=](const gp_Pnt& a, const gp_Pnt& b, const gp_Pnt& m) {
             return upright(a, b, m) && (std::abs(m.X() - x) < kNear) != (std::abs(m.Y() - y) < kNear);
           });
         };
         const Shape s = fused(box({0, 0, -20}, {100, 70, -12}), corner({0, 0, -13}, {40, 30, 0}, 40, 30));
         return fused(s, corner({60, 40, -13}, {100, 70, 0}, 60, 40));
       }},
      // Two corners stand; at the feet of their inner walls fillets of 3 mm, which meet in mitres.
      {"block_with_corners_standing",
       [] {
         Shape s = box({0, 0, -20}, {100, 70, -12});
         s = fused(s, box({0, 0, -13}, {25, 20, 0}));
         s = fused(s, box({75, 50, -13}, {100, 70, 0}));
         return filleted(s, 3, [](const gp_Pnt& a, const gp_Pnt& b, const gp_Pnt& m) {
           return at_height(-12)(a, b, m) && m.X() > 1 && m.X() < 99 && m.Y() > 1 && m.Y() < 69;
         });
       }},
      {"block_with_shoulder",
       [] {
         return cut(box({0, 0, -20}, {100, 70, 0}), shoulder(30, -1, 71));
       }},
      {"block_with_round_slot",
       [] {
         return cut(box({0, 0, -20}, {100, 70, 0}), round_slot());
       }},
      {"block_with_open_pocket",
       [] {
         return cut(box({0, 0, -20}, {100, 70, 0}), open_pocket());
       }},
      // A rib with sharp ends in the slot that interrupts the chamfer.
      {"plate_with_chamfers_and_rib",
       [] {
         const Shape s = cut(chamfered(plate(), 1, at_height(0)), box({30, -1, -6}, {70, 71, 1}));
         return fused(s, box({45, 0, -7}, {55, 70, 0}));
       }},
      // Two bosses of one pocket, of which one has a chamfer.
      {"block_with_two_bosses",
       [] {
         Shape s =
             cut(box({0, 0, -30}, {120, 80, 0}), filleted(box({10, 10, -15}, {110, 70, 1}), 8, upright));
         for (const double x : {35.0, 85.0}) s = fused(s, cylinder(x, 40, -16, 10, 16));
         return chamfered(s, 1, [](const gp_Pnt&, const gp_Pnt&, const gp_Pnt& m) {
           return std::abs(m.Z()) < kNear && std::hypot(m.X() - 35, m.Y() - 40) < 10 + kNear;
         });
       }},
      // Two bosses of one plate, one half as high as the other, with fillets at their feet.
      {"plate_with_bosses_of_two_heights",
       [] {
         Shape s = box({0, 0, -20}, {120, 70, -12});
         for (const double x : {35.0, 85.0}) s = fused(s, cylinder(x, 35, -13, 12, x < 50 ? 13 : 7));
         return filleted(s, 2, [](const gp_Pnt&, const gp_Pnt&, const gp_Pnt& m) {
           return std::abs(m.Z() + 12) < kNear && m.X() > 1 && m.X() < 119 && m.Y() > 1 && m.Y() < 69;
         });
       }},
      // Hollow from below down to a thin top, which has a window with corners of 2 mm.
      {"cover_with_window",
       [] {
         const Shape hollow = filleted(box({10, 10, -41}, {110, 70, -3}), 8, upright);
         const Shape window = filleted(box({40, 30, -10}, {80, 50, 1}), 2, upright);
         return cut(cut(box({0, 0, -40}, {120, 80, 0}), hollow), window);
       }},
      // A hole through it and one with a flat bottom, their mouths and the outline chamfered.
      {"plate_with_chamfered_holes",
       [] {
         const Shape s = cut(plate(), cylinder(25, 35, -21, 5, 22));
         return chamfered(cut(s, cylinder(75, 35, -10, 8, 11)), 0.5, at_height(0));
       }},
      // All edges of the top are chamfered, also those of the slot, and of the open pocket.
      {"plate_with_slot_all_chamfered", [] { return chamfered(slotted(plate()), 0.5, at_height(0)); }},
      {"plate_with_slot_all_rounded", [] { return filleted(slotted(plate()), 1, at_height(0)); }},
      {"plate_with_open_pocket_all_chamfered",
       [] { return chamfered(cut(plate(), open_pocket()), 0.5, at_height(0)); }},
      // All edges of top and underside, also of the hole.
      {"plate_chamfered_on_both_sides",
       [] {
         return chamfered(cut(plate(), cylinder(25, 35, -21, 5, 22)), 0.5,
                          [](const gp_Pnt& a, const gp_Pnt& b, const gp_Pnt& m) {
                            return at_height(0)(a, b, m) || at_height(-20)(a, b, m);
                          });
       }},
      // Upright edges as round as the upper ones: balls at the corners.
      {"block_with_round_corners",
       [] {
         return filleted(filleted(box({0, 0, -20}, {100, 70, 0}), 3, upright), 3, at_height(0));
       }},
      {"plate_and_sheet",
       [] {
         TopoDS_Compound both;
         BRep_Builder build;
         build.MakeCompound(both);
         build.Add(both, pocketed(plate()));
         build.Add(
             both,
             BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(50, 35, 30), gp_Dir(0, 0, 1)), -9, 9, -9, 9).Shape());
         return Shape(both);
       }},
      // A pocket with corners of a quarter of an inch and fillets of .09 along its floor; saved in inches.
      {"pocket_inch",
       [] {
         const Shape pocket = filleted(box({25.4, 25.4, -12.7}, {88.9, 63.5, 1}), 6.35, upright);
         return cut(box({0, 0, -25.4}, {114.3, 88.9, 0}), filleted(pocket, 2.286, at_height(-12.7)));
       }},
      // A hole of a quarter of an inch, and one of drill number 7.
      {"holes_inch",
       [] {
         const Shape s = cut(box({0, 0, -12.7}, {76.2, 50.8, 0}), cylinder(25.4, 25.4, -13, 3.175, 14));
         return cut(s, cylinder(50.8, 25.4, -13, 0.5 * 0.201 * 25.4, 14));
       }},
      // Three bosses on one another in a pocket.
      {"pocket_with_stack",
       [] {
         Shape s =
             cut(box({0, 0, -30}, {120, 80, 0}), filleted(box({10, 10, -18}, {110, 70, 1}), 8, upright));
         s = fused(s, cylinder(60, 40, -19, 22, 6));
         s = fused(s, cylinder(60, 40, -14, 14, 6));
         return fused(s, cylinder(60, 40, -9, 6, 9));
       }},
      {"long_plate",
       [] {
         return cut(box({0, 0, -30}, {900, 300, 0}), cylinder(450, 150, -31, 6, 32));
       }},
      // An edge that is broken along one side alone: no rim.
      {"block_with_one_bevel",
       [] {
         return chamfered(box({0, 0, -20}, {100, 70, 0}), 3,
                          [](const gp_Pnt& a, const gp_Pnt& b, const gp_Pnt& m) {
                            return m.Y() < kNear && at_height(0)(a, b, m);
                          });
       }},
      // Wider than mills of 90 degrees are.
      {"block_with_wide_bevels",
       [] {
         return chamfered(box({0, 0, -30}, {100, 70, 0}), 10, at_height(0));
       }},
  };
  return kParts;
}

}  // namespace

int main(int argc, char** argv) {
  const auto part = argc == 3 ? parts().find(argv[1]) : parts().end();
  if (part == parts().end()) {
    std::cerr << "everyday_parts NAME FILE; names:";
    for (const auto& p : parts()) std::cerr << " " << p.first;
    std::cerr << "\n";
    return 2;
  }
  STEPControl_Writer writer;
  const bool inch = part->first.find("_inch") != std::string::npos;
  if (inch) Interface_Static::SetCVal("write.step.unit", "INCH");
  // The writer takes lengths for those of the file's unit.
  gp_Trsf to_unit;
  if (inch) to_unit.SetScale(gp_Pnt(0, 0, 0), 1.0 / 25.4);
  writer.Transfer(BRepBuilderAPI_Transform(part->second(), to_unit).Shape(), STEPControl_AsIs);
  return writer.Write(argv[2]) == IFSelect_RetDone ? 0 : 1;
}
