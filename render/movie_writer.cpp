// Why a socket and not a pipe: writing to a pipe whose reader has died raises SIGPIPE for the whole
// process, while `send` can be told not to.

#include "render/movie_writer.hpp"

#include "engine/base/descriptor.hpp"
#include "engine/base/error.hpp"
#include "render/mp4_boxes.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <condition_variable>
#include <csignal>
#include <cstring>
#include <deque>
#include <fcntl.h>
#include <mutex>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

extern char** environ;  // NOLINT: POSIX declares it nowhere

namespace spheroscope::render {

namespace {

Error no_movie(const std::string& what, const std::string& remedy = "") {
    return Error("no movie: " + what,
                 "the pictures (PNG) that are done stay" + (remedy.empty() ? "" : "; " + remedy),
                 ExitCode::environment);
}

constexpr const char* k_install = "install ffmpeg with libx264 (Debian: ffmpeg)";
constexpr const char* k_look_at_disk = "is the disk full, or the folder protected?";

/// ffmpeg ended by itself: what helps depends on what it complained of.
Error ffmpeg_stopped(const std::string& complaint) {
    const auto names = [&](const char* words) {
        return complaint.find(words) != std::string::npos;
    };
    const bool is_disk = names("No space left") || names("quota exceeded") ||
                         names("Permission denied") || names("Read-only file system");
    const bool is_incomplete = names("Unknown encoder") || names("Encoder not found");
    const std::string what = "ffmpeg stopped: " + complaint;
    if (is_disk) return no_movie(what, k_look_at_disk);
    return no_movie(what, is_incomplete ? k_install : "");
}

constexpr int k_metadata_number = 3;  // in ffmpeg, after its standard ones

/// The ffmpeg process: takes frames on its standard input; what it complains of is kept in memory.
class Encoder {
  public:
    /// `metadata` is what the process reads from its descriptor 3.
    Encoder(const std::vector<std::string>& arguments, const std::string& metadata);
    ~Encoder();
    Encoder(const Encoder&) = delete;
    Encoder& operator=(const Encoder&) = delete;

    /// False when the process no longer reads.
    [[nodiscard]] bool send(const Image& image) const;
    /// Ends the input, waits, and returns whether the process ended well.
    [[nodiscard]] bool finish();
    [[nodiscard]] std::string complaint() const;

  private:
    Descriptor input_, complaint_;
    pid_t process_ = -1;
};

Encoder::Encoder(const std::vector<std::string>& arguments, const std::string& metadata)
    : complaint_(memfd_create("ffmpeg-messages", MFD_CLOEXEC)) {
    const Descriptor metadata_file(memfd_create("ffmpeg-metadata", MFD_CLOEXEC));
    if (pwrite(metadata_file.number(), metadata.data(), metadata.size(), 0) !=
        static_cast<ssize_t>(metadata.size()))
        throw no_movie(std::string("no memory for its texts: ") + std::strerror(errno));
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        throw no_movie(std::string("no socket: ") + std::strerror(errno));
    input_ = Descriptor(ends[0]);
    const Descriptor child_input(ends[1]);

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, child_input.number(), STDIN_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, complaint_.number(), STDERR_FILENO);
    // last: descriptor 3 may be one of those above
    posix_spawn_file_actions_adddup2(&actions, metadata_file.number(), k_metadata_number);
    // Ctrl-C goes to the whole foreground group; the program stops ffmpeg itself, in its own time.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes, 0);

    std::vector<char*> argv;
    for (const std::string& argument : arguments)
        argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    const int error = posix_spawnp(&process_, argv[0], &actions, &attributes, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    if (error != 0) {
        process_ = -1;
        throw no_movie("the program ffmpeg cannot be started: " + std::string(std::strerror(error)),
                       k_install);
    }
}

Encoder::~Encoder() {
    input_.close();
    if (process_ > 0) {
        kill(process_, SIGKILL);
        waitpid(process_, nullptr, 0);
    }
}

bool Encoder::send(const Image& image) const {
    const std::uint8_t* data = image.rgb.data();
    std::size_t left = image.rgb.size();
    while (left > 0) {
        const ssize_t n = ::send(input_.number(), data, left, MSG_NOSIGNAL);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return false;
        data += n;
        left -= static_cast<std::size_t>(n);
    }
    return true;
}

bool Encoder::finish() {
    input_.close();
    int status = 0;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

std::string Encoder::complaint() const {
    std::string text(2000, '\0');
    const ssize_t n = pread(complaint_.number(), text.data(), text.size(), 0);
    text.resize(n > 0 ? static_cast<std::size_t>(n) : 0);
    while (!text.empty() && text.back() == '\n') text.pop_back();
    return text.empty() ? "it gave no reason" : text;
}

std::vector<std::string> ffmpeg_arguments(const MovieWriter::Settings& s,
                                          const std::filesystem::path& output) {
    return {
        "ffmpeg", "-hide_banner", "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24",
        "-video_size", fmt::format("{}x{}", s.width_px, s.height_px), "-framerate",
        fmt::format("{:g}", s.fps), "-i", "pipe:0", "-f", "ffmetadata", "-i",
        fmt::format("pipe:{}", k_metadata_number), "-map", "0:v", "-map_metadata", "1",
        "-map_chapters", "1", "-an",
        // the colours of the bar must survive: say which matrix was used, and use that of HD video
        "-vf", "scale=out_color_matrix=bt709:out_range=tv", "-colorspace", "bt709",
        "-color_primaries", "bt709", "-color_trc", "bt709", "-color_range", "tv", "-c:v", "libx264",
        "-preset", "veryfast", "-crf", "17", "-pix_fmt", "yuv420p", "-movflags", "+faststart", "-f",
        "mp4", output.string()};
}

/// Each writer has a name of its own: the ffmpeg of a program that was killed may still be busy.
std::filesystem::path partial_path(const std::filesystem::path& path) {
    std::filesystem::path partial = path;
    partial += fmt::format(".{}.partial", getpid());
    return partial;
}

/// Removes what movies of that name have left that were killed: "main.mp4.1234.partial".
void remove_left_overs(const std::filesystem::path& path) {
    const std::string begin = path.filename().string() + ".";
    std::error_code ignored;
    std::vector<std::filesystem::path> unwanted;
    for (const auto& entry : std::filesystem::directory_iterator(
             path.has_parent_path() ? path.parent_path() : ".", ignored)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with(begin) && name.ends_with(".partial")) unwanted.push_back(entry.path());
    }
    for (const auto& name : unwanted) std::filesystem::remove(name, ignored);
}

/// "=", ";", "#", "\\" and the end of a line mean something in ffmetadata.
std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '=' || c == ';' || c == '#' || c == '\\' || c == '\n') result += '\\';
        result += c;
    }
    return result;
}

}  // namespace

