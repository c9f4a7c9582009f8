#include "engine/store/checkpoint_file.hpp"

#include "engine/base/error.hpp"
#include "engine/base/fnv1a.hpp"
#include "engine/store/atomic_file.hpp"
#include "engine/store/hdf5_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <span>
#include <string_view>
#include <unistd.h>

namespace spheroscope {
namespace {

using hdf5::File;

constexpr std::string_view k_format = "spheroscope checkpoint";
constexpr std::int64_t k_format_version = 1;

std::string with_ending(const std::string& run_path, const std::string& ending) {
    std::filesystem::path path(run_path);
    if (path.extension() == ".h5") path.replace_extension();
    return path.string() + ending;
}

/// Over names, lengths and contents, in the order of the names.
class Summer {
  public:
    template <class T> void add(const std::string& name, std::span<const T> values) {
        const std::uint64_t n = values.size();
        sum_.add(std::as_bytes(std::span(name.c_str(), name.size() + 1)));
        sum_.add(std::as_bytes(std::span(&n, 1)));
        sum_.add(std::as_bytes(values));
    }
    [[nodiscard]] std::uint64_t sum() const { return sum_.value(); }

  private:
    Fnv1a sum_;
};

std::uint64_t checksum_of(const CheckpointData& data) {
    Summer summer;
    for (const auto& [name, values] : data.float64) summer.add<double>(name, values);
    for (const auto& [name, values] : data.int64) summer.add<std::int64_t>(name, values);
    for (const auto& [name, text] : data.text) summer.add<char>(name, text);
    return summer.sum();
}

template <class T> void write_arrays(File& file, const std::string& group,
                                     const std::map<std::string, std::vector<T>>& arrays) {
    file.create_group(group);
    for (const auto& [name, values] : arrays) {
        SPHEROSCOPE_ASSERT(!name.empty() && name.find('/') == std::string::npos, name);
        file.write_array<T>(group + "/" + name, values, {values.size()});
    }
}

template <class T>
std::map<std::string, std::vector<T>> read_arrays(const File& file, const std::string& group) {
    std::map<std::string, std::vector<T>> arrays;
    for (const std::string& name : file.children(group))
        arrays[name] = file.read_array<T>(group + "/" + name);
    return arrays;
}

void rename_file(const std::string& from, const std::string& to) {
    if (std::rename(from.c_str(), to.c_str()) != 0)
        throw Error(Loc{from}, fmt::format("cannot rename it to {}: {}", to, std::strerror(errno)),
                    "", ExitCode::environment);
}

}  // namespace

std::string checkpoint_path(const std::string& run_path) {
    return with_ending(run_path, ".checkpoint.h5");
}

std::string older_checkpoint_path(const std::string& run_path) {
    return with_ending(run_path, ".checkpoint.1.h5");
}

void write_checkpoint(const std::string& run_path, const CheckpointData& data) {
    const std::string newest = checkpoint_path(run_path), fresh = newest + ".new";
    {
        File file(fresh, File::Mode::create);
        file.write_attribute("/", "format", std::string(k_format));
        file.write_attribute("/", "format_version", k_format_version);
        file.write_attribute("/", "checksum", checksum_of(data));
        write_arrays(file, "/float64", data.float64);
        write_arrays(file, "/int64", data.int64);
        std::map<std::string, std::vector<std::uint8_t>> texts;  // as bytes: a text may hold any
        for (const auto& [name, text] : data.text) texts[name].assign(text.begin(), text.end());
        write_arrays(file, "/text", texts);
        file.commit();
    }
    sync_to_disk(fresh);
    // Between the two renames there is no newest one; then the older one is what read_newest finds.
    if (std::filesystem::exists(newest)) rename_file(newest, older_checkpoint_path(run_path));
    rename_file(fresh, newest);
    const std::string folder = std::filesystem::path(newest).parent_path().string();
    sync_to_disk(folder.empty() ? "." : folder);
}

CheckpointData read_checkpoint(const std::string& path) {
    const File file(path, File::Mode::read);
    if (!file.has_attribute("/", "format") || file.text_attribute("/", "format") != k_format)
        file.fail("wanted a checkpoint of spheroscope, got another HDF5 file");
    const std::int64_t version = file.int_attribute("/", "format_version");
    if (version != k_format_version)
        file.fail(fmt::format("wanted a checkpoint of format {}, got format {}", k_format_version,
                              version));
    CheckpointData data;
    data.float64 = read_arrays<double>(file, "/float64");
    data.int64 = read_arrays<std::int64_t>(file, "/int64");
    for (const auto& [name, bytes] : read_arrays<std::uint8_t>(file, "/text"))
        data.text[name].assign(bytes.begin(), bytes.end());
    if (checksum_of(data) != file.unsigned_attribute("/", "checksum"))
        file.fail("the checkpoint is damaged: its contents do not have its checksum");
    return data;
}

LoadedCheckpoint read_newest_checkpoint(const std::string& run_path) {
    const std::string newest = checkpoint_path(run_path), older = older_checkpoint_path(run_path);
    std::string reason;
    try {
        return {read_checkpoint(newest), newest, ""};
    } catch (const Error& error) {
        reason = error.what();
    }
    try {
        return {read_checkpoint(older), older,
                fmt::format("going on from the older checkpoint {}: {}", older, reason)};
    } catch (const Error& error) {
        throw Error(
            Loc{run_path},
            fmt::format("there is no checkpoint to go on from\n  {}\n  {}", reason, error.what()),
            "run the scene from its start");
    }
}

void remove_checkpoints(const std::string& run_path) {
    for (const std::string& path : {checkpoint_path(run_path), older_checkpoint_path(run_path)})
        if (unlink(path.c_str()) != 0 && errno != ENOENT)
            throw Error(Loc{path}, std::string("cannot remove it: ") + std::strerror(errno), "",
                        ExitCode::environment);
}

}  // namespace spheroscope
