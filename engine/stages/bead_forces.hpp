#pragma once

#include "engine/base/vec3.hpp"

#include <span>
#include <vector>

namespace spheroscope {

/// What holds the beads together: a sphere about the origin with a wall that pushes back, or a cube
/// that repeats in all directions (no wall; the standard check of a packing code).
enum class BeadBoundary { sphere, periodic };

struct BeadBox {
    BeadBoundary boundary = BeadBoundary::sphere;
    double size = 0.0;  ///< radius of the sphere, or edge of the cube
};

/// Two beads that overlap, i < j.
struct BeadContact {
    int i, j;
    double overlap;  ///< r_i + r_j - distance, > 0
};

/// Forces of soft frictionless beads, divided by their common stiffness, so that they are lengths:
///   pair     (r_i + r_j - d)  along the line of centres, while > 0
///   wall     (|x| + r - R)    towards the centre, while > 0 (sphere only)
///   centring  c x             towards the centre (c = stiffness of centring / stiffness of beads)
///
/// Pairs come from a list of all pairs closer than contact plus a skin. It is renewed when some
/// bead has moved half a skin. Pairs in it ascend by (i, j) and a pair that does not overlap adds
/// nothing, so the bits of a force do not depend on when the list was made, and the list is not
/// part of any saved state. The list is made by looking at all pairs: it is made once in some tens
/// of steps while the noise is strong and hardly ever later, so a grid would not be felt.
class BeadForces {
  public:
    /// radius [n beads], > 0, in the unit of box.size. Preconditions: every radius fits the sphere;
    /// a cube is so wide that two beads meet in one image only.
    BeadForces(std::vector<double> radius, const BeadBox& box, double centring = 0.0);

    /// Writes force / stiffness on each bead. x, force [n]. x need not be wrapped into the cube.
    void compute(std::span<const Vec3> x, std::span<Vec3> force);

    /// The pairs that overlap, ascending by (i, j). Looks at all pairs.
    [[nodiscard]] std::vector<BeadContact> contacts(std::span<const Vec3> x) const;

    [[nodiscard]] std::span<const double> radius() const { return radius_; }
    [[nodiscard]] const BeadBox& box() const { return box_; }
    /// How often the list was made.
    [[nodiscard]] int n_lists() const { return n_lists_; }

  private:
    struct Neighbours {
        int i, j;
        double reach;  // r_i + r_j
        Vec3 image;    // to subtract from x_i - x_j, a multiple of the cube's edge
    };
    /// Multiple of the cube's edge that brings `difference` closest to zero; zero in a sphere.
    [[nodiscard]] Vec3 nearest_image(const Vec3& difference) const;
    [[nodiscard]] bool list_is_stale(std::span<const Vec3> x) const;
    void make_list(std::span<const Vec3> x);

    std::vector<double> radius_;
    BeadBox box_;
    double centring_;
    double skin_;
    std::vector<Neighbours> list_;
    std::vector<Vec3> x_of_list_;
    int n_lists_ = 0;
};

/// Largest of the lengths of `vectors`.
[[nodiscard]] double largest_norm(std::span<const Vec3> vectors);

}  // namespace spheroscope
