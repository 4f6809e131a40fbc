#include "tests/cli/node_trees.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace weft::test {

std::vector<std::string> exr_channels(const std::string& path) {
    const auto file = OIIO::ImageInput::open(path);
    EXPECT_TRUE(file) << path;
    return file ? file->spec().channelnames : std::vector<std::string>();
}

ImageF1 exr_channel(const std::string& path, const std::string& name) {
    const auto file = OIIO::ImageInput::open(path);
    EXPECT_TRUE(file) << path;
    if (!file) return ImageF1(1, 1);
    const OIIO::ImageSpec& spec = file->spec();
    const int channel = spec.channelindex(name);
    EXPECT_GE(channel, 0) << path << " has no channel " << name;
    ImageF1 out(spec.width, spec.height);
    if (channel < 0) return out;
    EXPECT_TRUE(file->read_image(0, 0, channel, channel + 1, OIIO::TypeDesc::FLOAT, out.data()));
    return out;
}

Rgba read_rgba(const std::string& path) {
    const std::vector<std::string> names = exr_channels(path);
    Rgba out;
    for (int c = 0; c < 3; ++c)
        out[static_cast<std::size_t>(c)] = exr_channel(path, std::string(1, "RGB"[c]));
    if (std::find(names.begin(), names.end(), "A") != names.end())
        out[3] = exr_channel(path, "A");
    else
        out[3] = ImageF1(out[0].size(), 1.0f);
    return out;
}

float sample(const ImageF1& picture, float s, float t, bool wraps) {
    const int w = picture.width(), h = picture.height();
    const float x = s * static_cast<float>(w) - 0.5f, y = (1 - t) * static_cast<float>(h) - 0.5f;
    const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    const float u = x - static_cast<float>(i), v = y - static_cast<float>(j);
    const auto at = [&](int a, int b) {
        if (!wraps) return picture.at(std::clamp(a, 0, w - 1), std::clamp(b, 0, h - 1));
        return picture.at(((a % w) + w) % w, ((b % h) + h) % h);
    };
    return (1 - v) * ((1 - u) * at(i, j) + u * at(i + 1, j)) +
           v * ((1 - u) * at(i, j + 1) + u * at(i + 1, j + 1));
}

float linear_from_srgb(float code) {
    return code <= 0.04045f ? code / 12.92f : std::pow((code + 0.055f) / 1.055f, 2.4f);
}

}  // namespace weft::test
