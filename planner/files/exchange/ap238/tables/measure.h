#pragma once

#include <array>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "planner/files/exchange/ap238/read/graph.h"
#include "planner/model/nouns/arena/attribute.h"

namespace capstan::exchange::ap238 {

/// A unit of a file by what it measures and its size in SI units.
struct FileUnit {
  double factor = 1.0;  ///< to m, kg, s, A, K, mol, cd, rad; a revolution counts 2 pi
  /// Exponents of length, mass, time, current, temperature, amount, luminosity; then plane angle.
  std::array<double, 8> exponents{};
  bool counted = false;  ///< revolutions and other counts: an angle of 1 instead of 2 pi
  [[nodiscard]] bool operator==(const FileUnit&) const = default;
};

/// The kind of coordinates of a point: a curve need not be in space.
enum class Coordinates : std::uint8_t {
  kLengths,
  kNumbers,   ///< ratios, components of directions: no units
  kSections,  ///< the seven cross-section parameters: lengths, the fifth an area
};

/// The identifier of the context with units that the writer makes; @context in 0_macros.map.
inline constexpr std::string_view kWrittenContext = "MILLIMETRE RADIAN STERADIAN";

/// Units of the numbers of a representation that has no units of its own.
struct Scale {
  double length = 1.0;  ///< to mm
  double angle = 1.0;   ///< to rad
  double uncertainty_mm =
      0.0;               ///< of distances, as the context states it: points nearer coincide; 0 where open
  bool unclear = false;  ///< it should say the unit of lengths and cannot be understood, or says two
  bool stated = false;   ///< the context says so
  bool ours = false;     ///< the context is the one that the writer makes: solids are read as the model's own
  Coordinates coordinates = Coordinates::kLengths;
  [[nodiscard]] bool operator==(const Scale&) const = default;
  [[nodiscard]] bool identity() const { return length == 1.0 && angle == 1.0; }
};

/// Units of one file, each worked out once.
class Units {
 public:
  explicit Units(const Graph& g) : g_(g) {}

  /// A NAMED_UNIT or DERIVED_UNIT; nothing if it cannot be understood. Its parts are added to `used`.
  [[nodiscard]] std::optional<FileUnit> unit(Node n);
  /// Factor from a number in that unit to the model's `to`; nothing if it measures something else.
  [[nodiscard]] static std::optional<double> factor(const FileUnit& from, model::Unit to);
  /// Of a representation's context. Without global units: millimetres and what `fallback` says.
  [[nodiscard]] Scale scale(Node context, const Scale& fallback);
  /// Instances that units and contexts consist of, in the order they were met.
  [[nodiscard]] const std::vector<Node>& used() const { return used_; }

 private:
  // Remembers every unit, also those that are only parts of others.
  std::optional<FileUnit> part(Node n, int depth);
  std::optional<FileUnit> work_out(Node n, int depth);

  const Graph& g_;
  std::unordered_map<Node, std::optional<FileUnit>> units_;
  std::unordered_map<Node, Scale> scales_;
  std::vector<Node> used_;
};

}  // namespace capstan::exchange::ap238
