#include "engine/base/error.hpp"
#include "engine/store/checkpoint_file.hpp"
#include "engine/store/hdf5_file.hpp"
#include "engine/store/run_file.hpp"
#include "run_samples.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <functional>
#include <limits>
#include <string>
#include <sys/resource.h>
#include <tuple>
#include <vector>

namespace spheroscope {
namespace {

using samples::error_of;
using samples::make_frame;

class BadFile : public testing::Test {
  protected:
    void SetUp() override {
        RunFileWriter writer =
            RunFileWriter::create(good_, *header_, RunFileWriter::Existing::refuse);
        for (int n = 0; n < 3; ++n) writer.write(make_frame(header_, n));
    }

    /// The message must name the file, and hold `wanted`.
    static void expect_refusal(const std::string& path, const std::string& wanted) {
        const std::string error = error_of([&] {
            const RunFileReader reader(path);
            for (int n = 0; n < reader.n_frames(); ++n) static_cast<void>(reader.frame(n));
        });
        EXPECT_EQ(error.find(path + ": error: "), 0U) << error;
        EXPECT_NE(error.find(wanted), std::string::npos) << error;
    }

    /// The good run, changed by someone.
    std::string changed(const std::function<void(hdf5::File&)>& change) const {
        std::string path = folder_ / "changed.h5";
        samples::write_bytes(path, samples::read_bytes(good_));
        hdf5::File file(path, hdf5::File::Mode::append);
        change(file);
        file.commit();
        return path;
    }

