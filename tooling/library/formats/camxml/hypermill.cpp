#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "planner/ground/base/number.h"
#include "planner/ground/base/text.h"
#include "tooling/library/formats/all.h"
#include "tooling/library/formats/camxml/parameters.h"

// hyperMILL's exchange file of tools (omtdx).

namespace capstan::tooling {
namespace {

using camxml::Parameter;
using model::CutterClass;

constexpr std::array kParameters = {
    Parameter{"toolDiameter", "DC"},       Parameter{"cuttingLength", "APMX"},
    Parameter{"toolTotalLength", "OAL"},   Parameter{"cuttingEdges", "ZEFF"},
    Parameter{"toolShaftDiameter", "DMM"}, Parameter{"cornerRadius", "RE"},
    Parameter{"cuttingMaterial", "GRADE"},
};
constexpr std::array<std::string_view, 6> kElsewhere = {"lengthOfUnit", "manufacturer",    "orderingCode",
                                                        "comment",      "spindleRotation", "tipDiameter"};
struct Type {
  std::string_view name;  ///< in small letters: public importers fold them differently
  CutterClass cutter_class;
};
/// Types of tools. Source: endMill by makers' files; ballMill and radiusMill by three public importers of
/// such files that read them alike; tslotcutter by one, and by a public list of the system's tool classes. A
/// corner radius makes a bull nose of an end mill and a radius mill (`class_by_radius`).
constexpr std::array kTypes = {
    Type{"endmill", CutterClass::kEndmill},
    Type{"radiusmill", CutterClass::kEndmill},
    Type{"ballmill", CutterClass::kBallEndmill},
    Type{"tslotcutter", CutterClass::kTSlotMill},
};
/// Makers write a radius of nearly nothing where a corner is sharp.
constexpr double kSharpMm = 1e-3;

class Reader {
 public:
  Reader(const std::string& file, Imported& out, Job& job)
      : file_(file), out_(out), gatherer_(out, file, "HYPERMILL-VALUE", job) {}

  Status read(const XmlNode& root) {
    // Tools lie in folders of folders; their depth is bounded by that of the document.
    std::vector<const XmlNode*> open{&root};
    while (!open.empty()) {
      const XmlNode* n = open.back();
      open.pop_back();
      if (n->name == "tool") {
        take(*n);
        continue;
      }
      for (auto c = n->children.rbegin(); c != n->children.rend(); ++c)
        if (c->name == "tools" || c->name == "tool") open.push_back(&*c);
    }
    return gatherer_.finish("tool elements");
  }

 private:
  void take(const XmlNode& tool) {
    CatalogueItem item;
    item.product_id = camxml::parameter(tool, "orderingCode");
    item.id = item.product_id.empty() ? tool.attribute("name") : item.product_id;
    const std::string comment = camxml::parameter(tool, "comment");
    item.description = comment.empty() ? tool.attribute("name") : comment;
    item.manufacturer = camxml::parameter(tool, "manufacturer");
    item.kind = tool.attribute("type");
    const Place place{file_, tool.line, item.id};
    const std::string unit = camxml::parameter(tool, "lengthOfUnit");
    if (!mm_per_unit_of(unit))
      gatherer_.fault(fault_at(place, "DATA-UNIT",
                               unit.empty() ? "the unit is missing" : "the unit '" + unit + "' is not known",
                               "lengthOfUnit: mm or inch"));
    camxml::read_parameters(tool, kParameters, kElsewhere, unit, "hyperMILL", place, item, gatherer_,
                            out_.report);
    hand(tool, item);
    sharp(item);
    grade(item);
    classify(item);
    if (const XmlNode* sets = tool.find("tecsets"))
      for (const XmlNode& s : sets->children)
        if (s.name == "tecset") preset(s, place, item);
    if (tool.find("geometry") != nullptr)
      out_.report.dropped.push_back({item.id, "geometry", "the drawn outline; the sizes are taken"});
    (void)gatherer_.take(std::move(item), place);
  }

  void hand(const XmlNode& tool, CatalogueItem& item) {
    const std::string turn = camxml::parameter(tool, "spindleRotation");
    if (turn == "clockwise")
      item.properties.push_back(text_property("HAND", "R", "hyperMILL spindleRotation"));
    if (turn == "counterclockwise" || turn == "counterClockwise")
      item.properties.push_back(text_property("HAND", "L", "hyperMILL spindleRotation"));
  }

  void sharp(CatalogueItem& item) {
    const auto re = number_of(item, "RE");
    if (!re || *re >= kSharpMm) return;
    std::erase_if(item.properties, [](const Property& p) { return p.symbol == "RE"; });
    out_.report.dropped.push_back(
        {item.id, "RE", "a corner radius of " + shortest(*re) + " mm is how it writes a sharp corner"});
  }

  void grade(CatalogueItem& item) {
    const Property* p = find(item.properties, "GRADE");
    if (p == nullptr) return;
    const std::string t = lower_text(p->text);
    if (t.find("carbide") != std::string::npos || t == "md" || t == "vhm" || t == "hm")
      add_derived_text(item, "SUBSTRATE", "carbide", "cuttingMaterial '" + p->text + "'", out_.report);
    if (t.find("hss") != std::string::npos)
      add_derived_text(item, "SUBSTRATE", "hss", "cuttingMaterial '" + p->text + "'", out_.report);
  }

