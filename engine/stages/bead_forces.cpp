#include "engine/stages/bead_forces.hpp"

#include "engine/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace spheroscope {
namespace {

// Skin over the mean radius. A wider one makes fewer lists but longer ones; from 0.15 to 0.5 the
// run time of a packing changes by less than a quarter.
constexpr double k_skin_over_mean_radius = 0.3;

double mean(std::span<const double> values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

}  // namespace

BeadForces::BeadForces(std::vector<double> radius, const BeadBox& box, double centring)
    : radius_(std::move(radius)), box_(box), centring_(centring),
      skin_(k_skin_over_mean_radius * mean(radius_)) {
    SPHEROSCOPE_ASSERT(!radius_.empty(), "no beads");
    [[maybe_unused]] const double largest = *std::max_element(radius_.begin(), radius_.end());
    SPHEROSCOPE_ASSERT(box_.boundary == BeadBoundary::sphere
                           ? largest <= box_.size
                           : 2.0 * (2.0 * largest + skin_) < box_.size,
                       "the largest bead is too large for the box");
}

Vec3 BeadForces::nearest_image(const Vec3& difference) const {
    if (box_.boundary == BeadBoundary::sphere) return Vec3::Zero();
    return {box_.size * std::round(difference.x() / box_.size),
            box_.size * std::round(difference.y() / box_.size),
            box_.size * std::round(difference.z() / box_.size)};
}

bool BeadForces::list_is_stale(std::span<const Vec3> x) const {
    if (x_of_list_.size() != x.size()) return true;
    // Two beads that each moved less than half a skin came closer by less than a skin.
    const double limit = 0.25 * skin_ * skin_;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if ((x[i] - x_of_list_[i]).squaredNorm() >= limit) return true;
    }
    return false;
}

void BeadForces::make_list(std::span<const Vec3> x) {
    list_.clear();
    for (std::size_t i = 0; i < x.size(); ++i) {
        for (std::size_t j = i + 1; j < x.size(); ++j) {
            const Vec3 difference = x[i] - x[j];
            const Vec3 image = nearest_image(difference);
            const double reach = radius_[i] + radius_[j];
            const double limit = reach + skin_;
            if ((difference - image).squaredNorm() < limit * limit) {
                list_.push_back({static_cast<int>(i), static_cast<int>(j), reach, image});
            }
        }
    }
    x_of_list_.assign(x.begin(), x.end());
    ++n_lists_;
}

void BeadForces::compute(std::span<const Vec3> x, std::span<Vec3> force) {
    SPHEROSCOPE_ASSERT(x.size() == radius_.size() && force.size() == radius_.size(),
                       "one position and one force per bead");
    if (list_is_stale(x)) make_list(x);
    std::fill(force.begin(), force.end(), Vec3::Zero());
    for (const Neighbours& pair : list_) {
        const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j);
        const Vec3 d = x[i] - x[j] - pair.image;
        const double squared = d.squaredNorm();
        if (squared >= pair.reach * pair.reach) continue;
        const double distance = std::sqrt(squared);
        SPHEROSCOPE_ASSERT(distance > 0.0, "two beads have the same centre");
        const Vec3 f = (pair.reach / distance - 1.0) * d;
        force[i] += f;
        force[j] -= f;
    }
    if (box_.boundary == BeadBoundary::periodic) return;
    for (std::size_t i = 0; i < x.size(); ++i) {
        force[i] -= centring_ * x[i];
        const double distance = x[i].norm();
        const double overlap = distance + radius_[i] - box_.size;
        // A bead as wide as the sphere may sit exactly at the centre: nothing to push then.
        if (overlap > 0.0 && distance > 0.0) force[i] -= (overlap / distance) * x[i];
    }
}

std::vector<BeadContact> BeadForces::contacts(std::span<const Vec3> x) const {
    std::vector<BeadContact> found;
    for (std::size_t i = 0; i < x.size(); ++i) {
        for (std::size_t j = i + 1; j < x.size(); ++j) {
            const Vec3 difference = x[i] - x[j];
            const double overlap =
                radius_[i] + radius_[j] - (difference - nearest_image(difference)).norm();
            if (overlap > 0.0) found.push_back({static_cast<int>(i), static_cast<int>(j), overlap});
        }
    }
    return found;
}

double largest_norm(std::span<const Vec3> vectors) {
    double largest = 0.0;
    for (const Vec3& v : vectors) largest = std::max(largest, v.squaredNorm());
    return std::sqrt(largest);
}

}  // namespace spheroscope
