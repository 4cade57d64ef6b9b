#pragma once

#include "tests/removal/planned.h"

namespace capstan::testing::removal {

// The parts that are planned and simulated, by what is on them.
[[nodiscard]] Part island_pocket();
[[nodiscard]] Part boss_beside_pocket();
[[nodiscard]] Part bosses_in_a_pattern();
[[nodiscard]] Part boss_in_a_compound();
[[nodiscard]] Part leaning_boss();
[[nodiscard]] Part boss_without_height();
[[nodiscard]] Part boss_beside_what_lists_it();
[[nodiscard]] Part boss_without_contour(bool listed);
[[nodiscard]] Part open_pocket();
[[nodiscard]] Part plain_slots();
[[nodiscard]] Part undercut_slots();
[[nodiscard]] Part short_step();
[[nodiscard]] Part wide_step();
/// The face stops at walls as high as it is deep on one, two or three of its sides.
[[nodiscard]] Part face_beside_walls(int walls, double height);
[[nodiscard]] Part face_with_boss_beside_wall();
[[nodiscard]] Part face_at_the_edge_and_narrow_face();
[[nodiscard]] Part deeper_face_over_a_shallow_one();
[[nodiscard]] Part single_holes();
[[nodiscard]] Part compound_holes();
[[nodiscard]] Part threaded_hole();
[[nodiscard]] Part hole_patterns();
[[nodiscard]] Part outside_contour();
[[nodiscard]] Part arcs_across_zero(bool clockwise);
[[nodiscard]] Part chamfered_edges();
[[nodiscard]] Part holes_near_walls();
[[nodiscard]] Part turned_over();
[[nodiscard]] Part tight_holes();
[[nodiscard]] Part small_countersink();
[[nodiscard]] Part fine_holes();
[[nodiscard]] Part hole_over_an_edge();
[[nodiscard]] Part pocket_over_an_edge();
[[nodiscard]] Part lone_boss(bool round);
[[nodiscard]] Part boss_at_the_end_of_a_long_block();
[[nodiscard]] Part pocket_in_a_pocket();
[[nodiscard]] Part flat_ended_slot();
[[nodiscard]] Part unequal_flat_ends();
/// Inside corners that no mill makes; `stays`: the radius that they keep.
[[nodiscard]] Part pocket_with_rest_in_its_corners(double stays);
[[nodiscard]] Part square_ended_slot(double stays);
[[nodiscard]] Part pattern_that_meets_itself();
[[nodiscard]] Part hole_into_a_cross_bore();

// Closed meshes in a larger block.
[[nodiscard]] Part mesh_box();
[[nodiscard]] Part mesh_step();
[[nodiscard]] Part mesh_pocket();

// Parts that once took minutes of planning.
[[nodiscard]] Part tight_flat_hole();
[[nodiscard]] Part overlapping_flat_holes();
[[nodiscard]] Part pocket_deeper_than_its_piece();
[[nodiscard]] Part tilted_slot();
[[nodiscard]] Part hole_over_the_side();
[[nodiscard]] Part open_pocket_beside_boss();

/// The target of ISO 14649-11's example 2, of a raw piece.
[[nodiscard]] Target example2(const Box& raw);

}  // namespace capstan::testing::removal
