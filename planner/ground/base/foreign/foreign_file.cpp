#include "planner/ground/base/foreign/foreign_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

namespace capstan {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kSaveAsStep = "save the part as STEP (AP242, or AP203 or AP214) or as an STL mesh";
constexpr std::string_view kNoSolid = "it holds lines and no solid: save the part's solid as STEP or STL";

struct Signature {
  std::string_view bytes;
  ForeignFile file;
};

/// What files of a kind begin with, as their formats state it.
constexpr std::array kSignatures = {
    Signature{"%PDF-"sv, {"a PDF document", kNoSolid}},
    Signature{"AutoCAD Binary DXF"sv, {"a DXF drawing (binary)", kNoSolid}},
    Signature{"AC10"sv, {"a DWG drawing", kNoSolid}},
    Signature{"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1"sv,
              {"a native CAD file (SolidWorks, Inventor or another in an OLE container)", kSaveAsStep}},
    Signature{"V5_CFV2"sv, {"a native CAD file of CATIA V5", kSaveAsStep}},
    Signature{"#UGC:2"sv, {"a native CAD file of Creo", kSaveAsStep}},
    Signature{"**ABCDEFGHIJKLMNOPQRSTUVWXYZ"sv, {"a Parasolid file (text)", kSaveAsStep}},
    Signature{"PS\0"sv, {"a Parasolid file (binary)", kSaveAsStep}},
    Signature{"3D Geometry File Format "sv, {"a native CAD file of Rhino", kSaveAsStep}},
    Signature{"ACIS BinaryFile"sv, {"an ACIS file (binary)", kSaveAsStep}},
    Signature{"ASM BinaryFile"sv, {"an ACIS file (binary)", kSaveAsStep}},
    Signature{"DBRep_DrawableShape"sv, {"a B-rep file of Open CASCADE", kSaveAsStep}},
    Signature{"glTF"sv, {"a glTF scene", kSaveAsStep}},
    Signature{"\x89PNG"sv, {"a PNG picture", kSaveAsStep}},
    Signature{"\xFF\xD8\xFF"sv, {"a JPEG picture", kSaveAsStep}},
    Signature{"PK\x03\x04"sv, {"a ZIP archive (FreeCAD, 3MF and others are such)", kSaveAsStep}},
    Signature{"\x1F\x8B"sv, {"a gzip archive", "unpack it first"}},
    Signature{"ISO-10303-28"sv, {"a STEP file as XML", kSaveAsStep}},
};

std::string_view next_line(std::string_view& rest) {
  const auto end = std::min(rest.find('\n'), rest.size());
  std::string_view line = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back())) != 0) line.remove_suffix(1);
  while (!line.empty() && std::isspace(static_cast<unsigned char>(line.front())) != 0) line.remove_prefix(1);
  return line;
}

/// Pairs of a code and its value, the first of them 0 and SECTION behind comments (999).
bool is_dxf(std::string_view rest) {
  for (int pairs = 0; pairs < 100 && !rest.empty(); ++pairs) {
    const std::string_view code = next_line(rest), value = next_line(rest);
    if (code == "0") return value == "SECTION";
    if (code != "999") return false;
  }
  return false;
}

/// 80 columns, of which the 73rd is the letter of the section (S) and behind it number 1.
bool is_iges(std::string_view rest) {
  const std::string_view line = rest.substr(0, std::min(rest.find_first_of("\r\n"), rest.size()));
  return line.size() == 80 && line[72] == 'S' && line.ends_with("1");
}

/// A line of four whole numbers (version, records, bodies, history); behind it the length of the product's
/// name and that name.
bool is_acis(std::string_view rest) {
  std::string_view head = next_line(rest), product = next_line(rest);
  const auto number = [](std::string_view& text) {
    const auto end = std::min(text.find_first_not_of("0123456789"), text.size());
    const bool any = end > 0;
    text.remove_prefix(end);
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    return any;
  };
  for (int k = 0; k < 4; ++k) {
    if (!number(head)) return false;
  }
  if (product.starts_with('@')) product.remove_prefix(1);
  return head.empty() && number(product) && !product.empty() &&
         std::isalpha(static_cast<unsigned char>(product.front())) != 0;
}

/// A line of a program: words of a letter and a number, comments aside; `words` counts those.
bool is_program_line(std::string_view line, int& words) {
  for (std::size_t i = 0; i < line.size();) {
    const char c = line[i];
    if (c == ';') return true;
    if (c == '(') {
      const auto end = line.find(')', i);
      if (end == std::string_view::npos) return false;
      i = end + 1;
      continue;
    }
    if (std::isspace(static_cast<unsigned char>(c)) != 0 || c == '/') {
      ++i;
      continue;
    }
    if (std::isalpha(static_cast<unsigned char>(c)) == 0) return false;
    const std::size_t first = ++i;
    while (i < line.size() && (std::isdigit(static_cast<unsigned char>(line[i])) != 0 || line[i] == '.' ||
                               line[i] == '-' || line[i] == '+'))
      ++i;
    if (i == first) return false;
    if (c == 'G' || c == 'g' || c == 'M' || c == 'm') ++words;
  }
  return true;
}

/// Of the lines that are looked at most are those of a program (a control's own words are in the others), and
/// some have G or M words.
bool is_gcode(std::string_view rest) {
  constexpr int kLines = 50, kWords = 3;
  int words = 0, lines = 0, of_program = 0;
  while (!rest.empty() && lines < kLines) {
    const std::string_view line = next_line(rest);
    const bool comment = line.starts_with(';') || (line.starts_with('(') && line.ends_with(')'));
    if (line.empty() || line == "%" || comment) continue;
    of_program += is_program_line(line, words) ? 1 : 0;
    ++lines;
  }
  return words >= kWords && 2 * of_program > lines;
}

}  // namespace

std::optional<ForeignFile> foreign_file(std::string_view bytes) {
  for (const Signature& s : kSignatures) {
    if (bytes.starts_with(s.bytes)) return s.file;
  }
  const std::string_view head = bytes.substr(0, std::min<std::size_t>(bytes.size(), 1 << 16));
  if (is_dxf(head)) return ForeignFile{"a DXF drawing", kNoSolid};
  if (is_iges(head)) return ForeignFile{"an IGES file", kSaveAsStep};
  if (is_acis(head)) return ForeignFile{"an ACIS file (SAT)", kSaveAsStep};
  if (is_gcode(head)) return ForeignFile{"a program (G-code)", kPlanItsPart, true};
  const auto first = head.find_first_not_of(" \t\r\n");
  if (first != std::string_view::npos &&
      (head.substr(first).starts_with("<?xml") || head.substr(first).starts_with("<html") ||
       head.substr(first).starts_with("<!DOCTYPE")))
    return ForeignFile{"an XML or HTML document", kSaveAsStep};
  return std::nullopt;
}

}  // namespace capstan
