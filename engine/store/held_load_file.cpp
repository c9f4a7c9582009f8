#include "engine/store/held_load_file.hpp"

#include "engine/store/hdf5_file.hpp"

namespace spheroscope {
namespace {

constexpr const char* k_group = "/held";
constexpr const char* k_force = "/held/force";
constexpr const char* k_integral = "/held/volume_integral";

}  // namespace

void write_held_load(const std::string& path, const HeldLoad& load) {
    hdf5::File file(path, hdf5::File::Mode::append);
    file.create_group(k_group);
    std::vector<double> force;
    for (const Vec3& f : load.force_nN) force.insert(force.end(), {f.x(), f.y(), f.z()});
    file.write_array<double>(k_force, force, {load.force_nN.size(), 3}, hdf5::Packing::gzip);
    file.write_attribute(k_force, "unit", "nN");
    file.write_array<double>(k_integral, load.volume_integral_s, {load.volume_integral_s.size()});
    file.write_attribute(k_integral, "unit", "s");
    file.commit();
}

std::optional<HeldLoad> read_held_load(const std::string& path) {
    const hdf5::File file(path, hdf5::File::Mode::read);
    if (!file.exists(k_group)) return {};
    const hdf5::Shape shape = file.shape(k_force);
    if (shape.size() != 2 || shape[1] != 3)
        file.fail(std::string(k_force) + " wants rows of three numbers");
    const auto force = file.read_array<double>(k_force);
    HeldLoad load;
    for (std::size_t i = 0; i < force.size(); i += 3)
        load.force_nN.emplace_back(force[i], force[i + 1], force[i + 2]);
    load.volume_integral_s = file.read_array<double>(k_integral);
    return load;
}

}  // namespace spheroscope
