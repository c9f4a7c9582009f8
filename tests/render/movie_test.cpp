#include "engine/base/folder_lock.hpp"
#include "render/layers/plot_strip.hpp"
#include "render/movie.hpp"
#include "render/movie_writer.hpp"
#include "render/mp4_boxes.hpp"
#include "render/png.hpp"
#include "render/provenance.hpp"
#include "tests/render/drifting_pair.hpp"
#include "tests/render/synthetic.hpp"
#include "tests/render/temporary_folder.hpp"

#include <fmt/format.h>
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
    EXPECT_EQ(survey.time_decimals, 2) << "a frame each quarter of a second";
}

TEST(Movie, WritesItsTimesWithAsManyDecimalsAsTheyHave) {
    const auto decimals = [](const std::vector<double>& time_s) { return time_decimals(time_s); };
    EXPECT_EQ(decimals({0.0, 0.25, 0.5}), 2);
    EXPECT_EQ(decimals({0.0, 0.5, 1.0}), 1);
    EXPECT_EQ(decimals({0.0, 0.0, 1.0, 2.0}), 1) << "beads are seeded at one time";
    EXPECT_EQ(decimals({0.0, 0.1, 0.35, 0.6}), 2) << "the smallest interval has one decimal only";
    EXPECT_EQ(decimals({0.0, 0.125}), 3);
    EXPECT_EQ(decimals({0.0, 1e-5, 2e-5}), 3) << "never more";
    EXPECT_EQ(decimals({0.0, 0.1 + 1e-12, 0.2 - 1e-12}), 1) << "rounding has no decimals";
    EXPECT_EQ(decimals({0.0, 5.0, 5.0 + 1e-12, 10.0}), 1) << "a stage ends where one begins";
    EXPECT_EQ(decimals({12.4371}), 1) << "one frame is told apart from nothing";
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
    EXPECT_EQ(stopped.n_done, 2);
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

TEST(Movie, WhoseFfmpegSaysThatAllIsWellAndLeavesHalfAFileIsAnError) {
    const TemporaryFolder folder, programs;
    DriftingPair frames(4);
    const MovieSettings settings = settings_in(folder.path());
    make_movie(frames, settings);
    EXPECT_EQ(problem_of_mp4(settings.movie_path), "");
    // a full disk at the end: the first half of a movie, and success
    const fs::path whole = programs.path() / "whole.mp4", fake = programs.path() / "ffmpeg";
    fs::rename(settings.movie_path, whole);
    for (const std::string share : {"2", "100000"}) {
        std::ofstream(fake) << "#!/bin/sh\nPATH=/usr/bin:/bin\nfor last; do :; done\n"
                            << "cat > /dev/null\nsize=$(wc -c < " << whole << ")\n"
                            << "head -c $((size / " << share << ")) " << whole << " > \"$last\"\n";
        fs::permissions(fake, fs::perms::owner_all);
        DriftingPair again(4);
        const PathIs path(programs.path());
        try {
            make_movie(again, settings);
            FAIL() << "no error";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::environment);
            EXPECT_NE(std::string(error.what()).find("the file was cut short"), std::string::npos)
                << error.what();
        }
        EXPECT_FALSE(fs::exists(settings.movie_path));
    }
}

