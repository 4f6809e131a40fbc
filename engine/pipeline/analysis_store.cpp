#include "engine/pipeline/analysis_store.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "engine/core/byte_stream.h"

namespace weft {
namespace {

constexpr int kLargestSide = 1 << 16;

double area(Size s) {
    return static_cast<double>(s.width) * s.height;
}

bool sane(Size s) {
    return s.width >= 0 && s.height >= 0 && s.width <= kLargestSide && s.height <= kLargestSide;
}

tl::unexpected<Error> damaged(const char* what) {
    return fail(ErrorCode::kRenderFailed, std::string("The cached ") + what + " is damaged.",
                "Delete the cache folder and render again.");
}

// Shading is kept as round(log2(v) · 2048) + 32768: from 2^-16 to 2^16.
constexpr float kLogSteps = 2048.0f;

std::uint16_t log_code(float v) {
    const float code = std::log2(std::max(v, 1e-9f)) * kLogSteps + 32768.5f;
    return static_cast<std::uint16_t>(std::clamp(code, 0.0f, 65535.0f));
}

float from_log_code(std::uint16_t code) {
    return std::exp2((static_cast<float>(code) - 32768.0f) / kLogSteps);
}

}  // namespace

Bytes encode(const StoredMatte& m) {
    ByteWriter out;
    out.value(m.matte.size()).value(m.confidence).raw(m.matte.data(), m.matte.size_bytes());
    const auto put_if_any = [&](const auto& image) {
        out.value(static_cast<std::uint8_t>(!image.empty()));
        if (!image.empty()) out.raw(image.data(), image.size_bytes());
    };
    put_if_any(m.followed);
    put_if_any(m.since);
    return out.value(m.since_confidence).take();
}

namespace {

ByteWriter& write(ByteWriter& to, const LatticeField& field) {
    return to.value(field.full_size())
        .value(field.spacing())
        .raw(field.nodes().data(), field.nodes().size_bytes());
}

}  // namespace

Bytes encode(const LatticeField& field) {
    ByteWriter out;
    return write(out, field).take();
}

Bytes encode(const FormMap& form) {
    ByteWriter out;
    const FormFinding& f = form.finding;
    write(out, form.displacement)
        .value(form.origin)
        .value(f.source)
        .value(static_cast<std::uint8_t>(f.plane))
        .value(f.frames)
        .value(f.belief)
        .value(f.tilt_deg)
        .value(f.tilt_error_deg)
        .value(f.fov_deg)
        .value(f.fov_error_deg)
        .value(f.fov_regions)
        .value(static_cast<std::uint8_t>(f.no_parallax))
        .value(form.aspect.ratio())
        .value(form.relief_fov_deg);
    if (!form.relief.empty()) write(out, form.relief);
    return out.take();
}

Bytes encode(const Shading& shading) {
    std::vector<std::uint16_t> codes;
    codes.reserve(shading.value.size_bytes() / sizeof(float));
    for (int y = 0; y < shading.value.height(); ++y) {
        const float* row = shading.value.row(y);
        std::transform(row, row + shading.value.width(), std::back_inserter(codes), log_code);
    }
    return ByteWriter()
        .value(shading.full)
        .value(shading.downscale)
        .value(shading.value.size())
        .raw(codes.data(), codes.size() * sizeof codes[0])
        .value(static_cast<std::uint8_t>(!shading.sure.empty()))
        .raw(shading.sure.data(), shading.sure.size_bytes())
        .take();
}

Bytes encode(const StillSurface& still) {
    std::vector<std::uint16_t> codes(still.colour.size_bytes() / sizeof(float));
    std::transform(still.colour.data(), still.colour.data() + codes.size(), codes.begin(),
                   log_code);
    std::vector<std::uint8_t> known(still.known.size_bytes() / sizeof(float));
    std::transform(still.known.data(), still.known.data() + known.size(), known.begin(),
                   [](float w) { return static_cast<std::uint8_t>(w > 0); });
    return ByteWriter()
        .value(still.box)
        .value(still.pixel_px)
        .value(still.usual)
        .value(still.confidence)
        .raw(codes.data(), codes.size() * sizeof codes[0])
        .raw(known.data(), known.size())
        .take();
}

namespace {

// Luma is a natural logarithm.
constexpr float kLumaSteps = kLogSteps * 1.44269504f;

std::vector<std::int16_t> luma_codes(const ImageF1& luma) {
    std::vector<std::int16_t> codes(luma.size_bytes() / sizeof(float));
    std::transform(luma.data(), luma.data() + codes.size(), codes.begin(), [](float v) {
        return static_cast<std::int16_t>(
            std::clamp(std::floor(v * kLumaSteps + 0.5f), -32768.0f, 32767.0f));
    });
    return codes;
}

ImageF1 from_luma_codes(const std::vector<std::int16_t>& codes, Size size) {
    ImageF1 luma(size);
    std::transform(codes.begin(), codes.end(), luma.data(),
                   [](std::int16_t code) { return static_cast<float>(code) / kLumaSteps; });
    return luma;
}

}  // namespace

Bytes encode(const SurfaceSample& s) {
    // Weights above 0 stay above 0, because they mark where the surface is.
    std::vector<std::uint8_t> weight(s.weight.size_bytes() / sizeof(float));
    std::transform(s.weight.data(), s.weight.data() + weight.size(), weight.begin(), [](float w) {
        return static_cast<std::uint8_t>(w > 0 ? std::clamp(w * 255.0f + 0.5f, 1.0f, 255.0f)
                                               : 0.0f);
    });
    const std::vector<std::int16_t> luma = luma_codes(s.luma);
    const std::vector<std::int16_t> paint =
        luma_codes(s.paint.empty() ? ImageF1(s.luma.size()) : s.paint);
    const std::vector<std::int16_t> daylight =
        luma_codes(s.daylight.empty() ? ImageF1(s.luma.size()) : s.daylight);
    return ByteWriter()
        .value(s.full)
        .value(s.downscale)
        .value(s.box)
        .value(s.floor)
        .value(s.print.confidence)
        .raw(luma.data(), luma.size() * sizeof luma[0])
        .raw(paint.data(), paint.size() * sizeof paint[0])
        .raw(daylight.data(), daylight.size() * sizeof daylight[0])
        .raw(weight.data(), weight.size())
        .take();
}

Bytes encode(const FocusReading& focus) {
    return ByteWriter()
        .value(focus.blur_px)
        .value(focus.error_px)
        .value(focus.confidence)
        .value(focus.slope)
        .value(static_cast<std::uint8_t>(focus.has_lens ? 1 : 0))
        .value(focus.lens)
        .take();
}

Bytes encode(const GrainModel& grain) {
    return ByteWriter().value(grain.deviation).value(grain.kernel).value(grain.mix).take();
}

Bytes encode(const ImageU8x3& picture) {
    return ByteWriter().value(picture.size()).raw(picture.data(), picture.size_bytes()).take();
}

Bytes encode(float number) {
    return ByteWriter().value(number).take();
}

Expected<StoredMatte> decode_matte(const Bytes& bytes) {
    ByteReader reader(bytes);
    Size size;
    StoredMatte out;
    reader.value(size).value(out.confidence);
    if (!reader.ok() || !sane(size) || !reader.holds(area(size), 1)) return damaged("matte");
    out.matte = Matte(size);
    reader.raw(out.matte.data(), out.matte.size_bytes());
    const auto read_if_any = [&](auto& image) {
        std::uint8_t any = 0;
        reader.value(any);
        if (any == 0 || !reader.ok()) return reader.ok();
        if (!reader.holds(area(size), sizeof(*image.data()))) return false;
        image = std::decay_t<decltype(image)>(size);
        reader.raw(image.data(), image.size_bytes());
        return reader.ok();
    };
    if (!read_if_any(out.followed) || !read_if_any(out.since)) return damaged("matte");
    reader.value(out.since_confidence);
    if (!reader.complete()) return damaged("matte");
    return out;
}

namespace {

Expected<LatticeField> read_lattice(ByteReader& reader, const char* what) {
    Size full;
    int spacing = 0;
    reader.value(full).value(spacing);
    if (!reader.ok() || !sane(full) || spacing < 1 || spacing > kLargestSide) return damaged(what);
    const double cells = area({full.width / spacing, full.height / spacing});
    if (!reader.holds(cells, 2 * sizeof(float))) return damaged(what);
    LatticeField out(full, spacing);
    reader.raw(out.nodes().data(), out.nodes().size_bytes());
    return out;
}

}  // namespace

Expected<LatticeField> decode_lattice(const Bytes& bytes) {
    ByteReader reader(bytes);
    WEFT_TRY(out, read_lattice(reader, "motion"));
    if (!reader.complete()) return damaged("motion");
    return out;
}

Expected<FormMap> decode_form(const Bytes& bytes) {
    ByteReader reader(bytes);
    FormMap out;
    WEFT_TRY(displacement, read_lattice(reader, "form"));
    out.displacement = std::move(displacement);
    FormFinding& f = out.finding;
    std::uint8_t plane = 0, no_parallax = 0;
    reader.value(out.origin).value(f.source).value(plane).value(f.frames).value(f.belief);
    reader.value(f.tilt_deg).value(f.tilt_error_deg).value(f.fov_deg);
    float aspect = 1;
    reader.value(f.fov_error_deg).value(f.fov_regions).value(no_parallax).value(aspect);
    reader.value(out.relief_fov_deg);
    out.aspect = PixelAspect(static_cast<double>(aspect));
    f.plane = plane != 0;
    f.no_parallax = no_parallax != 0;
    if (out.relief_fov_deg != 0) {
        if (!(out.relief_fov_deg > 0 && out.relief_fov_deg < 180)) return damaged("form");
        WEFT_TRY(relief, read_lattice(reader, "form"));
        out.relief = std::move(relief);
    }
    if (!reader.complete() || !std::isfinite(out.origin.x + out.origin.y) || !(aspect > 0) ||
        f.source > FormFinding::Source::kLines || !(f.belief >= 0 && f.belief <= 1))
        return damaged("form");
    return out;
}

Expected<Shading> decode_shading(const Bytes& bytes) {
    ByteReader reader(bytes);
    Shading out;
    Size size;
    reader.value(out.full).value(out.downscale).value(size);
    const int d = out.downscale;
    if (!reader.ok() || !sane(out.full) || d < 1 || d > kLargestSide) return damaged("light");
    if (size != Size{(out.full.width + d - 1) / d, (out.full.height + d - 1) / d} ||
        !reader.holds(area(size), sizeof(std::uint16_t))) {
        return damaged("light");
    }
    std::vector<std::uint16_t> codes(static_cast<std::size_t>(size.width) *
                                     static_cast<std::size_t>(size.height));
    std::uint8_t has_sure = 0;
    reader.raw(codes.data(), codes.size() * sizeof codes[0]).value(has_sure);
    if (!reader.ok()) return damaged("light");
    if (has_sure != 0) {
        out.sure = Matte(size);
        reader.raw(out.sure.data(), out.sure.size_bytes());
    }
    if (!reader.complete()) return damaged("light");
    out.value = ImageF1(size);
    std::transform(codes.begin(), codes.end(), out.value.data(), from_log_code);
    return out;
}

Expected<StillSurface> decode_still_surface(const Bytes& bytes) {
    ByteReader reader(bytes);
    StillSurface out;
    reader.value(out.box).value(out.pixel_px).value(out.usual).value(out.confidence);
    const bool bounded = std::abs(static_cast<double>(out.box.x0)) < kLargestSide &&
                         std::abs(static_cast<double>(out.box.y0)) < kLargestSide;
    if (!reader.ok() || !bounded || !(out.pixel_px > 0 && out.pixel_px < kLargestSide) ||
        !std::isfinite(out.usual) || !(out.confidence >= 0 && out.confidence <= 1))
        return damaged("gloss");
    if (out.box.empty()) return reader.complete() ? Expected<StillSurface>(out) : damaged("gloss");
    if (!sane(out.box.size()) || !reader.holds(area(out.box.size()), 7)) return damaged("gloss");
    out.colour = ImageF3(out.box.size());
    out.known = ImageF1(out.box.size());
    std::vector<std::uint16_t> codes(out.colour.size_bytes() / sizeof(float));
    std::vector<std::uint8_t> known(out.known.size_bytes() / sizeof(float));
    if (!reader.raw(codes.data(), codes.size() * sizeof codes[0])
             .raw(known.data(), known.size())
             .complete())
        return damaged("gloss");
    std::transform(codes.begin(), codes.end(), out.colour.data(), from_log_code);
    std::transform(known.begin(), known.end(), out.known.data(),
                   [](std::uint8_t k) { return k != 0 ? 1.0f : 0.0f; });
    return out;
}

Expected<SurfaceSample> decode_light_sample(const Bytes& bytes) {
    ByteReader reader(bytes);
    SurfaceSample s;
    reader.value(s.full).value(s.downscale).value(s.box).value(s.floor).value(s.print.confidence);
    if (!reader.ok() || !sane(s.full) || s.downscale < 1 || s.downscale > kLargestSide ||
        !(s.floor >= 0) || !(s.print.confidence >= 0 && s.print.confidence <= 1)) {
        return damaged("light");
    }
    if (s.box.empty()) return s;
    const Recti frame = rect_of(reduced_size(s.full, s.downscale));
    if (s.box.intersected(frame) != s.box || !reader.holds(area(s.box.size()), 7)) {
        return damaged("light");
    }
    s.weight = ImageF1(s.box.size());
    const std::size_t n = s.weight.size_bytes() / sizeof(float);
    std::vector<std::int16_t> luma(n), paint(n), daylight(n);
    std::vector<std::uint8_t> weight(n);
    if (!reader.raw(luma.data(), n * sizeof luma[0])
             .raw(paint.data(), n * sizeof paint[0])
             .raw(daylight.data(), n * sizeof daylight[0])
             .raw(weight.data(), n)
             .complete()) {
        return damaged("light");
    }
    s.luma = from_luma_codes(luma, s.box.size());
    s.paint = from_luma_codes(paint, s.box.size());
    s.daylight = from_luma_codes(daylight, s.box.size());
    std::transform(weight.begin(), weight.end(), s.weight.data(),
                   [](std::uint8_t w) { return static_cast<float>(w) / 255.0f; });
    return s;
}

Expected<FocusReading> decode_focus(const Bytes& bytes) {
    ByteReader reader(bytes);
    FocusReading focus;
    std::uint8_t has_lens = 0;
    reader.value(focus.blur_px)
        .value(focus.error_px)
        .value(focus.confidence)
        .value(focus.slope)
        .value(has_lens)
        .value(focus.lens);
    if (!reader.complete()) return damaged("focus");
    focus.has_lens = has_lens != 0;
    return focus;
}

Expected<GrainModel> decode_grain(const Bytes& bytes) {
    ByteReader reader(bytes);
    GrainModel grain;
    reader.value(grain.deviation).value(grain.kernel).value(grain.mix);
    if (!reader.complete()) return damaged("grain");
    return grain;
}

Expected<ImageU8x3> decode_picture(const Bytes& bytes) {
    ByteReader reader(bytes);
    Size size;
    reader.value(size);
    if (!reader.ok() || !sane(size) || !reader.holds(area(size), 3)) return damaged("texture");
    ImageU8x3 out(size);
    if (!reader.raw(out.data(), out.size_bytes()).complete()) return damaged("texture");
    return out;
}

Expected<float> decode_number(const Bytes& bytes) {
    ByteReader reader(bytes);
    float number = 0;
    reader.value(number);
    if (!reader.complete() || !std::isfinite(number)) return damaged("number");
    return number;
}

}  // namespace weft