    samples::Folder folder_;
    std::string good_ = folder_ / "good.h5";
    std::shared_ptr<const RunHeader> header_ = samples::make_header();
};

TEST_F(BadFile, AMissingFileIsNamed) {
    expect_refusal(folder_ / "none.h5", "cannot open it: No such file or directory");
}

TEST_F(BadFile, AFolderIsNotAFile) {
    expect_refusal(folder_.path(), "wanted a file, got a folder");
}

TEST_F(BadFile, AnEmptyFileIsNoRun) {
    const std::string path = folder_ / "empty.h5";
    samples::write_bytes(path, "");
    expect_refusal(path, "got an empty file");
}

TEST_F(BadFile, ATextFileIsNotHdf5) {
    const std::string path = folder_ / "notes.h5";
    samples::write_bytes(path, std::string(5000, 'x'));
    expect_refusal(path, "wanted an HDF5 file, got something else");
}

TEST_F(BadFile, AnotherProgramsHdf5IsNoRun) {
    const std::string path = folder_ / "foreign.h5";
    hdf5::File file(path, hdf5::File::Mode::create);
    file.create_group("/data");
    file.commit();
    expect_refusal(path, "wanted a run of spheroscope, got another HDF5 file");
}

TEST_F(BadFile, ACheckpointIsNoRun) {
    write_checkpoint(good_, {});
    expect_refusal(checkpoint_path(good_), "got a 'spheroscope checkpoint'");
}

TEST_F(BadFile, ARunIsNoCheckpoint) {
    EXPECT_NE(
        error_of([&] { static_cast<void>(read_checkpoint(good_)); }).find("wanted a checkpoint"),
        std::string::npos);
}

TEST_F(BadFile, AFileThatIsCutOffAnywhereIsRefused) {
    const std::string bytes = samples::read_bytes(good_), path = folder_ / "cut.h5";
    for (std::size_t length = 1; length < bytes.size(); length += 1 + bytes.size() / 100) {
        SCOPED_TRACE("cut to " + std::to_string(length) + " bytes");
        samples::write_bytes(path, bytes.substr(0, length));
        expect_refusal(path, "");
    }
    samples::write_bytes(path, bytes.substr(0, bytes.size() - 1));
    expect_refusal(path, "one that is cut off");
}

TEST_F(BadFile, ANewerFormatIsRefusedWithItsVersion) {
    expect_refusal(changed([](hdf5::File& file) {
                       file.write_attribute("/", "format_version", std::int64_t{2});
                   }),
                   "wanted a run of format 1 to 1, got format 2\n  hint: it was written by version "
                   "0.1.0-abc");
}

TEST_F(BadFile, ATimeThatIsNotANumberIsRefused) {
    expect_refusal(changed([](hdf5::File& file) {
                       file.append_to_column("/time", std::numeric_limits<double>::quiet_NaN());
                   }),
                   "the time of frame 3 is nan");
}

/// Replaces number `k` of an array by NaN.
template <class T> void spoil(hdf5::File& file, const std::string& object, std::size_t k) {
    const hdf5::Shape shape = file.shape(object);
    std::vector<T> values = file.read_array<T>(object);
    ASSERT_LT(k, values.size()) << object;
    values[k] = std::numeric_limits<T>::quiet_NaN();
    file.remove(object);
    file.write_array<T>(object, values, shape);
}

TEST_F(BadFile, ANumberOfAPictureThatIsNoneIsRefused) {
    const std::string step = "/steps/000002";  // with contacts and a bead
    const auto with_nan = [&]<class T>(T, const std::string& object, std::size_t k) {
        return changed([&](hdf5::File& file) { spoil<T>(file, object, k); });
    };
    for (const auto& [array, k, what] :
         {std::tuple{"/x", 5U, "a position"}, std::tuple{"/normal", 7U, "a direction"},
          std::tuple{"/cells/centre", 2U, "a position"},
          std::tuple{"/cells/pressure", 1U, "a pressure"},
          std::tuple{"/cells/volume", 0U, "a volume"}, std::tuple{"/contacts/force", 1U, "a force"},
          std::tuple{"/contacts/area", 0U, "an area"}})
        expect_refusal(with_nan(0.0F, step + array, k),
                       step + array + " holds nan where " + what + " should be");
    expect_refusal(with_nan(0.0F, "/hull/vertices", 4U),
                   "/hull/vertices holds nan where a position should be");
    for (const std::size_t k : {0U, 3U})
        expect_refusal(with_nan(0.0, step + "/probe", k),
                       step + "/probe holds nan where the bead's place or radius should be");
    for (const std::size_t k : {1U, 3U, 5U})
        expect_refusal(with_nan(0.0, step + "/probe_motion", k),
                       step + "/probe_motion holds nan where the bead's way, force, friction or "
                              "speed should be");
}

TEST_F(BadFile, WhatIsUndefinedIsNoMistake) {
    const RunFileReader reader(changed([](hdf5::File& file) {
        spoil<float>(file, "/steps/000002/fields/sigma_nn", 1);  // no contact
        spoil<double>(file, "/diagnostics/probe_force", 2);
        file.write_attribute("/steps/000002", "stage_progress",
                             std::numeric_limits<double>::quiet_NaN());
    }));
    EXPECT_TRUE(std::isnan(reader.frame(2)->totals.probe_force_nN));
}

TEST_F(BadFile, AFrameThatIsMissingIsNamed) {
    expect_refusal(changed([](hdf5::File& file) { file.remove("/steps/000001"); }),
                   "frame 1 is missing");
}

TEST_F(BadFile, AnArrayOfAnotherSizeIsNamedWithBothSizes) {
    expect_refusal(changed([](hdf5::File& file) {
                       file.remove("/steps/000000/fields/gamma_eff");
                       file.write_array<float>("/steps/000000/fields/gamma_eff",
                                               std::vector<float>(7), {7});
                   }),
                   "wanted /steps/000000/fields/gamma_eff with [84] numbers, got [7]");
}

TEST_F(BadFile, AFrameOfAnotherTimeIsRefused) {
    expect_refusal(
        changed([](hdf5::File& file) { file.write_attribute("/steps/000001", "time_s", 99.0); }),
        "disagree about the time of frame 1");
}

TEST_F(BadFile, AContactWithoutASecondCellIsRefused) {
    expect_refusal(changed([](hdf5::File& file) {
                       file.remove("/steps/000001/contacts/pairs");
                       const std::vector<std::int32_t> pair{0, 2};
                       file.write_array<std::int32_t>("/steps/000001/contacts/pairs", pair, {1, 2});
                   }),
                   "a contact between cells 0 and 2");
}

TEST_F(BadFile, ATriangleWithAnImpossibleNodeIsRefused) {
    expect_refusal(
        changed([&](hdf5::File& file) {
            auto nodes = file.read_array<std::int32_t>("/topology/triangles");
            nodes[4] = 1000000;
            file.remove("/topology/triangles");
            file.write_array<std::int32_t>("/topology/triangles", nodes, {nodes.size() / 3, 3});
        }),
        "/topology/triangles of cell 0 is not the mesh of a cell");
}

TEST_F(BadFile, AMeshWithAHoleIsRefused) {
    expect_refusal(
        changed([&](hdf5::File& file) {
            auto nodes = file.read_array<std::int32_t>("/topology/triangles");
            const std::size_t per_cell = nodes.size() / 2;
            nodes[0] = nodes[1];  // in both cells alike
            nodes[per_cell] = nodes[per_cell + 1];
            file.remove("/topology/triangles");
            file.write_array<std::int32_t>("/topology/triangles", nodes, {nodes.size() / 3, 3});
        }),
        "its mesh is damaged");
}

class BadOutput : public BadFile {
  protected:
    std::string refusal(const std::string& path) const {
        return error_of([&] {
            static_cast<void>(
                RunFileWriter::create(path, *header_, RunFileWriter::Existing::replace));
        });
    }
};

TEST_F(BadOutput, AFolderInTheWayIsNamed) {
    EXPECT_NE(refusal(folder_.path()).find("wanted the name of a file to write, got a folder"),
              std::string::npos);
}

TEST_F(BadOutput, AFolderThatDoesNotExistIsNamedWithAHint) {
    const std::string error = refusal(folder_ / "none/run.h5");
    EXPECT_NE(error.find("cannot create it: No such file or directory"), std::string::npos)
        << error;
    EXPECT_NE(error.find("make the folder first"), std::string::npos) << error;
}

TEST_F(BadOutput, AFolderThatCannotBeWrittenIsNamed) {
    const std::string error = refusal("/proc/self/run.h5");  // also closed to the superuser
    EXPECT_EQ(error.find("/proc/self/run.h5: error: cannot create it: "), 0U) << error;
}

/// A limit on the size of files stands for a full disk: both fail in the middle of a write.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(std::size_t n_bytes) {
        handler_ = std::signal(SIGXFSZ, SIG_IGN);
        getrlimit(RLIMIT_FSIZE, &before_);
        rlimit limit = before_;
        limit.rlim_cur = n_bytes;
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