TEST(Movie, WhoseFfmpegDiesSaysWhatHelpsAgainstThatCause) {
    const auto hint_after = [](const std::string& last_words) -> std::string {
        const TemporaryFolder folder, programs;
        const fs::path fake = programs.path() / "ffmpeg";
        std::ofstream(fake) << "#!/bin/sh\necho '" << last_words << "' >&2\nexit 1\n";
        fs::permissions(fake, fs::perms::owner_all);
        DriftingPair frames(2);
        const PathIs path(programs.path());
        try {
            make_movie(frames, settings_in(folder.path()));
        } catch (const Error& error) {
            return error.what();
        }
        return "no error";
    };
    const std::string full = hint_after("av_interleaved_write_frame(): No space left on device");
    EXPECT_NE(full.find("is the disk full"), std::string::npos) << full;
    EXPECT_EQ(full.find("install"), std::string::npos) << full;
    const std::string bare = hint_after("Unknown encoder libx264");
    EXPECT_NE(bare.find("install ffmpeg with libx264"), std::string::npos) << bare;
    EXPECT_EQ(bare.find("disk"), std::string::npos) << bare;
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

TEST(Movie, HasAChapterForEachStageAndCarriesItsSceneAndRange) {
    const TemporaryFolder folder;
    DriftingPair frames(8);
    make_movie(frames, settings_in(folder.path()));
    const std::string movie = (folder.path() / "pair.mp4").string();
    const std::string chapters = output_of(
        "ffprobe -v error -show_chapters -show_entries chapter=start,end:chapter_tags=title -of "
        "csv=p=0 " +
        movie);
    EXPECT_EQ(chapters, "0,133,compact\n133,267,relax\n") << "4 of 8 pictures at 30 in a second";
    const std::string texts =
        output_of("ffprobe -v error -show_entries format_tags -of default=nw=1:nk=0 " + movie);
    EXPECT_NE(texts.find("TAG:description=title = \"Synthetic aggregate\"\n"), std::string::npos)
        << texts;
    EXPECT_NE(
        texts.find("scene synthetic.toml; seed 42; frames 0 to 7; mean_stress -100 to 100 Pa; "
                   "run by: spheroscope run synthetic.toml --seed 42\n"),
        std::string::npos)
        << texts;
}

TEST(Movie, TextsOfEveryKindReachItsFileAsTheyAre) {
    MovieWriter::Settings settings;
    settings.title = "a=b;c#d\\e";
    settings.description = "one\ntwo\n";
    settings.fps = 25.0;
    settings.chapters = {{0, "press; hold"}, {50, "relax"}};
    settings.n_pictures = 75;
    EXPECT_EQ(metadata_text(settings),
              ";FFMETADATA1\ntitle=a\\=b\\;c\\#d\\\\e\ndescription=one\\\ntwo\\\n\n"
              "[CHAPTER]\nTIMEBASE=1/1000\nSTART=0\nEND=2000\ntitle=press\\; hold\n"
              "[CHAPTER]\nTIMEBASE=1/1000\nSTART=2000\nEND=3000\ntitle=relax\n");
}

TEST(Movie, WithoutPicturesLeavesTheMovieOnly) {
    const TemporaryFolder folder;
    DriftingPair frames(3);
    MovieSettings settings = settings_in(folder.path());
    settings.keeps_pictures = false;
    EXPECT_EQ(make_movie(frames, settings).n_drawn, 3);
    EXPECT_TRUE(fs::exists(settings.movie_path));
    EXPECT_FALSE(fs::exists(settings.frames_folder));
    const TemporaryFolder empty;
    const PathIs path(empty.path());
    EXPECT_THROW(make_movie(frames, settings), Error) << "nothing would be left of it";
}

TEST(Movie, OfTwoRunsShowsBothWithOneRangeAndOneScale) {
    const TemporaryFolder folder;
    DriftingPair frames(4), wilder(4, 0.05F, 1.0);
    const MovieSettings settings = settings_in(folder.path());
    const MovieResult result = make_comparison(frames, wilder, settings);
    EXPECT_EQ(result.range, (Range{-250.0, 250.0})) << "of the wilder run: 200 Pa";
    const PngFile file = read_png(settings.frames_folder / "000003.png");
    EXPECT_EQ(file.image.width, 2 * 320);
    const Description left = parse_description(file.texts.at(k_view_key));
    const Description right =
        parse_description(file.texts.at(std::string(MoviePainter::k_beside) + k_view_key));
    EXPECT_EQ(left.view.range, right.view.range);
    EXPECT_EQ(left.view.fit_radius_um, right.view.fit_radius_um);
    // The left half is the picture that the run alone has with that range and that scale.
    Renderer renderer(frames.frame(3)->header, settings.picture);
    const Image alone = renderer.render(*frames.frame(3), left.view);
    bool is_equal = true;
    for (int y = 0; y < 180; ++y)
        for (int x = 0; x < 320; ++x) is_equal = is_equal && alone.at(x, y) == file.image.at(x, y);
    EXPECT_TRUE(is_equal);
    const std::string comment =
        output_of("ffprobe -v error -show_entries format_tags=comment -of default=nw=1:nk=1 " +
                  settings.movie_path.string());
    EXPECT_TRUE(comment.ends_with("run by: spheroscope run synthetic.toml --seed 42; "
                                  "beside it by: spheroscope run synthetic.toml --seed 42\n"))
        << comment;
    EXPECT_EQ(make_comparison(frames, wilder, settings).n_drawn, 0);
    DriftingPair other(4, 0.04F, 1.0);
    EXPECT_EQ(make_comparison(frames, other, settings).n_drawn, 4)
        << "the fingerprint is of both halves";
}

/// The drifting pair under another title, or seed.
class PairOf : public FrameSource {
  public:
    PairOf(std::uint64_t seed, const std::string& title) : pair_(4) {
        header_ = std::make_shared<RunHeader>(*pair_.frame(0)->header);
        header_->seed = seed;
        header_->title = title;
        header_->resolved_scene = fmt::format("[scene]\ntitle = \"{}\"\nseed = {}\n", title, seed);
    }
    int n_frames() override { return pair_.n_frames(); }
    SnapshotPtr frame(int i) override {
        auto snapshot = std::make_shared<Snapshot>(*pair_.frame(i));
        snapshot->header = header_;
        return snapshot;
    }

  private:
    DriftingPair pair_;
    std::shared_ptr<RunHeader> header_;
};

TEST(Movie, HalvesOfOneTitleSayWhatTellsTheirRunsApart) {
    PairOf first(1, "A pair"), second(2, "A pair");
    scene::Picture picture = synthetic::make_picture("mean_stress");
    picture.size_px = {320, 180};
    const View view{.range = Range{-60.0, 60.0}};
    const std::array<MoviePainter::Shown, 2> shown{{{3, view}, {3, view}}};
    const std::vector<Survey> surveys(2, survey_frames(first, picture));
    FrameSource* const runs[]{&first, &second};
    const Image compared = MoviePainter(runs, surveys, picture, "test").paint(shown);
    const auto is_half = [&](int half, const Image& wanted) {
        for (int y = 0; y < wanted.height; ++y)
            for (int x = 0; x < wanted.width; ++x)
                if (compared.at(half * 320 + x, y) != wanted.at(x, y)) return false;
        return true;
    };
    const auto drawn = [&](PairOf& run, const std::string& difference) {
        return Renderer(run.frame(3)->header, picture, difference).render(*run.frame(3), view);
    };
    EXPECT_TRUE(is_half(0, drawn(first, "seed = 1")));
    EXPECT_TRUE(is_half(1, drawn(second, "seed = 2")));
    EXPECT_FALSE(is_half(1, drawn(second, "seed = 1")));
    FrameSource* const twice[]{&first, &first};
    const Image alone = drawn(first, "");
    const Image both = MoviePainter(twice, surveys, picture, "test").paint(shown);
    for (int x = 0; x < 640; ++x)
        for (int y = 0; y < 180; ++y) ASSERT_EQ(both.at(x, y), alone.at(x % 320, y));
}

TEST(Movie, APlotBelowItMovesItsMarkAlongTheCurve) {
    const TemporaryFolder folder;
    DriftingPair frames(5);
    MovieSettings settings = settings_in(folder.path());
    settings.picture.plot = "sigma_h_core";
    make_movie(frames, settings);
    const Survey survey = survey_frames(frames, settings.picture);
    EXPECT_EQ(survey.plotted, (std::vector<double>{0.0, 0.01, 0.04, 0.09, 0.16}));
    PlotStrip strip;
    strip.curves.push_back({"run", survey.time_s, survey.plotted});
    const PlotStripPainter painter(strip, 320, 180);
    for (int i = 0; i < 5; ++i) {
        const Image image =
            read_png(settings.frames_folder / ("00000" + std::to_string(i) + ".png")).image;
        ASSERT_EQ(image.height, 180 + PlotStripPainter::height_px(180));
        const auto at = [&](int k) {
            const PlotStripPainter::Point p =
                painter.point(survey.time_s[std::size_t(k)], survey.plotted[std::size_t(k)]);
            return image.at(static_cast<int>(p.x), 180 + static_cast<int>(p.y));
        };
        // The disc is wider than the curve: 2 px beside it only the mark has the curve's colour.
        const auto has_mark = [&](int k) {
            const PlotStripPainter::Point p =
                painter.point(survey.time_s[std::size_t(k)], survey.plotted[std::size_t(k)]);
            const int x = static_cast<int>(p.x), y = 180 + static_cast<int>(p.y);
            return image.at(x - 2, y) == painter.colour(0) &&
                   image.at(x, y - 2) == painter.colour(0);
        };
        EXPECT_EQ(at(i), painter.colour(0));
        for (int k = 0; k < 5; ++k) EXPECT_EQ(has_mark(k), k == i) << "frame " << i << " at " << k;
    }
}

TEST(Movie, TheFingerprintKnowsTheWholeCurveOfThePlot) {
    DriftingPair short_run(4), long_run(5);
    scene::Picture picture = synthetic::make_picture("mean_stress");
    const auto fingerprint = [&](FrameSource& run) {
        const Survey survey = survey_frames(run, picture);
        FrameSource* const runs[]{&run};
        MoviePainter painter(runs, std::span(&survey, 1), picture, "test");
        const MoviePainter::Shown shown{1, {}};
        return painter.texts(std::span(&shown, 1)).at(k_fingerprint_key);
    };
    EXPECT_EQ(fingerprint(short_run), fingerprint(long_run)) << "frame 1 alone is the same";
    picture.plot = "sigma_h_core";
    EXPECT_NE(fingerprint(short_run), fingerprint(long_run)) << "the curve below it is longer";
}

TEST(Movie, ThePlotBelowItHasAGapWhereBeadsArePacked) {
    struct : DriftingPair {
        using DriftingPair::DriftingPair;
        SnapshotPtr frame(int i) override {
            auto snapshot = std::make_shared<Snapshot>(*DriftingPair::frame(i));
            if (i == 1) snapshot->stage_name = "anneal";
            return snapshot;
        }
    } run(4);
    scene::Picture picture = synthetic::make_picture("mean_stress");
    picture.plot = "sigma_h_core";
    const Survey survey = survey_frames(run, picture);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(std::isnan(survey.plotted[i]), i == 1) << i;
}

TEST(Movie, IsNotMadeWhereAnotherJobMakesOne) {
    const TemporaryFolder folder;
    DriftingPair frames(2);
    const MovieSettings settings = settings_in(folder.path());
    {
        const FolderLock other(settings.movie_path.parent_path());
        try {
            make_movie(frames, settings);
            FAIL();
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("another program is writing into"),
                      std::string::npos)
                << error.what();
        }
    }
    EXPECT_EQ(make_movie(frames, settings).n_frames, 2) << "the lock ends with its owner";
}

