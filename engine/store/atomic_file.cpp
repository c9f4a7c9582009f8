#include "engine/store/atomic_file.hpp"

#include "engine/base/descriptor.hpp"
#include "engine/base/error.hpp"
#include "engine/base/fnv1a.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <optional>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

namespace spheroscope {
namespace {

/// The journal begins with this; then `n_pages` page numbers, then the pages.
struct JournalHead {
    std::array<char, 8> magic;
    std::uint64_t n_pages;
    std::uint64_t size;  // of the file after the commit
    // The journal belongs to a file only if each byte of the file's first page is one of these two:
    // a writer killed while it brings that page leaves a part of each.
    std::array<std::byte, 4096> first_page_before;
    std::array<std::byte, 4096> first_page_after;
    std::uint64_t checksum;  // of all the rest, this being 0
};
constexpr std::array<char, 8> k_journal_magic{'s', 'p', 'h', 'j', 'r', 'n', 'l', '2'};

bool belongs_to(const JournalHead& head, std::span<const std::byte> first_page) {
    for (std::size_t i = 0; i < first_page.size(); ++i)
        if (first_page[i] != head.first_page_before[i] && first_page[i] != head.first_page_after[i])
            return false;
    return true;
}

/// Places far behind any data that stand for the two locks. Open-file-description locks end with
/// their descriptor, so a killed program leaves none behind.
constexpr off_t k_writer_lock = off_t{1} << 62;
constexpr off_t k_commit_lock = k_writer_lock + 1;

enum class Wait { no, yes };

/// False only if somebody else holds the lock. On file systems without locks (ENOLCK, ENOSYS, ...)
/// all programs get it: that costs only the protection against two programs on one file.
bool lock_byte(int descriptor, off_t place, short type, Wait wait) {
    struct flock request {};
    request.l_type = type;
    request.l_whence = SEEK_SET;
    request.l_start = place;
    request.l_len = 1;
    const int command = wait == Wait::yes ? F_OFD_SETLKW : F_OFD_SETLK;
    int result = fcntl(descriptor, command, &request);
    while (result != 0 && errno == EINTR) result = fcntl(descriptor, command, &request);
    return result == 0 || (errno != EAGAIN && errno != EACCES);
}

/// All of it, or false with errno set.
bool write_all(int descriptor, std::span<const std::byte> bytes, std::uint64_t address) {
    while (!bytes.empty()) {
        const ssize_t n =
            pwrite(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(address));
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return false;
        if (n == 0) {
            errno = ENOSPC;
            return false;
        }
        bytes = bytes.subspan(static_cast<std::size_t>(n));
        address += static_cast<std::uint64_t>(n);
    }
    return true;
}

/// Fills `out`, with zeros behind the end of the file; false with errno set on an error.
bool read_all(int descriptor, std::span<std::byte> out, std::uint64_t address) {
    while (!out.empty()) {
        const ssize_t n = pread(descriptor, out.data(), out.size(), static_cast<off_t>(address));
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return false;
        if (n == 0) break;
        out = out.subspan(static_cast<std::size_t>(n));
        address += static_cast<std::uint64_t>(n);
    }
    std::fill(out.begin(), out.end(), std::byte{0});
    return true;
}

template <class T> std::span<const std::byte> bytes_of(const T& value) {
    return std::as_bytes(std::span(&value, 1));
}

struct Journal {
    JournalHead head;
    std::vector<std::uint64_t> page_numbers;
    std::vector<std::byte> pages;
};

std::uint64_t checksum_of(JournalHead head, std::span<const std::byte> numbers,
                          std::span<const std::byte> pages) {
    head.checksum = 0;
    Fnv1a sum;
    for (const std::span<const std::byte> part : {bytes_of(head), numbers, pages}) sum.add(part);
    return sum.value();
}

/// Nothing if there is no complete journal: its writer was killed before the file was touched.
std::optional<Journal> read_journal(const std::string& path, std::size_t page_bytes) {
    const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC));
    struct stat status {};
    if (file.number() < 0 || fstat(file.number(), &status) != 0) return std::nullopt;
    const auto size = static_cast<std::uint64_t>(status.st_size);
    Journal journal{};
    if (size < sizeof(JournalHead)) return std::nullopt;
    const std::span<std::byte> head = std::as_writable_bytes(std::span(&journal.head, 1));
    if (!read_all(file.number(), head, 0) || journal.head.magic != k_journal_magic)
        return std::nullopt;
    const std::uint64_t page_record = sizeof(std::uint64_t) + page_bytes;
    if (journal.head.n_pages != (size - sizeof(JournalHead)) / page_record) return std::nullopt;
    journal.page_numbers.resize(journal.head.n_pages);
    journal.pages.resize(journal.head.n_pages * page_bytes);
    const std::span<std::byte> numbers = std::as_writable_bytes(std::span(journal.page_numbers));
    if (!read_all(file.number(), numbers, sizeof(JournalHead)) ||
        !read_all(file.number(), journal.pages, sizeof(JournalHead) + numbers.size()))
        return std::nullopt;
    if (checksum_of(journal.head, numbers, journal.pages) != journal.head.checksum)
        return std::nullopt;
    return journal;
}

}  // namespace

