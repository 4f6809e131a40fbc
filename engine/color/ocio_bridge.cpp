#include "engine/color/ocio_bridge.h"

#include <OpenColorIO/OpenColorIO.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <mutex>
#include <utility>
#include <vector>

#include "engine/core/input_file.h"
#include "engine/core/parallel.h"
#include "engine/core/text.h"

namespace weft {
namespace {

namespace ocio = OCIO_NAMESPACE;

constexpr int kOcioBandRows = 16;

// As a sentence, which a remedy follows; not all of OpenColorIO's end in a full stop.
std::string reason_of(const ocio::Exception& error) {
    std::string reason = error.what();
    if (!reason.ends_with('.')) reason += '.';
    return reason;
}

// Names of scene-linear Rec.709/sRGB in common configs: ACES 2.x and 1.x studio and CG configs and
// their aliases, ACES 1.0-1.2, Blender's filmic, and the OpenColorIO samples.
constexpr std::array kLinearNames{"Linear Rec.709 (sRGB)",
                                  "lin_rec709_srgb",
                                  "lin_srgb",
                                  "lin_rec709",
                                  "lin_rec709_scene",
                                  "Utility - Linear - sRGB",
                                  "Utility - Linear - Rec.709",
                                  "Linear Rec.709",
                                  "Linear sRGB",
                                  "Linear BT.709",
                                  "linear_srgb",
                                  "linear_rec709",
                                  "Linear (sRGB)"};
constexpr std::array kEncodedNames{"sRGB - Texture",
                                   "sRGB Encoded Rec.709 (sRGB)",
                                   "srgb_tx",
                                   "srgb_texture",
                                   "srgb_rec709_scene",
                                   "Utility - sRGB - Texture",
                                   "Input - Generic - sRGB - Texture",
                                   "sRGB"};

// OpenColorIO's tables turn NaN and infinity into numbers; here these components keep their values.
struct Nonfinite {
    float* where;
    float value;
};

void collect_nonfinite(ImageView<float, 3> rgb, int y0, int y1, std::vector<Nonfinite>& found) {
    for (int y = y0; y < y1; ++y) {
        float* const row = rgb.row(y);
        for (int i = 0; i < 3 * rgb.width(); ++i) {
            if (!std::isfinite(row[i])) found.push_back({row + i, row[i]});
        }
    }
}

class OcioTransform final : public ColorTransform {
  public:
    OcioTransform(ocio::ConstCPUProcessorRcPtr processor, bool identity)
        : processor_(std::move(processor)), identity_(identity) {}

    void apply(ImageView<float, 3> rgb) const override {
        if (identity_ || rgb.empty()) return;
        parallel_rows(rgb.height(), kOcioBandRows, [&](int y0, int y1) {
            std::vector<Nonfinite> nonfinite;
            collect_nonfinite(rgb, y0, y1, nonfinite);
            ocio::PackedImageDesc band(rgb.row(y0), rgb.width(), y1 - y0, 3, ocio::BIT_DEPTH_F32,
                                       sizeof(float), 3 * sizeof(float),
                                       rgb.stride() * static_cast<std::ptrdiff_t>(sizeof(float)));
            processor_->apply(band);
            for (const Nonfinite& n : nonfinite)
                *n.where = n.value;
        });
    }
    bool identity() const override { return identity_; }

