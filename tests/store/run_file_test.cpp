#include "engine/base/error.hpp"
#include "engine/store/hdf5_file.hpp"
#include "engine/store/run_file.hpp"
#include "engine/store/run_format.hpp"
#include "run_samples.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace spheroscope {
namespace {

using samples::error_of;
using samples::expect_equal;
using samples::make_frame;

class RunFile : public testing::Test {
  protected:
    [[nodiscard]] RunFileWriter create(const std::string& path) const {
        return RunFileWriter::create(path, *header_, RunFileWriter::Existing::refuse);
    }
    void write_frames(RunFileWriter& writer, int end) const {
        for (int n = writer.n_frames(); n < end; ++n) writer.write(make_frame(header_, n));
    }
    void expect_frames(const std::string& path, int n_frames) const {
        const RunFileReader reader(path);
        ASSERT_EQ(reader.n_frames(), n_frames);
        for (int n = 0; n < n_frames; ++n) {
            SCOPED_TRACE("frame " + std::to_string(n));
            expect_equal(*reader.frame(n), make_frame(header_, n));
            EXPECT_EQ(reader.time(n), make_frame(header_, n).time_s);
        }
    }

    samples::Folder folder_;
    std::string path_ = folder_ / "run.h5";
    std::shared_ptr<const RunHeader> header_ = samples::make_header();
};

TEST_F(RunFile, EveryFrameComesBackBitByBit) {
    RunFileWriter writer = create(path_);
    write_frames(writer, 4);
    expect_frames(path_, 4);
}

TEST_F(RunFile, HeaderComesBackAndOutlivesItsReader) {
    static_cast<void>(create(path_));
    const std::shared_ptr<const RunHeader> header = RunFileReader(path_).header();
    expect_equal(*header, *header_);
}

TEST_F(RunFile, AFrameCanBeReadAsSoonAsItsWriteReturned) {
    RunFileWriter writer = create(path_);
    for (int n = 1; n < 4; ++n) {
        write_frames(writer, n);
        expect_frames(path_, n);
    }
}

TEST_F(RunFile, AReaderFromBeforeStillReadsItsFramesWhileTheFileGrows) {
    RunFileWriter writer = create(path_);
    write_frames(writer, 2);
    const RunFileReader reader(path_);
    write_frames(writer, 20);
    EXPECT_EQ(reader.n_frames(), 2);
    expect_equal(*reader.frame(1), make_frame(header_, 1));
}

TEST_F(RunFile, ANumberOfAllFramesNeedsNoFrame) {
    RunFileWriter writer = create(path_);
    write_frames(writer, 4);
    const RunFileReader reader(path_);
    const std::vector<double> radius_um = reader.number_of_frames("wall_radius");
    ASSERT_EQ(radius_um.size(), 4U);
    for (int i = 0; i < 4; ++i)
        EXPECT_EQ(radius_um[static_cast<std::size_t>(i)],
                  reader.frame(i)->diagnostics.wall_radius_um);
    EXPECT_THROW(static_cast<void>(reader.number_of_frames("wall_colour")), Error);
}

TEST_F(RunFile, AFrameKnowsWhatHadChangedBeforeIt) {
    RunFileWriter writer = create(path_);
    write_frames(writer, 4);  // every 0.1 s
    const std::vector<Change> changes{{0.1, "cortex.tension.gamma", {0.7}},
                                      {0.25, "contact.adhesion.omega", {0.3}}};
    writer.record_changes(changes);
    const RunFileReader reader(path_);
    EXPECT_EQ(reader.frame(0)->changes, nullptr);
    EXPECT_EQ(reader.frame(1)->changes, nullptr);  // made with the step that begins there
    ASSERT_NE(reader.frame(2)->changes, nullptr);
    EXPECT_EQ(*reader.frame(2)->changes, std::vector<Change>{changes[0]});
    ASSERT_NE(reader.frame(3)->changes, nullptr);
    EXPECT_EQ(*reader.frame(3)->changes, changes);
}

TEST_F(RunFile, OnlyAFinishedRunIsComplete) {
    {
        RunFileWriter writer = create(path_);
        write_frames(writer, 1);
        EXPECT_FALSE(RunFileReader(path_).is_complete());
        EXPECT_EQ(RunFileReader(path_).outcome(), "");
        EXPECT_FALSE(RunFileReader(path_).end().state_hash);
        writer.finish({true, "rest", 12.5, {}, 0xfedcba9876543210ULL});
    }
    const RunFileReader reader(path_);
    EXPECT_TRUE(reader.is_complete());
    EXPECT_EQ(reader.outcome(), "rest");
    EXPECT_EQ(reader.end().wall_time_s, 12.5);
    EXPECT_EQ(reader.end().state_hash, 0xfedcba9876543210ULL);
}

TEST_F(RunFile, NothingButTheFileItselfIsLeftBehind) {
    RunFileWriter writer = create(path_);
    write_frames(writer, 3);
    EXPECT_EQ(folder_.list(), "run.h5");
}

TEST_F(RunFile, AnExistingFileIsNotOverwrittenUnasked) {
    RunFileWriter writer = create(path_);
    write_frames(writer, 1);
    EXPECT_NE(error_of([&] { static_cast<void>(create(path_)); }).find("exists already"),
              std::string::npos);
    expect_frames(path_, 1);
}

TEST_F(RunFile, AReplacedFileHasOnlyTheNewRun) {
    {
        RunFileWriter writer = create(path_);
        write_frames(writer, 3);
    }
    RunFileWriter writer = RunFileWriter::create(path_, *header_, RunFileWriter::Existing::replace);
    write_frames(writer, 1);
    expect_frames(path_, 1);
}

TEST_F(RunFile, TwoWritersOfOneFileAreRefused) {
    const RunFileWriter writer = create(path_);
    EXPECT_NE(error_of([&] {
                  static_cast<void>(RunFileWriter::append(path_, *header_, 0));
              }).find("another program is writing this file"),
              std::string::npos);
    EXPECT_NE(error_of([&] {
                  static_cast<void>(
                      RunFileWriter::create(path_, *header_, RunFileWriter::Existing::replace));
              }).find("another program is writing this file"),
              std::string::npos);
}

TEST_F(RunFile, APositionThatIsNotANumberIsRefusedAndNamed) {
    RunFileWriter writer = create(path_);
    write_frames(writer, 1);
    Snapshot frame = make_frame(header_, 1);
    frame.x_um[3 * 43 + 2] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_NE(error_of([&] { writer.write(frame); }).find("position of cell 1, node 1 is nan"),
              std::string::npos);
    expect_frames(path_, 1);
}

/// Everything below an object, as text: names, shapes and numbers.
std::string contents(const hdf5::File& file, int n_frames) {
    std::string text;
    const auto add = [&](const std::string& object, const auto& values) {
        text += object;
        for (const auto value : values) text += " " + std::to_string(value);
        text += "\n";
    };
    add("/time", file.read_array<double>("/time"));
    for (const run_format::Column& column : run_format::columns())
        add(run_format::column_path(column),
            file.read_array<double>(run_format::column_path(column)));
    for (const std::string& step : file.children("/steps")) text += step + "\n";
    for (int n = 0; n < n_frames; ++n)
        add(run_format::step_path(n), file.read_array<float>(run_format::step_path(n) + "/x"));
    text +=
        std::to_string(file.int_attribute("/", "complete")) + file.text_attribute("/", "outcome");
    return text;
}

TEST_F(RunFile, GoingOnFromAnyFrameGivesTheContentsOfTheUninterruptedRun) {
    constexpr int k_frames = 6;
    {
        RunFileWriter writer = create(path_);
        write_frames(writer, k_frames);
        writer.finish({true, "rest", 1.0});
    }
    const std::string wanted = contents(hdf5::File(path_, hdf5::File::Mode::read), k_frames);
    for (int kept = 0; kept <= k_frames; ++kept) {
        SCOPED_TRACE("going on after " + std::to_string(kept) + " frames");
        {
            RunFileWriter writer = RunFileWriter::append(path_, *header_, kept);
            EXPECT_EQ(writer.n_frames(), kept);
            EXPECT_EQ(RunFileReader(path_).n_frames(), kept);
            EXPECT_FALSE(RunFileReader(path_).is_complete());
            write_frames(writer, k_frames);
            writer.finish({true, "rest", 1.0});
        }
        EXPECT_EQ(contents(hdf5::File(path_, hdf5::File::Mode::read), k_frames), wanted);
        expect_frames(path_, k_frames);
    }
}

TEST_F(RunFile, OnlyTheSameRunCanBeContinued) {
    {
        RunFileWriter writer = create(path_);
        write_frames(writer, 2);
    }
    const auto refusal = [&](const RunHeader& header, int n_frames) {
        return error_of([&] { static_cast<void>(RunFileWriter::append(path_, header, n_frames)); });
    };
    RunHeader other = *header_;
    other.seed = 7;
    EXPECT_NE(refusal(other, 1).find("wanted seed 7"), std::string::npos);
    other = *header_;
    other.fields.pop_back();
    EXPECT_NE(refusal(other, 1).find("wanted the fields sigma_nn, gamma_eff"), std::string::npos);
    other = *header_;
    other.resolved_scene += "#";
    EXPECT_NE(refusal(other, 1).find("wanted the same scene"), std::string::npos);
    EXPECT_NE(refusal(*header_, 3).find("at least 3 frames to continue, got 2"), std::string::npos);
    expect_frames(path_, 2);
    other = *header_;
    other.resolved_scene += "[[picture]]\nfield = \"sigma_nn\"\n";
    EXPECT_EQ(refusal(other, 2), "") << "what is drawn of a run is no part of it";
}

TEST_F(RunFile, ARunOfAVersionWithOtherColumnsIsNotContinuedAndKeepsItsFrames) {
    {
        RunFileWriter writer = create(path_);
        write_frames(writer, 2);
    }
    const std::string column = run_format::column_path(run_format::columns().front());
    {
        hdf5::File file(path_, hdf5::File::Mode::append);
        file.remove(column);
        file.commit();
    }
    const std::string refusal =
        error_of([&] { static_cast<void>(RunFileWriter::append(path_, *header_, 1)); });
    EXPECT_NE(refusal.find("it has no " + column), std::string::npos) << refusal;
    EXPECT_EQ(hdf5::File(path_, hdf5::File::Mode::read).shape("/time").at(0), 2U);
}

TEST_F(RunFile, AMissingFrameNumberIsAnErrorWithTheNumberOfFrames) {
    RunFileWriter writer = create(path_);
    write_frames(writer, 2);
    const RunFileReader reader(path_);
    for (const int number : {-1, 2})
        EXPECT_NE(
            error_of([&] { static_cast<void>(reader.frame(number)); }).find("a run of 2 frames"),
            std::string::npos);
}

TEST_F(RunFile, UnitsStandBesideTheNumbers) {
    RunFileWriter writer = create(path_);
    write_frames(writer, 1);
    const hdf5::File file(path_, hdf5::File::Mode::read);
    EXPECT_EQ(file.text_attribute("/time", "unit"), "s");
    EXPECT_EQ(file.text_attribute("/steps/000000/x", "unit"), "um");
    EXPECT_EQ(file.text_attribute("/steps/000000/fields/sigma_nn", "unit"), "kPa");
    EXPECT_EQ(file.text_attribute("/steps/000000/fields/sigma_nn", "place"), "triangle");
    EXPECT_EQ(file.text_attribute("/steps/000000/contacts/force", "unit"), "nN");
    for (const run_format::Column& column : run_format::columns())
        EXPECT_EQ(file.text_attribute(run_format::column_path(column), "unit"), column.unit);
}

}  // namespace
}  // namespace spheroscope