  private:
    rlimit before_{};
    void (*handler_)(int) = nullptr;
};

TEST_F(BadOutput, WhereverTheDiskIsFullEveryFrameBeforeIsKept) {
    const std::size_t header_bytes = samples::read_bytes(good_).size() / 2;
    const std::string path = folder_ / "full.h5";
    int most_frames = 0;
    for (std::size_t room = header_bytes; room < header_bytes + 200000; room += 9973) {
        SCOPED_TRACE("room for " + std::to_string(room) + " bytes");
        int n_written = -1;
        std::string error;
        {
            const FileSizeLimit limit(room);
            error = error_of([&] {
                RunFileWriter writer =
                    RunFileWriter::create(path, *header_, RunFileWriter::Existing::replace);
                for (n_written = 0; n_written < 100; ++n_written)
                    writer.write(make_frame(header_, n_written));
            });
        }
        EXPECT_NE(error.find(path + ": error: cannot write it: File too large"), std::string::npos)
            << error;
        if (n_written < 0) {
            EXPECT_EQ(folder_.list(), "good.h5");  // nothing half-written
            continue;
        }
        EXPECT_EQ(folder_.list(), "full.h5 good.h5");
        const RunFileReader reader(path);
        EXPECT_EQ(reader.n_frames(), n_written);
        for (int n = 0; n < reader.n_frames(); ++n)
            EXPECT_TRUE(samples::is_equal(*reader.frame(n), make_frame(header_, n)));
        most_frames = std::max(most_frames, n_written);
        std::filesystem::remove(path);
    }
    EXPECT_GT(most_frames, 3);  // the limits did fall into the frames
}

}  // namespace
}  // namespace spheroscope
