// What is here and works, so that trouble is found before a run and not after it.
#include "engine/base/error.hpp"
#include "engine/cli/doctor.hpp"
#include "engine/cli/json_output.hpp"
#include "engine/cli/options.hpp"
#include "engine/contact/simd_target.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <sys/socket.h>
#include <sys/un.h>
#include <thread>
#include <unistd.h>

namespace spheroscope::cli {
namespace {

/// Whole output of a command of ours (no user's words in it); empty if there is none.
std::string output_of(const char* command) {
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command, "r"), pclose);
    std::string text;
    std::array<char, 4096> part;
    while (pipe && std::fgets(part.data(), static_cast<int>(part.size()), pipe.get()) != nullptr)
        text += part.data();
    return text;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// Whether something answers at a local socket; `is_abstract`: Linux' sockets without a file.
bool answers(const std::string& path, bool is_abstract) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::size_t begin = is_abstract ? 1 : 0;
    if (path.size() + 1 + begin > sizeof(address.sun_path)) return false;
    std::memcpy(address.sun_path + begin, path.data(), path.size());
    const int number = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (number < 0) return false;
    const auto length =
        static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + begin + path.size());
    const bool is_there = connect(number, reinterpret_cast<sockaddr*>(&address), length) == 0;
    close(number);
    return is_there;
}

Finding find_opengl(const PictureProbe& probe) {
    Finding finding{"opengl", false, true, ""};
    try {
        finding.text = probe() + "; green beside white was drawn and read back";
        finding.is_there = true;
    } catch (const Error& error) {
        finding.text = error.what();
    }
    return finding;
}

Finding find_ffmpeg() {
    const std::string version = first_line(output_of("ffmpeg -version 2>/dev/null"));
    if (version.empty())
        return {"ffmpeg", false, true, "not there; movie leaves pictures only (Debian: ffmpeg)"};
    const bool has_x264 =
        output_of("ffmpeg -hide_banner -encoders 2>/dev/null").find(" libx264 ") !=
        std::string::npos;
    return {"ffmpeg", has_x264, true,
            version.substr(0, version.find(" Copyright")) +
                (has_x264 ? ", with libx264" : ", without libx264, which movies need")};
}

nlohmann::json document_of(const std::vector<Finding>& findings, const std::string& version,
                           bool is_well) {
    nlohmann::json parts = nlohmann::json::array();
    for (const Finding& finding : findings)
        parts.push_back({{"name", finding.name},
                         {"is_there", finding.is_there},
                         {"is_needed", finding.is_needed},
                         {"text", finding.text}});
    return {{"version", version},
            {"well", is_well},
            {"simd", {{"used", simd_target()}, {"available", simd_targets()}}},
            {"threads", std::max(1U, std::thread::hardware_concurrency())},
            {"parts", parts}};
}

ExitCode doctor(const CommonOptions& options, const PictureProbe& probe,
                const Invocation& invocation) {
    std::vector<Finding> findings;
    if (probe) {
        findings.push_back(find_opengl(probe));
        findings.push_back(find_ffmpeg());
    } else {
        findings.push_back({"opengl", false, false, "this program was built without pictures"});
    }
    const char* const display = std::getenv("DISPLAY");
    const char* const wayland = std::getenv("WAYLAND_DISPLAY");
    findings.push_back(find_display(display == nullptr ? "" : display,
                                    wayland != nullptr && *wayland != '\0',
                                    !output_of("command -v Xvfb 2>/dev/null").empty()));
    bool is_well = true;
    for (const Finding& finding : findings)
        is_well = is_well && (finding.is_there || !finding.is_needed);
    if (options.json) {
        print_json(document_of(findings, invocation.version, is_well));
    } else {
        fmt::print("version    {}\n", invocation.version);
        fmt::print("simd       {} (this machine has {})\n", simd_target(),
                   fmt::join(simd_targets(), ", "));
        fmt::print("threads    {}\n", std::max(1U, std::thread::hardware_concurrency()));
        for (const Finding& finding : findings)
            fmt::print("{:<11}{}{}\n", finding.name,
                       finding.is_there || !finding.is_needed ? "" : "MISSING: ", finding.text);
    }
    return is_well ? ExitCode::ok : ExitCode::environment;
}

}  // namespace

Finding find_display(const std::string& display, bool has_wayland, bool has_xvfb) {
    const std::string xvfb = has_xvfb ? "; Xvfb is there: xvfb-run starts one in memory"
                                      : "; there is no Xvfb either (Debian: xvfb)";
    Finding finding{"display", false, false, ""};
    if (display.empty()) {
        finding.is_there = has_wayland;
        finding.text = has_wayland ? "WAYLAND_DISPLAY is set" : "none: DISPLAY is not set" + xvfb;
        return finding;
    }
    // "[host]:number[.screen]"
    const std::size_t colon = display.rfind(':');
    int number = -1;
    if (colon != std::string::npos)
        std::from_chars(display.data() + colon + 1, display.data() + display.size(), number);
    if (number < 0) {
        finding.text = "none: DISPLAY wants [host]:number, got '" + display + "'" + xvfb;
    } else if (colon > 0 && display.substr(0, colon) != "unix") {
        finding.is_there = true;
        finding.text = "DISPLAY is " + display + ", on another machine: not tried";
    } else {
        const std::string socket = fmt::format("/tmp/.X11-unix/X{}", number);
        finding.is_there = answers(socket, false) || answers(socket, true);
        finding.text = finding.is_there
                           ? "DISPLAY is " + display + ", and an X server answers"
                           : "none: DISPLAY is " + display + ", but nothing answers there" + xvfb;
    }
    return finding;
}

Verb doctor_verb(const PictureProbe& probe) {
    return {"doctor", "says what is installed and works: OpenGL, ffmpeg, display, SIMD, threads",
            [probe](CommandLine& command) -> VerbAction {
                const auto options = std::make_shared<CommonOptions>();
                add_common_options(command, *options, {CommonOption::json});
                return [options, probe](const Invocation& invocation) {
                    return doctor(*options, probe, invocation);
                };
            }};
}

}  // namespace spheroscope::cli
