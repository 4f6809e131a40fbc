#include "app/shot/pass_choice.h"

#include <filesystem>
#include <functional>
#include <optional>

#include "app/exchange/region_matte_sources.h"
#include "app/shot/form_files.h"
#include "engine/core/setting.h"
#include "engine/core/text.h"
#include "engine/form/reciprocal_depth.h"
#include "engine/media/cryptomatte.h"
#include "engine/media/form_passes.h"
#include "engine/media/image_files.h"
#include "engine/media/light_passes.h"
#include "engine/media/sequence_pattern.h"
#include "engine/media/stereo_views.h"

namespace weft {
namespace {

bool is_exr(const std::string& files) {
    return lower_case(std::filesystem::path(files).extension().string()) == ".exr";
}

std::optional<std::string> first_file(const std::string& files, const std::vector<int>& frames) {
    const auto pattern = SequencePattern::parse(files);
    if (!pattern) return std::nullopt;
    std::error_code ignored;
    for (const int frame : frames) {
        std::string path = pattern->path_for(frame);
        if (std::filesystem::exists(path, ignored)) return path;
        if (pattern->is_single()) break;
    }
    return std::nullopt;
}

// Of another view than the plate's layer, which without a view in its name is of the first one.
bool is_of_another_view(const PassLayer& pass, const std::string& plate) {
    if (pass.view.empty()) return false;
    std::string view = split_view(plate, {pass.view}).view;
    if (view.empty()) view = split_view(plate, {}).view;
    return view.empty() ? !pass.first_view : !same_ignoring_case(view, pass.view);
}

class Chooser {
  public:
    Chooser(Region& region, const Plate& plate, const std::vector<int>& frames)
        : region_(region), plate_(plate), frames_(frames) {
        if (!plate.layer.empty()) beside_.push_back(plate.layer);
        const MatteSource& matte = *region.matte;
        if (matte.select.crypto.empty()) return;
        const auto path = first_file(matte.files, frames);
        if (!path) return;
        const std::string layer = cryptomatte_layer(*path, matte.select.crypto);
        if (!layer.empty()) beside_.push_back(layer);
    }

    Status choose() {
        choose_ids();
        MotionSource& motion = region_.motion;
        if (motion.convention != MotionConvention::kFiles) {
            const MotionSelect select{motion.convention, motion.direction, motion.layer};
            WEFT_CHECK_OK(settle(
                "motion pass", motion.files, motion.layer, setting::kMotionLayer,
                [&](const std::string& path) { return locate_motion(path, select, beside_); }));
        }
        Placement& placement = region_.placement;
        WEFT_CHECK_OK(settle(
            "UV pass", placement.uv, placement.uv_layer, setting::kUvLayer,
            [&](const std::string& path) { return locate_uv(path, placement.uv_layer, beside_); }));
        WEFT_CHECK_OK(choose_form());
        return choose_light();
    }

    PassChoice choice;

  private:
    using Locate = std::function<Expected<FoundPass>(const std::string&)>;

    // A file that is not there is reported where it is missed.
    Status settle(const std::string& what, const std::string& files, std::string& layer,
                  std::string_view setting, const Locate& locate) {
        const auto path = files.empty() ? std::nullopt : first_file(files, frames_);
        if (!path) return {};
        WEFT_TRY(found, locate(*path));
        warn_of_codec(what, *path, found);
        if (!layer.empty()) return {};
        layer = found.layer.name;
        if (!found.also_called.empty()) tell_choice(what, files, found, setting);
        if (is_of_another_view(found.layer, plate_.layer)) {
            choice.warnings.push_back("Region '" + region_.name + "': the " + what + " " + *path +
                                      " has the view '" + found.layer.view +
                                      "' only, and the plate is of another. Name its layer if it "
                                      "is meant" +
                                      by({{setting}}) + ".");
        }
        return {};
    }

    // One layer of ids is found by each file; of several it is named here.
    void choose_ids() {
        change_matte_sources(region_, [&](MatteSource& matte) {
            MatteSelect& select = matte.select;
            if (!select.value || !select.channel.empty() || !select.crypto.empty()) return;
            std::optional<std::string> path;
            if (!matte.files.empty())
                path = first_file(matte.files, frames_);
            else if (!matte.keyframes.empty())
                path = matte.keyframes.begin()->second.path;
            const auto found = path ? find_ids(*path, beside_) : std::nullopt;
            if (!found || found->also_called.empty()) return;
            const std::string& channel = found->channels.front();
            select.channel = found->layer.prefixed ? channel : found->layer.name + "." + channel;
            tell_choice("matte of ids", matte.files, *found, setting::kMatteChannel);
        });
    }

