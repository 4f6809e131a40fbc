// Painting, and the mattes that the view shows.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "app/base/background.h"
#include "app/mattes/matte_layer.h"
#include "app/project/codec/project_file.h"
#include "app/session/session.h"
#include "app/shot/matte_movies.h"
#include "app/shot/region_projection.h"
#include "engine/core/hash.h"
#include "engine/media/image_files.h"
#include "engine/media/sequence_pattern.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

std::string select_text(const MatteSelect& select) {
    return (select.value ? std::to_string(*select.value) : std::string()) + "/" + select.channel +
           (select.invert ? "/inverted" : "") + "/" + select.crypto;
}

// In the names of mattes: two editors may paint in one project at the same time, and a frozen frame
// must not be that of an earlier session.
const std::string& editor_tag() {
    static const std::string tag = [] {
        char host[256] = {};
        gethostname(host, sizeof host - 1);
        Hasher hasher;
        hasher.text(host).value(getpid());
        hasher.value(std::chrono::system_clock::now().time_since_epoch().count());
        constexpr std::size_t kDigits = 6;
        return hasher.finish().hex().substr(0, kDigits);
    }();
    return tag;
}

// A key of everything in the document that a propagated matte depends on.
std::string keys_text(const MatteSource& matte) {
    Hasher hasher;
    for (const auto& [frame, key] : matte.keyframes)
        hasher.value(frame).text(key.path);
    for (const auto& [frame, edge] : matte.confirmed)
        hasher.value(frame).text(edge.path).text(edge.area);
    hasher.value(matte.steadiness)
        .value(static_cast<int>(matte.propagate_direction))
        .value(matte.propagate_from.value_or(-1))
        .value(matte.propagate_to.value_or(-1));
    return hasher.finish().hex();
}

// The files of a matte for every frame; a Cryptomatte without files uses the plate's.
std::string files_of(const MatteSource& source, const std::string& plate) {
    if (!source.files.empty()) return source.files;
    return source.select.crypto.empty() ? std::string() : plate;
}

}  // namespace

// The name and the reader of a matte that is drawn from a shape.
std::pair<std::string, MatteShelf::Reader> Session::drawn_matte(const MatteSource& source,
                                                                int frame) const {
    const KeyedShape shape = absolute_shape(source);
    Hasher hasher;
    add_shape(hasher, shape);
    hasher.value(source.select.invert).value(frame);
    return {"shape " + hasher.finish().hex(),
            [drawn = drawn_, shape, invert = source.select.invert, frame] {
                return drawn->matte(shape, invert, frame);
            }};
}

RegionMatteView Session::matte_of(const Region& region, int layer, int frame, int place) {
    RegionMatteView out;
    out.region = region.id;
    out.layer = layer;
    out.frame = frame;
    if (const auto stroke = painting_.at({region.id, layer, frame})) {
        show_stroke(*stroke, out);
        return out;
    }
    const MatteSource& source = layer_source(region, layer);
    if (source.empty() || !reader_) return out;
    const std::string dir = project_dir(path_);
    const Size size = reader_->size();
    std::string name;
    MatteShelf::Reader read;
    const std::string files = files_of(source, document().plate.path);
    if (!source.shape.empty()) {
        out.kind = RegionMatteView::Kind::kFile;
        std::tie(name, read) = drawn_matte(source, frame);
    } else if (!files.empty()) {
        out.kind = RegionMatteView::Kind::kFile;
        const auto mattes = matte_files(resolve_path(dir, files), *reader_);
        if (!mattes) {
            out.kind = RegionMatteView::Kind::kFailed;
            out.error = mattes.error().text();
            return out;
        }
        name = mattes->path_for(frame) + "|" + select_text(source.select);
        if (mattes->is_movie()) name += "|" + std::to_string(frame);
        read = [mattes = *mattes, select = source.select, size, frame] {
            return mattes.read(frame, select, size);
        };
    } else if (const auto key = source.keyframes.find(frame); key != source.keyframes.end()) {
        out.kind = RegionMatteView::Kind::kPainted;
        const std::string path = resolve_path(dir, key->second.path);
        name = path;
        read = [path, select = source.select, size] { return read_matte(path, select, size); };
    } else {
        out.kind = RegionMatteView::Kind::kPropagated;
        name = "propagated " + std::to_string(document_id_) + " " + std::to_string(region.id) +
               " " + std::to_string(layer) + " " + std::to_string(frame) + " " + keys_text(source);
        read = [this, id = region.id, layer, frame] {
            return preview_.propagated_matte(id, layer, frame);
        };
        // It may exist now; retry.
        if (!shelf_.error(name).empty()) {
            const std::uint64_t now = preview_.matte_version();
            std::uint64_t& tried = missed_mattes_[name];
            if (tried != now) shelf_.forget(name);
            tried = now;
        }
    }
    out.keep = shelf_.get(name, read);
    if (!out.keep && out.kind == RegionMatteView::Kind::kPropagated)
        out.keep = confirmed_matte(source, frame);
    if (!out.keep) {
        out.error = shelf_.error(name);
        const bool propagated = out.kind == RegionMatteView::Kind::kPropagated;
        out.kind = out.error.empty() || propagated ? RegionMatteView::Kind::kLoading
                                                   : RegionMatteView::Kind::kFailed;
        return out;
    }
    Shown& shown = shown_mattes_[{region.id, layer, place}];
    out.edged = shown.edged.of(out.keep, project_edge(source.edge).at(frame), name, shelf_);
    const MattePtr& visible = out.edged ? out.edged : out.keep;
    if (shown.matte != visible) shown = {shown.edged, visible, next_picture_id()};
    out.version = shown.version;
    out.pixels = visible->view();
    return out;
}

