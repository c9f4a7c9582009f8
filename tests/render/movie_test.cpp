#include "render/movie.hpp"
#include "render/movie_writer.hpp"
#include "render/png.hpp"
#include "render/provenance.hpp"
#include "tests/render/synthetic.hpp"
#include "tests/render/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <string>

namespace spheroscope::render {
namespace {

namespace fs = std::filesystem;

/// Two cells that drift apart while their stress grows.
class DriftingPair : public FrameSource {
  public:
    explicit DriftingPair(int n_frames, float stress_kPa = 0.01F)
        : n_frames_(n_frames), stress_kPa_(stress_kPa) {}
    int n_frames() override { return n_frames_; }
    SnapshotPtr frame(int i) override {
        const double shift = 0.2 * i;
        auto snapshot =
            synthetic::make_balls(header_, {{0, -9 - shift, 0}, {0, 9 + shift, 0}}, 9.0);
        snapshot->frame = i;
        snapshot->time_s = 0.25 * i;
        snapshot->fields[2] = {stress_kPa_ * static_cast<float>(i + 1), -stress_kPa_};
        return snapshot;
    }

  private:
    int n_frames_;
    float stress_kPa_;
    std::shared_ptr<const RunHeader> header_ = synthetic::make_header(2, 42);
};

MovieSettings settings_in(const fs::path& folder) {
    MovieSettings settings;
    settings.picture = synthetic::make_picture("mean_stress");
    settings.picture.size_px = {320, 180};
    settings.frames_folder = folder / "pair" / "frames";
    settings.movie_path = folder / "pair.mp4";
    settings.drawn_by = "test";
    return settings;
}

std::string output_of(const std::string& command) {
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    std::array<char, 256> part;
    std::string text;
    while (std::fgets(part.data(), static_cast<int>(part.size()), pipe.get()) != nullptr)
        text += part.data();
    return text;
}

int count_files(const fs::path& folder) {
    int n = 0;
    for (const auto& entry : fs::directory_iterator(folder)) n += entry.is_regular_file() ? 1 : 0;
    return n;
}

/// Sets PATH to a folder for the life of the object.
class PathIs {
  public:
    explicit PathIs(const fs::path& folder) : before_(std::getenv("PATH")) {
        setenv("PATH", folder.c_str(), 1);
    }
    ~PathIs() { setenv("PATH", before_.c_str(), 1); }