  private:
    ocio::ConstCPUProcessorRcPtr processor_;
    bool identity_;
};

// The sRGB curve continued as color_space.cpp does it: above 1, and mirrored below 0.
constexpr const char* kEncode = R"(
vec3 weft_srgb(vec3 linear) {
    vec3 v = abs(linear);
    vec3 high = 1.055 * pow(v, vec3(1.0 / 2.4)) - 0.055;
    return sign(linear) * mix(12.92 * v, high, step(vec3(0.0031308), v));
}
)";

ScreenShader::Table flat_table(const ocio::ConstGpuShaderDescRcPtr& shader, unsigned index) {
    const char *name = nullptr, *sampler = nullptr;
    unsigned width = 0, height = 0;
    ocio::GpuShaderDesc::TextureType channel{};
    ocio::Interpolation interpolation{};
    ScreenShader::Table out;
#if OCIO_VERSION_HEX >= 0x02030000
    ocio::GpuShaderDesc::TextureDimensions dimensions{};
    shader->getTexture(index, name, sampler, width, height, channel, dimensions, interpolation);
    out.dimensions = dimensions == ocio::GpuShaderDesc::TEXTURE_1D ? 1 : 2;
#else
    shader->getTexture(index, name, sampler, width, height, channel, interpolation);
    out.dimensions = height > 1 ? 2 : 1;
#endif
    out.sampler = sampler;
    out.width = static_cast<int>(width);
    out.height = static_cast<int>(height);
    out.channels = channel == ocio::GpuShaderDesc::TEXTURE_RED_CHANNEL ? 1 : 3;
    out.nearest = interpolation == ocio::INTERP_NEAREST;
    const float* values = nullptr;
    shader->getTextureValues(index, values);
    out.values.assign(
        values, values + std::size_t{width} * height * static_cast<std::size_t>(out.channels));
    return out;
}

ScreenShader::Table cube_table(const ocio::ConstGpuShaderDescRcPtr& shader, unsigned index) {
    const char *name = nullptr, *sampler = nullptr;
    unsigned edge = 0;
    ocio::Interpolation interpolation{};
    shader->get3DTexture(index, name, sampler, edge, interpolation);
    ScreenShader::Table out;
    out.sampler = sampler;
    out.dimensions = 3;
    out.width = out.height = out.depth = static_cast<int>(edge);
    // The shader source interpolates tetrahedrally by itself, from exact texels.
    out.nearest =
        interpolation == ocio::INTERP_NEAREST || interpolation == ocio::INTERP_TETRAHEDRAL;
    const float* values = nullptr;
    shader->get3DTextureValues(index, values);
    out.values.assign(values, values + std::size_t{3} * edge * edge * edge);
    return out;
}

// `encoded`: the input must first be encoded by the sRGB curve.
ScreenShader shader_of(const ocio::ConstProcessorRcPtr& processor, bool encoded) {
    ocio::GpuShaderDescRcPtr shader = ocio::GpuShaderDesc::CreateShaderDesc();
    shader->setLanguage(ocio::GPU_LANGUAGE_GLSL_1_3);
    shader->setFunctionName("weft_ocio");
    shader->setResourcePrefix("weft_");
    processor->getDefaultGPUProcessor()->extractGpuShaderInfo(shader);
    ScreenShader out;
    out.source = kEncode;
    out.source += shader->getShaderText();
    out.source += encoded ? "\nvec4 weft_screen(vec4 v) { return weft_ocio(vec4(weft_srgb(v.rgb), "
                            "v.a)); }\n"
                          : "\nvec4 weft_screen(vec4 v) { return weft_ocio(v); }\n";
    for (unsigned k = 0; k < shader->getNumTextures(); ++k)
        out.tables.push_back(flat_table(shader, k));
    for (unsigned k = 0; k < shader->getNum3DTextures(); ++k)
        out.tables.push_back(cube_table(shader, k));
    return out;
}

class Config final : public OcioConfig {
  public:
    Config(std::string path, ocio::ConstConfigRcPtr config)
        : path_(std::move(path)), config_(std::move(config)) {}

    bool knows(const std::string& name) const override {
        return config_->getColorSpace(name.c_str()) != nullptr;
    }

    std::string some_names() const override {
        constexpr int kShown = 12;
        std::string list;
        const int count = config_->getNumColorSpaces();
        for (int i = 0; i < std::min(count, kShown); ++i) {
            list += (list.empty() ? "" : ", ") + std::string(config_->getColorSpaceNameByIndex(i));
        }
        return count > kShown ? list + ", …" : list;
    }

    std::optional<Meeting> rec709() const override {
        for (const char* name : kLinearNames) {
            if (knows(name)) return Meeting{name, false};
        }
        // By convention, "linear" as a config's scene_linear means these primaries.
        if (const auto scene = config_->getColorSpace(ocio::ROLE_SCENE_LINEAR)) {
            if (same_ignoring_case(scene->getName(), "linear"))
                return Meeting{scene->getName(), false};
        }
        for (const char* name : kEncodedNames) {
            if (knows(name)) return Meeting{name, true};
        }
        return std::nullopt;
    }

