#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/result.h"
#include "planner/model/nouns/arena/attribute.h"

/// @file The language of `inspect`: paths over the application objects, the same for every form of a plan.
///
///     path      = [ "/" ] root { step } [ "#size" ]  |  "//" KEYWORD { step } [ "#size" ]
///     root      = "project" | "kept" | "unhandled" | KEYWORD | "#" number
///     step      = "/" attribute | "//" KEYWORD | "[" index "]" | "[*]" | "[" condition "]"
///     condition = all { "or" all }
///     all       = one { "and" one }
///     one       = [ "not" ] ( "(" condition ")" | operand [ compare literal | "is" KEYWORD ] )
///     operand   = "." | attribute { ("." | "/") attribute | "[" index "]" } [ "#size" ]
///     compare   = "=" | "!=" | "<" | "<=" | ">" | ">="
///     literal   = number | 'text' | "true" | "false" | enumerator
///
/// Indices begin at 0. `//KEYWORD`: everything of that kind (or below it) that is reached from here, in the
/// order of the attributes. Numbers are in the model's units: mm, rad, mm/min, 1/min, s. Names and keywords
/// may be written in either case.

namespace capstan::app {

struct OperandStep {
  std::string attribute;  ///< lower case; empty: an index
  std::optional<std::size_t> index;
  std::size_t position = 0;
};

/// A condition as a tree; `parts` of kOr, kAnd, kNot.
struct Condition {
  enum class Kind : std::uint8_t { kOr, kAnd, kNot, kHas, kIs, kCompare };
  enum class Compare : std::uint8_t { kEqual, kNotEqual, kLess, kLessEqual, kGreater, kGreaterEqual };
  Kind kind = Kind::kHas;
  std::vector<Condition> parts;
  std::vector<OperandStep> operand;  ///< empty: the object itself
  bool count = false;                ///< `#size` behind the operand
  model::TypeId type = model::TypeId::kNone;
  Compare compare = Compare::kEqual;
  std::optional<double> number;  ///< the literal, or
  std::string text;              ///< ... text, enumerator, true, false
  bool quoted = false;
  std::size_t position = 0;  ///< in the path, from 0
};

struct QueryStep {
  enum class Kind : std::uint8_t { kRoot, kAttribute, kBelow, kIndex, kAll, kFilter };
  Kind kind = Kind::kAttribute;
  std::string name;  ///< as spelled; attributes in lower case
  model::TypeId type = model::TypeId::kNone;
  std::size_t index = 0;
  Condition condition;
  std::size_t position = 0;
};

struct Query {
  std::string text;
  std::vector<QueryStep> steps;
  bool count = false;
};

/// Fails  INS-PATH, naming the character.
[[nodiscard]] Result<Query> parse_query(std::string_view path);

/// A fault about a place of a path.
[[nodiscard]] tl::unexpected<Diagnostic> query_fault(std::string_view path, std::size_t position,
                                                     const std::string& message, std::string expected = {});

}  // namespace capstan::app
