#include "app/motion_export/motion_frames.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "app/motion_export/vector_files.h"
#include "app/render/st_map_files.h"
#include "engine/core/hash.h"
#include "engine/media/exr_frame.h"
#include "engine/media/image_files.h"
#include "engine/media/metadata.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/st_maps.h"

namespace weft {
namespace {

// What the pictures of a frame are made of.
struct WrittenMotion {
    LatticeField ref_from_cur, next_from_cur, prev_from_cur;  // empty: not wanted, or no such frame
    Matte visible;
    float confidence = 1;
};

void add(Hasher& hasher, const LatticeField& field) {
    hasher.value(field.empty() ? 0 : field.spacing());
    if (!field.empty()) hasher.image(field.nodes());
}

// Only of what is in the pictures, so that those of one kind do not depend on the others.
std::string hash_of_maps(const WrittenMotion& motion) {
    Hasher hasher;
    add(hasher, motion.ref_from_cur);
    return hasher.image(motion.visible).finish().hex();
}

std::string hash_of_vectors(const WrittenMotion& motion) {
    Hasher hasher;
    add(hasher, motion.next_from_cur);
    add(hasher, motion.prev_from_cur);
    return hasher.image(motion.visible).value(motion.confidence).finish().hex();
}

Expected<LatticeField> to_neighbour(const MotionFramesInputs& in, int frame, int step,
                                    float& confidence) {
    const auto beside = in.motion.neighbour(frame, step);
    if (!in.spec.what.vectors || !beside || shows_black(in.shot, *beside)) return LatticeField();
    const int shown = in.shot.plate->shown_frame(*beside);
    WEFT_TRY(of_beside, in.surface.confidence(shown));
    confidence = std::min(confidence, of_beside);
    return in.surface.between(in.shot.plate->shown_frame(frame), shown);
}

Expected<WrittenMotion> motion_of(const MotionFramesInputs& in, int frame) {
    WrittenMotion out;
    if (shows_black(in.shot, frame)) {
        out.visible = Matte(in.surface.size());
        return out;
    }
    const int shown = in.shot.plate->shown_frame(frame);
    WEFT_TRY(visible, in.surface.visible(shown));
    out.visible = std::move(visible);
    WEFT_TRY(confidence, in.surface.confidence(shown));
    out.confidence = confidence;
    if (in.spec.what.st_maps) {
        WEFT_TRY(map, in.surface.between(shown, in.shot.plate->shown_frame(in.region.reference)));
        out.ref_from_cur = std::move(map);
    }
    WEFT_TRY(next, to_neighbour(in, frame, 1, out.confidence));
    out.next_from_cur = std::move(next);
    WEFT_TRY(prev, to_neighbour(in, frame, -1, out.confidence));
    out.prev_from_cur = std::move(prev);
    return out;
}

ImageF2 dense_inside(const LatticeField& field, const Matte& visible) {
    ImageF2 out(visible.size());
    const Recti box = matte_bounds(visible);
    if (field.empty() || box.empty()) return out;
    const ImageF2 inside = field.dense(box);
    for (int y = box.y0; y < box.y1; ++y)
        for (int x = box.x0; x < box.x1; ++x)
            if (visible.row(y)[x] > 0)
                std::copy_n(inside.pixel(x - box.x0, y - box.y0), 2, out.pixel(x, y));
    return out;
}

FrameVectors vectors_of(const WrittenMotion& motion) {
    FrameVectors out;
    out.forward = dense_inside(motion.next_from_cur, motion.visible);
    out.backward = dense_inside(motion.prev_from_cur, motion.visible);
    out.has_forward = !motion.next_from_cur.empty();
    out.has_backward = !motion.prev_from_cur.empty();
    out.visible = ImageF1(motion.visible.size());
    for (int y = 0; y < motion.visible.height(); ++y)
        for (int x = 0; x < motion.visible.width(); ++x)
            out.visible.at(x, y) = static_cast<float>(motion.visible.row(y)[x]) / 255.0f;
    out.confidence = motion.confidence;
    return out;
}

// One way in a file of its own.
Status write_one_way(const std::string& path, const StMap& map, StConvention convention,
                     WriteOptions write) {
    const Size size = map.visible.size();
    ImageF3 picture(size);
    ExrLayer uv{{"U", "V"}, true, {}};
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const float* st = map.st.pixel(x, y);
            float* to = picture.pixel(x, y);
            to[0] = st[0], to[1] = st[1], to[2] = map.visible.at(x, y);
            uv.samples.insert(uv.samples.end(), {st[0], st[1]});
        }
    }
    ExrFrame frame;
    frame.rgb = picture;
    frame.alpha = map.visible;
    if (convention == StConvention::kFusion) frame.layers.push_back(std::move(uv));
    write.depth = PixelDepth::kFloat;
    write.exr_compression = "zip";
    return write_exr(path, frame, write);
}

