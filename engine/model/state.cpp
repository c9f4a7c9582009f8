#include "engine/model/state.hpp"

#include <bit>

namespace spheroscope {
namespace {

class Fnv1a {
  public:
    void add(std::uint64_t word) {
        for (int byte = 0; byte < 8; ++byte) {
            hash_ = (hash_ ^ ((word >> (8 * byte)) & 0xffU)) * 0x100000001b3ULL;
        }
    }
    void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
    void add(const std::vector<Vec3>& vectors) {
        for (const Vec3& v : vectors)
            for (const double component : {v.x(), v.y(), v.z()}) add(component);
    }
    [[nodiscard]] std::uint64_t value() const { return hash_; }

  private:
    std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

}  // namespace

std::uint64_t State::hash() const {
    Fnv1a fnv;
    fnv.add(time_s);
    fnv.add(x_um);
    for (const double integral : volume_integral_s) fnv.add(integral);
    for (const double value : {wall.radius_um, wall.speed_um_per_s, wall.time_s}) fnv.add(value);
    // the hull does not move, so its planes are not part of what must agree
    const Probe& probe = load.probe;
    if (probe.acts())
        for (const double value : {probe.way_um, probe.speed_um_per_s}) fnv.add(value);
    fnv.add(v_um_per_s);
    fnv.add(std::uint64_t{has_velocity ? 1U : 0U});
    for (const double value : {next_dt_s, fastest_rate_per_s, rate_time_s}) fnv.add(value);
    return fnv.value();
}

}  // namespace spheroscope
