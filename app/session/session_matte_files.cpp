// Writes mattes to files: exported or frozen.
#include <filesystem>

#include "app/base/background.h"
#include "app/exchange/input_files.h"
#include "app/mattes/matte_layer.h"
#include "app/project/codec/project_file.h"
#include "app/session/session.h"
#include "app/shot/matte_movies.h"
#include "app/shot/region_projection.h"
#include "engine/media/frame_writer.h"
#include "engine/media/image_files.h"
#include "engine/media/sequence_pattern.h"

namespace weft {

namespace fs = std::filesystem;

namespace {

WriteRule export_rule_of(const Project& absolute, const std::string& project_file) {
    WriteRule rule;
    rule.existing = Existing::kReplace;
    // Cannot fail without a root.
    if (const auto fence = make_fence(absolute, {{}, {project_file}})) rule.fence = *fence;
    return rule;
}

}  // namespace

WriteRule Session::export_rule() const {
    return export_rule_of(resolved(), path_);
}

// Writes the matte of every frame of the range, with or without its edge tools, then calls `then`
// with the frames.
void Session::write_mattes(const std::string& pattern_text, MatteEdges edges,
                           std::function<void(const std::vector<int>&)> then) {
    const Region* region = region_by_id(document(), selected_);
    if (!region || !reader_) {
        notify(NoticeKind::kWarning, "Select a region to export its mattes.");
        return;
    }
    end_stroke();
    const auto [first, last] = playback_.range();
    const std::vector<int> frames(reader_->frames().begin() + first,
                                  reader_->frames().begin() + last + 1);
    const Project absolute = resolve_paths(document(), project_dir(path_));
    const MatteSource source = layer_source(*region_by_id(absolute, selected_), layer_);
    const MatteEdgePlan edge =
        edges == MatteEdges::kAsShown ? project_edge(source.edge) : MatteEdgePlan();
    start_for_document([this, pattern_text, frames, source, edge, size = reader_->size(), absolute,
                        plate = reader_, file = path_, id = region->id, layer = layer_,
                        drawn = drawn_, then = std::move(then)]() -> Finish {
        shelf_.flush();
        const auto write = [&]() -> Status {
            WEFT_TRY(pattern, SequencePattern::parse(pattern_text));
            const WriteRule rule = export_rule_of(absolute, file);
            WEFT_CHECK_OK(make_folder_of(pattern.path_for(frames.front()), rule));
            for (const int frame : frames) {
                Expected<Matte> matte = Matte();
                if (!source.shape.empty()) {
                    matte = drawn->matte(source.shape, source.select.invert, frame);
                } else if (!source.files.empty()) {
                    WEFT_TRY(files, matte_files(source.files, *plate));
                    matte = files.read(frame, source.select, size);
                } else if (const auto key = source.keyframes.find(frame);
                           key != source.keyframes.end()) {
                    matte = read_matte(key->second.path, source.select, size);
                } else {
                    matte = preview_.propagated_matte(id, layer, frame);
                }
                if (!matte) return tl::unexpected<Error>(matte.error());
                const Matte edged = with_edge(std::move(*matte), edge.at(frame));
                WEFT_CHECK_OK(write_matte(pattern.path_for(frame), edged, rule));
            }
            return {};
        };
        const Status done = write();
        return [this, done, frames, then] {
            if (done)
                then(frames);
            else
                notify(NoticeKind::kError, "Cannot write the mattes. " + done.error().text());
        };
    });
}

void Session::export_mattes(const std::string& pattern) {
    write_mattes(pattern, MatteEdges::kAsShown, [this, pattern](const std::vector<int>& frames) {
        notify(NoticeKind::kGood,
               "Wrote " + std::to_string(frames.size()) + " mattes to " + pattern + ".");
    });
}

// Frozen frames are read from files from now on, so other changes do not affect them.
void Session::freeze_mattes(bool frozen) {
    const Region* region = region_by_id(document(), selected_);
    if (!region) return;
    const RegionRef ref{region->id, {}};
    if (!frozen) {
        MatteSource matte = *region->matte;
        matte.frozen.clear();
        matte.frozen_files.clear();
        edit(SetMatte{ref, matte}, true);
        return;
    }
    if (layer_ != 0) {
        notify(NoticeKind::kWarning,
               "Holdouts and zones cannot be frozen. Select the region's own matte.");
        return;
    }
    if (region->matte->keyframes.empty()) {
        notify(NoticeKind::kWarning,
               "Only painted mattes can be frozen. Mattes from files do not change.");
        return;
    }
    const fs::path any = new_matte_path(region->id, 0);
    const std::string pattern =
        (any.parent_path() / (any.stem().string() + "_frozen.####.png")).string();
    // The edge tools go over them as over the others.
    write_mattes(pattern, MatteEdges::kNone, [this, ref, pattern](const std::vector<int>& frames) {
        const Region* now = region_by_id(document(), ref.id);
        if (!now) return;
        MatteSource matte = *now->matte;
        matte.frozen = frames;
        matte.frozen_files = beside_project(pattern);
        edit(SetMatte{ref, matte}, true);
        notify(NoticeKind::kInfo,
               "Froze the mattes of " + std::to_string(frames.size()) + " frames.");
    });
}

}  // namespace weft
