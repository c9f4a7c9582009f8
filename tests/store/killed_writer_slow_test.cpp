#include "engine/store/run_file.hpp"
#include "run_samples.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <random>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

// Every change of a file goes through these four functions. This program's own versions count the
// calls, and the process ends, as kill -9 would end it, at a chosen one: so that every moment
// between two changes is tried, and not only those that a random kill happens to hit.
namespace {

long g_calls_left = -1;  // -1: no end

enum class Moment { now, later };

Moment count_call() {
    if (g_calls_left < 0) return Moment::later;
    return g_calls_left-- == 0 ? Moment::now : Moment::later;
}

[[noreturn]] void end_as_killed() {
    kill(getpid(), SIGKILL);
    std::abort();
}

}  // namespace

extern "C" {

ssize_t pwrite(int file, const void* bytes, size_t n, off_t place) {
    if (count_call() == Moment::now) {
        // A kill can also come in the middle of a write.
        syscall(SYS_pwrite64, file, bytes, n / 2, place);
        end_as_killed();
    }
    return syscall(SYS_pwrite64, file, bytes, n, place);
}

int ftruncate(int file, off_t size) noexcept {
    if (count_call() == Moment::now) end_as_killed();
    return static_cast<int>(syscall(SYS_ftruncate, file, size));
}

int unlink(const char* name) noexcept {
    if (count_call() == Moment::now) end_as_killed();
    return static_cast<int>(syscall(SYS_unlink, name));
}

int rename(const char* from, const char* to) noexcept {
    if (count_call() == Moment::now) end_as_killed();
    return static_cast<int>(syscall(SYS_rename, from, to));
}
}

namespace spheroscope {
namespace {

class KilledWriter : public testing::Test {
  protected:
    /// In a child process: `action` until the end or the kill. Returns true if the child was
    /// killed.
    template <class F> static bool run_in_child(const F& action) {
        const pid_t child = fork();
        if (child == 0) {
            action();
            _exit(0);
        }
        int status = 0;
        waitpid(child, &status, 0);
        EXPECT_TRUE(WIFSIGNALED(status) || WEXITSTATUS(status) == 0);
        return WIFSIGNALED(status);
    }

    void write_all(int n_frames) const {
        RunFileWriter writer =
            RunFileWriter::create(path_, *header_, RunFileWriter::Existing::replace);
        for (int n = 0; n < n_frames; ++n) writer.write(samples::make_frame(header_, n));
    }

    /// Returns the number of frames, after a look at each.
    [[nodiscard]] int read_all() const {
        const RunFileReader reader(path_);
        for (int n = 0; n < reader.n_frames(); ++n)
            EXPECT_TRUE(samples::is_equal(*reader.frame(n), samples::make_frame(header_, n))) << n;
        return reader.n_frames();
    }

    void go_on(int kept, int n_frames) const {
        RunFileWriter writer = RunFileWriter::append(path_, *header_, kept);
        for (int n = kept; n < n_frames; ++n) writer.write(samples::make_frame(header_, n));
        writer.finish({true, "rest", 1.0});
    }

    samples::Folder folder_;
    std::string path_ = folder_ / "run.h5";
    std::shared_ptr<const RunHeader> header_ = samples::make_header(1, 42);
};

TEST_F(KilledWriter, AtEveryChangeOfTheFileAllItsFramesCanBeReadAndTheRunGoesOn) {
    constexpr int k_frames = 12;  // more than the 8 names that the first leaf of a group can hold
    int before = 0, n_recovered = 0;
    bool was_killed = true;
    for (long call = 0; was_killed; ++call) {
        SCOPED_TRACE("killed at change " + std::to_string(call));
        std::filesystem::remove(path_);
        was_killed = run_in_child([&] {
            g_calls_left = call;
            write_all(k_frames);
        });
        if (!std::filesystem::exists(path_)) {
            EXPECT_EQ(before, 0);  // the run had not begun
            continue;
        }
        if (std::filesystem::exists(path_ + ".journal")) ++n_recovered;
        const int n_frames = read_all();
        EXPECT_GE(n_frames, before);  // a later kill never leaves less
        before = n_frames;
        go_on(n_frames, n_frames + 1);
        EXPECT_EQ(read_all(), n_frames + 1);
        EXPECT_EQ(folder_.list(), "run.h5");
        if (HasFailure()) return;
    }
    EXPECT_EQ(before, k_frames);
    EXPECT_GT(n_recovered, k_frames);  // the kills did fall between the changes of one frame
}

TEST_F(KilledWriter, KilledWhileItGoesOnTheRunCanGoOnAgain) {
    constexpr int k_frames = 4;
    bool was_killed = true;
    for (long call = 0; was_killed; ++call) {
        SCOPED_TRACE("killed at change " + std::to_string(call));
        write_all(k_frames);
        was_killed = run_in_child([&] {
            g_calls_left = call;
            go_on(2, k_frames);
        });
        EXPECT_GE(read_all(), 2);
        go_on(2, k_frames);
        EXPECT_EQ(read_all(), k_frames);
        if (HasFailure()) return;
    }
}

/// A writer in a process of its own, without end, until it is killed.
class EndlessWriter {
  public:
    template <class F> explicit EndlessWriter(const F& write) : process_(fork()) {
        if (process_ != 0) return;
        write();
        _exit(0);
    }
    ~EndlessWriter() {
        if (process_ > 0) end();
    }
    EndlessWriter(const EndlessWriter&) = delete;
    EndlessWriter& operator=(const EndlessWriter&) = delete;

    /// True if it was still at work.
    bool end() {
        kill(process_, SIGKILL);
        int status = 0;
        waitpid(process_, &status, 0);
        process_ = 0;
        return WIFSIGNALED(status);
    }

  private:
    pid_t process_;
};

constexpr int k_endless = 1000000;

TEST_F(KilledWriter, KilledAtRandomMomentsAllItsFramesCanBeRead) {
    std::mt19937 random(1);
    std::uniform_int_distribution<int> delay_us(0, 10000);
    for (int trial = 0; trial < 20; ++trial) {
        std::filesystem::remove(path_);
        EndlessWriter writer([&] { write_all(k_endless); });
        while (!std::filesystem::exists(path_)) std::this_thread::yield();
        const int at_least = trial % 4;
        while (RunFileReader(path_).n_frames() < at_least) std::this_thread::yield();
        std::this_thread::sleep_for(std::chrono::microseconds(delay_us(random)));
        ASSERT_TRUE(writer.end()) << "the writer ended by itself";
        EXPECT_GE(read_all(), at_least);
    }
}

TEST_F(KilledWriter, AReaderBesideAWriterNeverSeesHalfAFrame) {
    write_all(1);
    EndlessWriter writer([&] { go_on(1, k_endless); });
    int n_frames = 0;
    for (int look = 0; (look < 50 || n_frames < 50) && !HasFailure(); ++look) {
        const RunFileReader reader(path_);
        EXPECT_GE(reader.n_frames(), n_frames);
        n_frames = reader.n_frames();
        const int last = n_frames - 1;
        EXPECT_TRUE(samples::is_equal(*reader.frame(last), samples::make_frame(header_, last)));
    }
    EXPECT_TRUE(writer.end());
}

}  // namespace
}  // namespace spheroscope