TEST(Movie, ItsShotsFreezeTurnAndCut) {
    const TemporaryFolder folder;
    DriftingPair frames(5);
    MovieSettings settings = settings_in(folder.path());
    settings.picture.fps = 10.0;
    settings.picture.shots = {"play to 0.5 s", "cutaway on", "freeze 0.2 s, orbit 90 deg",
                              "play to end"};
    EXPECT_EQ(make_movie(frames, settings).n_frames, 3 + 2 + 2);
    const auto view = [&](int i) {
        const PngTexts texts =
            read_png_texts(settings.frames_folder / ("00000" + std::to_string(i) + ".png"));
        return std::pair{texts.at("Frame"), parse_description(texts.at(k_view_key)).view};
    };
    EXPECT_EQ(view(2).first, "2");
    EXPECT_EQ(view(2).second.turned_deg, 0.0);
    EXPECT_FALSE(view(2).second.cutaway.has_value());
    EXPECT_EQ(view(3).first, "2");
    EXPECT_EQ(view(3).second.turned_deg, 45.0);
    EXPECT_EQ(view(4).second.turned_deg, 90.0);
    EXPECT_EQ(view(4).second.cutaway, true);
    EXPECT_EQ(view(6).first, "4");
    EXPECT_EQ(view(6).second.turned_deg, 90.0) << "what was turned stays turned";
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
