#include "app/cache/stage_cache.h"

#include <filesystem>

#include "app/cache/blob_file.h"
#include "app/shot/color_contents.h"
#include "engine/core/byte_stream.h"
#include "engine/media/atomic_file.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

// Increase this when the result of the estimate changes.
constexpr int kMotionVersion = 4;

class DiskStages final : public StageStore {
  public:
    DiskStages(fs::path planes, fs::path motion)
        : planes_(std::move(planes)), motion_(std::move(motion)) {}

    [[nodiscard]] std::optional<TexturePlane> plane(const Hash128& key) const override {
        const auto bytes = read_blob((planes_ / key.hex()).string());
        if (!bytes) return std::nullopt;
        ByteReader reader(*bytes);
        TexturePlane out;
        reader.image(out.pixels).image(out.source).image(out.origin).value(out.stats);
        if (!reader.complete() || out.source.size() != out.pixels.size()) return std::nullopt;
        return out;
    }
    void keep_plane(const Hash128& key, const TexturePlane& plane) override {
        ByteWriter writer;
        writer.image(plane.pixels).image(plane.source).image(plane.origin).value(plane.stats);
        keep(planes_, key.hex(), writer.take());
    }
    [[nodiscard]] std::optional<FlowField> motion(int current, int previous) const override {
        const auto bytes = read_blob((motion_ / name_of(current, previous)).string());
        if (!bytes) return std::nullopt;
        ByteReader reader(*bytes);
        FlowField out;
        reader.image(out.d).image(out.valid);
        if (!reader.complete() || out.d.size() != out.valid.size()) return std::nullopt;
        return out;
    }
    void keep_motion(int current, int previous, const FlowField& motion) override {
        ByteWriter writer;
        writer.image(motion.d).image(motion.valid);
        keep(motion_, name_of(current, previous), writer.take());
    }

  private:
    static std::string name_of(int current, int previous) {
        return std::to_string(current) + "to" + std::to_string(previous);
    }
    static void keep(const fs::path& folder, const std::string& name, const Bytes& bytes) {
        std::error_code ignored;
        fs::create_directories(folder, ignored);
        // On a full disk the result is only computed again.
        static_cast<void>(write_blob((folder / name).string(), bytes));
    }

    fs::path planes_, motion_;
};

static_assert(std::is_trivially_copyable_v<PlaneStats>);

}  // namespace

void add_plate_ids(Hasher& hasher, const Shot& shot) {
    for (const int frame : shot.plate->frames()) {
        const auto id = shot.files->id(shot.plate->path_of(frame));
        const Hash128 value = id ? *id : Hash128{};
        hasher.value(frame).value(value.high).value(value.low);
    }
    if (const auto color = color_contents(shot)) hasher.value(color->high).value(color->low);
}

std::shared_ptr<StageStore> open_stage_cache(const Shot& shot, const std::string& root) {
    Hasher hasher;
    hasher.value(kMotionVersion)
        .text(shot.project.plate.layer)
        .value(shot.project.plate.movie_start);
    add_plate_ids(hasher, shot);
    hasher.text(shot.spaces.plate.name);
    const fs::path planes = fs::path(root) / "planes";
    const fs::path motion = fs::path(root) / "motion" / hasher.finish().hex();
    // A run that was killed while it wrote leaves its file there.
    for (const fs::path& folder : {planes, motion})
        remove_stale_temporaries((folder / "blob").string());
    return std::make_shared<DiskStages>(planes, motion);
}

}  // namespace weft
