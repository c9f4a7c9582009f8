#include "engine/store/hdf5_file.hpp"

#include "engine/base/error.hpp"
#include "engine/store/gzip_chunk.hpp"
#include "engine/store/hdf5_driver.hpp"

#include <hdf5.h>

#include <algorithm>
#include <numeric>
#include <type_traits>
#include <utility>

namespace spheroscope::hdf5 {
namespace {

static_assert(std::is_same_v<hid_t, std::int64_t>);

/// Owns one HDF5 identifier of any kind.
class Handle {
  public:
    explicit Handle(hid_t id) : id_(id) {}
    ~Handle() {
        if (id_ > 0 && H5Iis_valid(id_) > 0) H5Idec_ref(id_);
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    operator hid_t() const { return id_; }

  private:
    hid_t id_;
};

/// HDF5 prints its errors by itself unless told otherwise, thread by thread.
void keep_quiet() {
    static thread_local const bool quiet = H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr) >= 0;
    static_cast<void>(quiet);
}

/// The innermost message on HDF5's error stack: the cause.
std::string innermost_message() {
    std::string text;
    const auto visit = [](unsigned n, const H5E_error2_t* error, void* out) -> herr_t {
        if (n == 0 && error->desc != nullptr) *static_cast<std::string*>(out) = error->desc;
        return 0;
    };
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, visit, &text);
    return text.empty() ? "no reason given" : text;
}

template <class T> hid_t memory_type();
template <> hid_t memory_type<float>() { return H5T_NATIVE_FLOAT; }
template <> hid_t memory_type<double>() { return H5T_NATIVE_DOUBLE; }
template <> hid_t memory_type<std::int32_t>() { return H5T_NATIVE_INT32; }
template <> hid_t memory_type<std::int64_t>() { return H5T_NATIVE_INT64; }
template <> hid_t memory_type<std::uint8_t>() { return H5T_NATIVE_UINT8; }

template <class T> constexpr H5T_class_t k_class =
    std::is_floating_point_v<T> ? H5T_FLOAT : H5T_INTEGER;

std::uint64_t product(const Shape& shape) {
    return std::accumulate(shape.begin(), shape.end(), std::uint64_t{1}, std::multiplies<>());
}

std::string text_of(const Shape& shape) {
    std::string text;
    for (const std::uint64_t n : shape) text += (text.empty() ? "" : " x ") + std::to_string(n);
    return "[" + text + "]";
}

Shape shape_of(hid_t dataset) {
    const Handle space(H5Dget_space(dataset));
    Shape shape(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
    static_assert(std::is_same_v<hsize_t, unsigned long long>);
    std::vector<hsize_t> extent(shape.size());
    H5Sget_simple_extent_dims(space, extent.data(), nullptr);
    std::copy(extent.begin(), extent.end(), shape.begin());
    return shape;
}

}  // namespace

File::File(const std::string& path, Mode mode)
    : path_(path), storage_(std::make_unique<AtomicFile>(path, mode)) {
    keep_quiet();
    const Handle access(check(H5Pcreate(H5P_FILE_ACCESS), "open it"));
    check(use_storage(access, *storage_) ? 0 : -1, "open it");
    if (mode == Mode::create) {
        // An index of chunks has room for 64 by default, 2 KiB in each packed array; ours have one
        // chunk.
        const Handle layout(check(H5Pcreate(H5P_FILE_CREATE), "create it"));
        check(H5Pset_istore_k(layout, 2), "create it");
        file_ = check(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, layout, access), "create it");
        return;
    }
    if (storage_->size() == 0) fail("wanted a run, got an empty file");
    const unsigned flags = mode == Mode::read ? H5F_ACC_RDONLY : H5F_ACC_RDWR;
    file_ = H5Fopen(path.c_str(), flags, access);
    if (file_ >= 0) return;
    const std::string detail = innermost_message();
    if (detail.find("file signature not found") != std::string::npos)
        fail("wanted an HDF5 file, got something else");
    if (detail.find("truncated file") != std::string::npos)
        fail("wanted a complete HDF5 file, got one that is cut off",
             "it was probably not copied to its end");
    fail("cannot read it: " + detail);
}

