#include "engine/media/encode.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <array>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <span>
#include <string_view>
#include <vector>

#include "engine/core/text.h"
#include "engine/media/atomic_file.h"
#include "engine/media/metadata.h"
#include "engine/media/picture_file.h"
#include "engine/media/png_writer.h"
#include "engine/media/read_back.h"

namespace weft {
namespace {

using OIIO::ImageOutput;
using OIIO::ImageSpec;

OIIO::TypeDesc type_of(SampleKind kind) {
    switch (kind) {
        case SampleKind::kU8:
            return OIIO::TypeUInt8;
        case SampleKind::kU16:
            return OIIO::TypeUInt16;
        case SampleKind::kHalf:
            return OIIO::TypeHalf;
        default:
            return OIIO::TypeFloat;
    }
}

// Attributes of the shot in a DPX header, as opposed to those of the pixel storage.
constexpr std::array kShotAttributes{"smpte:TimeCode",        "smpte:KeyCode",
                                     "dpx:TimeCode",          "dpx:FrameRate",
                                     "dpx:TemporalFrameRate", "dpx:FramePosition",
                                     "dpx:SequenceLength",    "dpx:HeldCount",
                                     "dpx:FrameId",           "dpx:SlateInfo",
                                     "dpx:ShutterAngle",      "dpx:Format",
                                     "dpx:InputDevice",       "dpx:InputDeviceSerialNumber",
                                     "dpx:FilmEdgeCode",      "dpx:FieldNumber"};

void keep_shot_attributes(const std::string& source, ImageSpec& spec) {
    const auto opened = open_picture(source);
    if (!opened) return;
    const auto& input = *opened;
    if (std::string_view(input->format_name()) != "dpx") return;
    for (const char* name : kShotAttributes) {
        if (const OIIO::ParamValue* kept = input->spec().find_attribute(name))
            spec.extra_attribs.add_or_replace(*kept);
    }
}

ImageSpec spec_of(const Samples& samples, const WriteOptions& options, const std::string& format) {
    ImageSpec spec(samples.size.width, samples.size.height, samples.channels,
                   type_of(samples.kind));
    // The samples go into the file as they are; a TIFF declares how they are meant.
    if (format != "tiff" || samples.alpha == AlphaKind::kStraight)
        spec.attribute("oiio:UnassociatedAlpha", 1);
    // OpenImageIO would write the current time, and the same frame would differ between runs.
    spec.attribute("DateTime", "1970:01:01 00:00:00");
    if (const double aspect = options.pixel_aspect.value_or(1); aspect != 1)
        spec.attribute("PixelAspectRatio", static_cast<float>(aspect));
    if (format == "openexr") {
        for (const auto& [name, text] : options.metadata)
            spec.attribute(name, text);
    } else if (!options.metadata.empty()) {
        // The field of a DPX ends after 100 characters.
        const bool is_dpx = format == "dpx";
        spec.attribute("Software", software_text(options.metadata, !is_dpx));
        if (is_dpx) spec.attribute("DocumentName", inputs_text(options.metadata));
        spec.attribute("Copyright", copyright_text(options.metadata));
    }
    if (format == "jpeg") {
        spec.attribute("Compression", "jpeg:" + std::to_string(options.jpeg_quality));
        spec.attribute("jpeg:subsampling", "4:4:4");
    } else if (format == "tiff") {
        spec.attribute("Compression", "zip");
        spec.attribute("tiff:zipquality", 4);
    } else if (format == "openexr") {
        spec.attribute("Compression",
                       options.exr_compression == "auto" ? "zip" : options.exr_compression);
    } else if (format == "dpx") {
        if (samples.kind == SampleKind::kU16)
            spec.attribute("oiio:BitsPerSample", options.dpx_bits);
        if (!options.source.empty()) keep_shot_attributes(options.source, spec);
    }
    if (format == "dpx" && options.dpx_log) spec.attribute("dpx:Transfer", "Logarithmic");
    return spec;
}

Error cannot_encode(const std::string& path, const std::string& reason) {
    std::string first_line = reason.substr(0, reason.find('\n'));
    if (first_line.empty()) first_line = "the encoder gave no reason";
    return {ErrorCode::kUnreadable,
            path + " cannot be written: " + first_line + ".",
            "Choose another format.",
            {}};
}

Status write_pixels(ImageOutput& output, const std::string& name, const ImageSpec& spec,
                    const Samples& samples, const std::string& path) {
    const OIIO::TypeDesc given =
        samples.kind == SampleKind::kHalf ? OIIO::TypeFloat : type_of(samples.kind);
    if (!output.open(name, spec) || !output.write_image(given, samples.data) || !output.close()) {
        return tl::unexpected(cannot_encode(path, output.geterror()));
    }
    return {};
}

Status put_on_disk(const std::string& path, std::span<const std::byte> bytes,
                   std::span<const WrittenPart> parts, const WriteRule& rule) {
    WEFT_TRY(temporary, TemporaryFile::create(path, rule));
    WEFT_CHECK_OK(temporary.write(bytes));
    WEFT_CHECK_OK(check_written_picture(temporary.name(), path, parts));
    return temporary.commit();
}

bool is_png_name(const std::string& path) {
    return lower_case(std::filesystem::path(path).extension().string()) == ".png";
}

Status encode(const std::string& path, const Samples& samples, const WriteOptions& options) {
    const std::array parts{WrittenPart{samples.size, samples.channels}};
    if (is_png_name(path))
        return put_on_disk(path, encode_png(samples, options).bytes(), parts, options.rule);
    auto output = ImageOutput::create(path);
    if (!output) return tl::unexpected(cannot_encode(path, OIIO::geterror()));
    const ImageSpec spec = spec_of(samples, options, output->format_name());
    if (output->supports("ioproxy")) {
        // Encoded into memory first, so that all disk errors get our messages.
        std::vector<unsigned char> bytes;
        OIIO::Filesystem::IOVecOutput proxy(bytes);
        if (!output->set_ioproxy(&proxy)) {
            return tl::unexpected(cannot_encode(path, output->geterror()));
        }
        WEFT_CHECK_OK(write_pixels(*output, path, spec, samples, path));
        return put_on_disk(path, std::as_bytes(std::span(bytes)), parts, options.rule);
    }
    WEFT_TRY(temporary, TemporaryFile::create(path, options.rule));
    if (Status written = write_pixels(*output, temporary.name(), spec, samples, path); !written) {
        WEFT_CHECK_OK(temporary.check_disk());
        return written;
    }
    WEFT_CHECK_OK(check_written_picture(temporary.name(), path, parts));
    return temporary.commit();
}

}  // namespace

Status write_samples(const std::string& path, const Samples& samples, const WriteOptions& options) {
    try {
        return encode(path, samples, options);
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::kNoSpace, path + " cannot be written: out of memory.");
    } catch (const std::exception& e) {
        return tl::unexpected(cannot_encode(path, e.what()));
    }
}

}  // namespace weft
