#include "engine/base/error.hpp"
#include "engine/store/checkpoint_file.hpp"
#include "engine/store/hdf5_file.hpp"
#include "run_samples.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

namespace spheroscope {
namespace {

using samples::error_of;

CheckpointData make_data(int number) {
    CheckpointData data;
    data.float64["x_um"] = {0.1 * number,
                            -0.0,
                            5e-324,
                            -1e300,
                            std::numeric_limits<double>::infinity(),
                            std::bit_cast<double>(std::uint64_t{0x7ff8000000000123U}),
                            std::bit_cast<double>(std::uint64_t{0xfff0000000000001U})};
    data.float64["none"] = {};
    data.int64["counts"] = {std::numeric_limits<std::int64_t>::min(), -1, 0, number};
    data.text["stage"] = std::string("relax\0 \n", 8) + std::string(2, '\0');
    data.text["empty"] = "";
    return data;
}

void expect_equal(const CheckpointData& got, const CheckpointData& wanted) {
    EXPECT_EQ(got.int64, wanted.int64);
    EXPECT_EQ(got.text, wanted.text);
    ASSERT_EQ(got.float64.size(), wanted.float64.size());
    for (const auto& [name, values] : wanted.float64) {
        const std::vector<double>& read = got.float64.at(name);
        ASSERT_EQ(read.size(), values.size());
        for (std::size_t k = 0; k < values.size(); ++k)
            EXPECT_EQ(std::bit_cast<std::uint64_t>(read[k]),
                      std::bit_cast<std::uint64_t>(values[k]))
                << name << " " << k;
    }
}

class Checkpoint : public testing::Test {
  protected:
    samples::Folder folder_;
    std::string run_ = folder_ / "run.h5";
};

TEST_F(Checkpoint, EveryBitComesBack) {
    write_checkpoint(run_, make_data(3));
    const LoadedCheckpoint loaded = read_newest_checkpoint(run_);
    expect_equal(loaded.data, make_data(3));
    EXPECT_EQ(loaded.note, "");
    EXPECT_EQ(loaded.path, folder_ / "run.checkpoint.h5");
}

TEST_F(Checkpoint, TheLastTwoAreKept) {
    for (int n = 0; n < 4; ++n) write_checkpoint(run_, make_data(n));
    EXPECT_EQ(folder_.list(), "run.checkpoint.1.h5 run.checkpoint.h5");
    expect_equal(read_checkpoint(checkpoint_path(run_)), make_data(3));
    expect_equal(read_checkpoint(older_checkpoint_path(run_)), make_data(2));
}

TEST_F(Checkpoint, ANewestOneThatIsCutOffGivesWayToTheOlderOneWithANote) {
    for (int n = 0; n < 2; ++n) write_checkpoint(run_, make_data(n));
    const std::string bytes = samples::read_bytes(checkpoint_path(run_));
    for (const std::size_t length : {std::size_t{0}, std::size_t{100}, bytes.size() - 1}) {
        samples::write_bytes(checkpoint_path(run_), bytes.substr(0, length));
        const LoadedCheckpoint loaded = read_newest_checkpoint(run_);
        expect_equal(loaded.data, make_data(0));
        EXPECT_NE(
            loaded.note.find("going on from the older checkpoint " + older_checkpoint_path(run_)),
            std::string::npos);
    }
}

TEST_F(Checkpoint, AfterAKillBetweenTheTwoRenamesTheOlderOneIsFound) {
    for (int n = 0; n < 2; ++n) write_checkpoint(run_, make_data(n));
    std::filesystem::rename(checkpoint_path(run_), older_checkpoint_path(run_));
    const LoadedCheckpoint loaded = read_newest_checkpoint(run_);
    expect_equal(loaded.data, make_data(1));
    EXPECT_NE(loaded.note, "");
}

TEST_F(Checkpoint, HasTheChecksumThatEveryVersionHasWritten) {
    CheckpointData data;
    data.float64["a"] = {1.5};
    data.text["b"] = "xy";
    write_checkpoint(run_, data);
    const hdf5::File file(checkpoint_path(run_), hdf5::File::Mode::read);
    // FNV-1a of "a\0", 1, 1.5, "b\0", 2, "xy"
    EXPECT_EQ(file.unsigned_attribute("/", "checksum"), 0x3f24066d99657fb3ULL);
}

TEST_F(Checkpoint, AChangedNumberIsNoticed) {
    write_checkpoint(run_, make_data(3));
    std::string bytes = samples::read_bytes(checkpoint_path(run_));
    const double number = 0.1 * 3;
    const std::size_t place = bytes.find(std::string(reinterpret_cast<const char*>(&number), 8));
    ASSERT_NE(place, std::string::npos);
    bytes[place] = static_cast<char>(bytes[place] ^ 1);
    samples::write_bytes(checkpoint_path(run_), bytes);
    EXPECT_NE(error_of([&] {
                  static_cast<void>(read_checkpoint(checkpoint_path(run_)));
              }).find("do not have its checksum"),
              std::string::npos);
}

TEST_F(Checkpoint, WithoutAnyTheReasonsForBothAreGiven) {
    samples::write_bytes(checkpoint_path(run_), "text");
    const std::string error = error_of([&] { static_cast<void>(read_newest_checkpoint(run_)); });
    EXPECT_NE(error.find("there is no checkpoint to go on from"), std::string::npos);
    EXPECT_NE(error.find("run.checkpoint.h5: error: wanted an HDF5 file"), std::string::npos);
    EXPECT_NE(error.find("run.checkpoint.1.h5: error: cannot open it"), std::string::npos);
}

TEST_F(Checkpoint, ARunThatBeginsAnewHasNone) {
    for (int n = 0; n < 2; ++n) write_checkpoint(run_, make_data(n));
    remove_checkpoints(run_);
    remove_checkpoints(run_);
    EXPECT_EQ(folder_.list(), "");
}

}  // namespace
}  // namespace spheroscope