File::~File() {
    // The library may still write while it closes; that stays in memory and ends with storage_.
    if (file_ >= 0) H5Fclose(file_);
}

void File::fail(const std::string& message, const std::string& hint) const {
    throw Error(Loc{path_}, message, hint);
}

std::int64_t File::check(std::int64_t result, const std::string& what) const {
    if (result < 0) fail("cannot " + what + ": " + innermost_message());
    return result;
}

void File::commit() {
    keep_quiet();
    check(H5Fflush(file_, H5F_SCOPE_GLOBAL), "gather what is to be written");
    storage_->commit();
}

bool File::exists(const std::string& object) const {
    keep_quiet();
    if (object == "/") return true;
    // H5Lexists wants every group on the way to exist.
    for (std::size_t slash = object.find('/', 1);; slash = object.find('/', slash + 1)) {
        const std::string part = object.substr(0, slash);
        if (check(H5Lexists(file_, part.c_str(), H5P_DEFAULT), "look for " + part) == 0)
            return false;
        if (slash == std::string::npos) return true;
    }
}

std::vector<std::string> File::children(const std::string& group) const {
    keep_quiet();
    const Handle id(check(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), "open group " + group));
    std::vector<std::string> names;
    const auto visit = [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
        static_cast<std::vector<std::string>*>(out)->emplace_back(name);
        return 0;
    };
    check(H5Literate(id, H5_INDEX_NAME, H5_ITER_INC, nullptr, visit, &names), "list " + group);
    return names;
}

