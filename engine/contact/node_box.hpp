#pragma once

#include "engine/base/vec3.hpp"

#include <span>

namespace spheroscope {

/// The box along the axes around some nodes. Precondition: at least one node.
struct NodeBox {
    Vec3 low = Vec3::Zero(), high = Vec3::Zero();
    NodeBox() = default;
    explicit NodeBox(std::span<const Vec3> nodes) : low(nodes[0]), high(nodes[0]) {
        for (const Vec3& node : nodes) {
            low = low.cwiseMin(node);
            high = high.cwiseMax(node);
        }
    }
    /// Whether a point is in the box made larger by `distance` on every side; negative: smaller.
    [[nodiscard]] bool is_within(const Vec3& point, double distance) const {
        return ((low - point).array() <= distance).all() &&
               ((point - high).array() <= distance).all();
    }
    /// Whether a point of this box can be within `distance` of one of the other.
    [[nodiscard]] bool is_near(const NodeBox& other, double distance) const {
        return ((low - other.high).array() <= distance).all() &&
               ((other.low - high).array() <= distance).all();
    }
};

}  // namespace spheroscope
