#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "planner/files/exchange/exchange.h"
#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"

namespace capstan::exchange::testing {

/// The diagnostics as lines, without the file's name.
inline std::vector<std::string> lines(const Job& job) {
  std::vector<std::string> out;
  for (Diagnostic d : job.diagnostics()) {
    d.file.clear();
    out.push_back(to_text(d));
  }
  return out;
}

/// "severity CODE #instance" of each diagnostic: what a file's deviations are, without the prose.
inline std::vector<std::string> codes(const Job& job) {
  std::vector<std::string> out;
  for (const Diagnostic& d : job.diagnostics()) {
    out.push_back(std::string(to_text(d.severity)) + " " + d.code +
                  (d.instance != 0 ? " #" + std::to_string(d.instance) : ""));
  }
  return out;
}

/// A file around the data section's text.
inline std::string part21(const std::string& data, const std::string& header = "") {
  return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\n"
         "FILE_NAME('test','',(''),(''),'','','');\nFILE_SCHEMA(('MACHINING_SCHEMA'));\n" +
         header + "ENDSEC;\nDATA;\n" + data + "ENDSEC;\nEND-ISO-10303-21;\n";
}

/// A small whole part: one hole, drilled. Lines may be replaced by number.
inline std::string drilled_plate(const std::map<int, std::string>& changed = {}) {
  std::map<int, std::string> lines = {
      {1, "PROJECT('P',#2,(#4),$,$,$)"},
      {2, "WORKPLAN('MAIN',(#10),$,#8,$)"},
      {4, "WORKPIECE('PIECE',$,0.01,$,$,$,())"},
      {8, "SETUP('S',#71,#62,(#9))"},
      {9, "WORKPIECE_SETUP(#4,#71,$,$,())"},
      {10, "MACHINING_WORKINGSTEP('WS',#62,#17,#20,$)"},
      {17, "ROUND_HOLE('HOLE',#4,(#20),#81,#64,#58,$,#26)"},
      {20, "DRILLING($,$,'DRILL',10.,$,#44,#45,#41,$,$,$,$,$,$)"},
      {26, "THROUGH_BOTTOM_CONDITION()"},
      {31, "TWIST_DRILL(#32,2,.RIGHT.,.F.,$)"},
      {32, "MILLING_TOOL_DIMENSION(10.,59.,$,45.,$,$,$)"},
      {41, "MILLING_MACHINE_FUNCTIONS(.T.,$,$,.F.,$,(),.T.,$,$,())"},
      {44, "MILLING_CUTTING_TOOL('D10',#31,(#46),90.,$,$)"},
      {45, "MILLING_TECHNOLOGY(0.005,.TCP.,$,-16.,$,.F.,.F.,.F.,$)"},
      {46, "CUTTING_COMPONENT(90.,$,$,$,$)"},
      {58, "TOLERANCED_LENGTH_MEASURE(10.,#59)"},
      {59, "PLUS_MINUS_VALUE(0.1,0.05,3)"},
      {62, "PLANE('SEC',#73)"},
      {64, "PLANE('DEPTH',#83)"},
      {71, "AXIS2_PLACEMENT_3D('',#95,#96,#97)"},
      {73, "AXIS2_PLACEMENT_3D('',#98,#96,#97)"},
      {81, "AXIS2_PLACEMENT_3D('',#110,#96,#97)"},
      {83, "AXIS2_PLACEMENT_3D('',#112,#96,#97)"},
      {95, "CARTESIAN_POINT('',(0.,0.,0.))"},
      {96, "DIRECTION('',(0.,0.,1.))"},
      {97, "DIRECTION('',(1.,0.,0.))"},
      {98, "CARTESIAN_POINT('',(0.,0.,30.))"},
      {110, "CARTESIAN_POINT('',(20.,60.,0.))"},
      {112, "CARTESIAN_POINT('',(0.,0.,-30.))"},
  };
  for (const auto& [n, text] : changed) lines[n] = text;
  std::string data;
  for (const auto& [n, text] : lines) {
    if (!text.empty()) data += "#" + std::to_string(n) + "=" + text + ";\n";
  }
  return data;
}

inline Result<model::Plan> read_text(const std::string& bytes, Job& job) {
  return read_bytes(bytes, "test.stp", ReadOptions{}, job);
}

/// One attribute as text, references by the instance number of what they point to.
inline std::string value_text(const model::Model& m, const model::Attribute& a, const void* data,
                              const std::map<model::AnyRef, std::uint64_t>& number) {
  using model::Storage;
  const auto ref = [&](model::AnyRef r) {
    if (!r.set()) return std::string("$");
    const auto it = number.find(r);
    return it == number.end() ? std::string("#?") : "#" + std::to_string(it->second);
  };
  const auto select = [&](const model::SelectValue& v) {
    return ref(v.ref) + "|" + v.type + "|" + (v.real ? shortest(*v.real) : "") + "|" + v.text;
  };
  if (!model::has_value(a, data)) return "$";
  std::string out;
  switch (a.storage) {
    case Storage::kReal:
      return shortest(*model::value_of<model::Real>(a, data));
    case Storage::kInteger:
      return std::to_string(*model::value_of<model::Integer>(a, data));
    case Storage::kBoolean:
      return *model::value_of<model::Boolean>(a, data) ? "T" : "F";
    case Storage::kText:
      return "'" + *model::value_of<model::Text>(a, data) + "'";
    case Storage::kEnum:
      return std::to_string(model::value_of<model::AnyEnum>(a, data).code);
    case Storage::kRef:
      return ref(model::value_of<model::AnyRef>(a, data));
    case Storage::kSelect:
      return select(model::value_of<model::SelectValue>(a, data));
    case Storage::kRefList:
      for (const auto r : model::value_of<model::AnyRefList>(a, data).items) out += ref(r) + ",";
      return out;
    case Storage::kSelectList:
      for (const auto& v : model::value_of<model::SelectList>(a, data).items) out += select(v) + ",";
      return out;
    case Storage::kRealList:
      for (const double v : model::value_of<model::RealList>(a, data).items) out += shortest(v) + ",";
      return out;
    case Storage::kIntegerList:
      for (const auto v : model::value_of<model::IntegerList>(a, data).items) out += std::to_string(v) + ",";
      return out;
    case Storage::kTextList:
      for (const auto& v : model::value_of<model::TextList>(a, data).items) out += v + ",";
      return out;
    case Storage::kRefTable:
      for (const auto& row : model::value_of<model::RefTable>(a, data).items) {
        for (const auto r : row) out += ref(r) + ",";
        out += ";";
      }
      return out;
    case Storage::kRealTable:
      for (const auto& row : model::value_of<model::RealTable>(a, data).items) {
        for (const double v : row) out += shortest(v) + ",";
        out += ";";
      }
      return out;
    case Storage::kPath:
      return "path";
  }
  (void)m;
  return out;
}

/// Every object that came from a file, as "#n KEYWORD" -> "attribute=value ...". Two plans say the same when
/// their pictures are equal. Objects without a number are given none, and are seen through what refers to
/// them.
inline std::map<std::string, std::string> picture(const model::Plan& plan) {
  const auto& m = plan.model;
  std::map<model::AnyRef, std::uint64_t> number;
  for (std::size_t t = 1; t < model::kTypeCount; ++t) {
    for (const auto at : m.all(static_cast<model::TypeId>(t))) number[at] = m.origin(at).instance;
  }
  std::map<std::string, std::string> out;
  for (const auto& [at, n] : number) {
    std::string text;
    if (const auto* kept = m.get<model::KeptInstance>(at)) {
      for (const auto& piece : kept->pieces) {
        const auto* s = std::get_if<std::string>(&piece);
        text += s != nullptr ? *s : "#" + std::to_string(number.at(std::get<model::AnyRef>(piece)));
      }
    }
    for (const auto& a : model::noun_type(at.type).attributes) {
      text += std::string(a.name) + "=" + value_text(m, a, m.object(at), number) + " ";
    }
    out["#" + std::to_string(n) + " " + std::string(model::noun_type(at.type).keyword)] = text;
  }
  return out;
}

/// The ledger by instance numbers.
inline std::map<std::string, std::string> ledger_picture(const model::Plan& plan) {
  std::map<std::string, std::string> out;
  for (const auto& [key, d] : plan.ledger.entries()) {
    const auto& why = plan.ledger.reason(d.reason);
    std::string needs;
    for (const auto& k : d.depends_on) {
      needs += "#" + std::to_string(plan.model.origin(k.object).instance) + "." + k.attribute + " ";
    }
    std::string rejected;
    for (const auto& r : d.rejected) rejected += r.what + ":" + r.why + ";";
    out["#" + std::to_string(plan.model.origin(key.object).instance) + "." + key.attribute] =
        std::string(d.state == model::DecisionState::kOpen ? "open " : "bound ") +
        std::string(model::to_text(d.binder)) + (d.pinned ? " pinned " : " ") + why.id + "|" + why.text +
        "|" + why.source + "|" + d.lexeme + "|" + needs + "|" + rejected;
  }
  return out;
}

}  // namespace capstan::exchange::testing