// The pictures of one frame, of which those that are there already may be kept.
class FramePictures {
  public:
    FramePictures(const MotionFramesInputs& in, int frame) : in_(in), frame_(frame) {}

    // What decides a picture.
    struct Source {
        std::string settings, inputs;
    };
    // Calls `write` with path and options unless the picture is kept.
    template <class Write>
    Status make(const std::string& relative, const Source& source, const Write& write) {
        WEFT_TRY(pattern, motion_pattern(in_.spec.folder, relative));
        const std::string path = pattern.path_for(frame_);
        Hasher hasher;
        hasher.text("weft.motion/1").text(source.settings);
        const std::string hash = hasher.finish().hex();
        if (is_kept(path, hash, source.inputs)) {
            ++done.kept;
            return {};
        }
        WriteOptions options;
        options.pixel_aspect = in_.shot.plate->pixel_aspect();
        options.metadata = {{"weft:version", WEFT_VERSION},
                            {"weft:settings", hash},
                            {"weft:inputs", source.inputs}};
        options.rule = in_.rule;
        WEFT_CHECK_OK(write(path, options));
        ++done.written;
        return {};
    }

    MotionPictures done;

  private:
    [[nodiscard]] bool is_kept(const std::string& path, const std::string& settings,
                               const std::string& inputs) const {
        if (in_.spec.existing != ExistingFrames::kResume) return false;
        auto had = read_recipe_metadata(path);
        if (had["weft:version"] != WEFT_VERSION || had["weft:settings"] != settings ||
            had["weft:inputs"] != inputs)
            return false;
        const auto image = read_image(path);
        return image && image->rgb.size() == in_.surface.size();
    }

    const MotionFramesInputs& in_;
    int frame_;
};

Status write_maps(const MotionFramesInputs& in, const WrittenMotion& motion,
                  FramePictures& pictures) {
    // Both ways at once, and only if one of them is written.
    std::optional<StMaps> found;
    const auto maps = [&]() -> const StMaps& {
        if (!found && motion.ref_from_cur.empty()) {
            const Size size = motion.visible.size();
            found = StMaps{{ImageF2(size), ImageF1(size)}, {ImageF2(size), ImageF1(size)}};
        } else if (!found) {
            found = st_maps_of(motion.ref_from_cur, motion.visible);
        }
        return *found;
    };
    const std::string settings = std::string("st ") + name_of(in.spec.st);
    const std::string inputs = hash_of_maps(motion);
    if (in.paths.stabilize.empty())
        return pictures.make(in.paths.st_map, {settings, inputs},
                             [&](const std::string& path, const WriteOptions& options) {
                                 return write_st_maps(path, maps(), options);
                             });
    WEFT_CHECK_OK(pictures.make(in.paths.st_map, {settings + " match-move", inputs},
                                [&](const std::string& path, const WriteOptions& options) {
                                    return write_one_way(path, maps().warp, in.spec.st, options);
                                }));
    return pictures.make(in.paths.stabilize, {settings + " stabilize", inputs},
                         [&](const std::string& path, const WriteOptions& options) {
                             return write_one_way(path, maps().stabilize, in.spec.st, options);
                         });
}

}  // namespace

Expected<MotionPictures> write_motion_frame(const MotionFramesInputs& in, int frame) {
    WEFT_TRY(motion, motion_of(in, frame));
    FramePictures pictures(in, frame);
    if (!in.paths.st_map.empty()) WEFT_CHECK_OK(write_maps(in, motion, pictures));
    if (in.paths.vectors.empty()) return pictures.done;
    const FrameVectors vectors = vectors_of(motion);
    const std::string inputs = hash_of_vectors(motion);
    for (const auto& [convention, pattern] : in.paths.vectors)
        WEFT_CHECK_OK(pictures.make(
            pattern, {std::string("vectors ") + name_of(convention), inputs},
            [&, convention = convention](const std::string& path, const WriteOptions& options) {
                return write_vectors(path, vectors, convention, options);
            }));
    return pictures.done;
}

}  // namespace weft
