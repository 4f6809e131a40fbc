#include "app/exchange/input_files.h"

#include <cctype>
#include <filesystem>
#include <map>

#include "app/exchange/crypto_files.h"
#include "engine/media/cryptomatte.h"
#include "engine/media/sequence_pattern.h"
#include "texture_db/library/library.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

void protect_file(WriteFence& fence, const std::string& path) {
    fence.protect(path);
    fence.protect(texture_credit_path(path));
}

void protect_folder(WriteFence& fence, const std::string& folder) {
    std::error_code error;
    fs::directory_iterator entry(folder, error);
    for (const fs::directory_iterator end; !error && entry != end; entry.increment(error)) {
        std::error_code ignored;
        if (entry->is_regular_file(ignored)) fence.protect(entry->path().string());
    }
}

// A path of the project is a folder of frames, a file or a numbered sequence.
void protect_path(WriteFence& fence, const std::string& path) {
    std::error_code ignored;
    if (names_library_texture(path)) return;
    if (fs::is_directory(path, ignored)) return protect_folder(fence, path);
    if (fs::exists(path, ignored)) return protect_file(fence, path);
    const auto pattern = SequencePattern::parse(path);
    if (!pattern || pattern->is_single()) return fence.protect(path);
    fence.protect_frames(*pattern);
    const auto frames = pattern->list_frames();
    if (!frames) return;
    for (const int frame : *frames)
        fence.protect(pattern->path_for(frame));
}

// Protects the frozen frames only; other frames of their pattern may be rewritten.
void protect_frozen(WriteFence& fence, const MatteSource& matte) {
    const auto pattern = SequencePattern::parse(matte.frozen_files);
    if (!pattern) return;
    for (const int frame : matte.frozen)
        fence.protect(pattern->path_for(frame));
}

// The manifests beside the EXR files of a Cryptomatte.
void protect_manifests(WriteFence& fence, const MatteSource& matte) {
    if (matte.select.crypto.empty()) return;
    const auto pattern = SequencePattern::parse(matte.files);
    if (!pattern) return;
    const auto frames = pattern->list_frames();
    const int first = frames && !frames->empty() ? frames->front() : 0;
    for (const std::string& manifest : cryptomatte_manifest_files(pattern->path_for(first)))
        fence.protect(manifest);
}

}  // namespace

Expected<std::shared_ptr<const WriteFence>> make_fence(const Project& project,
                                                       const WriteLimits& limits) {
    auto fence = std::make_shared<WriteFence>();
    if (!limits.root.empty()) WEFT_CHECK_OK(fence->add_root(limits.root));
    for (const std::string& root : limits.roots)
        WEFT_CHECK_OK(fence->add_root(root));
    Project inputs = project;
    inputs.output = {};
    for (Leaf<Region>& leaf : inputs.regions) {
        leaf = leaf.with([&](Region& region) {
            // A Cryptomatte without files uses the plate's. If that is impossible, opening the shot
            // reports it.
            static_cast<void>(name_crypto_files(region, project.plate.path));
            std::vector<MatteSource> mattes = *region.holdouts;
            mattes.push_back(*region.matte);
            for (const Zone& zone : *region.zones)
                mattes.push_back(zone.matte);
            for (const MatteSource& matte : mattes) {
                protect_frozen(*fence, matte);
                protect_manifests(*fence, matte);
            }
            region.matte =
                region.matte.with([](MatteSource& matte) { matte.frozen_files.clear(); });
        });
    }
    static_cast<void>(map_paths(inputs, [&](const std::string& path) {
        protect_path(*fence, path);
        return path;
    }));
    for (const std::string& path : limits.reads)
        protect_path(*fence, path);
    return fence;
}

Status check_apart(const std::vector<PlannedFile>& files) {
    std::map<std::string, std::string> seen;  // description by real path
    for (const PlannedFile& file : files) {
        const auto [at, fresh] = seen.emplace(real_path(file.path), file.what);
        if (fresh) continue;
        std::string second = file.what;  // lower-case inside the sentence
        second[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(second[0])));
        return fail(ErrorCode::kUsage,
                    at->second + " and " + second + " would both be written to " + file.path + ".",
                    "Give one of them another name.");
    }
    return {};
}

}  // namespace weft
