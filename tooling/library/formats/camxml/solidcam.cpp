#include <array>
#include <utility>

#include "planner/ground/base/number.h"
#include "planner/ground/base/text.h"
#include "tooling/library/formats/all.h"
#include "tooling/library/formats/camxml/parameters.h"

// SolidCAM's exchange file of tools: Results/Tools/Tool.

namespace capstan::tooling {
namespace {

using camxml::Parameter;
using model::CutterClass;

constexpr std::array kParameters = {
    Parameter{"diameter", "DC"},        Parameter{"arbor diameter", "DMM"},
    Parameter{"total length", "OAL"},   Parameter{"cutting edge length", "APMX"},
    Parameter{"helical angle", "FHA"},  Parameter{"number of teeth", "ZEFF"},
    Parameter{"corner radius", "RE"},   Parameter{"shoulder diameter", "DN"},
    Parameter{"shoulder length", "LN"},
};
constexpr std::array<std::string_view, 5> kElsewhere = {"unit", "units", "description",
                                                        "outside holder length", "id"};

class Reader {
 public:
  Reader(const std::string& file, Imported& out, Job& job)
      : file_(file), out_(out), gatherer_(out, file, "SOLIDCAM-VALUE", job) {}

  Status read(const XmlNode& root) {
    if (const XmlNode* tools = root.find("Tools"))
      for (const XmlNode& t : tools->children)
        if (t.name == "Tool") take(t);
    return gatherer_.finish("Tool elements");
  }

 private:
  void take(const XmlNode& tool) {
    CatalogueItem item;
    item.product_id = camxml::parameter(tool, "description");
    item.id = item.product_id.empty() ? camxml::parameter(tool, "id") : item.product_id;
    item.description = tool.attribute("UserType");
    if (item.id.empty()) item.id = item.description;
    item.kind = tool.attribute("SubType");
    const Place place{file_, tool.line, item.id};
    std::string unit = camxml::parameter(tool, "unit");
    if (unit.empty()) unit = camxml::parameter(tool, "units");
    const auto factor = mm_per_unit_of(unit);
    if (!factor)
      gatherer_.fault(fault_at(place, "DATA-UNIT",
                               unit.empty() ? "the unit is missing" : "the unit '" + unit + "' is not known",
                               "unit: metric or inch"));
    const std::string_view written = factor == kMmPerInch ? "in" : "mm";
    camxml::read_parameters(tool, kParameters, kElsewhere, written, "SolidCAM", place, item, gatherer_,
                            out_.report);
    shoulder(item);
    if (const XmlNode* coolant = tool.find("Coolant")) {
      const std::string through = lower_text(camxml::parameter(*coolant, "through tool"));
      if (!through.empty()) item.properties.push_back(text_property("CSP", through, "SolidCAM through tool"));
    }
    // Of the sub-types only this one is confirmed by a file.
    if (item.kind == "EndMill") item.cutter_class = CutterClass::kEndmill;
    if (!item.cutter_class) leave_out(item, "the sub-type '" + item.kind + "' is not known", out_.report);
    if (!number_of(item, "DC") && !gatherer_.has_fault())
      gatherer_.fault(place, "the cutting diameter is missing", "diameter");
    class_by_radius(item);
    ToolAssembly assembly{.id = item.id,
                          .item = item.id,
                          .instance = {},
                          .holder = {},
                          .stick_out_mm = {},
                          .functional_length_mm = {}};
    const auto out = camxml::positive(camxml::parameter(tool, "outside holder length"), place, gatherer_);
    if (out && factor) assembly.stick_out_mm = *out * *factor;
    if (gatherer_.take(std::move(item), place) && assembly.stick_out_mm)
      out_.library.assemblies.push_back(std::move(assembly));
  }

  /// A shoulder no wider or longer than the edges does not count.
  static void shoulder(CatalogueItem& item) {
    const auto dn = number_of(item, "DN"), dc = number_of(item, "DC"), ln = number_of(item, "LN"),
               edge = number_of(item, "APMX");
    if (dn == dc || (ln && edge && *ln <= *edge))
      std::erase_if(item.properties, [](const Property& p) { return p.symbol == "DN" || p.symbol == "LN"; });
  }

  const std::string& file_;
  Imported& out_;
  ItemGatherer gatherer_;
};

bool recognises(std::string_view bytes, std::string_view /*file*/) {
  const std::string_view head = bytes.substr(0, 4096);
  return head.find("<Results") != std::string_view::npos && head.find("<Tools") != std::string_view::npos &&
         head.find("SubType=") != std::string_view::npos;
}

Result<Imported> read(std::string_view bytes, const std::string& file, const FormatOptions& /*options*/,
                      Job& job) {
  return camxml::read_with<Reader>(bytes, file, job);
}

}  // namespace

const Format& solidcam_format() {
  static const Format kFormat{.name = "solidcam",
                              .title = "SolidCAM tools (XML)",
                              .endings = {".xml"},
                              .recognises = recognises,
                              .read = read};
  return kFormat;
}

}  // namespace capstan::tooling
