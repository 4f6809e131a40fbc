#include "app/session/mattes/matte_export.h"

#include <filesystem>
#include <memory>
#include <utility>

#include "app/exchange/input_files.h"
#include "app/mattes/matte_layer.h"
#include "app/preview/propagation_key.h"
#include "app/shot/drawn_mattes.h"
#include "app/shot/matte_movies.h"
#include "app/shot/region_projection.h"
#include "engine/media/frame_writer.h"
#include "engine/media/image_files.h"
#include "engine/media/sequence_pattern.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

// What is written, independent of the session.
struct MattesToWrite {
    std::string pattern;
    std::vector<int> frames;
    MatteSource source;
    MatteEdgePlan edge;
    RegionId region = 0;
    int layer = 0;
    std::string keyed;  // the propagation_key() of propagated ones
    std::shared_ptr<const FrameReader> plate;
    std::shared_ptr<const DrawnMattes> drawn;

    [[nodiscard]] Expected<Matte> matte(int frame, const Preview& preview) const {
        const Size size = plate->size();
        if (!source.shape.empty()) return drawn->matte(source.shape, source.select.invert, frame);
        if (!source.files.empty()) {
            WEFT_TRY(files, matte_files(source.files, *plate));
            return files.read(frame, source.select, size);
        }
        if (const auto key = source.keyframes.find(frame); key != source.keyframes.end())
            return read_matte(key->second.path, source.select, size);
        return preview.propagated_matte({region, layer, frame, keyed});
    }
};

Status write_all(const MattesToWrite& what, const WriteRule& rule, const Preview& preview) {
    WEFT_TRY(pattern, SequencePattern::parse(what.pattern));
    WEFT_CHECK_OK(make_folder_of(pattern.path_for(what.frames.front()), rule));
    for (const int frame : what.frames) {
        WEFT_TRY(matte, what.matte(frame, preview));
        const Matte edged = with_edge(std::move(matte), what.edge.at(frame));
        WEFT_CHECK_OK(write_matte(pattern.path_for(frame), edged, rule));
    }
    return {};
}

}  // namespace

WriteRule export_rule_of(const Project& absolute, const std::string& project_file) {
    WriteRule rule;
    rule.existing = Existing::kReplace;
    // Cannot fail without a root.
    if (const auto fence = make_fence(absolute, {{}, {project_file}})) rule.fence = *fence;
    return rule;
}

void MatteExport::write(const std::string& pattern, Edges edges, Then then) {
    if (!region() || !use_.plate.reader()) {
        use_.notices.add(NoticeKind::kWarning, "Select a region to export its mattes.");
        return;
    }
    use_.end_stroke();
    const Project absolute = use_.document.resolved();
    const auto& all = use_.plate.reader()->frames();
    const auto [first, last] = use_.playback.range();
    MattesToWrite what;
    what.pattern = pattern;
    what.frames = {all.begin() + first, all.begin() + last + 1};
    what.region = use_.selection.region;
    what.layer = use_.selection.layer;
    const Region& exported = *use_.selection.of(absolute);
    what.source = layer_source(exported, what.layer);
    what.keyed = propagation_key(absolute, exported, what.layer);
    if (edges == Edges::kAsShown) what.edge = project_edge(what.source.edge);
    what.plate = use_.plate.reader();
    what.drawn = use_.plate.drawn();
    use_.tasks.start_for_document([this, what = std::move(what), absolute,
                                   file = use_.document.path(),
                                   then = std::move(then)]() -> DocumentTasks::Finish {
        use_.shelf.flush();
        const Status done = write_all(what, export_rule_of(absolute, file), use_.preview);
        return [this, done, frames = what.frames, then] {
            if (done)
                then(frames);
            else
                use_.notices.add(NoticeKind::kError,
                                 "Cannot write the mattes. " + done.error().text());
        };
    });
}

void MatteExport::export_to(const std::string& pattern) {
    write(pattern, Edges::kAsShown, [this, pattern](const std::vector<int>& frames) {
        use_.notices.add(NoticeKind::kGood,
                         "Wrote " + std::to_string(frames.size()) + " mattes to " + pattern + ".");
    });
}

void MatteExport::thaw() {
    const Region* frozen = region();
    if (!frozen) return;
    MatteSource matte = *frozen->matte;
    matte.frozen.clear();
    matte.frozen_files.clear();
    use_.document.edit(SetMatte{{frozen->id, {}}, matte});
}

// Frozen frames are read from files from now on, so other changes do not affect them.
void MatteExport::freeze() {
    const Region* painted = region();
    if (!painted) return;
    if (use_.selection.layer != 0) {
        use_.notices.add(NoticeKind::kWarning,
                         "Holdouts and zones cannot be frozen. Select the region's own matte.");
        return;
    }
    if (painted->matte->keyframes.empty()) {
        use_.notices.add(NoticeKind::kWarning,
                         "Only painted mattes can be frozen. Mattes from files do not change.");
        return;
    }
    const fs::path any = use_.folder.new_path(painted->id, 0);
    const std::string pattern =
        (any.parent_path() / (any.stem().string() + "_frozen.####.png")).string();
    // The edge tools go over them as over the others.
    write(pattern, Edges::kNone, [this, id = painted->id, pattern](const std::vector<int>& frames) {
        const Region* now = region_by_id(use_.document.project(), id);
        if (!now) return;
        MatteSource matte = *now->matte;
        matte.frozen = frames;
        matte.frozen_files = use_.folder.beside_project(pattern);
        use_.document.edit(SetMatte{{id, {}}, matte});
        use_.notices.add(NoticeKind::kInfo,
                         "Froze the mattes of " + std::to_string(frames.size()) + " frames.");
    });
}

}  // namespace weft
