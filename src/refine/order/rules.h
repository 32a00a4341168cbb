// Rules for which child an any-hit ray had better visit first. Each sets orders of a binary tree; see order_stage().
#pragma once
#include <cstdint>
#include <vector>

#include "boxwood/vec3.h"
#include "build/build_input.h"
#include "tree/tree.h"

namespace boxwood {

/// What to do with the children of an inner node.
enum class ChildOrderChoice : std::uint8_t { as_it_is, as_stored, swapped };

/// One per node; leaves stay as they are.
using Orders = std::vector<ChildOrderChoice>;

/// By the cost of an any-hit ray by surface areas. Ize and Hansen 2011, "RTSAH Traversal Order for Occlusion Rays"; SAH
/// alternatives study, section 2.11, equation 18 with its index mended. `lines` uniform lines through each node measure
/// how many meet both children; 0: as if the children filled the node. O(nodes * lines).
Orders order_by_rtsah(const Tree& tree, double traversal_cost, std::uint32_t lines);

/// The child whose triangles are larger, on average or the largest of each. Nah and Manocha 2014, "SATO: Surface Area
/// Traversal Order for Shadow Ray Tracing". O(references).
enum class AreaOf { mean, largest };
Orders order_by_sato(const Tree& tree, const Geometry& geometry, AreaOf area);

/// By representative rays: what blocks them, and what they need not visit for it. Feltman, Lee, Fatahalian 2012, "SRDH:
/// Specializing BVH Construction and Traversal Order Using Representative Shadow Ray Sets"; SAH alternatives study,
/// section 2.13. Of any-hit rays, or of all when there are none. `as_it_is` where going from near to far is best, or
/// where no ray comes. O(rays * nodes met).
Orders order_by_srdh(const Tree& tree, const Geometry& geometry, const KnownUse& use);

}  // namespace boxwood
