#pragma once

#include <map>
#include <string>

#include "planner/model/plan/cutter/cutter.h"
#include "tooling/shop/data/tree.h"

/// Cutting speed by the grade of an edge: cobalt in high-speed steel, a coating. The cards of materials have
/// the speeds of bare edges of plain HSS and of carbide.
namespace capstan::tooling {

/// Speed of an edge relative to a bare one of its substrate, by ISO 513 group.
struct Edge {
  std::map<std::string, double> over_bare = {};
  std::string source = {};
};
using Edges = std::map<std::string, Edge>;

/// The entry `edges` of a file of cutter series; faults go where `top` puts them.
[[nodiscard]] Edges read_edges(const Node& node, Fields top);

/// Those of the shipped cutters.yaml; none where it cannot be read (`generic_library` says why).
[[nodiscard]] const Edges& shipped_edges();

/// What is stated of a cutter's edge beside its substrate.
struct Grade {
  bool cobalt = false;  ///< HSS-E, HSS-Co, M35, M42
  bool coated = false;
  bool inserts = false;
  std::string said;  ///< the words that say so; empty: nothing is stated
};

/// By the words of its description and of what states its substrate: "HSS-E TiAlN", "carbide, coated". What a
/// source calls assumed states nothing. An edge is bare, and HSS plain, unless it is said.
[[nodiscard]] Grade grade_of(const model::Cutter& c);

/// Name in `edges` of a grade of this cutter; empty: its edge is as the cards' are. Of coated reamers, taps
/// and cones no table was found: as bare.
[[nodiscard]] std::string edge_of(const Grade& g, const model::Cutter& c);

}  // namespace capstan::tooling
