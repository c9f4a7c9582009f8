#include "engine/store/hdf5_driver.hpp"

#include "engine/store/atomic_file.hpp"

#include <hdf5.h>

#include <exception>
#include <limits>
#include <memory>
#include <new>
#include <type_traits>

// HDF5's 'virtual file driver': a table of functions with C linkage in spirit, so no exception
// leaves them. H5FD_t must come first in our file: the library knows only that part.
namespace spheroscope::hdf5 {
namespace {

struct DriverFile {
    H5FD_t base;
    AtomicFile* storage;
    haddr_t end_of_allocation;
};
static_assert(std::is_standard_layout_v<DriverFile>);

/// What the property list carries; HDF5 copies it byte by byte.
struct DriverInfo {
    AtomicFile* storage;
};

DriverFile* ours(H5FD_t* file) { return reinterpret_cast<DriverFile*>(file); }
const DriverFile* ours(const H5FD_t* file) { return reinterpret_cast<const DriverFile*>(file); }

H5FD_t* open_file(const char*, unsigned, hid_t access_properties, haddr_t) {
    const auto* info = static_cast<const DriverInfo*>(H5Pget_driver_info(access_properties));
    if (info == nullptr) return nullptr;
    auto* file = new (std::nothrow) DriverFile{{}, info->storage, 0};  // close_file() frees it
    return file == nullptr ? nullptr : &file->base;
}

herr_t close_file(H5FD_t* file) {
    const std::unique_ptr<DriverFile> owner(ours(file));
    return 0;
}

herr_t query(const H5FD_t*, unsigned long* flags) {
    // Small pieces are gathered, so that a frame's changes lie on few pages.
    *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_AGGREGATE_SMALLDATA |
             H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
    return 0;
}

haddr_t end_of_allocation(const H5FD_t* file, H5FD_mem_t) { return ours(file)->end_of_allocation; }

herr_t set_end_of_allocation(H5FD_t* file, H5FD_mem_t, haddr_t address) {
    ours(file)->end_of_allocation = address;
    return 0;
}

haddr_t end_of_file(const H5FD_t* file, H5FD_mem_t) { return ours(file)->storage->size(); }

herr_t read(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, size_t size, void* out) {
    return ours(file)->storage->read(address, {static_cast<std::byte*>(out), size}) ? 0 : -1;
}

herr_t write(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, size_t size, const void* in) {
    try {
        ours(file)->storage->write(address, {static_cast<const std::byte*>(in), size});
    } catch (const std::exception&) {
        return -1;  // HDF5 reports 'file write failed' with the object
    }
    return 0;
}

herr_t truncate(H5FD_t* file, hid_t, hbool_t) {
    ours(file)->storage->set_size(ours(file)->end_of_allocation);
    return 0;
}

H5FD_class_t make_driver() {
    H5FD_class_t driver{};
    driver.name = "spheroscope";
    driver.maxaddr = static_cast<haddr_t>(std::numeric_limits<std::int64_t>::max() / 4);
    driver.fc_degree = H5F_CLOSE_STRONG;
    driver.fapl_size = sizeof(DriverInfo);
    driver.open = open_file;
    driver.close = close_file;
    driver.query = query;
    driver.get_eoa = end_of_allocation;
    driver.set_eoa = set_end_of_allocation;
    driver.get_eof = end_of_file;
    driver.read = read;
    driver.write = write;
    driver.truncate = truncate;
    // Metadata and numbers apart, as in HDF5's own drivers.
    const H5FD_mem_t free_lists[] = H5FD_FLMAP_DICHOTOMY;
    for (int kind = 0; kind < H5FD_MEM_NTYPES; ++kind) driver.fl_map[kind] = free_lists[kind];
    return driver;
}

}  // namespace

bool use_storage(std::int64_t access_properties, AtomicFile& storage) {
    static const H5FD_class_t driver = make_driver();
    static const hid_t registered = H5FDregister(&driver);
    const DriverInfo info{&storage};
    return registered >= 0 && H5Pset_driver(access_properties, registered, &info) >= 0;
}

}  // namespace spheroscope::hdf5
