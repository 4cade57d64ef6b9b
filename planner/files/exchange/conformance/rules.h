#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/files/exchange/conformance/faults.h"
#include "planner/files/exchange/conformance/population.h"
#include "planner/files/exchange/express/dictionary.h"

namespace capstan::exchange::conformance {

/// The subject of a rule; rules.table explains each.
enum class Subject : std::uint8_t {
  kOwn,        ///< an attribute of the instance itself
  kProperty,   ///< action_property
  kResource,   ///< resource_property
  kTool,       ///< item of a tool's body
  kItem,       ///< item of a representation
  kParameter,  ///< item of a shape_representation_with_parameters
  kParameters,
  kShape,
  kMethod,
  kTools,
  kAction,
  kAspect,
  kOf,
  kOfShape,
  kUnit,
};

using Names = std::vector<std::string>;

/// Powers of length and time; angles and ratios are numbers.
struct Dimension {
  double length = 0.0, time = 0.0;
  bool angle = false, ratio = false;  ///< wanted as such
};

/// How the value of a property or item must look; all that is given must hold.
struct Form {
  enum class Value : std::uint8_t { kAny, kCount, kNumber, kText } value = Value::kAny;
  Names texts;                                    ///< of kText; empty for any
  std::vector<express::EntityId> item;            ///< one item that is all of these
  std::vector<express::EntityId> representation;  ///< the representation is this
  Names named;                                    ///< and has one of these names
  std::vector<express::EntityId> to;              ///< of a relationship or an action: one of these
  std::string unit;                               ///< a dimension; empty for any
  std::string text;                               ///< as spelled in the table
};

struct Guard {
  std::string attribute;  ///< description, name, purpose, kind, ...
  Names values;
};

struct Rule {
  express::EntityId entity = express::kNoEntity;
  std::vector<Guard> guards;
  std::vector<express::EntityId> unless;
  Subject subject = Subject::kOwn;
  std::size_t least = 0, most = std::numeric_limits<std::size_t>::max();
  std::string attribute;  ///< of kOwn
  Names names;            ///< of the property, the item, the aspect (its description), ...
  express::EntityId type = express::kNoEntity;
  Names by, as_name, component_description;  ///< of kAspect
  std::vector<express::EntityId> from;       ///< of kAspect
  Form form;
};

/// Reads a table in the form that the head of rules.table describes; throws std::logic_error if it is
/// malformed.
[[nodiscard]] std::vector<Rule> read_rules(std::string_view table, const express::Dictionary& dictionary);

/// Checks every instance to which rules of `rules` apply. Each broken rule is one SCH-RULE.
void check_rules(const Population& population, std::span<const Rule> rules, Faults& faults);

}  // namespace capstan::exchange::conformance
