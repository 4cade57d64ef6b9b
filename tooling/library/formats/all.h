#pragma once

#include "tooling/library/formats/format.h"

/// @file The formats, one folder or file each; `formats()` lists them.

namespace capstan::tooling {

[[nodiscard]] const Format& fusion_format();       ///< `.tools`, both ways
[[nodiscard]] const Format& fusion_json_format();  ///< `.json`, both ways
[[nodiscard]] const Format& csv_format();          ///< with a column map, both ways
[[nodiscard]] const Format& linuxcnc_format();     ///< `.tbl`, PathPilot's too, both ways
[[nodiscard]] const Format& own_format();          ///< our own list (YAML, JSON), both ways
[[nodiscard]] const Format& store_format();        ///< SQLite, both ways; tooling/library/store
[[nodiscard]] const Format& freecad_format();
[[nodiscard]] const Format& iso13399_format();
[[nodiscard]] const Format& gtc_format();
[[nodiscard]] const Format& din4000_format();    ///< XML and CSV, read only
[[nodiscard]] const Format& family_format();     ///< a catalogue page as XML (FamilyDetails), read only
[[nodiscard]] const Format& hypermill_format();  ///< omtdx XML, read only
[[nodiscard]] const Format& solidcam_format();   ///< XML, read only
[[nodiscard]] const Format& mtconnect_format();

}  // namespace capstan::tooling
