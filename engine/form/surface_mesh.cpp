#include "engine/form/surface_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "engine/core/short_number.h"

namespace weft {
namespace {

bool shows_any(ViewU8x1 matte, int x0, int y0, int step) {
    for (int y = y0; y < std::min(y0 + step, matte.height()); ++y)
        for (int x = x0; x < std::min(x0 + step, matte.width()); ++x)
            if (matte.row(y)[x] > 127) return true;
    return false;
}

std::string corner_text(Vec3 p, const char* between) {
    return short_number(static_cast<double>(p.x)) + between +
           short_number(static_cast<double>(p.y)) + between +
           short_number(static_cast<double>(p.z));
}

std::string texture_text(Vec2 uv, const char* between) {
    return short_number(static_cast<double>(uv.x), 7) + between +
           short_number(static_cast<double>(uv.y), 7);
}

void add_bytes(std::string& out, std::uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8)
        out += static_cast<char>(static_cast<unsigned char>(value >> shift));
}

void add_bytes(std::string& out, float value) {
    add_bytes(out, std::bit_cast<std::uint32_t>(value));
}

}  // namespace

SurfaceMesh mesh_over(ViewU8x1 matte, int reference, int step_px) {
    SurfaceMesh out;
    out.picture = {matte.width(), matte.height()};
    out.reference = reference;
    const int columns = (matte.width() + step_px - 1) / step_px;
    const int rows = (matte.height() + step_px - 1) / step_px;
    std::vector<std::uint32_t> index(
        static_cast<std::size_t>(columns + 1) * static_cast<std::size_t>(rows + 1), ~0U);
    std::vector<Vec3>& corners = out.corners[reference];
    const Vec2 size(static_cast<float>(matte.width()), static_cast<float>(matte.height()));
    const auto corner = [&](int i, int j) {
        std::uint32_t& at =
            index[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns + 1) +
                  static_cast<std::size_t>(i)];
        if (at == ~0U) {
            at = static_cast<std::uint32_t>(corners.size());
            const Vec2 p(static_cast<float>(i * step_px), size.y - static_cast<float>(j * step_px));
            corners.emplace_back(p, 0.0f);
            out.uv.push_back(p / size);
        }
        return at;
    };
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i)
            if (shows_any(matte, i * step_px, j * step_px, step_px))
                out.faces.push_back(
                    {corner(i, j), corner(i, j + 1), corner(i + 1, j + 1), corner(i + 1, j)});
    return out;
}

std::string mesh_obj(const SurfaceMesh& mesh, std::string_view name) {
    std::string text = fmt::format("# Reference frame {}, {}x{}; a unit is a pixel\no {}\n",
                                   mesh.reference, mesh.picture.width, mesh.picture.height, name);
    for (const Vec3 p : mesh.corners.at(mesh.reference))
        text += "v " + corner_text(p, " ") + "\n";
    for (const Vec2 uv : mesh.uv)
        text += "vt " + texture_text(uv, " ") + "\n";
    for (const auto& face : mesh.faces) {
        text += "f";
        for (const std::uint32_t k : face)
            text += fmt::format(" {0}/{0}", k + 1);
        text += "\n";
    }
    return text;
}

std::string mesh_pc2(const SurfaceMesh& mesh, const std::vector<int>& frames) {
    const int first = frames.front(), last = frames.back();
    std::string out("POINTCACHE2\0", 12);
    add_bytes(out, std::uint32_t{1});
    add_bytes(out, static_cast<std::uint32_t>(mesh.uv.size()));
    add_bytes(out, static_cast<float>(first));
    add_bytes(out, 1.0f);  // frames between two samples
    add_bytes(out, static_cast<std::uint32_t>(last - first + 1));
    for (int frame = first; frame <= last; ++frame) {
        const auto after = std::lower_bound(frames.begin(), frames.end(), frame);
        const auto before = *after == frame ? after : after - 1;
        const float t = after == before ? 0.0f
                                        : static_cast<float>(frame - *before) /
                                              static_cast<float>(*after - *before);
        const std::vector<Vec3>&a = mesh.corners.at(*before), &b = mesh.corners.at(*after);
        for (std::size_t k = 0; k < a.size(); ++k) {
            const Vec3 p = a[k] + t * (b[k] - a[k]);
            add_bytes(out, p.x), add_bytes(out, p.y), add_bytes(out, p.z);
        }
    }
    return out;
}

std::string mesh_usd(const SurfaceMesh& mesh, std::string_view name, const std::vector<int>& frames,
                     double fps) {
    const std::string rate = short_number(fps, 6);
    std::string text = fmt::format(
        "#usda 1.0\n(\n    defaultPrim = \"{0}\"\n    startTimeCode = {1}\n    endTimeCode = {2}\n"
        "    timeCodesPerSecond = {3}\n    framesPerSecond = {3}\n    upAxis = \"Y\"\n)\n\n"
        "def Mesh \"{0}\"\n{{\n    uniform token subdivisionScheme = \"none\"\n"
        "    int[] faceVertexCounts = [",
        name, frames.front(), frames.back(), rate);
    for (std::size_t k = 0; k < mesh.faces.size(); ++k)
        text += k == 0 ? "4" : ", 4";
    text += "]\n    int[] faceVertexIndices = [";
    for (const auto& face : mesh.faces)
        for (const std::uint32_t k : face)
            text += fmt::format("{}{}", text.back() == '[' ? "" : ", ", k);
    text += "]\n    texCoord2f[] primvars:st = [";
    for (const Vec2 uv : mesh.uv)
        text += (text.back() == '[' ? "(" : ", (") + texture_text(uv, ", ") + ")";
    text +=
        "] (\n        interpolation = \"vertex\"\n    )\n    point3f[] points.timeSamples = {\n";
    for (const int frame : frames) {
        text += fmt::format("        {}: [", frame);
        for (const Vec3 p : mesh.corners.at(frame))
            text += (text.back() == '[' ? "(" : ", (") + corner_text(p, ", ") + ")";
        text += "],\n";
    }
    return text + "    }\n}\n";
}

}  // namespace weft