void Session::show_stroke(const MattePainting::Shown& stroke, RegionMatteView& out) {
    out.kind = RegionMatteView::Kind::kPainted;
    out.pixels = stroke.pixels;
    out.version = stroke.version;
    out.changed = stroke.changed;
}

bool Session::may_paint() {
    const Region* region = region_by_id(document(), selected_);
    if (!region) {
        notify(NoticeKind::kWarning, "Add a region first; then paint its matte.");
    } else if (locked_.contains(selected_)) {
        notify(NoticeKind::kWarning, "'" + region->name + "' is locked. Unlock it to paint.");
    } else if (!layer_source(*region, layer_).files.empty() ||
               !layer_source(*region, layer_).select.crypto.empty()) {
        notify(NoticeKind::kWarning, "The matte of '" + layer_name(*region, layer_) +
                                         "' comes from files. Choose 'Paint instead' to make it "
                                         "your own.");
    } else if (!layer_source(*region, layer_).shape.empty()) {
        notify(NoticeKind::kWarning, "The matte of '" + layer_name(*region, layer_) +
                                         "' is drawn from a shape. Change the shape, or choose "
                                         "'Surface' under Follow to paint keyframes.");
    } else if (!reader_) {
        notify(NoticeKind::kWarning, "The plate is not open yet.");
    } else if (changing_) {
        notify(NoticeKind::kWarning, "Updating matte…");
    } else {
        return true;
    }
    return false;
}

std::optional<MattePtr> Session::matte_to_paint_on() {
    const Region* region = region_by_id(document(), selected_);
    const RegionMatteView shown = matte_of(*region, layer_, playback_.frame());
    if (shown.keep) return shown.keep;
    if (shown.kind == RegionMatteView::Kind::kLoading &&
        layer_source(*region, layer_).keyframes.contains(playback_.frame())) {
        notify(NoticeKind::kWarning, "This keyframe is still being read. Try again in a moment.");
        return std::nullopt;
    }
    return nullptr;
}

// Prepares a stroke at the playhead.
void Session::prepare_stroke() {
    const Region* region = painted_region();
    const bool still = playback_.direction() == 0 && read_frame_ == playback_.frame();
    if (!region || !reader_ || !still || changing_ || locked_.contains(selected_)) return;
    const MatteSource& source = layer_source(*region, layer_);
    if (source.by_frame() || !source.select.crypto.empty()) return;
    const auto& views = layer_ == 0 ? view_.mattes : layer_ > 0 ? view_.holdouts : view_.zones;
    const auto shown = std::find_if(views.begin(), views.end(), [&](const RegionMatteView& view) {
        return view.region == selected_ && view.layer == layer_;
    });
    if (shown == views.end() || shown->kind == RegionMatteView::Kind::kLoading) return;
    painting_.prepare(shown->keep, reader_->size());
}

void Session::begin_stroke(const BeginStroke& action) {
    end_stroke();
    confirming_.reset();
    if (!open_ || !may_paint()) return;
    if (action.kind == StrokeKind::kConfirm)
        begin_confirming(action);
    else
        begin_painting(action);
}

void Session::begin_painting(const BeginStroke& action) {
    const auto before = matte_to_paint_on();
    if (!before) return;
    if (counts_in_part(action.kind == StrokeKind::kHere) && !(confirming_ = confirming_here()))
        return;
    playback_.stop();
    painting_.begin(painted_place(), *before, reader_->size(), action.brush);
    painting_.move_to(action.at, action.pressure);
}

void Session::end_stroke() {
    const auto done = painting_.end();
    const Region* region = done ? region_by_id(document(), done->place.region) : nullptr;
    if (!region) return;
    if (done->place.confirmed)
        return keep_confirmed({confirming_->matte, done->matte}, done->place, "Confirm edge of ");
    if (confirming_)
        return keep_here(done->matte, done->stroke->covered(), *confirming_, done->place,
                         "Correct ");
    keep_matte(done->matte, done->place,
               "Paint " + layer_name(*region, done->place.layer) + " on frame " +
                   std::to_string(done->place.frame));
}

