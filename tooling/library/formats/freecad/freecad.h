#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tooling/library/formats/format.h"

namespace capstan::tooling {

/// One file of a FreeCAD tool folder, by its path there: "Bit/5mm_Endmill.fctb", "Library/Default.fctl".
struct FreecadFile {
  std::string path, bytes;
  std::string on_disk = {};  ///< where it was read from, for diagnostics; empty: it lies in an archive
  bool operator==(const FreecadFile&) const = default;
};

/// FreeCAD's tool bits and libraries: one bit (`.fctb`), a library (`.fctl`) with the bits beside it or in
/// the folder Bit next to its own, or a zip of both.
///
/// Written  by the ending: `.fctb`, the JSON of one bit; `.fctl`, the JSON of a library, with its bits beside
///          it (in the folder Bit next to its own where that is called Library, as FreeCAD keeps them); else
///          a zip of Bit/ and Library/.
///
/// Read     name, shape, lengths ("6.0000 mm", "0.375 \""), angles, flutes, tool numbers; unknown parameters
///          and attributes are kept word for word. Chipload (a length per tooth, for no material named) is
///          the largest feed per tooth.
/// Source   FreeCAD's shape classes and their property names (src/Mod/CAM/Path/Tool/shape/models); of V-bits
/// and
///          chamfer mills CuttingEdgeAngle is the full angle (BIT_ATTRIBUTES.md there).
/// Fails    FREECAD-VALUE, FREECAD-FORM, TOOL-NUMBER (twice in a library), TOOL-ID, DATA-*, JSON-*, FILE-*; a
///          bit with a fault beside others without one is left out, with a warning.
/// The format is `freecad_format` (all.h). The same from files in memory; bits that no library lists are
/// read, too. `file`: to name in diagnostics; `options`: the unit of lengths that state none, which are a
/// fault else.
[[nodiscard]] Result<Imported> read_freecad(const std::vector<FreecadFile>& files, const std::string& file,
                                            const FormatOptions& options, Job& job);
/// As `options.to` ends, else as a zip.
/// Fails  FREECAD-NONE: no tool has a shape there; FREECAD-ONE: more than one bit for a `.fctb`, or more than
///        one list of tool numbers for a `.fctl`.
[[nodiscard]] Result<Exported> write_freecad(const ToolLibrary& library, const FormatOptions& options,
                                             Job& job);
/// The files of a FreeCAD folder, sorted by path.
[[nodiscard]] std::vector<FreecadFile> freecad_files(const ToolLibrary& library, LossReport& report);

}  // namespace capstan::tooling
