#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace capstan::exchange {

/// What a statement of a CAD file is about, and where it stands.
struct StatedOf {
  std::int64_t id = 0;              ///< `#id` of the instance that states it
  std::uint64_t line = 0;           ///< where that instance begins
  std::vector<std::int64_t> faces;  ///< `#id`s of faces, ascending, each once; empty: the file names none
  bool whole = false;               ///< it is about the whole part
  friend bool operator==(const StatedOf&, const StatedOf&) = default;
};

/// A size, or a distance, with its tolerance.
struct StatedSize : StatedOf {
  std::string kind;                             ///< "diameter", "radius", "linear distance", …, as written
  std::vector<std::int64_t> to;                 ///< faces at the other end of a distance; a size has none
  std::optional<double> nominal_mm;             ///< unset: limits alone are stated
  std::optional<double> lower_mm, upper_mm;     ///< deviations from nominal, signed; both or none
  std::optional<double> least_mm, greatest_mm;  ///< limits, where they are stated in place of deviations
  std::string fit;                              ///< class of ISO 286, "H7"; empty: none
  bool of_shaft = false;                        ///< the fit is stated of a shaft
  friend bool operator==(const StatedSize&, const StatedSize&) = default;
};

/// A geometric tolerance (ISO 1101).
struct StatedZone : StatedOf {
  std::string keyword;                 ///< "FLATNESS_TOLERANCE", …, of ISO 10303-47
  double value_mm = 0.0;               ///< of the zone
  std::string form;                    ///< "cylindrical or circular", …; empty: not stated
  std::vector<std::string> modifiers;  ///< lower case: "maximum_material_requirement"
  /// Letters by precedence; a common datum has several.
  std::vector<std::vector<std::string>> datums;
  friend bool operator==(const StatedZone&, const StatedZone&) = default;
};

/// A datum, and the faces of its datum feature.
struct StatedDatum : StatedOf {
  std::string letter;
  friend bool operator==(const StatedDatum&, const StatedDatum&) = default;
};

/// A parameter of surface texture (ISO 21920), such as Ra.
struct StatedTexture : StatedOf {
  std::string parameter;  ///< "Ra"
  double value_um = 0.0;
  std::string method;  ///< how it is measured; empty: not stated
  friend bool operator==(const StatedTexture&, const StatedTexture&) = default;
};

/// A statement that is kept in the file and not understood.
struct UnreadPmi {
  std::int64_t id = 0;
  std::string what;  ///< its keyword
  std::string why;
  friend bool operator==(const UnreadPmi&, const UnreadPmi&) = default;
};

/// Product and manufacturing information: what a CAD file asks of its shape. In the order of the file.
struct Pmi {
  std::vector<StatedSize> sizes;
  std::vector<StatedZone> zones;
  std::vector<StatedDatum> datums;
  std::vector<StatedTexture> textures;
  std::vector<UnreadPmi> unread;
  friend bool operator==(const Pmi&, const Pmi&) = default;
};

}  // namespace capstan::exchange
