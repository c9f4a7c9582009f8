#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>

namespace spheroscope {

/// A file whose changes appear all at once or not at all, whatever kills the program in between.
///
/// Why: to add one frame, the HDF5 library changes a dozen places of a file (name heap, B-trees,
/// sizes, superblock), and a file that has half of these changes cannot be read, not even its old
/// frames. So what the library writes stays in memory until commit(), which proceeds as follows.
///
///     1  new pages behind the old end     -> the file      nothing refers to them yet
///     2  changed pages before the old end -> FILE.journal  with a checksum: valid or ignored
///     3  the same pages                   -> the file
///     4  the journal is removed
///
/// Killed in 1 or 2: the file is as before. Killed in 3 or 4: whoever opens the file next takes
/// these pages from the journal (a reader without changing anything, a writer for good). A full
/// disk shows in 1 or 2; then the file is cut back to its old end.
///
/// The data survive the end of the program, not a power cut: nothing here waits for the disk
/// (see sync_to_disk).
class AtomicFile {
  public:
    enum class Mode {
        create,  ///< a new file; it gets its name, replacing an old file, at the first commit()
        append,  ///< an existing file, to be changed
        read,    ///< an existing file; a writer's next commit waits until this object is gone
    };

    /// Throws Error for a missing file, a directory, no permission, or a file that another program
    /// writes.
    AtomicFile(std::string path, Mode mode);
    /// What was not committed is lost; a new file without any commit is removed.
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// Bytes, what is not committed included.
    [[nodiscard]] std::uint64_t size() const { return size_; }
    void set_size(std::uint64_t size) { size_ = size; }

    /// Fills `out`; bytes behind the end are 0. Returns false on a read error of the system
    /// (errno).
    [[nodiscard]] bool read(std::uint64_t address, std::span<std::byte> out) const;
    void write(std::uint64_t address, std::span<const std::byte> bytes);

    /// Throws Error (disk full, ...): then the file is as after the commit before, and this object
    /// must not be used any more except to destroy it. Precondition: not opened for reading.
    void commit();

    /// The journal of a file: "run.h5.journal".
    [[nodiscard]] static std::string journal_path(const std::string& path);

  private:
    static constexpr std::size_t k_page_bytes = 4096;
    using Page = std::array<std::byte, k_page_bytes>;

    void open_existing();
    void open_new();
    void lock_as_writer(int descriptor) const;
    void take_over_journal();
    enum class Part { old_pages, new_pages };  ///< before the end at the last commit, behind it
    [[nodiscard]] bool write_pages(Part part) const;
    void write_new_pages() const;
    [[nodiscard]] bool write_journal() const;
    void apply_old_pages() const;
    [[nodiscard]] Page first_page() const;
    [[noreturn]] void fail(const std::string& wanted, int error) const;

    std::string path_;
    std::string working_path_;  // differs from path_ until the first commit of a new file
    Mode mode_;
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
    std::uint64_t committed_size_ = 0;
    std::map<std::uint64_t, Page> pages_;  // changed since the last commit, by page number
};

/// Waits until the file's contents, or a folder's names, are on the disk. Throws Error.
void sync_to_disk(const std::string& path);

}  // namespace spheroscope