std::string metadata_text(const MovieWriter::Settings& s) {
    std::string text = ";FFMETADATA1\n";
    for (const auto& [key, value] : {std::pair{"title", &s.title}, std::pair{"comment", &s.comment},
                                     std::pair{"description", &s.description}})
        if (!value->empty()) text += fmt::format("{}={}\n", key, escaped(*value));
    const auto ms = [&](int picture) { return std::lround(1000.0 * picture / s.fps); };
    for (std::size_t i = 0; i < s.chapters.size(); ++i) {
        const int end = i + 1 < s.chapters.size() ? s.chapters[i + 1].first_picture : s.n_pictures;
        text += fmt::format("[CHAPTER]\nTIMEBASE=1/1000\nSTART={}\nEND={}\ntitle={}\n",
                            ms(s.chapters[i].first_picture), ms(end), escaped(s.chapters[i].title));
    }
    return text;
}

void check_movie_size(int width_px, int height_px) {
    if (width_px % 2 != 0 || height_px % 2 != 0)
        throw Error(
            fmt::format("a movie wants even numbers of pixels, got {} x {}", width_px, height_px),
            "MP4 stores colours for blocks of 2 x 2 pixels (yuv420p)");
}

struct MovieWriter::Hidden {
    Settings settings;
    std::filesystem::path partial;
    Encoder encoder;
    std::mutex mutex;
    std::condition_variable changed;
    std::deque<Image> waiting;      // guarded by mutex
    bool no_more = false;           // guarded by mutex
    bool encoder_has_died = false;  // guarded by mutex
    bool finished = false;
    std::thread feeder;

    explicit Hidden(const Settings& s)
        : settings(s), partial(partial_path(s.path)),
          encoder(ffmpeg_arguments(s, partial), metadata_text(s)), feeder([this] { feed(); }) {}

    ~Hidden() {
        stop_feeder();
        std::error_code ignored;
        if (!finished) std::filesystem::remove(partial, ignored);
    }

    void feed() {
        std::unique_lock lock(mutex);
        while (true) {
            changed.wait(lock, [this] { return no_more || !waiting.empty(); });
            if (waiting.empty()) return;
            const Image image = std::move(waiting.front());
            waiting.pop_front();
            lock.unlock();
            changed.notify_all();
            const bool taken = encoder.send(image);
            lock.lock();
            if (!taken) {
                encoder_has_died = true;
                changed.notify_all();
                return;
            }
        }
    }

    void stop_feeder() {
        {
            const std::lock_guard lock(mutex);
            no_more = true;
        }
        changed.notify_all();
        if (feeder.joinable()) feeder.join();
    }

    [[noreturn]] void report_death() {
        stop_feeder();
        static_cast<void>(encoder.finish());
        throw ffmpeg_stopped(encoder.complaint());
    }
};

MovieWriter::MovieWriter(const Settings& settings) {
    check_movie_size(settings.width_px, settings.height_px);
    remove_left_overs(settings.path);
    hidden_ = std::make_unique<Hidden>(settings);
}

MovieWriter::~MovieWriter() = default;

void MovieWriter::add(Image image) {
    Hidden& h = *hidden_;
    SPHEROSCOPE_ASSERT(image.width == h.settings.width_px && image.height == h.settings.height_px,
                       "all pictures of a movie have its size");
    std::unique_lock lock(h.mutex);
    h.changed.wait(lock, [&h] { return h.encoder_has_died || h.waiting.size() < k_queue; });
    if (h.encoder_has_died) {
        lock.unlock();
        h.report_death();
    }
    h.waiting.push_back(std::move(image));
    lock.unlock();
    h.changed.notify_all();
}

void MovieWriter::finish() {
    Hidden& h = *hidden_;
    h.stop_feeder();
    const bool ended_well = h.encoder.finish();
    if (h.encoder_has_died || !ended_well) throw ffmpeg_stopped(h.encoder.complaint());
    if (const std::string problem = problem_of_mp4(h.partial); !problem.empty())
        throw no_movie(problem, k_look_at_disk);
    std::error_code error;
    std::filesystem::rename(h.partial, h.settings.path, error);
    if (error)
        throw no_movie("the file cannot be given its name: " + error.message(), k_look_at_disk);
    h.finished = true;
}

}  // namespace spheroscope::render
