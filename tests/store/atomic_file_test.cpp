#include "engine/base/error.hpp"
#include "engine/store/atomic_file.hpp"
#include "run_samples.hpp"

#include <gtest/gtest.h>

#include <span>
#include <unistd.h>

namespace spheroscope {
namespace {

std::span<const std::byte> bytes_of(const std::string& text) {
    return std::as_bytes(std::span(text));
}

std::string contents(const AtomicFile& file) {
    std::string text(file.size(), '?');
    EXPECT_TRUE(file.read(0, std::as_writable_bytes(std::span(text))));
    return text;
}

class AtomicFileTest : public testing::Test {
  protected:
    samples::Folder folder_;
    std::string path_ = folder_ / "file";
};

TEST_F(AtomicFileTest, ANewFileHasItsNameOnlyAfterTheFirstCommit) {
    AtomicFile file(path_, AtomicFile::Mode::create);
    file.write(0, bytes_of("one"));
    EXPECT_EQ(folder_.list(), "file.part");
    file.commit();
    EXPECT_EQ(folder_.list(), "file");
    EXPECT_EQ(samples::read_bytes(path_), "one");
}

TEST_F(AtomicFileTest, WithoutACommitNothingIsLeftAndTheOldFileStays) {
    samples::write_bytes(path_, "old");
    { AtomicFile(path_, AtomicFile::Mode::create).write(0, bytes_of("new")); }
    EXPECT_EQ(folder_.list(), "file");
    EXPECT_EQ(samples::read_bytes(path_), "old");
}

TEST_F(AtomicFileTest, ChangesAreSeenByTheWriterAtOnceAndInTheFileAfterTheCommit) {
    // Across pages, over old and new ground, with a hole.
    std::string wanted(10000, 'a');
    samples::write_bytes(path_, wanted);
    AtomicFile file(path_, AtomicFile::Mode::append);
    const std::string patch(5000, 'b');
    file.write(3000, bytes_of(patch));
    wanted.replace(3000, patch.size(), patch);
    file.write(20000, bytes_of("end"));
    wanted.resize(20000, '\0');
    wanted += "end";
    EXPECT_EQ(contents(file), wanted);
    EXPECT_EQ(samples::read_bytes(path_), std::string(10000, 'a'));
    file.commit();
    EXPECT_EQ(samples::read_bytes(path_), wanted);
    EXPECT_EQ(contents(file), wanted);
    file.set_size(4096);
    file.commit();
    EXPECT_EQ(samples::read_bytes(path_), wanted.substr(0, 4096));
}

/// The journal of a commit that puts "new" at the beginning of a file. A commit removes its
/// journal; here the journal's name is a link, so that the bytes stay.
std::string journal_of_a_change(const samples::Folder& folder, const std::string& before) {
    const std::string path = folder / "maker", kept = folder / "kept";
    samples::write_bytes(path, before);
    {
        AtomicFile file(path, AtomicFile::Mode::append);
        EXPECT_EQ(symlink(kept.c_str(), AtomicFile::journal_path(path).c_str()), 0);
        file.write(0, bytes_of("new"));
        file.commit();
    }
    std::string journal = samples::read_bytes(kept);
    std::filesystem::remove(path);
    std::filesystem::remove(kept);
    return journal;
}

class JournalTest : public AtomicFileTest {
  protected:
    void SetUp() override {
        samples::write_bytes(path_, before_);
        journal_ = journal_of_a_change(folder_, before_);
        ASSERT_GT(journal_.size(), 4096U);
    }
    void leave(const std::string& journal) const {
        samples::write_bytes(AtomicFile::journal_path(path_), journal);
    }

    std::string before_ = std::string("old").append(5000, '.');
    std::string after_ = std::string("new").append(5000, '.');
    std::string journal_;
};

TEST_F(JournalTest, AReaderSeesTheWholeCommitAndChangesNothing) {
    leave(journal_);
    EXPECT_EQ(contents(AtomicFile(path_, AtomicFile::Mode::read)), after_);
    EXPECT_EQ(samples::read_bytes(path_), before_);
    EXPECT_EQ(samples::read_bytes(AtomicFile::journal_path(path_)), journal_);
}

TEST_F(JournalTest, AWriterCompletesTheCommit) {
    leave(journal_);
    EXPECT_EQ(contents(AtomicFile(path_, AtomicFile::Mode::append)), after_);
    EXPECT_EQ(samples::read_bytes(path_), after_);
    EXPECT_EQ(folder_.list(), "file");
}

TEST_F(JournalTest, AJournalWithAWrongByteAnywhereIsNotUsed) {
    for (std::size_t place = 0; place < journal_.size(); place += place < 64 ? 1 : 61) {
        std::string damaged = journal_;
        damaged[place] = static_cast<char>(damaged[place] ^ 0x10);
        leave(damaged);
        const AtomicFile file(path_, AtomicFile::Mode::read);
        ASSERT_EQ(file.size(), before_.size()) << "byte " << place;
        EXPECT_TRUE(contents(file) == before_) << "byte " << place;
    }
}

TEST_F(JournalTest, AJournalThatIsCutOffIsNotUsed) {
    for (std::size_t length = 0; length < journal_.size(); length += 97) {
        leave(journal_.substr(0, length));
        EXPECT_TRUE(contents(AtomicFile(path_, AtomicFile::Mode::read)) == before_) << length;
    }
}

TEST_F(JournalTest, AJournalOfAnotherFileIsNotUsed) {
    const std::string other = "other" + std::string(5000, '.');
    samples::write_bytes(path_, other);
    leave(journal_);
    EXPECT_EQ(contents(AtomicFile(path_, AtomicFile::Mode::append)), other);
    EXPECT_EQ(samples::read_bytes(path_), other);
}

TEST_F(JournalTest, AFullDiskWhileTheJournalIsWrittenLeavesTheFileAsItWas) {
    // /dev/full is a disk without any room.
    AtomicFile file(path_, AtomicFile::Mode::append);
    ASSERT_EQ(symlink("/dev/full", AtomicFile::journal_path(path_).c_str()), 0);
    file.write(0, bytes_of("new"));
    file.write(20000, bytes_of("more"));
    const std::string error = samples::error_of([&] { file.commit(); });
    EXPECT_NE(error.find("cannot write beside it: No space left on device"), std::string::npos)
        << error;
    EXPECT_EQ(samples::read_bytes(path_), before_);
    EXPECT_EQ(folder_.list(), "file");
}

}  // namespace
}  // namespace spheroscope