void sync_to_disk(const std::string& path) {
    const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC));
    // EINVAL: a file system that has nothing to wait for.
    if (file.number() < 0 || (fsync(file.number()) != 0 && errno != EINVAL))
        throw Error(Loc{path}, std::string("cannot bring it to the disk: ") + std::strerror(errno),
                    "", ExitCode::environment);
}

std::string AtomicFile::journal_path(const std::string& path) { return path + ".journal"; }

AtomicFile::AtomicFile(std::string path, Mode mode)
    : path_(std::move(path)), working_path_(path_), mode_(mode) {
    try {
        if (mode_ == Mode::create)
            open_new();
        else
            open_existing();
    } catch (...) {
        if (descriptor_ >= 0) close(descriptor_);
        throw;
    }
}

AtomicFile::~AtomicFile() {
    if (working_path_ != path_) unlink(working_path_.c_str());
    close(descriptor_);
}

void AtomicFile::fail(const std::string& wanted, int error) const {
    std::string hint;
    if (error == ENOSPC || error == EDQUOT) hint = "make room; everything up to here is kept";
    if (error == ENOENT && mode_ == Mode::create) hint = "make the folder first";
    if (error == EFBIG)
        hint = "the file size limit (ulimit -f) is reached; what came before is kept";
    throw Error(Loc{path_}, "cannot " + wanted + ": " + std::strerror(error), hint,
                mode_ == Mode::read ? ExitCode::usage : ExitCode::environment);
}

void AtomicFile::open_new() {
    std::error_code ignored;  // open() below says what is wrong
    if (std::filesystem::is_directory(path_, ignored))
        throw Error(Loc{path_}, "wanted the name of a file to write, got a folder");
    if (const Descriptor old(open(path_.c_str(), O_RDWR | O_CLOEXEC)); old.number() >= 0)
        lock_as_writer(old.number());
    working_path_ = path_ + ".part";
    descriptor_ = open(working_path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor_ < 0) {
        const int error = errno;
        working_path_ = path_;  // nothing to remove
        fail("create it", error);
    }
    lock_as_writer(descriptor_);
    if (ftruncate(descriptor_, 0) != 0) fail("empty its first version", errno);
}

void AtomicFile::open_existing() {
    const int flags = mode_ == Mode::read ? O_RDONLY : O_RDWR;
    descriptor_ = open(path_.c_str(), flags | O_CLOEXEC);
    struct stat status {};
    const bool is_folder = descriptor_ < 0
                               ? errno == EISDIR
                               : fstat(descriptor_, &status) == 0 && S_ISDIR(status.st_mode);
    if (is_folder) throw Error(Loc{path_}, "wanted a file, got a folder");
    if (descriptor_ < 0) fail("open it", errno);
    if (mode_ == Mode::append)
        lock_as_writer(descriptor_);
    else
        lock_byte(descriptor_, k_commit_lock, F_RDLCK, Wait::yes);
    if (fstat(descriptor_, &status) != 0) fail("find its size", errno);  // again, under the lock
    size_ = committed_size_ = static_cast<std::uint64_t>(status.st_size);
    take_over_journal();
}

void AtomicFile::lock_as_writer(int descriptor) const {
    if (!lock_byte(descriptor, k_writer_lock, F_WRLCK, Wait::no))
        throw Error(Loc{path_}, "another program is writing this file",
                    "wait for it, stop it, or choose another output", ExitCode::environment);
}

void AtomicFile::take_over_journal() {
    const std::string name = journal_path(path_);
    if (const auto journal = read_journal(name, k_page_bytes)) {
        if (belongs_to(journal->head, first_page())) {
            for (std::size_t p = 0; p < journal->page_numbers.size(); ++p)
                std::memcpy(pages_[journal->page_numbers[p]].data(),
                            journal->pages.data() + p * k_page_bytes, k_page_bytes);
            size_ = journal->head.size;
        }
    }
    if (mode_ == Mode::read) return;
    if (!pages_.empty()) {
        apply_old_pages();
        pages_.clear();
        committed_size_ = size_;
    }
    unlink(name.c_str());
}

AtomicFile::Page AtomicFile::first_page() const {
    Page page{};
    if (!read_all(descriptor_, page, 0)) fail("read it", errno);
    return page;
}

bool AtomicFile::read(std::uint64_t address, std::span<std::byte> out) const {
    if (!read_all(descriptor_, out, address)) return false;
    const std::uint64_t end = address + out.size();
    for (auto it = pages_.lower_bound(address / k_page_bytes);
         it != pages_.end() && it->first * k_page_bytes < end; ++it) {
        const std::uint64_t page_begin = it->first * k_page_bytes;
        const std::uint64_t from = std::max(address, page_begin);
        const std::uint64_t to = std::min(end, page_begin + k_page_bytes);
        std::memcpy(out.data() + (from - address), it->second.data() + (from - page_begin),
                    to - from);
    }
    return true;
}