  private:
    std::string before_;
};

TEST(Movie, HasAllFramesInItsSizeAndItsTitle) {
    const TemporaryFolder folder;
    DriftingPair frames(5);
    const MovieResult result = make_movie(frames, settings_in(folder.path()));
    EXPECT_EQ(result.n_drawn, 5);
    EXPECT_EQ(count_files(folder.path() / "pair" / "frames"), 5);
    const std::string probe =
        output_of("ffprobe -v error -count_frames -select_streams v:0 -show_entries "
                  "stream=codec_name,width,height,pix_fmt,nb_read_frames:format_tags=title,comment "
                  "-of csv=p=0 " +
                  (folder.path() / "pair.mp4").string());
    EXPECT_NE(probe.find("h264,320,180,yuv420p,5"), std::string::npos) << probe;
    EXPECT_NE(probe.find("Synthetic aggregate"), std::string::npos) << probe;
    EXPECT_NE(probe.find("seed 42"), std::string::npos) << probe;
}

TEST(Movie, HasOneRangeOverTheWholeRun) {
    DriftingPair frames(5);
    const Survey survey = survey_frames(frames, synthetic::make_picture("mean_stress"));
    EXPECT_EQ(survey.range, (Range{-60.0, 60.0}))
        << "the largest stress is 50 Pa, in the last frame";
    EXPECT_EQ(survey.share_outside, 0.0);
    EXPECT_EQ(survey.time_decimals, 1);
}

TEST(Movie, PicturesCarryWhatTheyShow) {
    const TemporaryFolder folder;
    DriftingPair frames(2);
    make_movie(frames, settings_in(folder.path()));
    const PngTexts texts = read_png_texts(folder.path() / "pair" / "frames" / "000001.png");
    EXPECT_EQ(texts.at("Seed"), "42");
    EXPECT_EQ(texts.at("Frame"), "1");
    EXPECT_EQ(texts.at("Time"), "0.25 s");
    EXPECT_EQ(texts.at("Scene"), "title = \"Synthetic aggregate\"\n");
    EXPECT_EQ(texts.at("Range"), "mean_stress -25 to 25 Pa");
    EXPECT_EQ(texts.at(k_fingerprint_key).size(), 16U);
}

TEST(Movie, ResumesWithThePicturesThatAreThereAndReplacesAllOthers) {
    const TemporaryFolder folder;
    MovieSettings settings = settings_in(folder.path());
    const fs::path pictures = settings.frames_folder;
    DriftingPair frames(4);
    int n_asked = 0;
    settings.stop_requested = [&n_asked] { return ++n_asked > 2; };
    const MovieResult stopped = make_movie(frames, settings);
    EXPECT_TRUE(stopped.stopped);
    EXPECT_EQ(stopped.n_drawn, 2);
    EXPECT_EQ(count_files(pictures), 2);
    EXPECT_FALSE(fs::exists(settings.movie_path));

    // One of the two is damaged, and pictures of an older, longer movie lie about.
    fs::resize_file(pictures / "000001.png", fs::file_size(pictures / "000001.png") / 2);
    std::ofstream(pictures / "000099.png") << "old";
    std::ofstream(pictures / "000003.png.partial") << "unfinished";
    std::ofstream(pictures / "notes.txt") << "somebody's";
    settings.stop_requested = {};
    const MovieResult resumed = make_movie(frames, settings);
    EXPECT_EQ(resumed.n_drawn, 3) << "only picture 0 could be kept";
    EXPECT_EQ(count_files(pictures), 5) << "4 pictures and the notes";
    EXPECT_TRUE(fs::exists(settings.movie_path));
    EXPECT_EQ(make_movie(frames, settings).n_drawn, 0);

    const TemporaryFolder other;
    make_movie(frames, settings_in(other.path()));
    for (int i = 0; i < 4; ++i) {
        const fs::path name = "00000" + std::to_string(i) + ".png";
        EXPECT_TRUE(read_png(pictures / name).image ==
                    read_png(other.path() / "pair" / "frames" / name).image)
            << i;
    }
    DriftingPair stronger(4, 0.02F);
    EXPECT_EQ(make_movie(stronger, settings).n_drawn, 4) << "another run: nothing may be kept";
}

TEST(Movie, WithoutFfmpegIsAnErrorAndThePicturesStay) {
    const TemporaryFolder folder, empty;
    DriftingPair frames(3);
    const MovieSettings settings = settings_in(folder.path());
    const PathIs path(empty.path());
    try {
        make_movie(frames, settings);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::environment);
        EXPECT_NE(std::string(error.what()).find("ffmpeg"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("stay"), std::string::npos);
    }
    EXPECT_EQ(count_files(settings.frames_folder), 3);
    EXPECT_FALSE(fs::exists(settings.movie_path));
}

TEST(Movie, WhoseFfmpegDiesIsAnErrorWithItsLastWordsAndThePicturesStay) {
    const TemporaryFolder folder, programs;
    const fs::path fake = programs.path() / "ffmpeg";
    std::ofstream(fake) << "#!/bin/sh\nfor last; do :; done\necho half > \"$last\"\n"
                           "echo 'encoder is on strike' >&2\nexit 1\n";
    fs::permissions(fake, fs::perms::owner_all);
    DriftingPair frames(8);
    const MovieSettings settings = settings_in(folder.path());
    const PathIs path(programs.path());
    try {
        make_movie(frames, settings);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::environment);
        EXPECT_NE(std::string(error.what()).find("encoder is on strike"), std::string::npos)
            << error.what();
    }
    EXPECT_EQ(count_files(settings.frames_folder), 8);
    EXPECT_FALSE(fs::exists(settings.movie_path));
    EXPECT_FALSE(fs::exists(settings.movie_path.string() + ".partial"));
}

TEST(Movie, OfOddSizeIsRefusedWithTheReason) {
    const TemporaryFolder folder;
    DriftingPair frames(2);
    MovieSettings settings = settings_in(folder.path());
    settings.picture.size_px = {321, 180};
    try {
        make_movie(frames, settings);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::usage);
        EXPECT_NE(std::string(error.what()).find("321 x 180"), std::string::npos) << error.what();
    }
    EXPECT_FALSE(fs::exists(settings.frames_folder));
}

TEST(Movie, OfNoFramesIsRefused) {
    const TemporaryFolder folder;
    DriftingPair frames(0);
    EXPECT_THROW(make_movie(frames, settings_in(folder.path())), Error);
}

TEST(Scale, IsConstantForAnAggregateThatHardlyChangesItsSize) {
    const std::vector<double> extents{40, 44, 46, 41};
    EXPECT_EQ(fit_radii(extents, 30.0), std::vector<double>(4, 46.0));
}

TEST(Scale, FollowsALargeChangeSmoothlyAndNeverCutsTheAggregate) {
    std::vector<double> extents(200, 100.0);
    for (std::size_t i = 100; i < 200; ++i) extents[i] = 40.0;
    const std::vector<double> radii = fit_radii(extents, 30.0);
    for (std::size_t i = 0; i < extents.size(); ++i) EXPECT_GE(radii[i], extents[i] - 1e-9) << i;
    // From 100 to 40 within two seconds; a steady pace would be 1 per frame.
    for (std::size_t i = 1; i < extents.size(); ++i)
        EXPECT_LT(std::abs(radii[i] - radii[i - 1]), 4.5) << i;
    EXPECT_NEAR(radii.back(), 40.0, 1e-9);
}

}  // namespace
}  // namespace spheroscope::render