    Status choose_form() {
        FormParams& form = region_.form;
        FinishParams& finish = region_.finish;
        const std::string used = form_files(region_).pattern;
        if (!used.empty() && used == form.position) {
            WEFT_CHECK_OK(settle("position pass", used, form.position_layer,
                                 setting::kPositionLayer, [&](const std::string& path) {
                                     return locate_positions(path, form.position_layer, beside_);
                                 }));
        } else if (!used.empty() && used == form.normal && is_exr(used)) {
            WEFT_CHECK_OK(settle("normal pass", used, form.normal_layer, setting::kNormalLayer,
                                 [&](const std::string& path) {
                                     return locate_normals(path, form.normal_layer, beside_);
                                 }));
            warn_of_axes(form);
        }
        const bool depth = finish.focus > 0 || form.source == FormSource::kDepth;
        if (!depth || !is_exr(finish.depth)) return {};
        WEFT_CHECK_OK(settle("depth pass", finish.depth, finish.depth_layer, setting::kDepthLayer,
                             [&](const std::string& path) {
                                 return locate_depth(path, finish.depth_layer, beside_);
                             }));
        return warn_of_reciprocals(finish);
    }

    Status choose_light() {
        LightParams& light = region_.light;
        const bool albedo = light.lighting.empty();
        const std::string& files = albedo ? light.albedo : light.lighting;
        const auto path = files.empty() ? std::nullopt : first_file(files, frames_);
        if (!path) return {};
        if (light.pass_layer.empty()) {
            WEFT_TRY(layer,
                     find_light_layer(*path, albedo ? LightPass::kAlbedo : LightPass::kLighting,
                                      beside_));
            light.pass_layer = std::move(layer);
        }
        if (files != plate_.path || !is_same_picture(*path, light.pass_layer, plate_.layer))
            return {};
        const std::string what = albedo ? "albedo" : "lighting";
        return fail(ErrorCode::kUnreadable,
                    "The " + what + " pass " + *path +
                        " is the plate's own picture, light and colour together.",
                    "Give the " + what + " pass" +
                        by({{albedo ? setting::kAlbedo : setting::kLighting}}) +
                        ", or name its layer" + by({{setting::kLightLayer}}) + ".");
    }

    // The DCT of DWAA and DWAB is applied to channels of these names, which are colours to it.
    void warn_of_codec(const std::string& what, const std::string& path, const FoundPass& found) {
        std::string changed;
        for (const std::string& channel : found.channels) {
            const std::string last = channel.substr(channel.rfind('.') + 1);
            if (last == "Y" || last == "R" || last == "G" || last == "B")
                changed += (changed.empty() ? "" : ", ") + last;
        }
        if (!found.layer.codec.starts_with("dwa") || changed.empty()) return;
        choice.warnings.push_back("The " + what + " " + path + " is compressed with " +
                                  (found.layer.codec.starts_with("dwab") ? "DWAB" : "DWAA") +
                                  ", which changes its channel " + changed +
                                  ": expect errors of some thousandths of the scene's size. Write "
                                  "passes with a lossless codec such as ZIP.");
    }

    Status warn_of_reciprocals(const FinishParams& finish) {
        const auto path = first_file(finish.depth, frames_);
        if (!path) return {};
        WEFT_TRY(depth, read_depth(*path, finish.depth_layer, Size()));
        if (!looks_reciprocal(depth)) return {};
        choice.warnings.push_back(
            "Region '" + region_.name + "': the depth pass " + *path +
            " seems to hold reciprocal distances (1/z), as Nuke's ScanlineRender and depth buffers "
            "do: its planes are straight as they stand. It is read as distances; convert it to "
            "them, as by the expression 1/z.");
        return {};
    }

    void warn_of_axes(const FormParams& form) {
        const auto path = first_file(form.normal, frames_);
        if (!path || axes_of_normals(form, *path) != NormalAxes::kPresumedCamera) return;
        choice.warnings.push_back(
            "Region '" + region_.name + "': the normal pass " + *path +
            " does not tell whether its axes are the camera's or the world's, as those of Cycles "
            "and Arnold are. They are taken for the camera's; set them" +
            by({{setting::kNormalSpace, "camera"}, {setting::kNormalSpace, "world"}}) + ".");
    }

    void tell_choice(const std::string& what, const std::string& files, const FoundPass& found,
                     std::string_view setting) {
        std::string others;
        for (const std::string& name : found.also_called)
            others += (others.empty() ? "" : ", ") + name;
        // Without a layer the plate is of its file's first view, too.
        const bool with_plate = found.told == FoundPass::Told::kByNeighbour ||
                                (found.told == FoundPass::Told::kByView && files == plate_.path);
        auto& told = with_plate ? choice.notes : choice.warnings;
        told.push_back("Region '" + region_.name + "': the " + what + " is the layer " +
                       found.layer.name + ", " + found.why + ", not " + others +
                       ". Name another if needed" + by({{setting}}) + ".");
    }

    Region& region_;
    const Plate& plate_;
    const std::vector<int>& frames_;
    std::vector<std::string> beside_;
};

}  // namespace

Expected<PassChoice> choose_pass_layers(Region& region, const Plate& plate,
                                        const std::vector<int>& frames) {
    Chooser chooser(region, plate, frames);
    WEFT_CHECK_OK(chooser.choose());
    return std::move(chooser.choice);
}

}  // namespace weft