void AtomicFile::write(std::uint64_t address, std::span<const std::byte> bytes) {
    size_ = std::max(size_, address + bytes.size());
    while (!bytes.empty()) {
        const std::uint64_t number = address / k_page_bytes;
        const std::size_t offset = address % k_page_bytes;
        const std::size_t n = std::min(bytes.size(), k_page_bytes - offset);
        const auto [page, is_new] = pages_.try_emplace(number);
        // A page that is written in part keeps the rest of what the file has there.
        if (is_new && n < k_page_bytes && number * k_page_bytes < committed_size_ &&
            !read_all(descriptor_, page->second, number * k_page_bytes))
            fail("read it", errno);
        std::memcpy(page->second.data() + offset, bytes.data(), n);
        bytes = bytes.subspan(n);
        address += n;
    }
}

void AtomicFile::commit() {
    SPHEROSCOPE_ASSERT(mode_ != Mode::read, path_);
    pages_.erase(pages_.lower_bound((size_ + k_page_bytes - 1) / k_page_bytes), pages_.end());
    write_new_pages();
    if (working_path_ != path_) {
        unlink(journal_path(path_).c_str());  // of the file that this one replaces
        if (rename(working_path_.c_str(), path_.c_str()) != 0) fail("give it its name", errno);
        working_path_ = path_;
    } else {
        lock_byte(descriptor_, k_commit_lock, F_WRLCK, Wait::yes);
        if (!write_journal()) {
            const int error = errno;
            unlink(journal_path(path_).c_str());
            // If this fails too, bytes stay behind the end that HDF5 knows: they do no harm.
            static_cast<void>(ftruncate(descriptor_, static_cast<off_t>(committed_size_)) == 0);
            lock_byte(descriptor_, k_commit_lock, F_UNLCK, Wait::no);
            fail("write beside it", error);
        }
        apply_old_pages();
        unlink(journal_path(path_).c_str());
        lock_byte(descriptor_, k_commit_lock, F_UNLCK, Wait::no);
    }
    pages_.clear();
    committed_size_ = size_;
}

bool AtomicFile::write_pages(Part part) const {
    constexpr std::size_t k_longest_run = 256 * k_page_bytes;
    const auto border = pages_.lower_bound((committed_size_ + k_page_bytes - 1) / k_page_bytes);
    auto it = part == Part::old_pages ? pages_.begin() : border;
    const auto end = part == Part::old_pages ? border : pages_.end();
    std::vector<std::byte> run;  // neighbouring pages go out together
    while (it != end) {
        const std::uint64_t begin = it->first * k_page_bytes;
        run.clear();
        for (; it != end && run.size() < k_longest_run &&
               it->first * k_page_bytes == begin + run.size();
             ++it)
            run.insert(run.end(), it->second.begin(), it->second.end());
        run.resize(std::min<std::uint64_t>(run.size(), size_ - begin));
        if (!write_all(descriptor_, run, begin)) return false;
    }
    return true;
}

void AtomicFile::write_new_pages() const {
    // A file that ends in space nobody wrote to still has to be as long as HDF5 believes.
    if (write_pages(Part::new_pages) &&
        (size_ <= committed_size_ || ftruncate(descriptor_, static_cast<off_t>(size_)) == 0))
        return;
    const int error = errno;
    static_cast<void>(ftruncate(descriptor_, static_cast<off_t>(committed_size_)) == 0);
    fail("write it", error);
}

bool AtomicFile::write_journal() const {
    std::vector<std::uint64_t> numbers;
    std::vector<std::byte> pages;
    for (const auto& [number, page] : pages_) {
        if (number * k_page_bytes >= committed_size_) break;
        numbers.push_back(number);
        pages.insert(pages.end(), page.begin(), page.end());
    }
    JournalHead head{};
    head.magic = k_journal_magic;
    head.n_pages = numbers.size();
    head.size = size_;
    head.first_page_before = first_page();
    const auto first = pages_.find(0);
    head.first_page_after = first == pages_.end() ? head.first_page_before : first->second;
    const std::span<const std::byte> number_bytes = std::as_bytes(std::span(numbers));
    head.checksum = checksum_of(head, number_bytes, pages);

    const Descriptor journal(
        open(journal_path(path_).c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    return journal.number() >= 0 && write_all(journal.number(), bytes_of(head), 0) &&
           write_all(journal.number(), number_bytes, sizeof head) &&
           write_all(journal.number(), pages, sizeof head + number_bytes.size());
}

void AtomicFile::apply_old_pages() const {
    // An error here leaves the journal in place: the next one to open the file completes it.
    if (!write_pages(Part::old_pages)) fail("write it", errno);
    if (ftruncate(descriptor_, static_cast<off_t>(size_)) != 0) fail("set its size", errno);
}

}  // namespace spheroscope