std::string Session::new_matte_path(RegionId region, int frame) {
    const std::string name =
        "region" + std::to_string(region) + "_" + std::to_string(frame) + "_" + editor_tag() + "_";
    const fs::path folder =
        path_.empty()
            ? fs::path(options_.state_folder) / "unsaved" / std::to_string(getpid())
            : fs::path(project_dir(path_)) / (fs::path(path_).stem().string() + "_mattes");
    for (;;) {
        // Each version has a new name, so that undo finds the older file.
        const fs::path path = folder / (name + std::to_string(++matte_serial_) + ".png");
        std::error_code error;
        if (!fs::exists(path, error)) return path.string();
    }
}

std::string Session::beside_project(const std::string& path) const {
    return path_.empty() ? path : fs::path(path).lexically_relative(project_dir(path_)).string();
}

void Session::keep_matte(MattePtr matte, const MattePlace& place, const std::string& label,
                         const std::optional<RotoShape>& shape) {
    const Region* target = region_by_id(document(), place.region);
    if (!target) return;
    const std::string path = new_matte_path(place.region, place.frame);
    shelf_.write(path, std::move(matte));
    mattes_unwritten_ = true;
    // The shape of an older keyframe does not describe the new matte.
    MatteSource source = layer_source(*target, place.layer);
    source.keyframes[place.frame] = {beside_project(path), shape};
    source.confirmed.erase(place.frame);
    auto changed =
        apply_edit(history_.current(), set_layer(*target, place.layer, source, begun_zone_));
    if (!changed) {
        notify(NoticeKind::kError, changed.error().text());
        return;
    }
    commit(std::move(*changed), label);
}

void Session::change_matte(std::function<Matte(const Matte&)> change, std::string label,
                           bool here_only) {
    end_stroke();
    if (!open_ || !may_paint()) return;
    auto before = matte_to_paint_on();
    if (!before) return;
    std::optional<Confirming> part;
    if (counts_in_part(here_only) && !(part = confirming_here())) return;
    changing_.emplace();
    changing_->part = std::move(part);
    changing_->place = painted_place();
    changing_->label = std::move(label);
    changing_->matte =
        in_background([change = std::move(change), matte = std::move(*before),
                       size = reader_->size()] { return change(matte ? *matte : Matte(size)); });
}

bool Session::abandon_change() {
    const bool any = changing_.has_value();
    abandon(changing_, [](Changing& one) { return std::move(one.matte); });
    after_change_ = nullptr;
    return any;
}

void Session::take_changed_matte() {
    if (!changing_ ||
        changing_->matte.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return;
    Changing done = std::move(*changing_);
    changing_.reset();
    const auto matte = std::make_shared<const Matte>(done.matte.get());
    if (done.part)
        keep_here(matte, changed_area(*done.part->matte, *matte), *done.part, done.place,
                  done.label + ", ");
    else
        keep_matte(matte, done.place, done.label + " on frame " + std::to_string(done.place.frame),
                   done.shape);
    if (const auto next = std::exchange(after_change_, nullptr)) next();
}

void Session::paint_instead() {
    const Region* region = region_by_id(document(), selected_);
    if (!region || !reader_ ||
        (layer_source(*region, layer_).files.empty() &&
         layer_source(*region, layer_).select.crypto.empty()))
        return;
    const RegionMatteView shown = matte_of(*region, layer_, playback_.frame());
    if (!shown.keep) {
        notify(NoticeKind::kWarning,
               "The matte of this frame is still being read. Try again in a moment.");
        return;
    }
    const std::string path = new_matte_path(region->id, playback_.frame());
    shelf_.write(path, shown.keep);
    mattes_unwritten_ = true;
    MatteSource painted;
    painted.keyframes[playback_.frame()] = {beside_project(path), {}};
    const std::string name = layer_name(*region, layer_);
    edit(set_layer(*region, layer_, painted, begun_zone_), true);
    notify(NoticeKind::kInfo, "Frame " + std::to_string(playback_.frame()) +
                                  " is now a painted keyframe of '" + name +
                                  "'. It is propagated to the other frames.");
}

void Session::copy_keyframe(int from, int to) {
    const Region* region = region_by_id(document(), selected_);
    if (!region || !layer_source(*region, layer_).keyframes.contains(from)) {
        notify(NoticeKind::kWarning, "There is no painted keyframe before this frame.");
        return;
    }
    // Files never change once written, so both keyframes may use the same one.
    MatteSource source = layer_source(*region, layer_);
    source.keyframes[to] = {source.keyframes.at(from).path, {}};
    source.confirmed.erase(to);
    edit(set_layer(*region, layer_, source, begun_zone_), true);
}

}  // namespace weft
