#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/ground/geometry/vec.h"
#include "planner/model/features/shape.h"

namespace capstan::sequence {

/// One step to be ordered: one operation on one shape.
///
/// Shape   `feature` indexes the shapes given to `order`; steps of one feature are in the order of their
///         chain (`in_chain` rising).
struct Item {
  std::size_t feature = 0;
  int in_chain = 0;
  std::string name;       ///< for messages
  std::string cutter_id;  ///< steps of equal id need no tool change between them; empty: not chosen yet
  model::TypeId operation = model::TypeId::kNone;
};

/// Why one step comes before another.
enum class Cause : std::uint8_t {
  kGiven,      ///< the caller said so: a file's order, a compound's holes
  kChain,      ///< the chain of one feature: centre before drill, rough before finish
  kFaceFirst,  ///< a face is the surface in which the other begins
  kLiesIn,     ///< the second feature begins at the floor, or in the volume, of the first
  kThread,     ///< the hole before the thread in it
  kEdge,       ///< the feature before the chamfer along its edge
  kDatum,      ///< a datum feature before what refers to it
};

/// `before` must be finished when `after` begins (indices of items). A precedence of two features is between
/// the last step of the one and the first of the other.
struct Precedence {
  std::size_t before = 0, after = 0;
  Cause cause = Cause::kGiven;
  std::string text;  ///< "face 'top' is the surface in which hole 'H1' begins"
  friend bool operator==(const Precedence&, const Precedence&) = default;
};

/// One clamping: what is cut from one side.
struct SetupOrder {
  geometry::Vec3 direction;        ///< unit; tool axis, out of the material, workpiece frame
  std::vector<std::size_t> steps;  ///< items, in the order of execution
};

/// An order that keeps every precedence; or, when they contradict each other, the steps that do.
struct Order {
  std::vector<SetupOrder> setups;
  std::vector<Precedence> precedences;  ///< all that were kept, by (before, after)
  /// Found by geometry, but given the other way round (given wins); wishes that could not be kept.
  std::vector<Precedence> dropped;
  std::vector<std::size_t> cycle;  ///< outcome when there is no order: items, each before the next, the last
                                   ///< before the first; `setups` is empty then
  std::string cannot;              ///< names the steps of the cycle and their causes
  std::size_t tool_changes = 0;    ///< counted over the whole order, the first tool included
};

/// One feature wanted before another, where nothing that must hold says otherwise.
struct Wish {
  std::size_t before = 0, after = 0;  ///< shapes
  std::string text;                   ///< "datum A (face 'top') before hole 'H1': position 0.05 | A"
};

/// Constraints on the order besides shapes and items.
struct Options {
  /// Datum features before what refers to them. One that contradicts a given, a geometric or an earlier one,
  /// or for which a side would have to be visited once more, is in Order::dropped.
  std::vector<Wish> wishes;
  /// Pairs of items (before, after) that hold whatever geometry says.
  std::vector<std::pair<std::size_t, std::size_t>> given;
  /// Directions known beforehand, in the order wanted; others follow by the number of their steps.
  std::vector<geometry::Vec3> directions;
};

/// Frame z of two features agree within this (length of the difference of unit vectors).
inline constexpr double kSameDirection = 1e-6;

/// Set-ups by access direction, and an order of the steps within them.
///
/// A feature is cut from its frame's z; a through hole whose z has no set-up of its own is cut from the
/// opposite side when that is one (`Order` then lists it there: its shape is the caller's to turn round).
/// Set-ups follow the precedences between them (one that waits for no other first), then
/// `Options::directions`, then most steps first. Within a set-up the next step is one whose predecessors are
/// done: with the tool in the spindle when there is one, else the tool with which most steps can be made in
/// one go, one it will not need again first; ties by feature, then by chain.
///
/// Fails   SEQ-INDEX for an item that names no shape.
/// Cost    n log n and a sweep over the features' boxes: n^1.5 for n scattered on a square.
[[nodiscard]] Result<Order> order(const std::vector<model::FeatureShape>& shapes,
                                  const std::vector<Item>& items, const Options& options, Job& job);

}  // namespace capstan::sequence