    Expected<std::shared_ptr<const ColorTransform>> transform(
        const std::string& from, const std::string& to) const override {
        try {
            const auto processor = config_->getProcessor(from.c_str(), to.c_str());
            // Faster settings replace pow() by approximations that are too coarse for 16-bit codes.
            const auto cpu = processor->getOptimizedCPUProcessor(
                ocio::BIT_DEPTH_F32, ocio::BIT_DEPTH_F32, ocio::OPTIMIZATION_LOSSLESS);
            return std::make_shared<OcioTransform>(cpu, cpu->isNoOp());
        } catch (const ocio::Exception& e) {
            return fail(
                ErrorCode::kUsage,
                "OpenColorIO cannot convert '" + from + "' to '" + to + "': " + reason_of(e),
                "Choose other spaces.");
        }
    }

    std::string path() const override { return path_; }

    std::set<std::string> files_between(const std::string& from,
                                        const std::string& to) const override {
        std::set<std::string> files;
        try {
            const auto read =
                config_->getProcessor(from.c_str(), to.c_str())->getProcessorMetadata();
            for (int k = 0; k < read->getNumFiles(); ++k)
                files.insert(read->getFile(k));
        } catch (const ocio::Exception&) {
            // Whoever needs the conversion reports it.
        }
        return files;
    }

    std::vector<ScreenName> screens() const override {
        std::vector<ScreenName> out;
        const char* const usual = config_->getDefaultDisplay();
        if (!usual || !*usual) return out;
        out.push_back({usual, config_->getDefaultView(usual)});
        for (int d = 0; d < config_->getNumDisplays(); ++d) {
            const char* const display = config_->getDisplay(d);
            for (int v = 0; v < config_->getNumViews(display); ++v) {
                ScreenName name{display, config_->getView(display, v)};
                if (!(name == out.front())) out.push_back(std::move(name));
            }
        }
        return out;
    }

    std::vector<std::string> spaces() const override {
        std::vector<std::string> out;
        for (int k = 0; k < config_->getNumColorSpaces(); ++k)
            out.emplace_back(config_->getColorSpaceNameByIndex(k));
        return out;
    }

    Expected<std::shared_ptr<const ScreenView>> screen(const ScreenName& name,
                                                       const Meeting& meeting) const override {
        try {
            const auto transform = ocio::DisplayViewTransform::Create();
            transform->setSrc(meeting.space.c_str());
            transform->setDisplay(name.display.c_str());
            transform->setView(name.view.c_str());
            const auto processor = config_->getProcessor(transform);
            const auto cpu = processor->getOptimizedCPUProcessor(
                ocio::BIT_DEPTH_F32, ocio::BIT_DEPTH_F32, ocio::OPTIMIZATION_LOSSLESS);
            auto out = std::make_shared<ScreenView>();
            out->name = name;
            out->pixels = std::make_shared<OcioTransform>(cpu, cpu->isNoOp());
            out->shader = shader_of(processor, meeting.encoded);
            return out;
        } catch (const ocio::Exception& e) {
            return fail(ErrorCode::kUsage,
                        "OpenColorIO cannot show '" + name.view + "' of '" + name.display +
                            "': " + reason_of(e),
                        "Choose another view.");
        }
    }

  private:
    std::string path_;
    ocio::ConstConfigRcPtr config_;
};

}  // namespace

Expected<std::shared_ptr<const OcioConfig>> load_ocio_config() {
    static std::mutex mutex;
    static std::string loaded_path;
    static std::shared_ptr<const OcioConfig> loaded;
    const char* const variable = std::getenv("OCIO");
    if (!variable || !*variable) return std::shared_ptr<const OcioConfig>();
    const std::lock_guard lock(mutex);
    // A large config takes a good part of a second to load, and a process uses only one.
    if (loaded && loaded_path == variable) return loaded;
    // "ocio://default" names a config that OpenColorIO has built in.
    if (!std::string_view(variable).starts_with("ocio://")) {
        WEFT_CHECK_OK(check_input_file(variable, "The OpenColorIO config of $OCIO"));
    }
    try {
        ocio::SetLoggingLevel(ocio::LOGGING_LEVEL_NONE);
        loaded = std::make_shared<Config>(variable, ocio::Config::CreateFromFile(variable));
        loaded_path = variable;
        return loaded;
    } catch (const ocio::Exception& e) {
        loaded.reset();
        return fail(ErrorCode::kUnreadable,
                    std::string("The OpenColorIO config ") + variable +
                        " (from $OCIO) cannot be read: " + reason_of(e),
                    "Correct $OCIO or unset it.");
    }
}

}  // namespace weft