void File::create_group(const std::string& group) {
    keep_quiet();
    const Handle id(check(H5Gcreate2(file_, group.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                          "make " + group));
}

void File::remove(const std::string& object) {
    keep_quiet();
    check(H5Ldelete(file_, object.c_str(), H5P_DEFAULT), "remove " + object);
}

template <class T> void File::write_array(const std::string& object, std::span<const T> values,
                                          const Shape& shape, Packing packing) {
    keep_quiet();
    SPHEROSCOPE_ASSERT(values.size() == product(shape), object + " is not " + text_of(shape));
    const std::vector<hsize_t> extent(shape.begin(), shape.end());
    const std::string what = "write " + object;
    const Handle space(
        check(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr), what));
    const Handle how(check(H5Pcreate(H5P_DATASET_CREATE), what));
    // Times of creation would make equal runs differ.
    check(H5Pset_obj_track_times(how, false), what);
    if (packing == Packing::gzip && !values.empty()) {
        check(H5Pset_chunk(how, static_cast<int>(extent.size()), extent.data()), what);
        check(H5Pset_shuffle(how), what);
        check(H5Pset_deflate(how, 1), what);
    }
    const Handle dataset(check(
        H5Dcreate2(file_, object.c_str(), memory_type<T>(), space, H5P_DEFAULT, how, H5P_DEFAULT),
        what));
    if (values.empty()) return;
    if (packing == Packing::none) {
        check(H5Dwrite(dataset, memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
              what);
        return;
    }
    const GzipChunk chunk = pack_chunk(std::as_bytes(values), sizeof(T));
    const std::vector<hsize_t> first(extent.size(), 0);
    check(H5Dwrite_chunk(dataset, H5P_DEFAULT, chunk.filter_mask, first.data(), chunk.bytes.size(),
                         chunk.bytes.data()),
          what);
}

Shape File::shape(const std::string& object) const {
    keep_quiet();
    return shape_of(Handle(check(H5Dopen2(file_, object.c_str(), H5P_DEFAULT), "open " + object)));
}

template <class T> std::vector<T> File::read_array(const std::string& object) const {
    keep_quiet();
    const std::string what = "read " + object;
    const Handle dataset(check(H5Dopen2(file_, object.c_str(), H5P_DEFAULT), what));
    const Handle type(check(H5Dget_type(dataset), what));
    if (H5Tget_class(type) != k_class<T>)
        fail(object + " holds numbers of another kind than wanted");
    std::vector<T> values(product(shape_of(dataset)));
    if (!values.empty())
        check(H5Dread(dataset, memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
              what);
    return values;
}

template <class T>
std::vector<T> File::read_array(const std::string& object, const Shape& wanted) const {
    const Shape got = shape(object);
    if (got != wanted)
        fail("wanted " + object + " with " + text_of(wanted) + " numbers, got " + text_of(got));
    return read_array<T>(object);
}

template void File::write_array(const std::string&, std::span<const float>, const Shape&, Packing);
template std::vector<float> File::read_array(const std::string&) const;
template std::vector<float> File::read_array(const std::string&, const Shape&) const;
template void File::write_array(const std::string&, std::span<const double>, const Shape&, Packing);
template std::vector<double> File::read_array(const std::string&) const;
template std::vector<double> File::read_array(const std::string&, const Shape&) const;
template void File::write_array(const std::string&, std::span<const std::int32_t>, const Shape&,
                                Packing);
template std::vector<std::int32_t> File::read_array(const std::string&) const;
template std::vector<std::int32_t> File::read_array(const std::string&, const Shape&) const;
template void File::write_array(const std::string&, std::span<const std::int64_t>, const Shape&,
                                Packing);
template std::vector<std::int64_t> File::read_array(const std::string&) const;
template std::vector<std::int64_t> File::read_array(const std::string&, const Shape&) const;
template void File::write_array(const std::string&, std::span<const std::uint8_t>, const Shape&,
                                Packing);
template std::vector<std::uint8_t> File::read_array(const std::string&) const;
template std::vector<std::uint8_t> File::read_array(const std::string&, const Shape&) const;

void File::create_column(const std::string& object) {
    keep_quiet();
    const std::string what = "make column " + object;
    const hsize_t none = 0, no_end = H5S_UNLIMITED, chunk = 256;
    const Handle space(check(H5Screate_simple(1, &none, &no_end), what));
    const Handle how(check(H5Pcreate(H5P_DATASET_CREATE), what));
    check(H5Pset_obj_track_times(how, false), what);
    check(H5Pset_chunk(how, 1, &chunk), what);
    const Handle dataset(check(
        H5Dcreate2(file_, object.c_str(), H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, how, H5P_DEFAULT),
        what));
}

void File::append_to_column(const std::string& object, double value) {
    keep_quiet();
    const std::string what = "extend column " + object;
    const Handle dataset(check(H5Dopen2(file_, object.c_str(), H5P_DEFAULT), what));
    const hsize_t end = shape_of(dataset).at(0), longer = end + 1, one = 1;
    check(H5Dset_extent(dataset, &longer), what);
    const Handle place(check(H5Dget_space(dataset), what));
    check(H5Sselect_hyperslab(place, H5S_SELECT_SET, &end, nullptr, &one, nullptr), what);
    const Handle single(check(H5Screate_simple(1, &one, nullptr), what));
    check(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, single, place, H5P_DEFAULT, &value), what);
}

void File::truncate_column(const std::string& object, std::uint64_t n_values) {
    keep_quiet();
    const std::string what = "shorten column " + object;
    const Handle dataset(check(H5Dopen2(file_, object.c_str(), H5P_DEFAULT), what));
    const hsize_t length = n_values;
    check(H5Dset_extent(dataset, &length), what);
}

namespace {

/// The caller closes it.
hid_t make_text_type(std::size_t length) {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, std::max<std::size_t>(length, 1));
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    H5Tset_cset(type, H5T_CSET_UTF8);
    return type;
}

}  // namespace

void File::write_text(const std::string& object, const std::string& text) {
    keep_quiet();
    const std::string what = "write " + object;
    const Handle type(make_text_type(text.size()));
    const Handle space(check(H5Screate(H5S_SCALAR), what));
    const Handle how(check(H5Pcreate(H5P_DATASET_CREATE), what));
    check(H5Pset_obj_track_times(how, false), what);
    const Handle dataset(
        check(H5Dcreate2(file_, object.c_str(), type, space, H5P_DEFAULT, how, H5P_DEFAULT), what));
    check(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()), what);
}