  void classify(CatalogueItem& item) {
    const std::string type = lower_text(item.kind);
    const auto at = std::ranges::find(kTypes, std::string_view(type), &Type::name);
    if (at == kTypes.end())
      leave_out(item, "the type '" + item.kind + "' is not known", out_.report);
    else
      item.cutter_class = at->cutter_class;
    const auto dc = number_of(item, "DC");
    if (!dc) {
      if (!gatherer_.has_fault())
        gatherer_.fault({file_, 0, item.id}, "the cutting diameter is missing", "toolDiameter");
      return;
    }
    if (at == kTypes.end()) return;
    const std::string* tapered = find_kept(item.kept, "tapered");
    const std::string* taper = find_kept(item.kept, "taperAngle");
    if (tapered != nullptr && yes(*tapered)) {
      leave_out(item, "it is tapered, and which angle taperAngle is no source says", out_.report);
    } else if (taper != nullptr && parse_double(*taper) != 0.0) {
      leave_out(item,
                "its taperAngle is " + *taper + ": it is tapered, and which angle that is no source says",
                out_.report);
    } else if (type == "ballmill") {
      ball(item, *dc);
    } else if (type == "radiusmill" && !number_of(item, "RE")) {
      leave_out(item, "a radius mill without a corner radius", out_.report);
    } else if (type == "tslotcutter") {
      disc(item);
    }
    class_by_radius(item);
  }

  void ball(CatalogueItem& item, double dc) {
    const auto re = number_of(item, "RE");
    if (re && std::abs(*re - 0.5 * dc) > kSharpMm)
      leave_out(item, "a ball mill of " + mm_text(dc) + " with a corner radius of " + mm_text(*re),
                out_.report);
    else
      add_derived(item, "RE", 0.5 * dc, "mm", "half the diameter of a ball end mill", out_.report);
  }

  /// The head of a T-slot cutter is as high as it cuts; what discHeight is of it no source says.
  void disc(CatalogueItem& item) {
    const auto height = number_of(item, "APMX");
    const std::string* stated = find_kept(item.kept, "discHeight");
    const double other_mm =
        stated == nullptr ? 0.0 : parse_double(*stated).value_or(0.0) * (item.inches ? kMmPerInch : 1.0);
    if (!height)
      leave_out(item, "a T-slot cutter without a cutting length", out_.report);
    else if (other_mm != 0.0 && std::abs(other_mm - *height) > kSharpMm)
      leave_out(item,
                "a T-slot cutter with a cutting length of " + mm_text(*height) + " and discHeight " +
                    *stated + ": which is its width no source says",
                out_.report);
  }

  void preset(const XmlNode& set, const Place& place, CatalogueItem& item) {
    const auto value = [&](const char* name) {
      Place at = place;
      at.line = set.line;
      at.path = item.id + ", tecset " + name;
      return camxml::positive(camxml::parameter(set, name), at, gatherer_);
    };
    Preset p;
    p.name = camxml::parameter(set, "purpose");
    p.material = camxml::parameter(set, "material");
    const double unit = mm_per_unit_of(camxml::parameter(set, "lengthOfUnit")).value_or(1.0);
    p.rpm = value("spindleSpeed");
    p.vc_m_min = value("cuttingSpeed");  // m/min where lengths are mm
    const auto in_mm = [unit](std::optional<double> v) { return v ? std::optional(*v * unit) : v; };
    p.fz_mm = in_mm(value("feedratePerEdge"));
    p.stepover_mm = in_mm(value("cuttingWidth"));
    p.stepdown_mm = in_mm(value("cuttingLength"));
    if (!p.rpm && !p.vc_m_min && !p.fz_mm) return;
    if (unit != 1.0 && p.vc_m_min) {
      out_.report.dropped.push_back({item.id, "cuttingSpeed", "of an inch tool: its unit is not known"});
      p.vc_m_min.reset();
    }
    p.coolant = camxml::parameter(set, "coolants");
    p.source = "hyperMILL tecset";
    for (const char* formula :
         {"spindleSpeedFormula", "planeFeedrateFormula", "zFeedrateFormula", "reducedFeedrateFormula"})
      if (!camxml::parameter(set, formula).empty())
        out_.report.dropped.push_back({item.id, formula, "a formula of the CAM system's own"});
    item.presets.push_back(std::move(p));
  }

  const std::string& file_;
  Imported& out_;
  ItemGatherer gatherer_;
};

bool recognises(std::string_view bytes, std::string_view /*file*/) {
  return bytes.substr(0, 4096).find("<omtdx") != std::string_view::npos;
}

Result<Imported> read(std::string_view bytes, const std::string& file, const FormatOptions& /*options*/,
                      Job& job) {
  return camxml::read_with<Reader>(bytes, file, job);
}

}  // namespace

const Format& hypermill_format() {
  static const Format kFormat{.name = "hypermill",
                              .title = "hyperMILL tools (omtdx XML)",
                              .endings = {".xml"},
                              .recognises = recognises,
                              .read = read};
  return kFormat;
}

}  // namespace capstan::tooling
