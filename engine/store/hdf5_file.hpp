#pragma once

#include "engine/store/atomic_file.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

// HDF5 as the store needs it: arrays, columns and attributes by their path inside the file. The
// library's own handles stay in hdf5_file.cpp.
namespace spheroscope::hdf5 {

using Shape = std::vector<std::uint64_t>;

enum class Packing { none, gzip };  ///< gzip: byte shuffle, then gzip level 1; one chunk

/// An HDF5 file on an AtomicFile. All functions throw Error that names the file and the object; the
/// library's innermost message is part of the text. A file belongs to one thread.
///
/// Element types T: float, double, int32, int64, uint8.
class File {
  public:
    using Mode = AtomicFile::Mode;
    File(const std::string& path, Mode mode);
    ~File();
    File(const File&) = delete;
    File& operator=(const File&) = delete;

    [[nodiscard]] const std::string& path() const { return path_; }
    /// Everything since the last commit appears in the file, or (Error) nothing of it.
    void commit();

    [[nodiscard]] bool exists(const std::string& object) const;
    /// Names in a group, sorted.
    [[nodiscard]] std::vector<std::string> children(const std::string& group) const;
    void create_group(const std::string& group);
    void remove(const std::string& object);

    template <class T> void write_array(const std::string& object, std::span<const T> values,
                                        const Shape& shape, Packing packing = Packing::none);
    [[nodiscard]] Shape shape(const std::string& object) const;
    /// The stored type must be of the same class (integer, floating point).
    template <class T> [[nodiscard]] std::vector<T> read_array(const std::string& object) const;
    /// The same, and the array must have this shape.
    template <class T>
    [[nodiscard]] std::vector<T> read_array(const std::string& object, const Shape& wanted) const;

    /// A column: float64, one number per frame, grows at its end.
    void create_column(const std::string& object);
    void append_to_column(const std::string& object, double value);
    void truncate_column(const std::string& object, std::uint64_t n_values);

    void write_text(const std::string& object, const std::string& text);
    [[nodiscard]] std::string read_text(const std::string& object) const;

    // Attributes; writing replaces.
    void write_attribute(const std::string& object, const std::string& name, double value);
    void write_attribute(const std::string& object, const std::string& name, std::int64_t value);
    void write_attribute(const std::string& object, const std::string& name, std::uint64_t value);
    void write_attribute(const std::string& object, const std::string& name,
                         const std::string& text);
    [[nodiscard]] bool has_attribute(const std::string& object, const std::string& name) const;
    [[nodiscard]] double double_attribute(const std::string& object, const std::string& name) const;
    [[nodiscard]] std::int64_t int_attribute(const std::string& object,
                                             const std::string& name) const;
    [[nodiscard]] std::uint64_t unsigned_attribute(const std::string& object,
                                                   const std::string& name) const;
    [[nodiscard]] std::string text_attribute(const std::string& object,
                                             const std::string& name) const;

    /// An Error about this file: "wanted ..., got ...".
    [[noreturn]] void fail(const std::string& message, const std::string& hint = "") const;

  private:
    std::int64_t check(std::int64_t result, const std::string& what) const;
    void put_attribute(const std::string& object, const std::string& name, std::int64_t type,
                       const void* value);
    void get_attribute(const std::string& object, const std::string& name, int type_class,
                       std::int64_t type, void* value) const;

    std::string path_;
    std::unique_ptr<AtomicFile> storage_;
    std::int64_t file_ = -1;
};

}  // namespace spheroscope::hdf5