std::string File::read_text(const std::string& object) const {
    keep_quiet();
    const std::string what = "read " + object;
    const Handle dataset(check(H5Dopen2(file_, object.c_str(), H5P_DEFAULT), what));
    const Handle type(check(H5Dget_type(dataset), what));
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 ||
        !shape_of(dataset).empty())
        fail(object + " is not a text of ours");
    std::string text(H5Tget_size(type), '\0');
    check(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()), what);
    text.resize(text.find_last_not_of('\0') + 1);
    return text;
}

void File::put_attribute(const std::string& object, const std::string& name, std::int64_t type,
                         const void* value) {
    keep_quiet();
    const std::string what = "write attribute " + name + " of " + object;
    const Handle owner(check(H5Oopen(file_, object.c_str(), H5P_DEFAULT), what));
    if (check(H5Aexists(owner, name.c_str()), what) > 0)
        check(H5Adelete(owner, name.c_str()), what);
    const Handle space(check(H5Screate(H5S_SCALAR), what));
    const Handle attribute(
        check(H5Acreate2(owner, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), what));
    check(H5Awrite(attribute, type, value), what);
}

void File::get_attribute(const std::string& object, const std::string& name, int type_class,
                         std::int64_t type, void* value) const {
    keep_quiet();
    const std::string what = "read attribute " + name + " of " + object;
    const Handle attribute(check(
        H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), what));
    const Handle stored(check(H5Aget_type(attribute), what));
    const Handle space(check(H5Aget_space(attribute), what));
    if (H5Tget_class(stored) != type_class || H5Sget_simple_extent_npoints(space) != 1)
        fail("attribute " + name + " of " + object + " is of another kind than wanted");
    check(H5Aread(attribute, type, value), what);
}

void File::write_attribute(const std::string& object, const std::string& name, double value) {
    put_attribute(object, name, H5T_NATIVE_DOUBLE, &value);
}

void File::write_attribute(const std::string& object, const std::string& name, std::int64_t value) {
    put_attribute(object, name, H5T_NATIVE_INT64, &value);
}

void File::write_attribute(const std::string& object, const std::string& name,
                           std::uint64_t value) {
    put_attribute(object, name, H5T_NATIVE_UINT64, &value);
}

void File::write_attribute(const std::string& object, const std::string& name,
                           const std::string& text) {
    keep_quiet();
    const Handle type(make_text_type(text.size()));
    put_attribute(object, name, type, text.c_str());
}

bool File::has_attribute(const std::string& object, const std::string& name) const {
    keep_quiet();
    return check(H5Aexists_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT),
                 "look for attribute " + name + " of " + object) > 0;
}

double File::double_attribute(const std::string& object, const std::string& name) const {
    double value = 0.0;
    get_attribute(object, name, H5T_FLOAT, H5T_NATIVE_DOUBLE, &value);
    return value;
}

std::int64_t File::int_attribute(const std::string& object, const std::string& name) const {
    std::int64_t value = 0;
    get_attribute(object, name, H5T_INTEGER, H5T_NATIVE_INT64, &value);
    return value;
}

std::uint64_t File::unsigned_attribute(const std::string& object, const std::string& name) const {
    std::uint64_t value = 0;
    get_attribute(object, name, H5T_INTEGER, H5T_NATIVE_UINT64, &value);
    return value;
}

std::string File::text_attribute(const std::string& object, const std::string& name) const {
    keep_quiet();
    const std::string what = "read attribute " + name + " of " + object;
    const Handle attribute(check(
        H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), what));
    const Handle type(check(H5Aget_type(attribute), what));
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0)
        fail("attribute " + name + " of " + object + " is not a text of ours");
    std::string text(H5Tget_size(type), '\0');
    check(H5Aread(attribute, type, text.data()), what);
    text.resize(text.find_last_not_of('\0') + 1);
    return text;
}

}  // namespace spheroscope::hdf5
